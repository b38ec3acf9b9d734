"""Let a node go on when the system's clock is set back."""

import threading
import time
from collections.abc import Callable

from rclpy.executors import Executor
from rclpy.node import Node

LOOK_AT_CLOCK_EVERY = 0.05  # [s]
SET_BACK = 0.01  # [s] in that time, and more; less makes a timer late by less than two samples, once


class ClockWatch:
    """Lets a node's timers begin anew when the system's clock is set back: executors may wait until it has come again.

    Those of ROS 2 from PyPI do (`pthread_cond_timedwait` goes by that clock), for an hour where it was set by an hour.
    """

    def __init__(
        self, node: Node, executor: Executor, ahead: Callable[[], float] = lambda: time.time() - time.monotonic()
    ) -> None:
        """`ahead` [s]: how much the system's clock is ahead of one that is never set."""
        self._node, self._executor, self._ahead = node, executor, ahead
        self._was, self._over = ahead(), False
        self._thread = threading.Thread(target=self._run, daemon=True)

    def __enter__(self) -> None:
        self._thread.start()

    def __exit__(self, *_: object) -> None:
        self._over = True
        self._thread.join()

    def look(self) -> None:
        """Look at the clocks once."""
        before, self._was = self._was, self._ahead()
        if self._was < before - SET_BACK:
            for timer in self._node.timers:
                timer.reset()
            self._executor.wake()

    def _run(self) -> None:
        while not self._over:
            time.sleep(LOOK_AT_CLOCK_EVERY)
            self.look()
