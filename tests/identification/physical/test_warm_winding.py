"""A winding that warms up shows in the current as such."""

import numpy as np
import pytest
from electrical import FRICTION, fit_motion, known, measured
from plant import profiles

from motor_identification.physical.current_samples import select_current
from motor_identification.physical.joint_fit import fit_with_current
from motor_identification.physical.warm_winding import WARM_UP, describe_warm_winding, measure_change

HEATED = {"resistance_rise": 0.12, "warm_up_time": 6.0}
LONG = profiles.joined(*[profiles.random(12.0, 5.0, seed) for seed in range(4)])


def test_a_change_is_measured_with_its_error() -> None:
    random, time = np.random.default_rng(3), np.linspace(0.0, 10.0, 2000)
    current = 2.0 * np.sign(np.sin(3.0 * time))
    read = current / (1.0 + 0.05 * time / 10.0) + random.normal(0.0, 0.02, 2000)
    change, error = measure_change(time, current, read)
    assert abs(change - 0.05) < 4.0 * error and 3e-4 < error < 3e-3


@pytest.mark.slow
def test_it_is_named_where_the_model_has_none_and_found_where_it_has() -> None:
    recording = measured(HEATED, drive=LONG)
    fit = fit_with_current(fit_motion(recording), (select_current(recording),))
    (said,) = describe_warm_winding(fit)
    assert "The resistance rises by" in said and f"fit with --effects {WARM_UP.name}." in said
    warm = fit_with_current(fit_motion(recording, (*FRICTION, WARM_UP.name)), (select_current(recording),))
    assert list(describe_warm_winding(warm)) == []
    values = warm.electrical.values(warm.theta)
    assert values["resistance"] == pytest.approx(2.3, rel=2e-3)
    assert values["resistance_rise"] == pytest.approx(0.12, rel=0.03)
    assert warm.residuals.sigma[0] < 0.017 < fit.residuals.sigma[0]  # [A] the ammeter's own 15 mA, and more than that


def test_a_cold_winding_is_not() -> None:
    recording, motion = known()
    assert list(describe_warm_winding(fit_with_current(motion, (select_current(recording),)))) == []
