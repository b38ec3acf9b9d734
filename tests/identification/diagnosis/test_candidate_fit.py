"""A model is judged by what it leaves, in its training data and in held-out motion."""

import numpy as np
import pytest
from diagnosed import fitted, with_effect

from motor_identification.diagnosis import candidate_fit
from motor_identification.diagnosis.candidate_fit import (
    fit_in_place,
    judge_beside_torque,
    refit_without,
    validate_model,
)
from motor_identification.diagnosis.evidence.torque_evidence import compute_price, score_training
from motor_identification.diagnosis.fits.disturbed_fit import list_error_data
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.parameter_space import map_theta
from motor_identification.measurement.time_blocks import TimeBlocks
from motor_identification.validation.hold_out import WholeRecordings


def test_a_models_noise_is_that_of_its_training_data() -> None:
    """The disc of 0.3 % is seen by the right motor; a wrong one's error passes for drift, and it is less likely."""
    estimate, hold_out = fitted()
    complete = validate_model(hold_out, estimate)
    assert 0.002 < complete.noise.share < 0.004 and complete.noise.drift < 1e-6
    assert complete.at_floor and not complete.above_floor
    lacking, other = fitted(ks=0.4)
    wrong = validate_model(other, lacking)
    assert wrong.noise.drift > 1e-4 and wrong.above_floor and not wrong.at_floor and not wrong.quiet
    assert wrong.likelihood < complete.likelihood - 1000.0
    assert np.isfinite(wrong.likelihood)


def test_where_nothing_is_held_out_all_motion_counts_once_less_the_price_of_the_unknowns() -> None:
    estimate, _ = fitted()
    whole = WholeRecordings(estimate.problem, TimeBlocks(1), False)
    model = validate_model(whole, estimate)
    assert model.held.seen and model.score.training == 0.0 and model.held.counted.mean() > 0.99
    assert model.likelihood == pytest.approx(model.held.log_likelihood(model.noise) - compute_price(estimate), abs=1.0)
    beside = judge_beside_torque(model, whole, None, 40)
    assert beside.learned is not None
    alone = score_training(estimate, list_error_data(estimate), beside.learned)
    assert beside.likelihood == alone.likelihood and len(beside.score.moments) == len(alone.moments)
    assert len(model.structure) == 0 or not model.structure[0].certain  # judged by other blocks than it is learnt on


def test_a_static_friction_in_the_place_of_a_dead_zone_begins_above_the_sliding_one() -> None:
    """It has a speed, too, and needs the sliding one: without either a diagnosis ended with an internal error."""
    estimate, hold_out = fitted(ks=0.4)
    model = validate_model(hold_out, with_effect(estimate, "dead_zone", {"dead_zone_voltage": 0.2}))
    other = fit_in_place(model, "dead_zone", "static_friction", hold_out)
    values = other.estimate.parameters.values
    assert set(other.effects) == {"coulomb_friction", "static_friction"}
    assert values["breakaway_voltage"] >= values["ks"] > 0.0 and values["stribeck_speed"] > 0.0
    assert other.likelihood > model.likelihood  # friction is what is there


GAIN = {"reverse_gain": np.array(1.0)}


@pytest.mark.parametrize("lost", [True, False])
def test_beside_a_torque_a_model_without_an_effect_is_as_it_is_where_a_fit_loses_what_was_met(
    monkeypatch: pytest.MonkeyPatch, lost: bool
) -> None:
    """The fit that follows may leave the summit that the rest of the model is on: the effect was then said to be it."""
    estimate, hold_out = fitted(ks=0.4)
    friction = with_effect(estimate, "coulomb_friction", {"ks": 0.4})
    problem = friction.problem.adding("direction_asymmetry")
    larger = Estimate(problem, map_theta(friction.problem.unknowns, friction.theta, problem.unknowns, GAIN))
    model = judge_beside_torque(validate_model(hold_out, larger), hold_out, None, 40)
    given = model.estimate.parameters.value("ks")
    at = friction.problem.unknowns.names.index("ks")

    def move(begin: Estimate, *_: object) -> Estimate:
        theta = begin.theta.copy()
        theta[at] = 0.5 * given if lost else given
        return Estimate(begin.problem, theta)

    monkeypatch.setattr(candidate_fit, "fit_beside_torque", move)
    without, bare = refit_without(model, "direction_asymmetry", hold_out), validate_model(hold_out, friction, model)
    assert without.effects == ("coulomb_friction",)
    assert without.likelihood >= bare.likelihood - 1e-6
    assert without.estimate.parameters.value("ks") == pytest.approx(given, rel=1e-12)
    moved = validate_model(hold_out, move(friction), model)
    assert (moved.likelihood < bare.likelihood - 100.0) is lost  # what the fit alone would have come to
