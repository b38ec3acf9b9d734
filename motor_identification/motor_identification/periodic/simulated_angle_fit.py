"""Fit periodic effects on the simulated angle: what no edge shows, only a simulation of it can follow.

Such as the swings of a motor without friction at every standstill, or the blocks that are kept out of a fit. And a
measured angle is off by parts of a slot after every reversal, which a ripple's phase, and with it its size, pays for;
the simulated one is not, once the model is complete.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from motor_identification.estimation.direction_correction import correct_directions
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds, measure_scatter
from motor_identification.estimation.problem import Problem
from motor_identification.recording import Floats, Integers
from motor_model.effects import EFFECT_BY_NAME

PHASES = np.linspace(-np.pi, np.pi, 12, endpoint=False)
CYCLES = np.array([-1.0, -0.5, 0.0, 0.5, 1.0])  # of the width of a line: a measured angle's slips move it by as much
MOST_LAUNCHES = 2
MOST_TURNS = 3  # of directions and fit
ITERATIONS, TOLERANCE = 25, 1e-6  # of each fit on the way
LAST_TOLERANCE = 1e-10
OUTLIER_SIZE = 3.0  # times the typical residual of the best start: what is off by more counts no further


def fit_on_simulated_angle(free: Estimate, effect: str, starts: Sequence[Floats], angle: float) -> Estimate:
    """Fit a periodic effect on the simulated angle, from the best of some starts θ (D,).

    angle: [rad] how far the shaft turned; a line of the spectrum over it is as narrow as 1/angle. Where another phase
    does better than the θ that a fit ended at, it goes on from there.
    """
    end = starts[0]
    for _ in range(MOST_LAUNCHES):
        launch = _launch(free, effect, starts, angle)
        if launch.theta is end:
            return replace(free, theta=end, simulations=launch.simulations)
        free = _fit_with_directions(launch)
        end = free.theta
        starts = (end,)
    return free


def _fit_with_directions(free: Estimate) -> Estimate:
    """Correct directions and fit in turns, the fit not pulled by what is still read wrongly; the last fits all."""
    for turn in range(MOST_TURNS):
        before, free = free, correct_directions(free)
        if turn and np.array_equal(before.problem.speed, free.problem.speed):
            break
        free = fit_speeds(free, measure_scatter(free).robust, ITERATIONS, TOLERANCE)
    return fit_speeds(correct_directions(free), tolerance=LAST_TOLERANCE)


def _launch(free: Estimate, effect: str, starts: Sequence[Floats], angle: float) -> Estimate:
    """The best of some starts (D,), each also with every phase in every recording, and with cycles beside its own.

    Whichever way the shaft turned, and however far off some of it is.
    """
    problem = free.problem
    unknowns = problem.unknowns
    own = next(spec.name for spec in EFFECT_BY_NAME[effect].parameters if spec.of_recording)
    phase = unknowns.columns[:, unknowns.names.index(own)]
    thetas = [theta for start in starts for theta in _beside(problem, start, angle)]
    sizes = [_either_way(problem, _turned(theta, phase)) for theta in thetas]
    most = OUTLIER_SIZE * min(float(np.median(size, axis=1).min()) for size in sizes)
    as_it_is = _either_way(problem, starts[0][None])[0]
    best = [(float(np.minimum(as_it_is, most) ** 2 @ problem.weight), starts[0])]
    for theta, size in zip(thetas, sizes, strict=True):
        squares = problem.split((np.minimum(size, most) ** 2 * problem.weight).T)
        costs = np.array([part.sum(axis=0) for part in squares])  # of every recording with every phase
        theta[phase] = PHASES[costs.argmin(axis=1)]
        best.append((float(costs.min(axis=1).sum()), theta))
    chosen = min(best, key=lambda one: one[0])[1]
    return Estimate(problem, chosen, free.simulations + len(PHASES) * len(thetas) + 1)


def _beside(problem: Problem, theta: Floats, angle: float) -> list[Floats]:
    """Copies of θ (D,) with cycles beside its own, where it has a ripple."""
    unknowns = problem.unknowns
    if "ripple_cycles" not in unknowns.names:
        return [theta.copy()]
    shifts = np.zeros((len(CYCLES), len(theta)))
    shifts[:, unknowns.names.index("ripple_cycles")] = CYCLES / angle
    return list(np.clip(theta + shifts, unknowns.low, unknowns.high))


def _turned(theta: Floats, phase: Integers) -> Floats:
    """θ (D,) with every phase, shape (len(PHASES), D)."""
    turned = np.tile(theta, (len(PHASES), 1))
    turned[:, phase] = PHASES[:, None]
    return turned


def _either_way(problem: Problem, thetas: Floats) -> Floats:
    """Sizes of the residuals [rad/s] at θ (S, D), whichever way the shaft turned, shape (S, I)."""
    residuals = problem.evaluate(thetas)
    return np.asarray(np.minimum(np.abs(residuals), np.abs(residuals + 2.0 * problem.speed)))
