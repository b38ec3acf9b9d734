"""What curves are learnt on and judged by: held-out data by the other part of them, or by what a fit has seen."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosed import fitted

from motor_identification.diagnosis.candidate_fit import validate_model
from motor_identification.diagnosis.fits.disturbed_fit import list_error_data
from motor_identification.discrepancy.rests import are_parts_held_out, list_held_rests, list_training_rests
from motor_identification.estimation.estimate import Estimate
from motor_identification.validation.held_out import HeldOut, list_held_errors


@pytest.fixture(scope="module")
def judged() -> tuple[Estimate, HeldOut]:
    estimate, hold_out = fitted(ks=0.4)
    return estimate, validate_model(hold_out, estimate).held


def test_held_out_intervals_judge_and_other_recordings_are_learnt_on_alone(judged: tuple[Estimate, HeldOut]) -> None:
    estimate, held = judged
    (rest,) = list_held_rests(estimate, held, list_held_errors(held))
    assert np.array_equal(rest.judged, held.scored[0]) and np.array_equal(rest.learnt, ~held.scored[0])
    assert np.array_equal(rest.errors.increments, held.increments[0])
    (other,) = list_training_rests(estimate, list_error_data(estimate))
    assert other.learnt.all() and not other.judged.any()
    assert np.array_equal(other.errors.increments, estimate.increments[0])
    assert not are_parts_held_out(estimate, held)  # the held-out recording is another
    assert are_parts_held_out(estimate, replace(held, recordings=estimate.problem.recordings))


def test_of_what_a_fit_has_seen_curves_are_judged_by_some_blocks(judged: tuple[Estimate, HeldOut]) -> None:
    estimate, held = judged
    everything = tuple(np.ones_like(part) for part in held.scored)
    (rest,) = list_held_rests(estimate, replace(held, seen=True, scored=everything), list_held_errors(held))
    assert 0.1 < np.mean(rest.judged) < 0.6 and np.array_equal(rest.learnt, ~rest.judged)


def test_the_motion_is_simulated_without_what_is_left(judged: tuple[Estimate, HeldOut]) -> None:
    """A speed of the model is the measured one and what is left of it; the command is the same."""
    estimate, _ = judged
    (rest,) = list_training_rests(estimate, list_error_data(estimate))
    simulated, (data,) = rest.simulated(), estimate.problem.intervals
    assert np.array_equal(simulated.voltage, rest.history.voltage)
    moving = np.flatnonzero(data.slack == 0.0)
    apart = simulated.speed[simulated.at_start[moving]] - rest.history.speed[rest.history.at_start[moving]]
    assert np.median(np.abs(apart - rest.speeds[moving])) < 0.05 * np.std(rest.speeds[moving])
