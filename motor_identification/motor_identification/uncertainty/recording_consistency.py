"""Whether recordings that were fitted together agree: would one of them, alone, have another motor than all of them?

Around the common motor each recording is fitted by itself, to first order: the shift δ that leaves least of its white
residuals, min |r + J δ|². Recordings of one motor gain nothing by it but noise. Where the gain is far above noise and
leaves visibly smaller residuals, the common motor is a compromise: another day's temperature or supply, another bridge
mode, a missing effect; and the common standard errors are not those of any one of them.
"""

from dataclasses import dataclass

import numpy as np

from motor_identification.estimation.problem import Problem
from motor_identification.estimation.whitened_fit import Refined
from motor_identification.recording import Floats

FAR = 10.0  # mean square of a gained degree of freedom over that of what is left, from which on it is not noise
VISIBLE = 1.25  # residual beside the common motor over that beside the own one, from which on it is worth a word


@dataclass(frozen=True)
class Dissent:
    """How one recording would have the motor."""

    uri: str
    common: float  # [rad/s] RMS of simulated − measured beside the motor of all recordings
    own: float  # [rad/s] beside its own, to first order
    score: float  # mean square of a gained degree of freedom over that of what is left
    shifts: dict[str, float]  # parameter → own value minus common one, NaN where the recording does not say

    @property
    def disagrees(self) -> bool:
        """Whether this is more than noise, and more than nobody would see."""
        return self.score > FAR and self.common > VISIBLE * self.own


def dissents(refined: Refined, place: Floats) -> tuple[Dissent, ...]:
    """One for each recording of a fit at a place (D,); nothing for a single recording."""
    problem = refined.problem
    if len(problem.recordings) < 2:
        return ()
    parts = zip(problem.split(problem.jacobian(place)), problem.split(problem.residuals(place)), strict=True)
    return tuple(_one(refined, r, place, *part) for r, part in enumerate(parts))


def _one(refined: Refined, r: int, place: Floats, jacobian: Floats, residuals: Floats) -> Dissent:
    problem = refined.problem
    duration, encoder = problem.intervals[r].duration, refined.encoders[r]
    white = encoder.white(residuals * duration)
    scale = problem.unknowns.high - problem.unknowns.low
    columns = np.column_stack([encoder.white(column * duration) for column in (jacobian * scale).T])
    shift, _, rank, _ = np.linalg.lstsq(columns, -white, rcond=1e-6)
    left, freedom = float(np.sum((white + columns @ shift) ** 2)), max(len(residuals) - int(rank), 1)
    gained = float(np.sum(white**2)) - left
    weight = duration / duration.sum()
    own = residuals + jacobian @ (shift * scale)
    return Dissent(
        uri=problem.recordings[r].uri,
        common=float(np.sqrt(weight @ residuals**2)),
        own=float(np.sqrt(weight @ own**2)),
        score=gained / max(int(rank), 1) / max(left / freedom, 1e-300),
        shifts=_named(problem, place, shift * scale),
    )


def _named(problem: Problem, place: Floats, shift: Floats) -> dict[str, float]:
    unknowns = problem.unknowns
    value = np.where(unknowns.logarithmic, np.exp(np.where(unknowns.logarithmic, place, 0.0)) * shift, shift)
    return {name: float(value[i]) for i, name in enumerate(unknowns.names)}


def sentence_of(one: Dissent) -> str:
    """Describe a disagreement, and what to do about it."""
    return (
        f"{one.uri}: joint fit {one.common:.3g} rad/s RMS, separate fit {one.own:.3g}: the recordings disagree. "
        "Do not trust the joint values and errors; fit each recording alone and compare."
    )
