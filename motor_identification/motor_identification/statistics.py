"""How sure a fit is: standard errors, what the recording cannot separate, and what it could not tell apart from it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from motor_identification.problem import Problem
from motor_identification.recording import Floats
from motor_identification.refine import Refined
from motor_model.effects import EFFECT_BY_NAME, INDEX, SPEC_BY_NAME

BLOCKS = 120  # of consecutive intervals
NOTHING = 1e-6  # of the speed
COLLINEAR = 1e-4  # sine of the angle between a column of the Jacobian and the others, below which they are one
TOO_UNSURE = 0.3  # standard error as a share of the value
DETECTABLE = 10.0  # standard deviations by which a trace must differ from its imitation to be told apart

# Effects whose absence is a value that a small step can leave: their trace is a derivative.
RIVALS = ("coulomb_friction", "load_bias", "dead_zone", "quadratic_drag")


@dataclass(frozen=True)
class Certainty:
    """Standard errors of a place (D,) (NaN where not identifiable), and which physical parameters are not."""

    errors: Floats
    not_identifiable: tuple[str, ...]


def certainty(refined: Refined, place: Floats, jacobian: Floats) -> Certainty:
    """Judge a fitted place by the Jacobian of the white residuals there.

    The errors are a sandwich estimate, (JᵀJ)⁻¹ (Σ_b s_b s_bᵀ) (JᵀJ)⁻¹ with s_b the sum of Jᵢrᵢ over a block of
    consecutive residuals, so that what correlation the whitening has left, up to a block's length, needs no model
    (Liang & Zeger, Biometrika 73, 1986); but no smaller than (JᵀJ)⁻¹ alone, which is all there is for few residuals.
    """
    scale = _scales(refined.problem, place)
    scaled = jacobian * scale
    alone = _independence(scaled)
    inverse = np.linalg.pinv(scaled.T @ scaled, rcond=1e-14, hermitian=True)
    scores = scaled * refined.residuals(place)[:, None]
    blocks = np.array_split(scores, min(BLOCKS, max(len(scores) // 4, 2)))
    sums = np.array([block.sum(axis=0) for block in blocks])
    correction = len(blocks) / max(len(blocks) - len(place), 1)
    errors = np.sqrt(np.diag(np.maximum(inverse @ (sums.T @ sums * correction) @ inverse, inverse)))
    unsure = (alone < COLLINEAR) | (errors > TOO_UNSURE) | ~_shown(refined.problem, place, scale)
    names = tuple(name for name, bad in zip(refined.problem.unknowns.names, unsure, strict=False) if bad)
    return Certainty(np.where(unsure, np.nan, errors * scale), names)


def _shown(problem: Problem, place: Floats, scale: Floats) -> NDArray[np.bool_]:
    """Which unknowns move the speeds at all, by more than rounding, when they change by 100 %, shape (D,)."""
    moved = np.sqrt(problem.weight @ (problem.jacobian(place) * scale) ** 2)
    return np.asarray(moved > NOTHING * np.sqrt(problem.weight @ problem.speed**2))


def _scales(problem: Problem, place: Floats) -> Floats:
    """What 100 % of each unknown is: itself, or a twentieth of the box where it is near zero; 1 for logarithms."""
    box = problem.unknowns.high - problem.unknowns.low
    return np.where(problem.unknowns.logarithmic, 1.0, np.maximum(np.abs(place), 0.05 * box))


def _independence(columns: Floats) -> Floats:
    """Sine of the angle between each column (I, D) and the space of the others, shape (D,); 0 for a column of zeros."""
    norms = np.linalg.norm(columns, axis=0)
    unit = columns / np.where(norms > 0.0, norms, 1.0)
    sines = np.zeros(columns.shape[1])
    for j in np.flatnonzero(norms > 0.0):
        sines[j] = _unexplained(unit[:, j], np.delete(unit, j, axis=1))
    return sines


def _unexplained(column: Floats, others: Floats) -> float:
    """Norm of what is left of a unit column (I,) after the best combination of the others (I, D)."""
    if others.shape[1] == 0:
        return 1.0
    combination = np.linalg.lstsq(others, column, rcond=1e-10)[0]
    return float(np.linalg.norm(column - others @ combination))


def not_told_apart(refined: Refined, place: Floats, jacobian: Floats, sure: Certainty) -> dict[str, tuple[str, ...]]:
    """For each effect that was found, the absent effects that would have left the same trace in this recording.

    Effects that are not identifiable anyway, or that are not there (within 3 standard errors), are passed over.
    """
    unknowns = refined.problem.unknowns
    scales = _scales(refined.problem, place)
    columns = jacobian * scales
    found_size = np.abs(place) / np.nan_to_num(sure.errors, nan=np.inf)
    found: dict[str, list[str]] = {}
    for rival in RIVALS:
        if rival in unknowns.effects:
            continue
        trace = _trace(refined, place, rival)
        imitation = np.linalg.lstsq(columns, trace, rcond=1e-10)[0]
        left = float(np.linalg.norm(trace - columns @ imitation))
        for effect in unknowns.effects:
            specs = EFFECT_BY_NAME[effect].parameters
            which = [unknowns.names.index(spec.name) for spec in specs]
            if any(spec.name in sure.not_identifiable for spec in specs) or not np.any(found_size[which] > 3.0):
                continue
            # As much of the rival as would have made this effect's whole value, and what of it would still show.
            amount = max(abs(place[i] / scales[i]) for i in which) / max(max(abs(imitation[i]) for i in which), 1e-300)
            if amount * left < DETECTABLE:
                found.setdefault(effect, []).append(rival)
    return {effect: tuple(rivals) for effect, rivals in found.items()}


def _trace(refined: Refined, place: Floats, effect: str) -> Floats:
    """Derivative of the white residuals over an absent effect's first parameter, one step into the effect."""
    unknowns = refined.problem.unknowns
    name = EFFECT_BY_NAME[effect].parameters[0].name
    spec = SPEC_BY_NAME[name]
    step = 1e-4 * spec.high * unknowns.extent.of(spec)
    vectors, starts = unknowns.decode(np.tile(place, (2, 1)))
    vectors[1, INDEX[name]] += step
    without, with_it = refined.problem.evaluate_vectors(vectors, starts)
    return refined.white((with_it - without) / step)
