"""A fit's summary: bounds that were hit, notes in order, the experiment that would show more."""

from dataclasses import replace

import numpy as np
import pytest
from fits import made, quick
from plant import profiles
from small import THETA, TRUE, small_estimate

from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.request import Descent, SearchReport
from motor_identification.estimation.whitened_fit import WhitenedFit, make_whitened
from motor_identification.identify import identify
from motor_identification.uncertainty.summary import ON_BOUND, _suggest_experiment, find_bounds_hit, summarise_fit

SEARCH = SearchReport(
    THETA, 1.0, 10, np.array([4.0, 1.0]), np.array([5, 10]), (Descent(THETA, 1.0, 5, 0),), 1, 1, agreed=True
)


def whitened() -> WhitenedFit:
    return make_whitened(fit_speeds(small_estimate()))


def test_everything_a_user_should_know() -> None:
    fit = whitened()
    result = summarise_fit(fit, SEARCH, lambda: 2.5, ("one", "two"))
    assert result.parameters.values == pytest.approx(TRUE, rel=2e-3)
    assert result.residual_rms == pytest.approx(np.sqrt(fit.estimate.cost))
    assert 0.999 < result.r_squared < 1.0 and result.evaluations == fit.estimate.simulations
    assert result.duration == 2.5 and result.notes[-2:] == ("one", "two")
    assert result.uris == ("small 0",) and result.start_speeds == (0.0,)
    assert result.correlations["kv"]["kv"] == pytest.approx(1.0) and result.search.rms.tolist() == [2.0, 1.0]
    assert set(result.standard_errors) == set(TRUE) and all(error > 0.0 for error in result.standard_errors.values())


@pytest.mark.parametrize(("share", "hit"), [(0.5 * ON_BOUND, True), (2.0 * ON_BOUND, False)])
def test_a_parameter_on_the_edge_of_the_box(share: float, hit: bool) -> None:
    unknowns = small_estimate().problem.unknowns
    span = unknowns.high - unknowns.low
    at_high = np.append(THETA[:2], unknowns.high[2] - share * span[2])
    assert find_bounds_hit(small_estimate(at_high)) == {"kv": False, "ka": False, "ks": hit}
    at_low = np.array([unknowns.low[0] + share * span[0], *THETA[1:]])
    assert find_bounds_hit(small_estimate(at_low))["kv"] is hit


def test_no_friction_is_an_answer_not_an_edge() -> None:
    unknowns = small_estimate().problem.unknowns
    assert unknowns.low[2] == 0.0
    assert not find_bounds_hit(small_estimate(np.append(THETA[:2], 0.0)))["ks"]


def test_a_speed_that_does_not_vary_has_no_r_squared() -> None:
    fit = whitened()
    (data,) = fit.problem.intervals
    level = fit.problem.with_intervals((replace(data, speed=np.full(len(data.speed), 5.0)),))
    flat = make_whitened(fit.estimate.on(level))
    assert np.isnan(summarise_fit(flat, SEARCH, lambda: 0.0).r_squared)


@pytest.mark.parametrize(("share", "slow", "said"), [(0.1, 0.02, True), (0.0, 0.02, True), (0.1, 0.0, False)])
def test_a_winding_beside_viscous_friction_is_another_one(share: float, slow: float, said: bool) -> None:
    """The ka was 18 % off by 517 standard errors, without a word: the speed alone has two poles."""
    true = {"ka": 0.004, "electrical_time_constant": slow, "resistance": 2.0, "torque_constant": (1.0 - share) * 0.05}
    fit = identify([made({"kv": 0.05, **true}, profiles.rich(4.0, 0))], quick("armature_inductance"))
    assert slow == 0.0 or fit.residual_rms < 1.2 * fit.noise_floor
    notes = [note for note in fit.notes if "viscous" in note]
    assert bool(notes) is said
    if said:
        ka, lag = (float(part.split()[0]) for part in notes[0].split("they would be ")[1].split(" and "))
        tenth = share == 0.1  # as the motor has it, and else what one with it would be that moves as this one does
        assert (ka, lag) == pytest.approx((0.004, slow), rel=0.02) or not tenth
        assert ka * lag == pytest.approx(0.004 * slow, rel=0.02)
        assert ka + 0.1 * 0.05 * lag == pytest.approx(0.004 + share * 0.05 * slow, rel=0.01)


def test_the_experiment_that_would_show_more() -> None:
    assert _suggest_experiment((), {}) == ""
    assert _suggest_experiment(("ks",), {"coulomb_friction": ("dead_zone",)}) == "ramps"  # its own effect's first
    assert _suggest_experiment(("kv",), {}) == "staircase"
    assert _suggest_experiment((), {"coulomb_friction": ("dead_zone",)}) == "coast"
