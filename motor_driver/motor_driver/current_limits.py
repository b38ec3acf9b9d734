"""The currents that switch the board's output off, in amperes, and as its converter counts them."""

from dataclasses import dataclass

from motor_driver.frames.from_host import Protect
from motor_model.errors import MotorError

STEPS, REFERENCE = 1024, 5.0  # of the board's converter; [V] of them all
LEAST = 8  # [step] a current has to be told from the noise, and from none
# [step] of what lasts: the board counts squares in 64ths, and from here on a step more is always at least one of those
# (33^2 - 32^2 = 65); below, as much as half more than the rated current would be none.
LEAST_RATED = 32
EDGE = 2  # [step] from each end of the converter, beyond which it shows no more
MOST_BUDGET = 2**30 - 1


@dataclass(frozen=True, slots=True)
class CurrentLimits:
    """A peak, and what the motor bears for ever; between them, how long depends on the square (I2t).

    Raises:
        MotorError: the limits contradict each other.
    """

    most: float = 0.0  # [A] 0: no current switches off
    rated: float = 0.0  # [A] for ever; 0: as most
    time: float = 1.0  # [s] at `most`, from cold

    def __post_init__(self) -> None:
        if self.rated and not self.most:
            raise MotorError("continuous_current is set, and current_limit is not: set both.")
        if self.rated > self.most:
            raise MotorError(
                f"continuous_current is {self.rated:g} A, and current_limit {self.most:g} A: it cannot be more."
            )

    def check(self, gain: float, offset: float) -> None:
        """Check that a sensor of `gain` [V/A] and `offset` [V] without a current shows these limits, both ways.

        Raises:
            MotorError: it does not.
        """
        if self.most == 0.0:
            return
        if gain == 0.0:
            raise MotorError("current_limit needs a sensor on the board's A1: say its current_gain [V/A].")
        per_ampere, zero = _per_ampere(gain), offset * STEPS / REFERENCE
        shown = min(zero - EDGE, STEPS - EDGE - zero)
        if shown < LEAST:
            raise MotorError(
                f"A sensor of {offset:g} V without a current does not show currents in both directions, and "
                "current_limit needs that: set current_offset (2.5 V on most sensors), or use another sensor."
            )
        if self.most * per_ampere > shown:
            raise MotorError(
                f"The sensor shows currents up to {shown / per_ampere:.3g} A in both directions: lower current_limit "
                f"({self.most:g} A)."
            )
        if self.most * per_ampere < LEAST:
            raise MotorError(
                f"The board cannot resolve currents below {LEAST / per_ampere:.2g} A with this sensor: raise "
                "current_limit, or use a finer sensor."
            )
        if self.rated and self.rated * per_ampere < LEAST_RATED:
            raise MotorError(
                f"With this sensor the board keeps a continuous_current of {LEAST_RATED / per_ampere:.2g} A or more: "
                "raise it, or use a finer sensor."
            )

    def protect(self, gain: float, offset: float, tick_ns: int) -> Protect:
        """What to ask of a board whose sensor and clock are such."""
        per_ampere, zero = _per_ampere(gain), round(offset * STEPS / REFERENCE)
        if self.most == 0.0:
            return Protect(zero, 0, 0, 0)
        most, rated = round(self.most * per_ampere), round((self.rated or self.most) * per_ampere)
        if rated >= most:
            return Protect(zero, most, most, MOST_BUDGET)
        budget = (most**2 // 64 - rated**2 // 64) * self.time * 1e9 / tick_ns / 64
        return Protect(zero, most, rated, max(1, min(round(budget), MOST_BUDGET)))


def _per_ampere(gain: float) -> float:
    """[step/A]."""
    return abs(gain) * STEPS / REFERENCE
