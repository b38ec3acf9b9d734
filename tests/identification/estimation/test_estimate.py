"""An estimate is a problem, θ and what it took; what follows from them is theirs."""

import numpy as np
import pytest
from small import THETA, TRUE, small_estimate

from motor_identification.estimation.least_squares import fit_speeds


def test_what_follows_from_theta() -> None:
    one = small_estimate()
    assert one.parameters.values == pytest.approx(TRUE) and one.parameters.name == one.problem.recordings[0].info.name
    assert one.cost == pytest.approx(float(one.problem.weight @ one.problem.residuals(THETA) ** 2))
    (data,) = one.problem.intervals
    assert one.increments[0] == pytest.approx(one.problem.residuals(THETA) * data.duration)
    travel = one.angles[0][data.last] - one.angles[0][data.first]
    moving = data.slack == 0.0
    assert (travel - data.speed * data.duration)[moving] == pytest.approx(one.increments[0][moving], abs=1e-12)


def test_theta_goes_over_to_another_problem_and_simulations_add_up() -> None:
    start = small_estimate(THETA + [0.05, -0.05, 0.1])
    first = fit_speeds(start, iterations=2)
    shorter = first.problem.without((np.arange(len(first.problem.weight)) % 2 == 0,))
    moved = first.on(shorter)
    assert moved.theta is first.theta and moved.simulations == first.simulations > 0
    assert len(moved.problem.weight) < len(first.problem.weight)
    assert fit_speeds(moved).simulations > moved.simulations
