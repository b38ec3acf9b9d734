"""Count a motor's stops: whoever goes on after each of them gets the motor later and later.

A fault is known after some tenths of a second, at up to all the voltage. Somebody who has seen to it and goes on needs
that once or twice. A supervisor that answers every stop by itself runs the motor against the fault for ever: two
channels that are exchanged got a quarter of the voltage on average, a blocked shaft 0.39 of it. So the first stop may
be ended at once, and after each further one the motor rests, twice as long as the time before: a fault of 0.4 s gets
the motor for an 80th of the time in the end. Times are [s] on a clock that is never set.
"""

from dataclasses import dataclass
from math import ceil

FIRST, LONGEST = 1.0, 32.0  # [s] of rest after the second stop, and at most
FORGET = 60.0  # [s] without a stop after which the next one is the first again
REFUSED = "It has stopped {count} times, each within a minute of the one before: see to the cause, and wait {left} s."
ANNOUNCED = (
    "It is stop number {count}, each within a minute of the one before: {call} is refused for {rest:g} s after it."
)


@dataclass(frozen=True, slots=True)
class RepeatedStops:
    """How many stops came one after the other."""

    count: int = 0
    latest: float = 0.0  # [s]

    def stop(self, now: float) -> "RepeatedStops":
        """Count one more."""
        return RepeatedStops(self.count + 1 if self.count and now - self.latest <= FORGET else 1, now)

    @property
    def rest(self) -> float:
        """[s] after the latest stop for which the motor rests."""
        return min(FIRST * 2.0 ** min(self.count - 2, 30), LONGEST) if self.count > 1 else 0.0

    def refuse(self, now: float) -> str:
        """Say why nobody may go on yet, as a sentence; empty if they may."""
        left = self.latest + self.rest - now
        return REFUSED.format(count=self.count, left=ceil(left)) if self.count > 1 and left > 0.0 else ""

    def announce(self, call: str) -> str:
        """Say what follows from the latest stop for a service that goes on, as a sentence; empty if nothing does."""
        return ANNOUNCED.format(count=self.count, call=call, rest=self.rest) if self.count > 1 else ""
