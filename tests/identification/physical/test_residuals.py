"""Residuals of the current: white under the truth, and with the right derivatives."""

import numpy as np
from electrical import ELECTRIC, NOISE, OFFSET, STEP, known

from motor_identification.physical.current_samples import select_current
from motor_identification.physical.joint_fit import fit_with_current
from motor_identification.physical.residuals import simulate_currents


def test_the_truth_leaves_the_ammeters_noise() -> None:
    recording, motion = known()
    fit = fit_with_current(motion, (select_current(recording),))
    theta = fit.theta.copy()
    theta[fit.electrical.names.index("resistance")] = np.log(ELECTRIC["resistance"])
    theta[fit.electrical.names.index("torque_constant")] = ELECTRIC["torque_constant"]
    theta[fit.electrical.names.index("current_offset")] = OFFSET
    left = fit.residuals.current_errors(theta)
    expected = np.sqrt(NOISE**2 + STEP**2 / 12.0)
    assert 0.93 < np.std(left) / expected < 1.07 and abs(np.mean(left)) < 3.0 * expected / np.sqrt(len(left))
    assert 0.93 < fit.residuals.sigma[0] / expected < 1.07


def test_derivatives_are_those_of_the_currents() -> None:
    recording, motion = known()
    fit = fit_with_current(motion, (select_current(recording),))
    rows = len(fit.residuals.currents[0].time)
    columns = fit.residuals.jacobian(fit.theta)[-rows:] * fit.residuals.sigma[0]
    current = simulate_currents(fit.problem, fit.residuals.currents, fit.theta[None])[0]
    values = fit.electrical.values(fit.theta)
    of = dict(zip(fit.electrical.names, columns.T, strict=True))
    assert np.allclose(of["current_offset"], 1.0, atol=1e-6)
    assert np.allclose(of["resistance"], values["current_offset"] - current, atol=1e-4)  # a logarithm's: −i
    assert len(fit.residuals.residuals(fit.theta)) == len(fit.residuals.jacobian(fit.theta))
