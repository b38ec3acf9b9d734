"""What makes a motion late is judged where the command has just changed: nowhere else does a lag show."""

from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from plant import record
from stub_models import COUNT, FLOOR, LASTING_FLOOR, STEP, stub_model

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest
from motor_identification.diagnosis.evidence.change_evidence import explains_changes, mark_answers
from motor_identification.estimation.estimate import Estimate
from motor_identification.measurement.edit_intervals import exclude_intervals
from motor_identification.recording import Recording
from motor_model.parameters import Parameters

LAG = 2.0 * STEP  # [s] a time constant
ANSWER = round(thresholds.ANSWERING_LAGS * LAG / STEP)  # intervals
STEPPED = 10  # the interval that begins with the step


def stepped() -> Recording:
    """One step of the command, at the beginning of an interval."""
    time = STEP * np.arange(COUNT + 1)
    return record({"kv": 1.0, "ka": LAG}, time, np.where(np.arange(COUNT + 1) < STEPPED, 0.0, 6.0), seed=1)[0]


def off_by(answer: float, rest: float = 0.0) -> Model:
    """A model that is off by so much [rad/s] as long as the motor answers the step, and by so much else."""
    model = stub_model(1.0, 0.0)
    error = np.full(COUNT, rest)
    error[STEPPED : STEPPED + ANSWER] = answer
    angle = np.append(0.0, np.cumsum((10.0 + error) * STEP))
    estimate = cast(Estimate, SimpleNamespace(parameters=Parameters({"kv": 1.0, "ka": LAG})))
    held = replace(model.held, recordings=(stepped(),), angles=(angle,), seen=True)
    return replace(model, held=held, estimate=estimate)


def test_a_motor_answers_for_some_time_constants() -> None:
    (data,) = off_by(1.0).held.intervals
    marks = mark_answers(stepped(), data, ANSWER * STEP)
    assert np.flatnonzero(marks).tolist() == list(range(STEPPED, STEPPED + ANSWER))
    still = replace(stepped(), voltage=np.zeros(COUNT + 1))
    assert not mark_answers(still, data, 1.0).any()


@pytest.mark.parametrize(("times", "explained"), [(0.99, False), (1.01, True)])
def test_what_is_left_stands_out_where_the_command_changed(times: float, explained: bool) -> None:
    before = times * thresholds.SEEN_GAP * FLOOR
    assert explains_changes(off_by(before), off_by(0.0)) is explained


@pytest.mark.parametrize(("times", "explained"), [(0.99, False), (1.01, True)])
def test_most_of_it_goes(times: float, explained: bool) -> None:
    share = times * thresholds.RELEVANT_SHARE_NEAR_FLOOR
    after = np.sqrt(9.0 - share * (9.0 - FLOOR**2))
    assert explains_changes(off_by(3.0), off_by(after)) is explained
    assert explains_changes(off_by(3.0), off_by(after, 50.0)) is explained  # whatever is left elsewhere


def test_models_that_are_judged_by_other_intervals_are_not_compared() -> None:
    model = off_by(0.0)
    (data,), kept = model.held.intervals, np.arange(COUNT) >= 2
    held = replace(model.held, intervals=(exclude_intervals(data, ~kept),), scored=(kept[kept],))
    assert not explains_changes(off_by(3.0), replace(model, held=held))
    nothing = replace(model.held, scored=(np.zeros(COUNT, dtype=bool),))
    assert not explains_changes(off_by(3.0), replace(model, held=nothing))


@pytest.mark.parametrize(("effect", "relevant"), [("transport_delay", True), ("coulomb_friction", False)])
def test_only_a_lag_is_relevant_by_the_changes_alone(effect: str, relevant: bool) -> None:
    """Of a step in a long rest it takes away most where the motor answers, and next to nothing of the whole gap."""
    before, after = off_by(1.6), off_by(0.0)
    assert before.lasting.gap < thresholds.SEEN_GAP * LASTING_FLOOR
    assert CandidateTest(effect, before, after).relevant is relevant
