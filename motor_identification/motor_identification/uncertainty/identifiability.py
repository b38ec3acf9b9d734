"""What a recording can tell and what not, whatever the noise: judged by the directions of the Jacobian alone."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from motor_identification.estimation.problem import Problem
from motor_identification.estimation.whitened_fit import Refined
from motor_identification.recording import Floats
from motor_model.effects import EFFECT_BY_NAME, EFFECTS, INDEX, SPEC_BY_NAME

NOTHING = 1e-6  # of the speed
DETECTABLE = 10.0  # standard deviations by which a trace must differ from its imitation to be told apart
RIVALS = tuple(effect.name for effect in EFFECTS if effect.linear_onset)  # their trace is a derivative


def scales_of(problem: Problem, place: Floats) -> Floats:
    """What 100 % of each unknown is: itself, or a twentieth of the box where it is near zero; 1 for logarithms."""
    box = problem.unknowns.high - problem.unknowns.low
    return np.where(problem.unknowns.logarithmic, 1.0, np.maximum(np.abs(place), 0.05 * box))


def shown(problem: Problem, place: Floats, scale: Floats) -> NDArray[np.bool_]:
    """Which unknowns move the speeds at all, by more than rounding, when they change by 100 %, shape (D,)."""
    moved = np.sqrt(problem.weight @ (problem.jacobian(place) * scale) ** 2)
    return np.asarray(moved > NOTHING * np.sqrt(problem.weight @ problem.speed**2))


def independence(columns: Floats) -> Floats:
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


def not_told_apart(
    refined: Refined, place: Floats, jacobian: Floats, errors: Floats, not_identifiable: tuple[str, ...]
) -> dict[str, tuple[str, ...]]:
    """For each effect that was found, the absent effects that would have left the same trace in this recording.

    Effects that are not identifiable anyway, or that are not there (within 3 standard errors), are passed over.
    """
    unknowns = refined.problem.unknowns
    scales = scales_of(refined.problem, place)
    columns = jacobian * scales
    found_size = np.abs(place) / np.nan_to_num(errors, nan=np.inf)
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
            if any(spec.name in not_identifiable for spec in specs) or not np.any(found_size[which] > 3.0):
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
    vectors[1, :, INDEX[name]] += step
    without, with_it = refined.problem.evaluate_vectors(vectors, starts)
    return refined.white((with_it - without) / step)


def telling_apart(rivals: Iterable[str]) -> str:
    """The profile that separates an effect from its rivals; empty where there are none."""
    profiles = {EFFECT_BY_NAME[rival].shown_by for rival in rivals}
    return profiles.pop() if len(profiles) == 1 else "rich" if profiles else ""
