"""Watch a plant that is driven: whether its clock goes on, it obeys, and it is no faster than is wanted. No clock."""

from dataclasses import dataclass
from math import inf

DEAF = 0.5  # [s] without any voltage, while there should be one, after which the output is off
HELD_UP = 1.0  # [s] from one sample to the next, after which nobody expects the motor to go on by itself
SILENCE = 1.0  # [s] without samples after which the plant is gone, or nobody has listened
TOO_FAST = 2  # samples in a row: a single one may be a flank that came early
OUTPUT_OFF = "The plant's output is off: call motor/enable with data: true"
STEPPED_BACK = "The plant's clock stepped back after {:.2f} s: was it restarted, or are there two?"
GONE = "The samples stopped after {:.2f} s: is the plant still running?"
PAUSED = (
    "No sample was answered for {:.1f} s after {:.2f} s, in which the motor got 0 V: the command or this computer was "
    "stopped (Ctrl-Z, suspended) or held up. Start anew."
)
BEYOND = (
    "The motor ran at {:.4g} rad/s after {:.2f} s, at {:.3g} V, above --speed {:g}, and was stopped: give less "
    "--voltage."
)


@dataclass(frozen=True, slots=True)
class Asked:
    """What a sample is the answer to."""

    voltage: float  # [V] the latest command
    heard: bool  # any bridge can follow that
    elapsed: float  # [s] since the plan began, of the sample before


@dataclass(frozen=True, slots=True)
class PlantWatch:
    """What is remembered from sample to sample."""

    limit: float = inf  # [rad/s]
    latest: int = 0  # [ns] on the plant's clock
    seen: float | None = None  # [s] on the caller's clock; None: what was before is of no matter
    too_fast: int = 0  # samples in a row
    deaf_since: float | None = None  # [s] on the caller's clock

    def see(self, time: int, speed: float, voltage: float, asked: Asked, now: float) -> tuple["PlantWatch", str]:
        """Take a sample in (time [ns], speed [rad/s], voltage [V]); what is wrong, as a sentence, stands beside it."""
        problem = STEPPED_BACK.format(asked.elapsed) if time <= self.latest else ""
        gap = 0.0 if self.seen is None else max((time - self.latest) * 1e-9, now - self.seen)
        if gap > HELD_UP:
            problem = PAUSED.format(gap, asked.elapsed)
        limited = self.limit < inf  # and what is no number is not within it
        too_fast = self.too_fast + 1 if limited and not abs(speed) <= self.limit else 0
        if too_fast >= TOO_FAST:
            problem = BEYOND.format(abs(speed), asked.elapsed, asked.voltage, self.limit)
        deaf_since = None if voltage != 0.0 else self.deaf_since
        if voltage == 0.0 and asked.heard:
            deaf_since = self.deaf_since or now
            if now - deaf_since > DEAF:
                problem = f"{OUTPUT_OFF}."
        return PlantWatch(self.limit, time, now, too_fast, deaf_since), problem


@dataclass(frozen=True, slots=True)
class Listener:
    """When the command has looked for samples: one that stands still hears none, and cannot say that none came."""

    looked: float | None = None  # [s] on the caller's clock
    heard: float | None = None  # [s] on it, when the latest sample came; None: none has yet
    away: float = 0.0  # [s] the longest from look to look since then

    def look(self, heard: float | None, elapsed: float, now: float) -> tuple["Listener", str]:
        """Look at `now`; what is wrong stands beside it: elapsed [s] of the plan, if no sample came for SILENCE."""
        if heard is None:
            return Listener(now), ""
        gap = now - max(heard, self.looked or heard)
        away, silent = max(gap, self.away if heard == self.heard else 0.0), now - heard
        problem = ""
        if silent > SILENCE:
            problem = PAUSED.format(silent, elapsed) if away > 0.5 * silent else GONE.format(elapsed)
        return Listener(now, heard, away), problem
