"""Tell references that begin from those that go on: one home for when a motor that waits may be driven again.

Whoever goes on sending has not seen what ended the last reference, be it a plant that was restarted, away, or switched
off, or a stop: his motor would start by itself. References begin with 0 (the one after a 0 does, too), or after a
silence that is long beside the time between them.

Of a sender that is known (`senders`) a second one that asks for the same may be of a stream as well, however long after
the first: there is no time between two to go by. Then it has to be silent for longest.

What comes more seldom than any of that is somebody's who sends by hand, unless the times between are even: a schedule,
or a loop of a shell, which knows nothing of a motor that has stopped.
"""

from dataclasses import dataclass
from math import inf, isnan, nan

# [s] The shortest silence after which references begin: longer than any hiccup of a stream. And the longest time
# between two that are a stream (`ros2 topic pub` sends one a second); what comes more seldom, somebody sends by hand.
SHORTEST, LONGEST = 0.5, 2.0
# [s] The same where they are one sender's: a schedule has a time between two that hands have, too.
LONGEST_OF_ONE = 10.0
TIMES = 2.0  # the longest time between two of them, which is a silence
# Share of it by which the time between two may differ from the one before: a loop that sleeps for some seconds between
# commands, each of which takes a second or two to start, is that even. Of hands one in 400 is, twice one after the
# other, if they take between half and twice as long.
EVEN = 0.05

GOES_ON = "{} References that go on coming are not obeyed until they begin again, with 0 or after a silence of {:g} s."


@dataclass(frozen=True, slots=True)
class Sequence:
    """References that came one after the other, obeyed or not; times [s] are on the clock of `now`."""

    heard: float | None = None  # when the latest one came
    begins: bool = False  # with it
    stops: bool = False  # it was a speed of 0
    between: float = 0.0  # the longest time between two of them that are a stream
    longest: float = LONGEST  # [s] between two that are a stream
    single: float = nan  # what a known sender asked for, of which no other has been heard yet
    latest: float = nan  # the time between the latest two
    even: bool = False  # and it was as long as the one before

    @property
    def silence(self) -> float:
        """[s] without any, after which references begin."""
        return min(max(SHORTEST, TIMES * self.between), self.longest)

    @property
    def needed(self) -> float:
        """[s] of silence after which references begin, whatever the next one asks for."""
        least = self.silence if isnan(self.single) else self.longest
        return max(least, TIMES * self.latest) if self.even else least

    def hear(self, now: float, stops: bool, value: float = nan, steps: int = 1) -> "Sequence":
        """Take one more, which is a speed of 0 or not; value: what a known sender asks for.

        steps: how many it has sent since the latest that was heard; the lost ones share the time between the two.
        """
        silence = inf if self.heard is None else (now - self.heard) / steps
        between = max(self.between, silence) if silence <= self.longest else 0.0
        needed = self.longest if value == self.single else self.silence
        single = value if self.heard is None else nan
        even = abs(silence - self.latest) <= EVEN * self.latest  # False of nan
        latest = silence if silence < inf else nan
        begins = stops or self.stops or (silence > needed and not (even and self.even))
        return Sequence(now, begins, stops, between, self.longest, single, latest, even)
