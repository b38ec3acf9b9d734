"""Angles with noise are told from counts of edges, and are fitted as what they are."""

from dataclasses import replace

import numpy as np
import pytest
from recorded import as_counts
from scipy.signal import lfilter
from servo import AXIS, record_servo
from swinging import recorded

from motor_identification.identify import Request, identify
from motor_identification.measurement.build_intervals import make_intervals
from motor_identification.recording import Recording
from motor_identification.sensor import noisy_angle
from motor_identification.sensor.description import note_sensors
from motor_identification.sensor.noisy_angle import (
    LEAST_TOLD,
    MOST_ROWS,
    WELL_TOLD,
    average_rows,
    find_angle_noise,
    find_plain_speed,
)


@pytest.mark.parametrize(("noise", "scale"), [(1e-6, 5e-8), (1e-4, 1e-4), (3e-5, 1e-5)])
def test_the_noise_is_found_and_the_motor_with_it(noise: float, scale: float) -> None:
    recording, _ = record_servo(duration=10.0, noise=noise, scale=scale)
    expected = np.hypot(noise / scale, 12.0**-0.5)
    assert find_angle_noise(recording) == pytest.approx(expected, rel=0.1)
    data = make_intervals(recording)
    moves = data.slack == 0.0
    rows = np.rint(data.duration / recording.sample_period)
    assert rows.sum() == len(recording) - 1 and np.all(rows[moves] == 1)
    assert data.blur[moves] == pytest.approx(expected * scale, rel=0.1)
    fit = identify([recording], Request(("coulomb_friction", "load_bias")))
    for name, value in AXIS.items():
        error = fit.standard_errors[name]
        assert abs(fit.parameters.values[name] - value) < max(4.0 * error, 0.02 * value)
        assert error < 0.15 * value


def test_counts_of_edges_have_none() -> None:
    assert find_angle_noise(record_servo(duration=10.0)[0]) == 0.0
    for edges in (96, 960):
        assert find_angle_noise(as_counts(recorded(edges=edges, sample_rate=200.0))) == 0.0


def test_a_shaft_that_trembles_on_an_edge_has_none() -> None:
    counted = as_counts(recorded(sample_rate=200.0))
    trembling = counted.at_rows(np.arange(1000))
    count = np.arange(1000) % 2
    assert find_angle_noise(type(trembling)(**{**trembling.__dict__, "edge_count": count})) == 0.0
    many = np.random.default_rng(0).normal(0.0, 3.0, 1000).round().astype(np.int64)
    assert find_angle_noise(type(trembling)(**{**trembling.__dict__, "edge_count": many})) > 2.5


@pytest.mark.parametrize(("uneven", "noise", "told"), [(0.1, 0.0, False), (0.1, 30.0, True), (0.0, 3.0, True)])
def test_what_a_motor_travels_to_and_fro_in_uneven_rows_is_no_noise(uneven: float, noise: float, told: bool) -> None:
    """Of one turned back every two or three rows of 20 ± 2 ms, that was taken for noise of 1,600 counts."""
    random = np.random.default_rng(5)
    counted = as_counts(recorded(sample_rate=200.0)).at_rows(np.arange(1000))
    volts = 12.0 * np.repeat(random.choice([-1.0, 1.0], 500), 2)
    rows = 0.005 * (1.0 + uneven * random.standard_normal(1000))
    lag = np.exp(-1.0 / 1.5)
    speed = lfilter([1.0 - lag], [1.0, -lag], 1e3 * volts)
    count = np.rint(np.cumsum(speed * rows) + noise * random.standard_normal(1000)).astype(np.int64)
    driven = replace(
        counted, voltage=volts, edge_count=count, sample_time=np.round(1e9 * np.cumsum(rows)).astype(np.int64)
    )
    found = find_angle_noise(driven)
    assert found == pytest.approx(noise, rel=0.5) if told else found == 0.0


def potentiometer(told: float) -> Recording:
    """Angles of a motor that travels so many times the noise of a row's travel in a row."""
    counted = as_counts(recorded(edges=960, sample_rate=200.0))
    travel = float(np.sqrt(np.mean(np.diff(counted.edge_count) ** 2)))
    noise = np.random.default_rng(0).normal(0.0, travel / told / np.sqrt(2.0), len(counted))
    count = counted.edge_count + np.rint(noise).astype(np.int64)
    speed = np.diff(count, prepend=count[0]) * counted.info.edge_angle * 200.0
    return replace(counted, edge_count=count, speed=speed)


@pytest.mark.parametrize("told", [0.05, 1.5 * LEAST_TOLD])
def test_rows_are_averaged_where_the_noise_hides_their_motion(told: float) -> None:
    noisy = potentiometer(told)
    noise = find_angle_noise(noisy)
    found = average_rows(noisy, noise)
    averaged = told < LEAST_TOLD
    assert (found.rows > 1) is averaged and found.rows <= MOST_ROWS * len(noisy)
    assert found.noise == noise / np.sqrt(found.rows) and len(found.time) == len(noisy) // found.rows
    data = make_intervals(noisy)
    assert data.blur[data.slack == 0.0] == pytest.approx(found.noise * noisy.info.edge_angle)
    said = note_sensors([noisy])[0].notes[-1]
    assert ("averaged over" in said) is averaged and ("sample to sample" in said) is not averaged
    fastest = float(np.abs(find_plain_speed(noisy)).max())
    assert fastest < 400.0 if averaged else fastest == np.abs(noisy.speed).max()


@pytest.mark.parametrize(
    ("told", "rows"),
    [
        ({1: 0.99 * LEAST_TOLD, 2: 0.99 * WELL_TOLD, 3: 1.01 * WELL_TOLD}, 3),
        ({1: 1.01 * LEAST_TOLD, 2: 1.01 * WELL_TOLD}, 1),
        ({1: 0.0}, int(MOST_ROWS * 4001)),  # a motor that stands: no more than these
    ],
)
def test_so_many_rows_are_averaged_that_the_motion_stands_out(
    monkeypatch: pytest.MonkeyPatch, told: dict[int, float], rows: int
) -> None:
    monkeypatch.setattr(noisy_angle, "_measure_told", lambda angle, noise, count: told.get(count, 0.0))
    noisy = potentiometer(0.05)
    assert len(noisy) == 4001 and average_rows(noisy, 80.0).rows == rows


def test_a_motor_that_swings_has_travels_beyond_the_noise_though_none_in_common() -> None:
    swing = 10.0 * np.sin(0.25 * np.pi * np.arange(2000))  # 7.7 a row
    random = np.random.default_rng(1).normal(0.0, 3.0, 2000)
    assert noisy_angle._measure_told(swing + random, 3.0, 1) > 1.0
    assert noisy_angle._measure_told(random, 3.0, 1) < 0.2 < noisy_angle._measure_told(random + np.arange(2000), 3.0, 1)


def test_a_motor_is_identified_behind_a_potentiometer_that_hides_the_motion_of_a_row() -> None:
    """Of 0.61 rad of noise in rows of 22 ms a real one's kv ended at the limit of its range, by a factor of 7."""
    clean, noisy = identify([potentiometer(50.0)], Request()), identify([potentiometer(0.1)], Request())
    value, error = noisy.parameters.value("kv"), noisy.standard_errors["kv"]
    assert abs(value - clean.parameters.value("kv")) < 4.0 * error < 0.1 * value
    assert WELL_TOLD > LEAST_TOLD


def test_rests_are_times_at_which_nothing_moves_a_motor() -> None:
    """From angle to angle, a random torque that a filter learns seems to be too small for a motor that friction holds.

    In the simulated recording where that was met, 0.0100 V of 0.0120 V, and an effect "not in the table" was missing.
    """
    recording, truth = record_servo(duration=10.0, noise=3e-5, scale=1e-5)
    data = make_intervals(recording)
    still = data.slack > 0.0
    assert np.count_nonzero(still) >= 2 and data.slack[still] == pytest.approx(7.0 * data.blur[0])
    for start, end in zip(data.time[data.first[still]], data.time[data.last[still]], strict=True):
        inside = (recording.time >= start) & (recording.time <= end)
        assert np.ptp(truth.angle[inside]) < data.slack[still][0]
