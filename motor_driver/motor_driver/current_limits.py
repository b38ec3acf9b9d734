"""The currents that switch the board's output off, in amperes, and as its converter counts them."""

from dataclasses import dataclass

from motor_driver.frames import Protect
from motor_model.errors import MotorError

STEPS, REFERENCE = 1024, 5.0  # of the board's converter; [V] of them all
LEAST = 8  # [step] a current has to be told from the noise, and from none
MOST_BUDGET = 2**30 - 1
FULL = REFERENCE * (1 - 2 / STEPS)  # [V] beyond, the converter shows no more


@dataclass(frozen=True, slots=True)
class CurrentLimits:
    """A peak, and what the motor bears for ever; between them, how long depends on the square (I2t).

    Raises:
        MotorError: the limits contradict each other, or the sensor does not show them.
    """

    gain: float = 0.0  # [V/A] of the sensor; 0: there is none
    offset: float = 2.5  # [V] of it without a current
    most: float = 0.0  # [A] 0: no current switches off
    rated: float = 0.0  # [A] for ever; 0: as most
    time: float = 1.0  # [s] at `most`, from cold

    def __post_init__(self) -> None:
        if self.most == 0.0:
            return
        if self.gain == 0.0:
            raise MotorError("current_limit needs a sensor on the board's A1: say its current_gain [V/A].")
        if self.rated > self.most:
            raise MotorError(
                f"continuous_current is {self.rated:g} A, and current_limit {self.most:g} A: it cannot be more."
            )
        shown = min(self.offset, FULL - self.offset) / abs(self.gain)
        if self.most > shown:
            raise MotorError(f"The sensor shows currents up to {shown:.3g} A: lower current_limit ({self.most:g} A).")
        if min(self.most, self.rated or self.most) < LEAST / self._per_ampere:
            raise MotorError(
                f"The board tells currents from {LEAST / self._per_ampere:.2g} A on: raise current_limit and "
                "continuous_current, or use a finer sensor."
            )

    @property
    def _per_ampere(self) -> float:
        return abs(self.gain) * STEPS / REFERENCE

    def protect(self, tick_ns: int) -> Protect:
        """What to ask of a board whose clock ticks so."""
        zero = round(self.offset * STEPS / REFERENCE)
        if self.most == 0.0:
            return Protect(zero, 0, 0, 0)
        most, rated = round(self.most * self._per_ampere), round((self.rated or self.most) * self._per_ampere)
        if rated >= most:
            return Protect(zero, most, most, MOST_BUDGET)
        budget = (most**2 // 64 - rated**2 // 64) * self.time * 1e9 / tick_ns / 64
        return Protect(zero, most, rated, max(1, min(round(budget), MOST_BUDGET)))
