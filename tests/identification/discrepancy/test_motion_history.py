"""Segments of measured motion say what the motor did: speeds, voltages that act, standstill, what was before."""

from dataclasses import replace

import numpy as np
import pytest
from plant import profiles, record
from recorded import as_speed

from motor_identification.discrepancy.motion_history import LAGS, MotionHistory, make_history
from motor_identification.measurement.build_intervals import make_intervals
from motor_identification.measurement.edit_intervals import join_intervals
from motor_identification.recording import Recording, check

KV, KA, DELAY = 0.07, 0.0055, 0.008


def measured() -> tuple[Recording, MotionHistory, np.ndarray]:
    values = {"kv": KV, "ka": KA, "ks": 0.3, "delay": DELAY}
    recording, truth = record(values, *profiles.pieces([0.0, 6.0, 0.0, -6.0, 3.0], [0.5, 1.0, 1.0, 1.0, 1.0]), seed=1)
    data = make_intervals(check(recording))
    angle = np.interp(data.time, truth.time, truth.angle)
    history = make_history(recording, data, angle, KV, DELAY)
    return recording, history, np.interp(history.time, truth.time, truth.speed)


def test_speed_standstill_and_angle_are_the_shafts() -> None:
    _recording, history, speed = measured()
    moving = ~history.still & (np.abs(speed) > 20.0)
    assert np.abs(history.speed - speed)[moving].max() < 8.0
    assert np.all(history.speed[history.still] == 0.0)
    assert np.median(np.abs(speed[history.still])) < 0.01  # the last slot of a coast belongs to it
    assert 0.2 < history.duration[history.still].sum() < 2.0
    assert history.duration.sum() > 4.4


def test_the_voltage_acts_after_the_delay() -> None:
    _recording, history, _speed = measured()
    begins = history.time[np.flatnonzero(history.voltage == 6.0)[0]]
    assert abs(begins - (0.5 + DELAY)) < 0.006
    assert np.allclose(history.drive, history.voltage - KV * history.speed)


def test_the_past_is_the_command_s_and_ends() -> None:
    _recording, history, _speed = measured()
    assert history.past.shape == (len(history.time), LAGS)
    assert set(np.unique(history.past)) == {-6.0, 0.0, 6.0, 9.0}
    assert np.count_nonzero(history.past.any(axis=1)) < 0.5 * len(history.time)


def test_the_past_does_not_know_the_row_that_a_loop_answers_in() -> None:
    recording, history, _speed = measured()
    acts = recording.time + DELAY
    changed = np.flatnonzero(np.diff(recording.voltage)) + 1
    for k in changed[changed + LAGS + 1 < len(acts)]:
        own, next_row, last = (
            history.past[(history.time > acts[k + lag]) & (history.time < acts[k + lag + 1])] for lag in (0, 1, LAGS)
        )
        change = recording.voltage[k] - recording.voltage[k - 1]
        assert len(own) and np.all(own[:, 0] == 0.0)
        assert len(next_row) and np.all(next_row[:, 0] == change)
        assert len(last) and np.all(last[:, -1] == change)


def test_time_and_travel_since_the_motion_turned() -> None:
    _recording, history, speed = measured()
    after = (history.time > 2.75) & (history.time < 3.4) & (speed < -20.0)
    assert np.all(np.diff(history.since[after]) > 0.0) and history.since[after].max() < 1.2
    assert np.all(np.diff(history.travel[after]) >= 0.0)
    travelled = -np.trapezoid(speed[after], history.time[after])
    assert abs(np.ptp(history.travel[after]) - travelled) < 0.3


def test_intervals_know_their_segments() -> None:
    recording, history, _speed = measured()
    data = make_intervals(recording)
    lengths = np.array([history.duration[a:b].sum() for a, b in zip(history.at_start, history.at_end, strict=True)])
    assert np.allclose(lengths, data.duration, atol=1e-9)


def test_thinned_rows_have_segments_of_their_own_length_that_say_the_same() -> None:
    """But where the command swings: there it is followed sample by sample."""
    values = {"kv": KV, "ka": KA, "ks": 0.3}
    drive = profiles.pieces([0.0, 6.0, 0.0, -6.0, 3.0], [0.5, 1.0, 1.0, 1.0, 1.0])
    stamped, truth = record(values, *drive, seed=1, sample_rate=1000.0, edges=4096, single_channel=False)
    noise = 0.01 * np.random.default_rng(3).standard_normal(len(stamped))
    recording = check(replace(as_speed(stamped), voltage=stamped.voltage + noise))
    data = make_intervals(recording)
    thin = replace(join_intervals(data, 8 * recording.sample_period), rows=8)
    every, fewer = (
        make_history(recording, one, np.interp(one.time, truth.time, truth.angle), KV, DELAY) for one in (data, thin)
    )
    assert len(fewer.time) < 0.25 * len(every.time)
    assert fewer.duration.sum() == pytest.approx(every.duration.sum(), abs=0.01)
    for name in ("voltage", "speed", "drive"):
        before, after = ((getattr(one, name) * one.duration).sum() for one in (every, fewer))
        assert after == pytest.approx(before, abs=2e-3 * np.abs(getattr(every, name)).max())
    for lag in (0, LAGS - 1):
        before, after = ((one.past[:, lag] * one.duration).sum() for one in (every, fewer))
        assert after == pytest.approx(before, abs=1e-4)
    assert {-6, 6, 9} <= set(np.rint(fewer.past[:, 0]).astype(int))
