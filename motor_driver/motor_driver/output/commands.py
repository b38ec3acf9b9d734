"""Which duty was sent under which number: what a board obeys under a number of ours is what was sent with it."""

from motor_driver.frames.from_board import Telemetry
from motor_driver.frames.from_host import Command, Enable, FromHost

KEPT = 256  # numbers, a power of two; what is older is not known any more


class Commands:
    """The latest frames by number: the duty of each command, and of the one before it, which a sample may show."""

    def __init__(self) -> None:
        self._kept: list[tuple[int, tuple[int, int] | None]] = [(-1, None)] * KEPT
        self._duty = 0  # [1/pwm_top] of the latest command

    def send(self, frame: FromHost, number: int) -> None:
        """Keep a frame that is sent under a number."""
        duties = None
        if isinstance(frame, Command):
            duties, self._duty = (frame.duty, self._duty), frame.duty
        elif isinstance(frame, Enable):
            duties, self._duty = (0, 0), 0
        self._kept[number % KEPT] = number, duties

    def disagree(self, frame: Telemetry) -> bool:
        """Tell whether a board that is on obeys, under a number of ours, what was not sent with it.

        0 is always right: a board begins with it, and until 1.4.3 under a number that somebody else had sent before.
        """
        number, duties = self._kept[frame.command % KEPT]
        if number != frame.command or frame.duty == 0:
            return False
        return duties is None or frame.duty not in duties
