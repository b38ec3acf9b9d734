"""Evidence beside a random torque: on which intervals, at what price, and whether it matters."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosed import fitted, with_effect

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import CandidateTest, Model, judge_beside_torque, validate_model
from motor_identification.diagnosis.torque_evidence import count_scored, score_held_out, score_training
from motor_identification.noise.error_model import ErrorModel

ERRORS = ErrorModel(0.003, 0.0, 0.1, 0.05)


def test_an_unknown_costs_half_the_logarithm_of_the_intervals() -> None:
    estimate, _hold_out = fitted()
    larger = with_effect(estimate, "quadratic_drag", {"drag": 1e-9})
    same = replace(larger, theta=np.append(estimate.theta, larger.problem.unknowns.low[-1]))
    price = 0.5 * np.log(sum(len(data.first) for data in estimate.problem.intervals))
    assert score_training(estimate, ERRORS) - score_training(same, ERRORS) == pytest.approx(price, abs=0.01)


def test_only_blocks_of_the_common_set_are_scored() -> None:
    """Whatever is measured elsewhere in the held-out recording, the filter forgets it within a few intervals."""
    estimate, hold_out = fitted()
    (data,) = hold_out.problem.intervals
    marks = hold_out.scored_blocks.mark(data)
    assert count_scored(hold_out) == np.count_nonzero(marks)
    assert 0.3 * len(marks) < count_scored(hold_out) < 0.7 * len(marks)
    worse = score_held_out(hold_out, estimate, replace(ERRORS, rms_voltage=1.0))
    assert score_held_out(hold_out, estimate, replace(ERRORS, rms_voltage=1e-3)) > worse + 100.0


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
    assert test.evidence > after.held_out - before.held_out > 100.0
    assert test.relevant


@pytest.mark.parametrize(
    ("times", "held_out", "relevant"), [(1.01, 1.0, True), (0.99, 1.0, False), (1.01, -1.0, False)]
)
def test_what_matters_is_a_share_of_the_white_residual_and_shows_on_held_out_motion(
    times: float, held_out: float, relevant: bool
) -> None:
    estimate, hold_out = fitted()
    before = replace(validate_model(hold_out, estimate), learned=ERRORS, scored=2000, likelihood=0.0, held_out=0.0)
    evidence = times * 0.5 * thresholds.RELEVANT_WHITE_SHARE * 2000
    after = replace(before, likelihood=evidence, held_out=held_out)
    assert CandidateTest("coulomb_friction", before, after).relevant == relevant
