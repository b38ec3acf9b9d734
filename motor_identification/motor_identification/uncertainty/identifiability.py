"""Judge identifiability: what a recording can tell and what not, by the directions of the Jacobian alone."""

from collections.abc import Iterable

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.whitened_fit import WhitenedFit
from motor_identification.recording import Bools, Floats
from motor_model.effects import EFFECT_BY_NAME, EFFECTS, INDEX, SPEC_BY_NAME

INVISIBLE = 1e-6  # of the speed: what an unknown moves by rounding alone
LEAST_SCALE = 0.05  # of the scaled box: 100 % of a parameter that is near zero
PRESENT_SIGMA = 3.0  # standard errors from which on an effect is there
DETECTABLE_SIGMA = 10.0  # standard deviations by which a trace must differ from its imitation to be told apart
RIVALS = tuple(effect.name for effect in EFFECTS if effect.linear_onset)  # their trace is a derivative


def scale_unknowns(estimate: Estimate) -> Floats:
    """Scale unknowns, 100 % of each: itself, or a twentieth of its box where it is near zero; 1 for logarithms."""
    unknowns = estimate.problem.unknowns
    least = LEAST_SCALE * (unknowns.high - unknowns.low)
    for i, spec in enumerate(unknowns.specs):
        if spec.usual is not None:  # the box also spans what is rare
            least[unknowns.columns[:, i]] = LEAST_SCALE * (spec.high - spec.low) * spec.scale.of(unknowns.extent)
    return np.where(unknowns.logarithmic, 1.0, np.maximum(np.abs(estimate.theta), least))


def mark_visible(estimate: Estimate, scale: Floats) -> Bools:
    """Mark the unknowns that move the speeds at all, by more than rounding, when they change by 100 %, shape (D,)."""
    problem = estimate.problem
    moved = np.sqrt(problem.weight @ (problem.jacobian(estimate.theta) * scale) ** 2)
    return np.asarray(moved > INVISIBLE * np.sqrt(problem.weight @ problem.speed**2))


def measure_independence(columns: Floats) -> Floats:
    """Measure the sine of the angle between each column (I, D) and the space of the others, shape (D,); 0 for zeros."""
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


def find_confusable_effects(
    fit: WhitenedFit, jacobian: Floats, errors: Floats, not_identifiable: tuple[str, ...]
) -> dict[str, tuple[str, ...]]:
    """Find, for each effect that was fitted, the absent effects that would have left the same trace in this recording.

    Effects that are not identifiable anyway, or that are not there (within 3 standard errors), are passed over.
    """
    unknowns, theta = fit.problem.unknowns, fit.theta
    scales = scale_unknowns(fit.estimate)
    columns = jacobian * scales
    there = np.abs(theta) / np.nan_to_num(errors, nan=np.inf) > PRESENT_SIGMA
    found: dict[str, list[str]] = {}
    for rival in RIVALS:
        if rival in unknowns.effects:
            continue
        trace = _trace(fit, rival)
        imitation = np.linalg.lstsq(columns, trace, rcond=1e-10)[0]
        left = float(np.linalg.norm(trace - columns @ imitation))
        for effect in unknowns.effects:
            specs = EFFECT_BY_NAME[effect].parameters
            which = [unknowns.names.index(spec.name) for spec in specs]
            if any(spec.name in not_identifiable for spec in specs) or not np.any(there[which]):
                continue
            # As much of the rival as would have made this effect's whole value, and what of it would still show.
            amount = max(abs(theta[i] / scales[i]) for i in which) / max(max(abs(imitation[i]) for i in which), 1e-300)
            if amount * left < DETECTABLE_SIGMA:
                found.setdefault(effect, []).append(rival)
    return {effect: tuple(rivals) for effect, rivals in found.items()}


def _trace(fit: WhitenedFit, effect: str) -> Floats:
    """Derivative of the white residuals over an absent effect's first parameter, one step into the effect."""
    unknowns = fit.problem.unknowns
    name = EFFECT_BY_NAME[effect].parameters[0].name
    spec = SPEC_BY_NAME[name]
    step = 1e-4 * spec.box(unknowns.extent)[1]
    vectors, starts = unknowns.decode(np.tile(fit.theta, (2, 1)))
    vectors[1, :, INDEX[name]] += step
    without, with_it = fit.problem.evaluate_vectors(vectors, starts)
    return fit.residuals.white((with_it - without) / step)


def suggest_profile(rivals: Iterable[str]) -> str:
    """Suggest the profile that separates an effect from its rivals; empty where there are none."""
    profiles = {EFFECT_BY_NAME[rival].shown_by for rival in rivals}
    return profiles.pop() if len(profiles) == 1 else "rich" if profiles else ""
