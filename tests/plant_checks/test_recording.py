"""What the board reports: samples, latched voltages, periods, and a speed whose sign it can only conclude."""

import numpy as np
import pytest
from plant import Truth, profiles, record
from plant.board import SignOfOneChannel

from motor_identification.recording import Recording, check
from motor_model.errors import ModelError
from motor_model.sample import Measurement

KV, KA = 12 / 174.097, 0.0055
MOTOR = {"kv": KV, "ka": KA, "ks": 0.5}
SLOT = 2.0 * np.pi / 96


@pytest.fixture(scope="module")
def rich() -> tuple[Recording, Truth]:
    return record(MOTOR, *profiles.rich(), irregularity=0.01, name="rich")


def test_recording_is_one_that_identification_accepts(rich: tuple[Recording, Truth]) -> None:
    recording, truth = rich
    assert check(recording) is recording
    assert recording.uri == "rich" and recording.info.measurement is Measurement.EDGES
    assert recording.sample_time[0] == 1_000_000_000
    assert set(np.diff(recording.sample_time)) == {5_000_000}
    assert 30.0 < recording.duration < 45.0
    assert len(truth.speed) == len(recording) and np.array_equal(recording.voltage, profiles.rich()[1])


def test_reports_agree_with_the_edges_that_happened(rich: tuple[Recording, Truth]) -> None:
    recording, truth = rich
    since_start = recording.edge_time * 1e-9 - 1.0
    some = truth.latest_edge >= 0
    edges, first = np.unique(truth.latest_edge[some], return_index=True)
    late = truth.edge_time[edges] - since_start[some][first]
    assert late.min() > -1e-9 and 3.9e-6 < late.max() < 4e-6 + 1e-9
    assert late.mean() == pytest.approx(2e-6, rel=0.03)
    assert np.all(truth.edge_time[truth.latest_edge[some]] <= truth.time[some])
    following = truth.latest_edge + 1
    more = following < len(truth.edge_time)
    assert np.all(truth.edge_time[following[more]] > truth.time[more])
    two = recording.edge_count >= 2
    stamps = np.floor((1.0 + truth.edge_time) / 4e-6 + 1e-9) * 4e-6
    periods = np.diff(stamps)[truth.latest_edge[two] - 1]
    assert np.abs(recording.edge_period[two] - periods).max() < 1e-12
    assert np.all(recording.edge_period[~two] == 0.0)


def test_speed_is_the_period_bounded_by_the_wait(rich: tuple[Recording, Truth]) -> None:
    recording, truth = rich
    since = (recording.sample_time - recording.edge_time) * 1e-9
    two = recording.edge_count >= 2
    expected = SLOT / np.maximum(np.where(two, recording.edge_period, 1.0), since)
    expected[~two | (since > 0.1)] = 0.0
    assert np.allclose(np.abs(recording.speed), expected, rtol=1e-12, atol=0.0)
    assert np.count_nonzero((recording.speed == 0.0) & (since > 0.1)) > 50
    steady = np.abs(np.gradient(truth.speed, 0.005)) < 20.0
    fast = steady & (np.abs(truth.speed) > 50.0)
    assert np.median(np.abs(recording.speed[fast] - truth.speed[fast])) < 0.02 * 120.0


@pytest.mark.parametrize("seed", range(4))
def test_sign_follows_the_motion_not_the_voltage(seed: int) -> None:
    recording, truth = record(MOTOR, *profiles.random(12.0, 20.0, seed), irregularity=0.01, seed=seed)
    moving = np.abs(truth.speed) > 5.0
    wrong = moving & (np.sign(recording.speed) == -np.sign(truth.speed))
    by_voltage = moving & (recording.voltage != 0.0) & (np.sign(recording.voltage) != np.sign(truth.speed))
    turns = len(truth.reversal_time)
    assert turns > 15
    assert 0 < wrong.sum() < 5 * turns < by_voltage.sum()
    at = truth.time[wrong]
    since_turn = at - truth.reversal_time[np.searchsorted(truth.reversal_time, at, side="right") - 1]
    assert since_turn.min() >= 0.0 and since_turn.max() < 0.04  # only ever late, by a few slots
    flips = np.flatnonzero(np.diff(np.sign(recording.speed)) * np.sign(recording.speed[:-1]) == -2)
    assert np.all(recording.edge_time[flips + 1] > recording.edge_time[flips])  # at an edge, never between


@pytest.mark.parametrize("delay", [0.0, 0.008])
def test_a_speeding_motor_is_not_taken_to_reverse_when_the_voltage_does(delay: float) -> None:
    time, volts = profiles.pieces([12.0, -1.0, 6.0], [0.02, 0.02, 0.2])
    recording, truth = record(MOTOR | {"delay": delay}, time, volts, irregularity=0.01)
    assert np.all(truth.speed >= 0.0) and np.all(recording.speed >= 0.0)
    assert recording.speed.max() > 40.0


def test_sign_rule_edge_by_edge() -> None:
    rule = SignOfOneChannel()
    rule.voltage(-3.0)
    rule.edge(0.0, True)
    assert rule.sign == -1
    rule.edge(0.010, False)
    rule.edge(0.010, False)
    rule.voltage(0.0)
    rule.edge(0.012, False)
    rule.voltage(4.0)
    signs = []
    for period in (0.015, 0.020, 0.030, 0.025, 0.012):  # 0.025 is a maximum passed, but within what slots do
        rule.edge(period, False)
        signs.append(rule.sign)
    assert signs == [-1, -1, -1, -1, 1]
    rule.voltage(-4.0)
    rule.voltage(4.0)  # back before it acted
    rule.edge(0.006, False)
    assert rule.sign == 1
    rule.voltage(-4.0)
    rule.edge(0.2, True)  # stood in between
    assert rule.sign == -1


def test_latches_the_command_that_is_due_and_no_more_than_the_supply() -> None:
    recording, truth = record(MOTOR, [0.012, 0.05], [20.0, -3.0], duration=0.1)
    assert np.array_equal(recording.voltage, np.repeat([0.0, 12.0, -3.0], [3, 7, 11]))
    started = truth.motion.time[np.flatnonzero(truth.motion.speed)[0] - 1]
    assert started == pytest.approx(0.015, abs=1e-12)
    short = record(MOTOR | {"max_voltage": 6.0}, [0.0], [20.0], duration=0.1)[0]
    assert np.all(short.voltage == 6.0) and short.info.max_voltage == 6.0


def test_other_rates_ticks_and_discs() -> None:
    recording, truth = record(
        {"kv": 0.0, "ka": KA}, [0.0], [0.0], duration=0.5, sample_rate=1000.0, tick=62.5e-9, edges=20, start_speed=90.0
    )
    assert len(recording) == 501 and recording.info.sample_period == 0.001
    late = 1.0 + truth.edge_time[truth.latest_edge[-300:]] - recording.edge_time[-300:] * 1e-9
    assert late.min() > -1e-9 and 50e-9 < late.max() < 64e-9
    assert recording.speed[-1] == pytest.approx(90.0, rel=1e-5)
    assert recording.edge_count[-1] == pytest.approx(0.5 * 90.0 / (2.0 * np.pi / 20), abs=1.0)


def test_starts_anywhere_in_a_turn_by_the_seed() -> None:
    starts = np.array([record(MOTOR, [0.0], [5.0], duration=0.02, seed=seed)[1].start_angle for seed in range(40)])
    assert starts.min() < 1.0 and starts.max() > 5.3 and np.all((starts >= 0.0) & (starts < 2.0 * np.pi))
    assert record(MOTOR, [0.0], [5.0], duration=0.02, seed=7)[1].start_angle == starts[7]


def test_a_motor_that_never_moves_reports_nothing() -> None:
    recording, truth = record(MOTOR, [0.0], [0.4], duration=0.5)
    assert not np.any(recording.speed) and not np.any(recording.edge_count) and not np.any(recording.edge_time)
    assert np.all(truth.latest_edge == -1) and len(truth.reversal_time) == 0


@pytest.mark.parametrize("commands", [[float("nan")], [1.0, 2.0]])
def test_commands_that_are_no_voltages_are_refused(commands: list[float]) -> None:
    with pytest.raises(ModelError, match="finite voltage"):
        record(MOTOR, [0.0], commands)


@pytest.mark.parametrize("name", ["step", "staircase", "ramps", "reversals", "coast", "random", "rich"])
def test_profiles_keep_to_their_voltage_and_end_at_rest(name: str) -> None:
    time, volts = getattr(profiles, name)(9.0)
    assert np.array_equal(time, np.arange(len(time)) / 200.0) and volts[-1] == 0.0
    assert 8.0 < np.abs(volts).max() <= 9.0
    assert name == "step" or volts.min() < -4.4
