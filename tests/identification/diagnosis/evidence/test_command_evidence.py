"""A motion that has nothing to do with its command is told from one that a random torque shakes."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from stub_models import stub_held
from swinging import noisy

from motor_identification.diagnose import diagnose
from motor_identification.diagnosis.evidence import command_evidence
from motor_identification.diagnosis.evidence.command_evidence import (
    find_falling,
    find_ignored,
    find_stopped,
    goes_with_sweep,
)
from motor_identification.diagnosis.result import Diagnosis, Verdict
from motor_identification.discrepancy.structure import CERTAIN, Structure
from motor_identification.identify import Request
from motor_identification.measurement.intervals import index_intervals
from motor_identification.noise.error_model import Disturbance
from motor_identification.recording import Recording, check
from motor_identification.reporting.diagnosis_text import summarize_diagnosis


def diagnosed(recording: Recording) -> Diagnosis:
    return diagnose([recording], [], Request(()))


@cache
def following() -> Diagnosis:
    """Of a motor that does what it is told."""
    return diagnosed(noisy(0.5))


def wandering() -> Recording:
    """Speeds around 200 rad/s that go their own way, beside a slow triangle of voltages one way."""
    logged = noisy(0.5)
    random, count = np.random.default_rng(7), len(logged)
    walk = np.zeros(count)
    for k in range(1, count):
        walk[k] = 0.995 * walk[k - 1] + random.normal(0.0, 4.0)
    triangle = 2.0 + 10.0 * np.abs((np.linspace(0.0, 3.0, count) % 1.0) - 0.5) * 2.0
    return check(replace(logged, voltage=triangle, speed=200.0 + walk + random.normal(0.0, 6.0, count)))


def stepping(last: float, voltage: float = 6.0, rest: float = 0.1, ran: float = 1.0) -> Recording:
    """Four steps of 1 s to 6 V, 1 s apart, each followed after a rest; the last of them, of so long, by nothing."""
    logged = noisy(0.5)
    period = logged.info.sample_period
    time = period * np.arange(round((8.0 + last) / period))
    stepped = (time % 2.0 < 1.0) & (time < 8.0)
    runs = stepped & (time % 2.0 >= rest) & (time % 2.0 < ran)
    volts = np.where(time < 8.0, 6.0 * stepped, voltage)
    part = logged.at_rows(np.arange(len(time)) % len(logged))
    stamps = np.round(1e9 * time).astype(np.int64)
    return replace(part, sample_time=stamps, voltage=volts, speed=np.where(runs, 100.0, 1.0))


@pytest.mark.parametrize(
    ("logged", "begin"),
    [
        (stepping(2.9), 8.0),
        (stepping(2.9, voltage=-6.0), 8.0),
        (stepping(2.9, voltage=4.0), None),  # which never moved it
        (stepping(2.9, voltage=2.0), None),  # which need not
        (stepping(2.9, rest=0.45), 8.0),
        (stepping(1.3, rest=0.45), None),  # it rested before each step
        (stepping(2.9, rest=0.55), None),  # it stands as a rule
        (stepping(0.5), None),  # a few rows
        (stepping(15.0), None),  # it rather stands, as at the place that a loop was to hold
    ],
)
def test_a_motor_that_was_switched_off_stands_under_what_moved_it(logged: Recording, begin: float | None) -> None:
    """A robot's wheel stood for the last 11 s of 56: 148 times the floor, and a voltage limit or a load was offered."""
    others = [stepping(2.9, voltage=0.0), logged]
    found = find_stopped(others)
    assert (None if found is None else found.begin) == (None if begin is None else pytest.approx(begin, abs=0.02))
    assert found is None or found.recording is logged


@pytest.mark.parametrize(
    ("left", "expected"),
    [
        ([Structure("time", 0.15, 1.01 * CERTAIN), Structure("angle", 0.12, 5.6)], True),
        ([Structure("time", 0.15, 0.99 * CERTAIN)], False),
        ([Structure("angle", 0.16, 7.0), Structure("time", 0.15, 7.0)], False),
        ([Structure("time", 0.15, 7.0, cause="a load that wanders")], False),
        ([], False),
    ],
)
def test_what_goes_with_the_time_of_a_sweep_goes_with_its_frequency(left: list[Structure], expected: bool) -> None:
    logged = noisy(0.5)
    turns = np.linspace(0.0, 6.0, len(logged))
    swept, even = (replace(logged, voltage=6.0 * np.sin(2.0 * np.pi * phase)) for phase in (turns**2, turns))
    held = replace(stub_held(5.0), recordings=(swept,))
    assert goes_with_sweep(left, held) is expected
    for others in ((swept, even), (even,), ()):
        assert not goes_with_sweep(left, replace(held, recordings=others))


def rising_and_falling(times: int) -> Recording:
    """Under 0 to 10 V and back, so many times."""
    logged = noisy(0.5)
    turns = np.linspace(0.0, times, len(logged), endpoint=False)
    return replace(logged, voltage=10.0 * (1.0 - np.abs(2.0 * (turns % 1.0) - 1.0)))


@pytest.mark.parametrize(
    ("times", "lost", "once", "followed", "found"),
    [
        (3, 15.0, 0.0, 0.0, True),
        (3, 15.0, 0.0, 0.4, True),
        (3, 15.0, 0.0, 0.6, False),  # the model does so, too: it had no time to follow
        (1, 15.0, 0.0, 0.0, False),  # up and down once may be a load that came and went
        (3, 3.0, 0.0, 0.0, False),
        (3, 15.0, 150.0, 0.0, False),  # in one of them it was slower everywhere
    ],
)
def test_a_speed_that_falls_where_the_voltage_rises(
    times: int, lost: float, once: float, followed: float, found: bool
) -> None:
    """Lost speed [rad/s] a volt from 5 V on, as where a program misses counts: it was "a voltage limit"."""
    one = rising_and_falling(times)
    begin, end = one.time[:-1], one.time[1:]
    volts = one.voltage[:-1]
    fell = lost * np.maximum(volts - 5.0, 0.0)
    speed = 60.0 * np.minimum(volts, 5.0) - fell - once * (end > 0.7 * one.duration)
    follows = 60.0 * np.minimum(volts, 5.0) - followed * fell
    data = index_intervals(begin, end, speed, np.full(len(speed), 1e-3))
    angle = np.append(0.0, np.cumsum(follows * (end - begin)))
    held = replace(stub_held(5.0), recordings=(one,), intervals=(data,), angles=(angle,))
    falling = find_falling(held)
    assert (falling is not None) is found
    if falling is not None:
        assert 5.0 < falling.voltage < 6.3 < 8.7 < falling.higher < 10.0
        assert falling.slower == pytest.approx(300.0 - lost * (falling.higher - 5.0), rel=0.01)


def test_of_such_a_speed_that_is_said_and_nothing_is_explained() -> None:
    one = following()
    (data,), logged = one.after.intervals, rising_and_falling(3)
    middle = 0.5 * (data.time[data.first] + data.time[data.last])
    volts = np.interp(middle, logged.time, logged.voltage)
    speed = 60.0 * np.minimum(volts, 5.0) - 15.0 * np.maximum(volts - 5.0, 0.0)
    held = replace(one.after, recordings=(logged,), intervals=(replace(data, speed=speed),))
    text = summarize_diagnosis(replace(one, after=held, disturbance=Disturbance(0.4, 0.1, 0.3, 0.1)))
    assert text.startswith("The speed falls where the voltage rises, each time: ")
    assert "a sensor that misses counts at speed" in text and "The rest is random" not in text


@pytest.mark.slow
def test_a_motion_that_does_not_follow_its_command_is_no_motor_with_nothing_missing() -> None:
    said = diagnosed(wandering())
    assert said.verdict is Verdict.UNDECIDED and said.findings == () and said.suggested_experiment == ""
    text = summarize_diagnosis(said)
    assert text.startswith("The motion hardly follows the command: a motor leaves") and "Nothing is missing" not in text


@pytest.mark.parametrize(("limit", "value"), [("LEAST_EXPLAINED", 1.0), ("VARIES", 0.0), ("MATTERS", 0.0)])
def test_every_limit_decides(limit: str, value: float, monkeypatch: pytest.MonkeyPatch) -> None:
    held = following().after
    assert find_ignored(held) is None
    monkeypatch.setattr(command_evidence, "LEAST_EXPLAINED", 1.0)
    monkeypatch.setattr(command_evidence, "MATTERS", 0.0)
    assert find_ignored(held) is not None
    monkeypatch.setattr(command_evidence, limit, 1.0 - value if limit != "LEAST_EXPLAINED" else 0.0)
    assert find_ignored(held) is None
