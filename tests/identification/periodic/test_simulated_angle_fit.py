"""A periodic effect is fitted on the simulated angle from any phase near it."""

import numpy as np
import pytest
from plant import profiles, record
from small import THETA, TRUE

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.problem import make_problem
from motor_identification.periodic.simulated_angle_fit import _beside, _turned, fit_on_simulated_angle
from motor_identification.recording import check

RIPPLE = {"ripple_voltage": 0.3, "ripple_cycles": 5.3, "ripple_phase": 0.8}
RECORDING = check(record(TRUE | RIPPLE, *profiles.staircase(10.0, 2, 0.2), seed=1, irregularity=0.003)[0])
PROBLEM = make_problem([RECORDING], ("coulomb_friction", "torque_ripple"))
TRUTH = np.array([*THETA, *RIPPLE.values()])
ANGLE = float(np.ptp(PROBLEM.angles(TRUTH)[0]))


@pytest.mark.parametrize("phase", [0.8, -2.4, 3.1])
def test_the_phase_is_found_from_any_other(phase: float) -> None:
    start = TRUTH.copy()
    start[PROBLEM.unknowns.names.index("ripple_phase")] = phase
    found = fit_on_simulated_angle(Estimate(PROBLEM, start, 7), "torque_ripple", (start,), ANGLE)
    values = found.parameters.values
    assert abs(np.angle(np.exp(1j * (values["ripple_phase"] - 0.8)))) < 0.05
    assert values["ripple_voltage"] == pytest.approx(0.3, rel=0.05)
    assert values["ripple_cycles"] == pytest.approx(5.3, abs=0.01)
    assert found.cost < 1.5 * PROBLEM.cost(TRUTH) and found.simulations > 20


def test_cycles_beside_its_own_are_parts_of_a_lines_width() -> None:
    column = PROBLEM.unknowns.names.index("ripple_cycles")
    thetas = _beside(PROBLEM, TRUTH, ANGLE)
    assert [theta[column] - 5.3 for theta in thetas] == pytest.approx(np.array([-1.0, -0.5, 0.0, 0.5, 1.0]) / ANGLE)
    assert all(np.array_equal(np.delete(theta, column), np.delete(TRUTH, column)) for theta in thetas)
    bare = make_problem([RECORDING], ("encoder_eccentricity",))
    only = np.array([*THETA[:2], 0.01, 0.0])
    assert len(_beside(bare, only, ANGLE)) == 1  # an eccentricity comes once a turn


def test_every_phase_is_looked_at() -> None:
    column = PROBLEM.unknowns.columns[:, PROBLEM.unknowns.names.index("ripple_phase")]
    turned = _turned(TRUTH, column)
    assert turned.shape == (12, len(TRUTH)) and np.ptp(np.diff(turned[:, column[0]])) < 1e-9
    assert np.array_equal(np.delete(turned, column, axis=1), np.tile(np.delete(TRUTH, column), (12, 1)))
