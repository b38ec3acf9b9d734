"""Follow how long a motor has been driven without an edge, by what turns any motor that is meant for its voltage.

A single low sample, or a change of direction every few seconds, lets a blocked motor cool as little as none: time that
is not driven is taken from what was driven, and what was driven the other way before counts, too, where it was LONG
enough to show an edge. A short push counts but for as much as the motor is driven back: it may turn to and fro within a
slot by that. Measured: what was dropped at every turn let 1.5 s one way and 10 ms the other heat a blocked motor for
ever.
"""

from dataclasses import dataclass

LONG = 4  # stall times: at a quarter of its voltage a motor shows an edge in half of that, and what it takes to start


@dataclass(frozen=True)
class Lasting:
    """What was driven since the latest edge; all times in ns."""

    way: int = 0  # that it was driven last
    push: int = 0  # that way, since it turned, less what was not driven
    before: int = 0  # likewise of the LONG pushes before that one
    undone: int = 0  # likewise of the other way, of short ones: as much of it as this push has not driven back yet

    @property
    def time(self) -> int:
        """How long it has been driven, all in all."""
        return self.push + self.before + self.undone

    def see(self, direction: int, dt: int, edge: bool, stall_time: float) -> "Lasting":
        """What it is after dt, with a sample that drives in a direction (0: none), and at which an edge came or not.

        `stall_time` is in seconds.
        """
        if edge or self.way == 0:
            return Lasting(direction)
        if direction == 0 and self.time == 0:
            return Lasting()
        if direction == 0:
            return self._cool(dt)
        if direction == self.way:
            return Lasting(self.way, self.push + dt, self.before, max(self.undone - dt, 0))
        if self.push >= LONG * stall_time * 1e9:
            return Lasting(direction, self.undone, self.before + self.push)
        return Lasting(direction, self.undone, self.before, self.push)

    def _cool(self, dt: int) -> "Lasting":
        """What it is after dt without being driven."""
        left = []
        for driven in (self.push, self.before, self.undone):
            left.append(max(driven - dt, 0))
            dt = max(dt - driven, 0)
        return Lasting(self.way, *left)
