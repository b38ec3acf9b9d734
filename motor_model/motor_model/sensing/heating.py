"""Follow what heats a motor that shows no edge: the mean square of its voltage, however that comes and goes.

A voltage that comes and goes, or turns to and fro, is never strong for long; in the mean square over MEAN_OVER stall
times it may be no more than a strong one, which is what heats a motor that does not turn.

But a motor that turns to and fro within a slot shows no edge either: a chirp on a coarse disc. Where a push one way is
less than TURNED of what has brought an edge before (it may have to end a motion first), it does not count for that
mean; a second one, which is taken over PATIENT times as long, counts every push: a chirp over all the voltage, half of
it in the mean square, has 11 stall times.

A motor that has been heated is still warm after a stop: where this state lives on (the simulator's does), one that is
switched on again within a few stall times, and shows no edge, is stopped sooner; an edge ends that.
"""

from dataclasses import dataclass
from math import exp, sqrt

from motor_model.frozen_record import replace

MEAN_OVER = 4.0  # stall times
TURNED, PATIENT = 2.0, 4.0


@dataclass(frozen=True)
class Heating:
    """What the voltage, as a share of the motor's, has done since the latest edge; times in seconds."""

    heat: float = 0.0  # [s] mean square of the pushes that count, times the time that it is taken over
    warmth: float = 0.0  # [s] likewise of all, over PATIENT times that
    way: int = 0  # direction of the latest voltage that was not 0
    push: float = 0.0  # [s] of the motor's voltage that way, since it turned
    needed: float = 0.0  # [s] the same until an edge came, the first one after it had turned; 0: not known
    brought: bool = False  # an edge has come since it turned

    def see(self, share: float, dt: float, edge: bool, stall_time: float) -> "Heating":
        """What it is after a voltage for dt [s], at the end of which an edge came, or none."""
        way = (share > 0.0) - (share < 0.0) or self.way
        push = (self.push if way == self.way else 0.0) + abs(share) * dt
        brought = self.brought and way == self.way
        needed = push if edge and not brought else self.needed
        counts = push >= TURNED * needed  # where nothing is known, every push does
        time = MEAN_OVER * stall_time
        return replace(
            self,
            heat=0.0 if edge else _follow(self.heat, share if counts else 0.0, dt, time),
            warmth=0.0 if edge else _follow(self.warmth, share, dt, PATIENT * time),
            way=way,
            push=push,
            needed=needed,
            brought=brought or edge,
        )

    def excess(self, most: float, stall_time: float) -> tuple[float, float] | None:
        """The root mean square, if it is `most` or more, and the time [s] that it was taken over."""
        time = MEAN_OVER * stall_time
        for heat, over in ((self.heat, time), (self.warmth, PATIENT * time)):
            if heat >= most**2 * over > 0.0:
                return sqrt(heat / over), over
        return None


def _follow(heat: float, share: float, dt: float, time: float) -> float:
    """Follow a mean square over a time [s], which 0 switches off."""
    if time == 0.0:
        return 0.0
    kept = exp(-dt / time)
    return heat * kept + share**2 * time * (1.0 - kept)
