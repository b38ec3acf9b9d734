"""The board's output switch from the driver's side: on only when the user has said so, off when in doubt."""

from enum import Enum, auto

from motor_driver.frames.codes import Flag
from motor_driver.frames.from_board import Hello, Telemetry
from motor_driver.frames.from_host import Enable

ASK_EVERY = 10_000_000  # [ns]
ASKED = 10  # times that a board is asked to switch on, before it counts as deaf: a driver that stands still asks once
HELD_UP = "the board heard no command for too long and switched off"
OVERCURRENT = (
    "the motor's current was above current_limit, or above continuous_current for too long: see what holds the shaft, "
    "and the motor's wires, and let the motor cool before it goes on"
)
CURRENT_UNKNOWN = (
    "the board could not measure the motor's current for ten samples, and current_limit needs it: see whether more "
    "edges come than the board counts, and flash it again"
)
OWN_WAYS = Flag.TIMED_OUT | Flag.OVERCURRENT | Flag.CURRENT_UNKNOWN  # off, and only if it was on


def reason_off(frame: Telemetry) -> str:
    """Say why a board that was on has switched off, as a clause."""
    if frame.flags & Flag.TIMED_OUT:
        return HELD_UP
    if frame.flags & Flag.CURRENT_UNKNOWN:
        return CURRENT_UNKNOWN
    return OVERCURRENT if frame.flags & Flag.OVERCURRENT else "the board switched off"


class Output(Enum):
    """What is known of the board's output."""

    OFF = auto()
    TURNING_ON = auto()
    ON = auto()
    TURNING_OFF = auto()


class Switch:
    """Follows the user's wish until telemetry confirms it; time in ns is an argument."""

    def __init__(self) -> None:
        self.output = Output.OFF  # to configure is to switch off
        self._asked: int | None = None
        self._named: int | None = None  # latch in the latest enable, while turning on
        self._enables, self._since = 0, 0  # while turning on: how often that was asked for, and since when [ns]
        self._told = False  # while turning on: it was said what an enable is to name, which takes a while of its own
        self._doubted = False  # while turning on: that was said, and did not hold: an off was still under way
        self._off_at: int | None = None  # [ns] when it was last asked for to be off

    @property
    def listening(self) -> bool:
        """Whether the board may act on commands."""
        return self.output in (Output.ON, Output.TURNING_ON)

    def hear(self, frame: Telemetry, now: int = 0, longest: float = 0.0) -> bool:
        """Take what the board says at `now`; True if it has switched off by itself.

        An off that was asked for in the `longest` [ns] before may still have been under way when it said that it is on.
        """
        if frame.enabled:
            if self.output is Output.TURNING_ON:
                self.output = Output.ON
            elif self.output is Output.OFF:
                self._go(Output.TURNING_OFF)
            return False
        asked = self._off_at is not None and now - self._off_at <= longest and not frame.flags & OWN_WAYS
        fell = (self.output is Output.ON and not asked) or self._fell_unseen(frame)
        if fell or self.output is not Output.TURNING_ON:
            self.output = Output.OFF
        return fell

    def _fell_unseen(self, frame: Telemetry) -> bool:
        """Whether it was on after the enable, in frames that are lost, and has switched off by itself since."""
        turning_on = self.output is Output.TURNING_ON and self._named is not None
        return turning_on and frame.latch != self._named and bool(frame.flags & OWN_WAYS)

    def asks(self, wish: bool, named: Telemetry | Hello | None, now: int) -> Enable | None:
        """What to send at `now`, given what the user wants; `named` has boot and latch of a board that may be on."""
        if wish and self.output is Output.OFF:
            self._go(Output.TURNING_ON)
        elif not wish and self.listening:
            self._go(Output.TURNING_OFF)
        waiting = self.output in (Output.TURNING_ON, Output.TURNING_OFF)
        if not waiting or (self._asked is not None and now - self._asked < ASK_EVERY):
            return None
        self._asked = now
        if self.output is Output.TURNING_OFF:
            self._off_at = now
            return Enable(0)
        self._doubted = self._doubted or (named is None and self._told)
        if named is not None and not self._told:
            self._told, self._enables = True, 0
        self._enables, self._since = self._enables + 1, self._since if self._enables else now
        if named is None:
            return None
        self._named = named.latch
        return Enable(1, named.boot, named.latch)

    def unheard(self, now: int, longest: float, telling: float = 0.0) -> bool:
        """Whether at `now` the board has not switched on for more than `longest` [ns], however often it was asked.

        The same holds of one that is not to be switched on yet, however often it was to be: for `telling` [ns], if that
        is longer.
        """
        turning_on = self.output is Output.TURNING_ON
        most = longest if self._told and not self._doubted else max(longest, telling)
        return turning_on and self._enables >= ASKED and now - self._since > most

    def _go(self, output: Output) -> None:
        self.output, self._asked, self._named, self._enables = output, None, None, 0
        self._told = self._doubted = False
