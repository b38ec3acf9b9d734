"""Evidence beside a random torque: on which intervals, at what price, and whether it matters."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosed import fitted, with_effect
from stub_models import rescored, stub_model

from motor_identification.diagnosis import candidate_test, thresholds
from motor_identification.diagnosis.candidate_fit import judge_beside_torque, validate_model
from motor_identification.diagnosis.candidate_model import Model, Score
from motor_identification.diagnosis.candidate_test import CandidateTest
from motor_identification.diagnosis.evidence.torque_evidence import (
    MOMENTS,
    mark_common_set,
    measure_speaking,
    measure_steadiness,
    score_held_out,
    score_training,
)
from motor_identification.diagnosis.fits.disturbed_fit import list_error_data
from motor_identification.measurement.time_blocks import TimeBlocks
from motor_identification.noise.error_model import ErrorModel

ERRORS = ErrorModel(0.003, 0.0, 0.1, 0.05)


def test_an_unknown_costs_half_the_logarithm_of_the_intervals() -> None:
    estimate, _hold_out = fitted()
    larger = with_effect(estimate, "quadratic_drag", {"drag": 1e-9})
    same = replace(larger, theta=np.append(estimate.theta, larger.problem.unknowns.low[-1]))
    price = 0.5 * np.log(sum(len(data.first) for data in estimate.problem.intervals))
    smaller, other = (score_training(one, list_error_data(one), ERRORS).likelihood for one in (estimate, same))
    assert smaller - other == pytest.approx(price, abs=0.01)


def test_only_blocks_of_the_common_set_are_scored() -> None:
    """Half as many blocks say half as much."""
    estimate, hold_out = fitted()
    (data,) = hold_out.problem.intervals
    (marks,) = mark_common_set(hold_out)
    assert np.array_equal(marks, hold_out.scored_blocks.mark(data, hold_out.problem.sample_period))
    score = score_held_out(hold_out, hold_out.validate(estimate), ERRORS, estimate.lag)
    assert len(score.moments) == MOMENTS
    hold_out = replace(hold_out, scored_blocks=TimeBlocks(4))
    assert (
        0.4
        < score_held_out(hold_out, hold_out.validate(estimate), ERRORS, estimate.lag).moments.sum()
        / score.moments.sum()
        < 0.6
    )


def test_what_a_few_moments_say_is_no_evidence() -> None:
    """Of 120 moments the six that speak most are left out."""
    nothing = np.zeros(120)
    lucky, seven = nothing.copy(), nothing.copy()
    lucky[:6], seven[:7] = 20.0, 20.0
    assert measure_steadiness(nothing, np.full(120, 0.5)) == pytest.approx(57.0)
    assert measure_steadiness(nothing, lucky) == 0.0 and measure_steadiness(nothing, seven) == 20.0
    assert measure_steadiness(nothing, np.full(120, -0.5)) == pytest.approx(-57.0)


def test_what_can_speak_in_few_moments_is_judged_by_those() -> None:
    """A breakaway that shows in seven of 120 moments loses one of them, not six."""
    nothing, seven = np.zeros(120), np.append(np.full(7, 20.0), np.zeros(113))
    assert measure_speaking(nothing, seven) == pytest.approx(7.0 / 120.0)
    assert measure_speaking(nothing, nothing + 1.0) == pytest.approx(1.0)
    assert measure_speaking(nothing, nothing) == 1.0
    assert measure_steadiness(nothing, seven, 7.0 / 120.0) == 120.0
    once = np.append(20.0, np.zeros(119))
    assert measure_steadiness(nothing, once, measure_speaking(nothing, once)) == 0.0


def test_what_shows_at_the_beginning_of_most_runs_is_steady() -> None:
    """Of six runs the two best are left out; of fewer than five they are no measure."""
    nothing, each = np.zeros((2, 6, MOMENTS)), np.zeros((2, 6, MOMENTS))
    each[1, :, 0] = [1.0, 2.0, 3.0, 4.0, 50.0, 60.0]
    assert measure_steadiness(nothing.ravel(), each.ravel()) == 0.0
    assert measure_steadiness(nothing.ravel(), each.ravel(), runs=6) == pytest.approx(10.0)
    assert measure_steadiness(nothing.ravel(), each.ravel(), runs=5) == pytest.approx(6.0)  # of twelve others
    assert measure_steadiness(nothing[:, :4].ravel(), each[:, :4].ravel(), runs=4) == 0.0
    steady = measure_steadiness(nothing.ravel(), np.full(720, 0.1), runs=6)
    assert steady == pytest.approx(0.95 * 72.0)  # not less than by moments


@pytest.mark.parametrize(
    ("effect", "stood", "steadiness"),
    [
        ("static_friction", True, 120.0),
        ("static_friction", False, 20.0),
        ("dead_zone", True, 120.0),
        ("load_bias", True, 20.0),
        ("transport_delay", False, 120.0),
        ("armature_inductance", True, 120.0),
    ],
)
def test_what_holds_a_motor_speaks_where_it_stood_and_a_lag_where_its_command_changed(
    monkeypatch: pytest.MonkeyPatch, effect: str, stood: bool, steadiness: float
) -> None:
    monkeypatch.setattr(candidate_test, "was_held", lambda model: stood)
    moments = np.append(np.full(7, 20.0), np.zeros(113))
    before = rescored(stub_model(1.0), moments=np.zeros(120))
    assert CandidateTest(effect, before, rescored(before, moments=moments)).steadiness == steadiness


def judged(**hidden: float) -> tuple[Model, Model]:
    """The motor without and with friction, beside a random torque."""
    estimate, hold_out = fitted(**hidden)
    after = with_effect(estimate, "coulomb_friction", {"ks": 0.3})
    first, second = (
        judge_beside_torque(validate_model(hold_out, one), hold_out, None, thresholds.FINAL_EVALUATIONS)
        for one in (estimate, after)
    )
    return first, second


def test_a_friction_that_is_there_has_evidence_on_both_parts() -> None:
    before, after = judged(ks=0.4)
    test = CandidateTest("coulomb_friction", before, after)
    assert test.evidence > after.score.held_out - before.score.held_out > 100.0
    assert test.evidence > test.steadiness > 100.0 and test.relevant


@pytest.mark.parametrize(("times", "held", "relevant"), [(1.01, 1.0, True), (0.99, 1.0, False), (1.01, -1.0, False)])
def test_what_matters_is_a_share_of_the_white_residual_and_shows_on_held_out_motion(
    times: float, held: float, relevant: bool
) -> None:
    estimate, hold_out = fitted()
    least = times * 0.5 * thresholds.RELEVANT_WHITE_SHARE * 2000
    moments = np.append(np.full(95, least / 95.0), np.full(5, least))  # the five are left out of what may always speak
    model = validate_model(hold_out, estimate)
    before = replace(model, learned=ERRORS, score=Score(0.0, scored=2000, moments=0.0 * moments))
    after = rescored(before, likelihood=6.0 * least, held_out=held, moments=moments)
    # What moves alike at the sensor's floor never matters.
    slower = replace(model.held, angles=tuple((1.0 - 1e-4) * angle for angle in model.held.angles))
    assert CandidateTest("quadratic_drag", replace(before, held=slower), after).relevant == relevant


@pytest.mark.parametrize(("steady", "likely"), [(9.9, False), (10.1, True)])
def test_an_effect_is_likely_without_the_best_moments_too(steady: float, likely: bool) -> None:
    estimate, hold_out = fitted()
    moments = np.append(np.full(95, steady / 95.0), np.full(5, 50.0))
    before = replace(validate_model(hold_out, estimate), learned=ERRORS, score=Score(0.0, moments=0.0 * moments))
    after = rescored(before, likelihood=250.0 + steady, moments=moments)
    assert CandidateTest("quadratic_drag", before, after).is_likely(10.0) == likely
