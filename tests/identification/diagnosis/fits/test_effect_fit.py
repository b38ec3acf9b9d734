"""One more effect is fitted with all parameters, from starts of its own, or not at all where nothing is gained."""

from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from diagnosed import fitted

from motor_identification.diagnosis.fits.effect_fit import (
    INSTANTS_TRIED,
    _improve_instants,
    add_noticeable_effect,
    fit_with_effect,
    promises_gain,
)
from motor_identification.estimation.least_squares import LEAST_GAIN, SpeedResiduals
from motor_model.parameters import PAPER_KA, PAPER_KV


def test_what_was_hidden_is_fitted_and_the_rest_comes_right() -> None:
    estimate, _ = fitted(ks=0.4)
    wrong = estimate.parameters.value("kv")
    found = fit_with_effect(estimate, "coulomb_friction")
    assert found is not None
    values = found.parameters.values
    assert values["ks"] == pytest.approx(0.4, rel=1e-3)
    assert values["kv"] == pytest.approx(PAPER_KV, rel=1e-4) and values["ka"] == pytest.approx(PAPER_KA, rel=1e-3)
    assert abs(wrong / PAPER_KV - 1.0) > 10.0 * abs(values["kv"] / PAPER_KV - 1.0)
    assert found.cost < 0.01 * estimate.cost and found.simulations > estimate.simulations


def test_where_a_quick_look_gains_nothing_there_is_no_fit() -> None:
    estimate, _ = fitted()
    assert fit_with_effect(estimate, "voltage_limit") is None


def test_a_noticeable_effect_is_not_fitted() -> None:
    estimate, _ = fitted()
    larger = add_noticeable_effect(estimate, "coulomb_friction")
    assert larger.parameters.value("ks") == pytest.approx(0.03 * 12.0, rel=0.02)  # 3 % of the largest voltage
    assert larger.parameters.value("kv") == estimate.parameters.value("kv")
    assert larger.cost > 10.0 * estimate.cost and larger.simulations == estimate.simulations


@pytest.mark.parametrize("times", [0.99, 1.01])
def test_a_quick_look_promises_what_chance_does_not(times: float) -> None:
    """White residuals have a standard deviation of 1, mean speeds that of what is left."""
    gain = times * LEAST_GAIN
    assert promises_gain(1000.0 + gain, 1000.0, 500, white=True) == (times > 1.0)
    assert promises_gain(1.0 + gain / 500, 1.0, 500, white=False) == (times > 1.0)


def test_instants_are_put_at_the_best_of_many_times() -> None:
    """Two recordings, a column each: a minimum beside the start keeps no instant from the lower one far away."""
    true, beside = np.array([7.0, 3.0]), np.array([9.5, 8.0])

    def residuals(theta: np.ndarray) -> np.ndarray:
        return np.minimum(np.abs(theta[1:] - true), 1.0 + np.abs(theta[1:] - beside))

    unknowns = SimpleNamespace(names=("step_voltage", "step_time"), columns=np.array([[0, 1], [0, 2]]))
    problem = SimpleNamespace(unknowns=unknowns, recordings=[SimpleNamespace(duration=10.0)] * 2)
    target = cast(SpeedResiduals, SimpleNamespace(problem=problem, residuals=residuals))
    begin = np.array([0.5, *beside])
    found, least = _improve_instants(target, "load_step", begin, float(np.sum(residuals(begin) ** 2)))
    assert np.abs(found[1:] - true).max() < 0.5 * 10.0 / (INSTANTS_TRIED - 1) + 1e-9 and found[0] == 0.5
    assert least == np.sum(residuals(found) ** 2) < 0.1
    same, cost = _improve_instants(target, "load_step", np.array([0.5, *true]), 0.0)
    assert np.array_equal(same[1:], true) and cost == 0.0  # never worse
    assert np.array_equal(_improve_instants(target, "dead_zone", begin, 2.0)[0], begin)
