"""Follow edges that a board has no time to count: the motor is faster than its speed says, or the line picks up noise.

A board that hears more edges than it can count leaves some out, and says so: once at most in each of its steps. The
speed is then that of the edges that were heard, and a loop that holds it drives the motor faster than it was asked to.
Noise for a moment (a contact, a motor that is plugged in) does the same for a few steps; MOST of them within WINDOW do
not come of that, and under a voltage the motor is stopped.
"""

from dataclasses import dataclass
from math import ceil

WINDOW = 200_000_000  # [ns]
MOST = 20  # steps with edges left out in it: half of those of a board that steps as slowly as it can
STEP = 5_000_000  # [ns] of a board at most: samples that are further apart have several

SHED = (
    "edges came faster than the board can count them, again and again: speed and count are wrong then, and the motor "
    "may be faster than they say; see the encoder's cable and supply for noise, or take an encoder with fewer edges "
    "(two channels: count less with quadrature 2)"
)


@dataclass(frozen=True, slots=True)
class ShedEdges:
    """Samples of the latest WINDOW in which edges were left out; what comes without a voltage does not count."""

    seen: tuple[tuple[int, int], ...] = ()  # sample time [ns], steps
    latest: int | None = None  # [ns] sample time

    def see(self, now: int, times: int, driven: bool) -> "ShedEdges":
        """See a sample at `now` [ns], in which so many times edges were left out since the one before.

        A sample counts for as many steps as it has: however many times noise is seen in one, it is one burst.
        """
        if not driven:
            return ShedEdges((), now)
        passed = now - self.latest if self.latest is not None else 0
        steps = min(times, max(ceil(passed / STEP), 1))
        recent = tuple(one for one in self.seen if now - one[0] < WINDOW)
        return ShedEdges((*recent, (now, steps)) if steps > 0 else recent, now)

    @property
    def stop(self) -> str:
        """Why the motor has to be switched off, as a clause; empty if it may go on."""
        return SHED if sum(steps for _, steps in self.seen) > MOST else ""
