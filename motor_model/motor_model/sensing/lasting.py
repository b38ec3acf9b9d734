"""Follow how long a motor has been driven without an edge, by what turns any motor that is meant for its voltage.

A single low sample, or a change of direction every few seconds, lets a blocked motor cool as little as none: time that
is not driven is taken from what was driven, and what was driven the other way before counts, too, where it was LONG
enough to show an edge. Short pushes to and fro do not: a motor may turn within a slot by them.
"""

from dataclasses import dataclass

LONG = 4  # stall times: at a quarter of its voltage a motor shows an edge in half of that, and what it takes to start


@dataclass(frozen=True)
class Lasting:
    """What was driven since the latest edge; all times in ns."""

    way: int = 0  # that it was driven last
    push: int = 0  # that way, since it turned, less what was not driven
    before: int = 0  # likewise of the LONG pushes before that one

    @property
    def time(self) -> int:
        """How long it has been driven, all in all."""
        return self.push + self.before

    def see(self, direction: int, dt: int, edge: bool, stall_time: float) -> "Lasting":
        """What it is after dt, with a sample that drives in a direction (0: none), and at which an edge came or not.

        `stall_time` is in seconds.
        """
        if edge or self.way == 0:
            return Lasting(direction)
        if direction == 0 and self.time == 0:
            return Lasting()
        if direction == 0:
            left = max(self.before - max(dt - self.push, 0), 0)
            return Lasting(self.way, max(self.push - dt, 0), left)
        if direction == self.way:
            return Lasting(self.way, self.push + dt, self.before)
        kept = self.push if self.push >= LONG * stall_time * 1e9 else 0
        return Lasting(direction, 0, self.before + kept)
