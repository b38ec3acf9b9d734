"""How sure a fit is: standard errors, what the recording cannot separate, and what it could not tell apart from it."""

from dataclasses import dataclass

import numpy as np

from motor_identification.problem import Problem
from motor_identification.recording import Floats
from motor_model.effects import EFFECT_BY_NAME, INDEX, SPEC_BY_NAME

BLOCKS = 40  # of consecutive intervals or edges, in which noise may be correlated
TOUCHING = 1e-8  # [s] between intervals that follow each other
NOTHING = 1e-6  # of the speed: what moves the motion by less (for 100 % of itself) has not shown at all
COLLINEAR = 1e-4  # sine of the angle between a column of the Jacobian and the others, below which they are one
TOO_UNSURE = 0.3  # standard error as a share of the value
DETECTABLE = 10.0  # standard errors of the mean by which a trace must differ to be told apart from its imitation

# Effects whose absence is a value that a small step can leave: their trace is a derivative.
RIVALS = ("coulomb_friction", "load_bias", "dead_zone", "quadratic_drag")


@dataclass(frozen=True)
class Certainty:
    """Standard errors of a place (D,) (NaN where not identifiable), and which physical parameters are not."""

    errors: Floats
    not_identifiable: tuple[str, ...]


def certainty(problem: Problem, place: Floats, jacobian: Floats) -> Certainty:
    """Judge a fitted place by the Jacobian (I, D) of the unweighted residuals there.

    The errors are a sandwich estimate, (JᵀWJ)⁻¹ M (JᵀWJ)⁻¹, made twice: from what every interval adds to the gradient,
    and from what every edge does. Neighbouring intervals share an edge, whose error counts up in one and down in the
    other: seen by interval that noise looks up to ten times too large. A model that is a little wrong leaves residuals
    that last: seen by edge they add up to a drift that looks too large. So the smaller is taken.
    """
    weight = problem.weight
    scale = _scales(problem, place)
    scaled = jacobian * scale
    root = np.sqrt(weight)[:, None] * scaled
    alone = _independence(root)
    alone[np.linalg.norm(root, axis=0) < NOTHING * np.sqrt(np.sum(weight * problem.speed**2))] = 0.0
    inverse = np.asarray(np.linalg.pinv(root.T @ root, rcond=1e-14, hermitian=True), dtype=np.float64)
    parts = weight * problem.residuals(place)
    errors = np.minimum(_errors(inverse, parts, scaled), _errors(inverse, *_by_edge(problem, scaled, parts)))
    unsure = (alone < COLLINEAR) | (errors > TOO_UNSURE)
    names = tuple(name for name, bad in zip(problem.unknowns.names, unsure, strict=False) if bad)
    return Certainty(np.where(unsure, np.nan, errors * scale), names)


def _by_edge(problem: Problem, jacobian: Floats, parts: Floats) -> tuple[Floats, Floats]:
    """The gradient Σ Jᵢpᵢ as Σ qₑgₑ over the E ends of intervals: angle errors q (E,) and their leverage g (E, D).

    A part pᵢ of the residuals is the difference of the angle errors q at both ends of an interval. Where intervals
    follow each other without a gap, this is summation by parts; q is known but for its mean, which has no leverage.
    """
    errors, leverage = [], []
    column, nothing = 0, np.zeros((1, jacobian.shape[1]))
    for data in problem.intervals:
        breaks = np.flatnonzero(np.abs(data.time[data.first[1:]] - data.time[data.last[:-1]]) > TOUCHING) + 1
        for chain in np.split(np.arange(column, column + len(data.first)), breaks):
            q = np.concatenate([[0.0], np.cumsum(parts[chain])])
            errors.append(q - q.mean())
            leverage.append(-np.diff(np.concatenate([nothing, jacobian[chain], nothing]), axis=0))
        column += len(data.first)
    return np.concatenate(errors), np.concatenate(leverage)


def _errors(inverse: Floats, noise: Floats, leverage: Floats) -> Floats:
    """Standard errors (D,) of an estimate, for noise (N,) with a leverage (N, D) on the gradient; inverse: (D, D).

    The larger of two: noise that is independent, with one variance in a block of neighbours (precise where a few edges
    have all the leverage), and noise correlated in any way in a block (Liang & Zeger, Biometrika 73, 1986).
    """
    blocks = np.array_split(np.arange(len(noise)), min(BLOCKS, max(len(noise) // 8, 2)))
    effect = leverage @ inverse
    single = np.sum([np.mean(noise[block] ** 2) * np.sum(effect[block] ** 2, axis=0) for block in blocks], axis=0)
    together = np.sum([(noise[block] @ effect[block]) ** 2 for block in blocks], axis=0)
    correction = len(blocks) / max(len(blocks) - len(inverse), 1)
    return np.asarray(np.sqrt(correction * np.maximum(single, together)))


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


def not_told_apart(
    problem: Problem, place: Floats, jacobian: Floats, unsure: tuple[str, ...]
) -> dict[str, tuple[str, ...]]:
    """For each fitted effect, the absent effects that would have left the same trace in this recording.

    Effects with a parameter that is `unsure` anyway are passed over.
    """
    root = np.sqrt(problem.weight)[:, None]
    scales = _scales(problem, place)
    columns = root * jacobian * scales
    noise = float(np.sqrt(problem.costs(place[None])[0] / len(problem.weight)))
    found: dict[str, list[str]] = {}
    for rival in RIVALS:
        if rival in problem.unknowns.effects:
            continue
        trace = root[:, 0] * _trace(problem, place, rival)
        imitation = np.linalg.lstsq(columns, trace, rcond=1e-10)[0]
        left = float(np.linalg.norm(trace - columns @ imitation))
        for effect in problem.unknowns.effects:
            specs = EFFECT_BY_NAME[effect].parameters
            if any(spec.name in unsure for spec in specs):
                continue
            which = [problem.unknowns.names.index(spec.name) for spec in specs]
            # As much of the rival as would have made this effect's whole value, and what of it would still show.
            amount = max(abs(place[i] / scales[i]) for i in which) / max(max(abs(imitation[i]) for i in which), 1e-300)
            if amount * left < DETECTABLE * noise:
                found.setdefault(effect, []).append(rival)
    return {effect: tuple(rivals) for effect, rivals in found.items()}


def _trace(problem: Problem, place: Floats, effect: str) -> Floats:
    """Derivative of the residuals (I,) over an absent effect's first parameter, one step into the effect."""
    name = EFFECT_BY_NAME[effect].parameters[0].name
    spec = SPEC_BY_NAME[name]
    step = 1e-4 * spec.high * problem.unknowns.extent.of(spec)
    vectors, starts = problem.unknowns.decode(np.tile(place, (2, 1)))
    vectors[1, INDEX[name]] += step
    without, with_it = problem.evaluate_vectors(vectors, starts)
    return np.asarray((with_it - without) / step)
