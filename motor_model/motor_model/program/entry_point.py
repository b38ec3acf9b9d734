"""Start a program so that Ctrl-C ends it from its first import on, silently and at once.

What a program imports takes some tenths of a second, before anything of its own can hear a signal; until then Python
would show where among a thousand modules it was. Nothing has begun that would have to be taken back. Who starts it may
hold the signal back until Python itself has started.
"""

import signal
import sys
from collections.abc import Callable

from motor_model.program.memory import explain, lacks_memory, refuse_to_start

Main = Callable[[], int]


def entry_point(load: Callable[[], Main]) -> Main:
    """Make the program of a function that imports its `main`."""

    def start() -> int:
        """Import, and run."""
        heard = signal.getsignal(signal.SIGINT)
        if heard is signal.default_int_handler:  # a script's `&` has it ignored
            signal.signal(signal.SIGINT, signal.SIG_DFL)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
        if refusal := refuse_to_start():
            print(refusal, file=sys.stderr)
            return 1
        try:
            main = load()
        except (MemoryError, ImportError, OSError, RuntimeError, SystemError) as error:
            if not lacks_memory(error):
                raise
            print(explain(error), file=sys.stderr)
            return 1
        signal.signal(signal.SIGINT, heard)
        return main()

    start.__name__, start.__doc__ = load.__name__, load.__doc__
    return start


def hold_interrupt_back() -> None:
    """Have a Ctrl-C wait until the `entry_point` of the program that this process becomes."""
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})


def is_interrupted_import(error: BaseException) -> bool:
    """Tell whether an import failed because of Ctrl-C: compiled modules say that they could not be initialised."""
    cause: BaseException | None = error if isinstance(error, ImportError | SystemError) else None
    while cause is not None and not isinstance(cause, KeyboardInterrupt):
        cause = cause.__cause__ or cause.__context__
    return cause is not None
