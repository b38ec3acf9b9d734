"""A supply that runs down is told from the warming-up that stands in for it by the motion that both were fitted to."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from plant import profiles, record
from stand_ins import is_taken_back, select_beside_friction
from tiers import keep_fast

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.evidence.drooping_evidence import find_droop, run_down
from motor_identification.diagnosis.fits.altered_commands import score_alone
from motor_identification.diagnosis.selection.backward_elimination import eliminate_backward
from motor_identification.diagnosis.selection.selection import Selection
from motor_identification.progress import ProgressReporter
from motor_identification.recording import Floats, Recording, check

SILENT = ProgressReporter(lambda stage: None, lambda: False)
TIME, FAST = 12.0, 2.0  # [s]
WARM = {"resistance_rise": 0.3, "warm_up_time": TIME}


def droop_of(time: Floats, constant: float) -> Floats:
    return np.asarray(1.0 - 0.15 * (1.0 - np.exp(-time / constant)))


def recorded(hidden: str) -> Recording:
    """Half a minute of a motor with a friction, beside a random torque, under a command at every row."""
    motor = {"kv": 0.07, "ka": 0.0055, "ks": 0.8} | (WARM if hidden == "warming" else {})
    torque = {"random_torque": 0.05, "random_torque_time": 0.05, "random_torque_seed": 3.0}
    begin, levels = profiles.random(12.0, 30.0, 3)
    time = np.arange(0.0, float(begin[-1]), 0.01)
    wanted = levels[np.searchsorted(begin, time, side="right") - 1]
    drooping = {"drooping": TIME, "drooping fast": FAST}.get(hidden)
    given = wanted if drooping is None else wanted * droop_of(time, drooping)
    recording = check(record(motor | torque, time, given, seed=3)[0])
    if drooping is None:
        return recording
    at = np.clip(np.searchsorted(time, recording.time + 1e-6, side="right") - 1, 0, None)
    return replace(recording, voltage=recording.voltage / droop_of(time[at], drooping))


@cache
def selected(hidden: str) -> Selection:
    return select_beside_friction(recorded(hidden), "warm_up")


@pytest.mark.parametrize(
    ("hidden", "stands_in"),
    [("drooping", True), pytest.param("drooping fast", True, marks=pytest.mark.slow), ("warming", False)],
)
def test_a_warming_up_stands_in_for_a_supply_that_runs_down(hidden: str, stands_in: bool) -> None:
    (step,) = selected(hidden).steps
    found = find_droop("warm_up", step.before, step.found.model)
    assert (found is not None) is stands_in
    if found is not None:  # by 0.15 · (1 − e^(−30/12)) and 0.15 at the end
        assert found.variable == "time" and found.certain and 0.9 < found.share <= 1.0
        assert f"runs down, by {14 if hidden == 'drooping' else 15}%" in found.cause


def test_a_supply_that_was_measured_does_not_run_down_unseen() -> None:
    (step,) = selected("drooping").steps
    problem = step.found.model.estimate.problem
    seen = tuple(replace(one, supply_voltage=np.full_like(one.voltage, 12.0)) for one in problem.recordings)
    model = replace(step.found.model, estimate=step.found.model.estimate.on(replace(problem, recordings=seen)))
    assert find_droop("warm_up", step.before, model) is None


@pytest.mark.parametrize("hidden", keep_fast(["drooping", "warming"], "drooping"))
def test_elimination_takes_the_stand_in_back_and_leaves_it_unexplained(hidden: str) -> None:
    assert is_taken_back(eliminate_backward(selected(hidden), SILENT)) is (hidden == "drooping")


@pytest.mark.slow
@pytest.mark.parametrize(("over", "stands_in"), [(-1.0, True), (1.0, False)])
def test_it_has_to_gain_more_than_the_warming_up_by_a_margin(
    monkeypatch: pytest.MonkeyPatch, over: float, stands_in: bool
) -> None:
    """By so much as it does, one nat less and more."""
    (step,) = selected("drooping").steps
    found = find_droop("warm_up", step.before, step.found.model)
    assert found is not None
    model = step.found.model
    warm = score_alone(model.estimate, model) - score_alone(step.before.estimate, model)
    monkeypatch.setattr(thresholds, "DROOPING_GAIN", found.significance - warm + over)
    assert (find_droop("warm_up", step.before, model) is not None) is stands_in


def test_only_what_comes_slowly_is_judged() -> None:
    (step,) = selected("drooping").steps
    for effect in ("coulomb_friction", "load_step"):
        assert find_droop(effect, step.before, step.found.model) is None


def test_a_supply_runs_down_from_the_recordings_start() -> None:
    recording = recorded("warming")
    down = run_down(recording, 0.2, 10.0)
    share = down.voltage[recording.voltage != 0.0] / recording.voltage[recording.voltage != 0.0]
    since = (recording.time - recording.time[0])[recording.voltage != 0.0]
    assert share == pytest.approx(1.0 - 0.2 * (1.0 - np.exp(-since / 10.0)))
    assert share[-1] == pytest.approx(1.0 - 0.2 * (1.0 - np.exp(-3.0)), abs=0.002)
