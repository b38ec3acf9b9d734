"""Check the consistency of recordings: would one of them, alone, have another motor than all of them together?

Around the common motor each recording is fitted by itself, to first order: the shift δ that leaves least of its white
residuals, min |r + J δ|². Recordings of one motor gain nothing by it but noise. Where the gain is far above noise and
leaves visibly smaller residuals, the common motor is a compromise: another day's temperature or supply, another bridge
mode, a missing effect; and the common standard errors are not those of any one of them.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from motor_identification.estimation.whitened_fit import WhitenedFit
from motor_identification.recording import Floats

# Mean square of a gained degree of freedom over that of what is left, from which on it is not noise.
INCONSISTENT_SCORE = 10.0
# Residual beside the common motor over that beside the own one, from which on it is worth a word.
INCONSISTENT_RATIO = 1.25
# Values left for each degree of freedom, from which on a recording is a witness: five rows fit a motor of their own.
FEWEST_A_FREEDOM = 5


@dataclass(frozen=True)
class Dissent:
    """How much better one recording fits a motor of its own."""

    uri: str
    common: float  # [rad/s] RMS of simulated − measured beside the motor of all recordings
    own: float  # [rad/s] beside its own, to first order
    score: float  # mean square of a gained degree of freedom over that of what is left; 0 of too few values to tell

    @property
    def disagrees(self) -> bool:
        """Whether this is more than noise, and more than nobody would see."""
        return self.score > INCONSISTENT_SCORE and self.common > INCONSISTENT_RATIO * self.own


def compare_recordings(fit: WhitenedFit) -> tuple[Dissent, ...]:
    """Compare every recording of a fit with the motor of all; nothing for one, nor where each has a gain of its own."""
    problem, theta = fit.problem, fit.theta
    if len(problem.recordings) < 2 or fit.residuals.gains_differ:
        return ()
    parts = zip(problem.split(problem.jacobian(theta)), problem.split(problem.residuals(theta)), strict=True)
    return tuple(_compare_one(fit, r, *part) for r, part in enumerate(parts))


def _compare_one(fit: WhitenedFit, r: int, jacobian: Floats, residuals: Floats) -> Dissent:
    problem = fit.problem
    duration, encoder = problem.intervals[r].duration, fit.residuals.encoders[r]
    white = encoder.white(residuals * duration)
    scale = problem.unknowns.high - problem.unknowns.low
    columns = np.column_stack([encoder.white(column * duration) for column in (jacobian * scale).T])
    shift, _, rank, _ = np.linalg.lstsq(columns, -white, rcond=1e-6)
    left, freedom = float(np.sum((white + columns @ shift) ** 2)), len(residuals) - int(rank)
    gained = float(np.sum(white**2)) - left if freedom >= FEWEST_A_FREEDOM * int(rank) else 0.0
    weight = duration / duration.sum()
    own = residuals + jacobian @ (shift * scale)
    return Dissent(
        uri=problem.recordings[r].uri,
        common=float(np.sqrt(weight @ residuals**2)),
        own=float(np.sqrt(weight @ own**2)),
        score=gained / max(int(rank), 1) / max(left / max(freedom, 1), 1e-300),
    )


def describe_worst_dissent(compared: Sequence[Dissent]) -> list[str]:
    """Describe the worst of the recordings that disagree, how many others do, and what to do; nothing if none does."""
    dissent = [one for one in compared if one.disagrees]
    if not dissent:
        return []
    worst, others = max(dissent, key=lambda one: one.common / one.own), len(dissent) - 1
    more = f", and {others} other{'s do' if others > 1 else ' does'}, too" if others else ""
    return [
        f"{worst.uri}: joint fit {worst.common:.3g} rad/s RMS, separate fit {worst.own:.3g}: the recordings "
        f"disagree{more}. Do not trust the joint values and errors; fit each recording alone and compare."
    ]
