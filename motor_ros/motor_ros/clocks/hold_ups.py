"""Notice that this process stood still, after which old messages come."""

import time
from collections.abc import Callable
from math import inf

from rclpy.node import Node

from motor_ros.clocks.steady_timer import steady_timer

LOOK_FOR_HOLD_UPS_EVERY = 0.1  # [s]
HELD_UP = 1.0  # [s] without a look, after which nobody expects what he has sent meanwhile to happen now
LATE_MESSAGES = 3.5  # [s] after it in which old messages may come: writers ask every 3 s who has missed some
STOOD_STILL = (
    "What was asked for while this node stood still (Ctrl-Z, a suspended or overloaded computer) is not obeyed, nor "
    f"what comes within {LATE_MESSAGES:g} s after it, but for 0: ask again then."
)


def boot_time() -> float:
    """Read a clock [s] that nobody sets, and that goes on while the computer is suspended."""
    return time.clock_gettime(time.CLOCK_BOOTTIME)


class HoldUps:
    """Notices that this process stood still: what comes then may have been sent long ago, and says not when.

    It is made before whatever may hold old messages, so that none of them is missed: a process may stand still in the
    first instant, too. But a start may take its time: after one that did, a message is as old as its sender says.
    """

    def __init__(self, node: Node, clock: Callable[[], float] = boot_time) -> None:
        """`clock` [s] goes on while the computer is suspended."""
        self._clock = clock
        self._looked, self._woke = clock(), -inf
        self._looks, self._began_late = 0, False
        steady_timer(node, LOOK_FOR_HOLD_UPS_EVERY, self._look)

    def in_doubt(self) -> bool:
        """Whether a message that comes now may be an old one."""
        self._look()
        return self._looked - self._woke <= LATE_MESSAGES

    def bars(self, waited: int) -> bool:
        """Whether a message that comes now, and has waited for so long [ns] if nobody's clock is wrong, may be old."""
        return self.in_doubt() and (waited > HELD_UP * 1e9 or not self._began_late)

    def _look(self) -> None:
        now = self._clock()
        if now - self._looked > HELD_UP:
            self._woke, self._began_late = now, self._looks == 0
        self._looks += 1
        self._looked = now
