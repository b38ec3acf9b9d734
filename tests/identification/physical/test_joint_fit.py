"""Motion and current fitted together."""

from dataclasses import replace

import numpy as np
import pytest
from electrical import LUMPED, PHYSICAL, known, measured

from motor_identification.physical.current_samples import select_current
from motor_identification.physical.joint_fit import fit_with_current
from motor_identification.uncertainty.standard_errors import estimate_uncertainty
from motor_model.errors import RecordingError


def test_the_motor_is_found_within_its_errors() -> None:
    recording, motion = known()
    fit = fit_with_current(motion, (select_current(recording),))
    sure = estimate_uncertainty(fit, fit.residuals.jacobian(fit.theta))
    values, errors = fit.electrical.values(fit.theta), fit.electrical.value_errors(fit.theta, sure.errors)
    for name, true in {**LUMPED, "resistance": 2.3, "torque_constant": 0.065, "current_offset": 0.03}.items():
        assert abs(values[name] - true) < 3.5 * errors[name], name
    assert 1e-4 < errors["resistance"] / 2.3 < 2e-3  # 15 mA of noise in 1,000 readings of some 2 A
    assert 1e-4 < errors["torque_constant"] / 0.065 < 1e-3
    assert PHYSICAL["torque_constant"] != LUMPED["kv"] and fit.motion.problem.unknowns.names == tuple(
        motion.problem.unknowns.names
    )
    assert abs(fit.motion.cost / motion.estimate.cost - 1.0) < 1e-3


def test_a_current_against_the_voltage_is_refused() -> None:
    recording, motion = known()
    with pytest.raises(RecordingError, match="runs against the voltage"):
        fit_with_current(motion, (select_current(replace(recording, current=-recording.current)),))


def test_a_gain_of_the_ammeter_is_all_in_the_resistance() -> None:
    recording, motion = known()
    fits = [
        fit_with_current(motion, (select_current(replace(recording, current=gain * recording.current)),))
        for gain in (1.0, 1.05)
    ]
    right, wrong = (one.electrical.values(one.theta) for one in fits)
    assert wrong["resistance"] * 1.05 == pytest.approx(right["resistance"], rel=1e-5)
    assert wrong["torque_constant"] == pytest.approx(right["torque_constant"], rel=1e-6)
    assert np.isclose(fits[1].residuals.sigma[0], 1.05 * fits[0].residuals.sigma[0], rtol=1e-4)


@pytest.mark.parametrize("late", [-0.5, 1.4])
def test_how_late_a_foreign_current_is_is_found(late: float) -> None:
    """[samples] Negative: it was read after the voltage of its row had begun to act."""
    recording, motion = known()
    foreign = replace(recording.info, source="import")
    fine = measured(sample_rate=2000.0)  # the same motion, for the current between the samples
    wanted = np.clip(recording.time - late * recording.sample_period, 0.0, None)
    current = fine.current[np.minimum(np.searchsorted(fine.time, wanted), len(fine) - 1)]
    moved = replace(recording, info=foreign, current=current)
    other = replace(motion, estimate=replace(motion.estimate, problem=replace(motion.problem, recordings=(moved,))))
    fit = fit_with_current(other, (select_current(moved),))
    sure = estimate_uncertainty(fit, fit.residuals.jacobian(fit.theta))
    values, errors = fit.electrical.values(fit.theta), fit.electrical.value_errors(fit.theta, sure.errors)
    lag, error = (of["current_lag"] / recording.sample_period for of in (values, errors))
    assert abs(lag - late) < 3.5 * error and error < 0.3
    assert abs(values["resistance"] - 2.3) < 3.5 * errors["resistance"] < 0.1
