"""A bridge that slews is told from the lag that stands in for it by the motion that both were fitted to."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from plant import profiles, record
from stand_ins import is_taken_back, select_beside_friction

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.evidence.slewing_evidence import find_slewing, follow, slew
from motor_identification.diagnosis.selection.backward_elimination import eliminate_backward
from motor_identification.diagnosis.selection.selection import Selection
from motor_identification.progress import ProgressReporter
from motor_identification.recording import check

SILENT = ProgressReporter(lambda stage: None, lambda: False)
HIDDEN = {
    "slewing": {"slew_rate": 150.0},
    "inductance": {"electrical_time_constant": 0.01},
    "both": {"slew_rate": 150.0, "electrical_time_constant": 0.01},
}


@cache
def selected(hidden: str) -> Selection:
    """What is found of a motor with a friction beside a random torque: an inductance."""
    motor = {"kv": 0.07, "ka": 0.0055, "ks": 0.4} | HIDDEN[hidden]
    torque = {"random_torque": 0.05, "random_torque_time": 0.05, "random_torque_seed": 3.0}
    recording = check(record(motor | torque, *profiles.random(12.0, 12.0, 3), seed=3)[0])
    return select_beside_friction(recording, "armature_inductance")


@pytest.mark.parametrize(("hidden", "stands_in"), [("slewing", True), ("inductance", False), ("both", False)])
def test_an_inductance_stands_in_for_a_slewing_bridge(hidden: str, stands_in: bool) -> None:
    (step,) = selected(hidden).steps
    found = find_slewing("armature_inductance", step.before, step.found.model)
    assert (found is not None) is stands_in
    if found is not None:
        assert found.variable == "past" and found.certain and "at 150 V/s at most" in found.cause
        assert 0.9 < found.share < 1.0 and 2000.0 < found.significance < 2700.0


@pytest.mark.parametrize(("gain", "stands_in"), [(1680.0, True), (1790.0, False)])
def test_slewing_has_to_gain_more_than_the_lag_by_a_margin(
    monkeypatch: pytest.MonkeyPatch, gain: float, stands_in: bool
) -> None:
    monkeypatch.setattr(thresholds, "SLEWING_GAIN", gain)
    (step,) = selected("slewing").steps
    assert (find_slewing("armature_inductance", step.before, step.found.model) is not None) is stands_in


def test_only_lags_are_judged() -> None:
    (step,) = selected("slewing").steps
    assert find_slewing("coulomb_friction", step.before, step.found.model) is None


@pytest.mark.parametrize("hidden", ["slewing", "inductance"])
def test_elimination_takes_a_stand_in_back_and_leaves_it_unexplained(hidden: str) -> None:
    left = eliminate_backward(selected(hidden), SILENT)
    assert is_taken_back(left) is (hidden == "slewing")


def test_a_command_that_never_changes_slews_by_nothing() -> None:
    """Such as runs that are a step each, from their first row on."""
    (step,) = selected("slewing").steps
    problem = step.found.model.estimate.problem
    held = tuple(replace(one, voltage=np.full_like(one.voltage, 5.0)) for one in problem.recordings)
    model = replace(step.found.model, estimate=step.found.model.estimate.on(replace(problem, recordings=held)))
    assert find_slewing("armature_inductance", step.before, model) is None


def test_a_slewing_output_follows_in_rows_means() -> None:
    """Of 0 V, then 10 V: at 2 V a row the means are 1, 3, 5, 7, 9 V; at 4 V a row the third row reaches it halfway."""
    command, row = np.array([0.0, *[10.0] * 6]), 0.01
    for rate, means in ((200.0, [0, 1, 3, 5, 7, 9, 10]), (400.0, [0, 2, 6, 9.5, 10, 10, 10])):
        for sign in (1.0, -1.0):
            given = np.empty_like(command)
            follow(sign * command, np.full(7, row), rate, np.inf, given)
            np.testing.assert_allclose(given, sign * np.array(means), atol=1e-12)


def test_a_row_in_which_others_were_lost_has_its_own_command_from_its_start() -> None:
    """Of a log that lost rows such a bridge came nearer to the commands that nobody logged, and was made up."""
    (step,) = selected("slewing").steps
    recording = step.found.model.estimate.problem.recordings[0]
    time = recording.time.copy()
    time[50:] += 10.0 * recording.info.sample_period  # row 49 is eleven long
    time[100:] += 0.3 * recording.info.sample_period
    changed = replace(recording, sample_time=np.rint(time * 1e9).astype(np.int64))
    voltage = np.where(np.arange(len(time)) % 50 >= 49, 6.0, -6.0)
    given = slew(replace(changed, voltage=voltage), 600.0)
    assert given.voltage[49] == 6.0 and given.voltage[50] > -6.0  # and follows from there
    assert given.voltage[99] < 6.0  # no row was lost
