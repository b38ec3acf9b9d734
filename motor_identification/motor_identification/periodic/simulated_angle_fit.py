"""Periodic effects on the simulated angle: what no edge shows, only a simulation of it can follow.

Such as the swings of a motor without friction at every standstill, or the blocks that are kept out of a fit. And a
measured angle is off by parts of a slot after every reversal, which a ripple's phase, and with it its size, pays for;
the simulated one is not, once the model is complete.
"""

from collections.abc import Sequence

import numpy as np

from motor_identification.estimation.direction_correction import redirected
from motor_identification.estimation.least_squares import Speeds, descend, typical
from motor_identification.estimation.problem import Problem
from motor_identification.recording import Floats, Integers
from motor_model.effects import EFFECT_BY_NAME

PHASES = np.linspace(-np.pi, np.pi, 12, endpoint=False)
CYCLES = np.array([-1.0, -0.5, 0.0, 0.5, 1.0])  # of the width of a line: a measured angle's slips move it by as much
LAUNCHES = 2
TURNS, ITERATIONS = 3, 25  # of directions and fit, and of each fit on the way
MOST = 3.0  # times the typical residual of the best: what is off by more counts no further


def adrift(free: Problem, effect: str, starts: Sequence[Floats], angle: float) -> tuple[Problem, Floats, int]:
    """The best fit from some places (D,) on the simulated angle: problem, place, simulations.

    angle: [rad] how far the shaft turned; a line of the spectrum over it is as narrow as 1/angle. Where another phase
    does better than the place that a fit ended at, it goes on from there.
    """
    evaluations, end = 0, starts[0]
    for _ in range(LAUNCHES):
        there, more = _launched(free, effect, starts, angle)
        evaluations += more
        if there is end:
            break
        free, end, more = _settled(free, there)
        evaluations += more
        starts = (end,)
    return free, end, evaluations


def _settled(free: Problem, place: Floats) -> tuple[Problem, Floats, int]:
    """Directions and fit in turns, the fit not pulled by what is still judged the wrong way; the last counts all."""
    evaluations = 0
    for turn in range(TURNS):
        before, free = free, redirected(free, place)
        if turn and _alike(before, free):
            break
        most = typical(free, place)[1]
        place, more = descend(free, Speeds(free), place, most=most, iterations=ITERATIONS, tolerance=1e-6)
        evaluations += more
    free = redirected(free, place)
    place, more = descend(free, Speeds(free), place, tolerance=1e-10)
    return free, place, evaluations + more


def _alike(one: Problem, other: Problem) -> bool:
    """Whether two problems read the same speeds from their recordings."""
    return np.array_equal(one.speed, other.speed)


def _launched(free: Problem, effect: str, starts: Sequence[Floats], angle: float) -> tuple[Floats, int]:
    """The best of some places (D,), each also with every phase in every recording, and with cycles beside its own.

    Whichever way the shaft turned, and however far off some of it is; and the simulations.
    """
    unknowns = free.unknowns
    own = next(spec.name for spec in EFFECT_BY_NAME[effect].parameters if spec.of_recording)
    phase = unknowns.columns[:, unknowns.names.index(own)]
    places = [place for start in starts for place in _beside(free, start, angle)]
    sizes = [_either_way(free, _turned(place, phase)) for place in places]
    most = MOST * min(float(np.median(size, axis=1).min()) for size in sizes)
    as_it_is = _either_way(free, starts[0][None])[0]
    best = [(float(np.minimum(as_it_is, most) ** 2 @ free.weight), starts[0])]
    for place, size in zip(places, sizes, strict=True):
        squares = free.split((np.minimum(size, most) ** 2 * free.weight).T)
        costs = np.array([part.sum(axis=0) for part in squares])  # of every recording with every phase
        place[phase] = PHASES[costs.argmin(axis=1)]
        best.append((float(costs.min(axis=1).sum()), place))
    return min(best, key=lambda one: one[0])[1], len(PHASES) * len(places) + 1


def _beside(problem: Problem, place: Floats, angle: float) -> list[Floats]:
    """Copies of a place (D,) with cycles beside its own, where it has a ripple."""
    unknowns = problem.unknowns
    if "ripple_cycles" not in unknowns.names:
        return [place.copy()]
    shifts = np.zeros((len(CYCLES), len(place)))
    shifts[:, unknowns.names.index("ripple_cycles")] = CYCLES / angle
    return list(np.clip(place + shifts, unknowns.low, unknowns.high))


def _turned(place: Floats, phase: Integers) -> Floats:
    """A place (D,) with every phase, shape (len(PHASES), D)."""
    turned = np.tile(place, (len(PHASES), 1))
    turned[:, phase] = PHASES[:, None]
    return turned


def _either_way(problem: Problem, places: Floats) -> Floats:
    """Sizes of the residuals [rad/s] at places (S, D), whichever way the shaft turned, shape (S, I)."""
    residuals = problem.evaluate(places)
    return np.asarray(np.minimum(np.abs(residuals), np.abs(residuals + 2.0 * problem.speed)))
