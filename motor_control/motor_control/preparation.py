"""Prepare the observer's machine code: at the start at once, in a running loop beside it."""

import gc
import sys
import threading

BESIDE = 2e-4  # [s] for which the thread that prepares may keep the interpreter from the loop


class Preparation:
    """Loads (or compiles, the first time) what observer and feed-forward run on, once."""

    def __init__(self) -> None:
        self._thread: threading.Thread | None = None
        self._done = False

    @property
    def done(self) -> bool:
        """Whether all is loaded."""
        return self._done

    def now(self) -> None:
        """Prepare, and come back when it is done."""
        from motor_control import warm_up  # who never asks for a model does not wait for it

        warm_up.main()
        gc.collect()
        gc.freeze()  # what has been loaded stays: looking through it again would hold the loop up for 100 ms
        self._done = True

    def begin(self) -> None:
        """Prepare in a thread, so that a running loop keeps its voltage; nothing if that has begun or is done."""
        if self._thread is None and not self._done:
            self._thread = threading.Thread(target=self._beside, daemon=True)
            self._thread.start()

    def _beside(self) -> None:
        interval = sys.getswitchinterval()
        sys.setswitchinterval(BESIDE)
        try:
            self.now()
        finally:
            sys.setswitchinterval(interval)
