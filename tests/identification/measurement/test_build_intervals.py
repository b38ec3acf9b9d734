"""Every kind of recording becomes intervals of the mean speed that the disc really had."""

from dataclasses import replace
from math import sqrt, tau

import numpy as np
import pytest
from handmade import PERIOD, SLOTS, turning
from recorded import as_speed

from motor_identification.measurement.build_intervals import OWN_ROW, SAME_ROW, make_intervals
from motor_identification.recording import Floats, Recording
from motor_model.errors import RecordingError
from motor_model.sample import Measurement

SLOT = tau / SLOTS
BELOW = 0.99


def evenly(time: Floats) -> Floats:
    return 700.0 * time


def faster(time: Floats) -> Floats:
    return 300.0 * time + 400.0 * time**2


def test_between_stamped_edges_the_mean_speed_is_exact() -> None:
    data = make_intervals(turning(faster, 1.0))
    start, end = data.time[data.first], data.time[data.last]
    assert data.speed == pytest.approx((faster(end) - faster(start)) * SLOT / (end - start), rel=1e-5)
    assert np.array_equal(data.edge[1:, 0], data.edge[:-1, 1]) and data.slot == pytest.approx(SLOT)
    assert np.all(data.blur == 0.0) and np.all(data.slack == 0.0) and data.left_out == 0
    assert not data.fresh[1:].any() and data.fresh[0]


def test_the_timers_tick_blurs_by_its_standard_deviation() -> None:
    recording = turning(evenly, 0.5)
    coarse = replace(recording, info=replace(recording.info, edge_resolution=1e-5))
    data = make_intervals(coarse)
    assert data.blur == pytest.approx(700.0 * SLOT * 1e-5 / sqrt(12.0), rel=1e-3)
    assert np.all(data.time[data.first] > 0.0)  # stamps are the last tick before the edge: half a tick is added


def test_counts_fix_the_angle_at_the_samples() -> None:
    data = make_intervals(turning(evenly, 1.0, Measurement.COUNTS))
    moving = data.slack == 0.0
    assert np.average(data.speed[moving], weights=data.duration[moving]) == pytest.approx(700.0 * SLOT, rel=0.01)
    assert data.blur[moving] == pytest.approx(SLOT / sqrt(12.0), rel=0.01)  # 3.5 slots a sample: one slot each
    assert data.slot == 0.0  # which flank it was is not known


def test_a_logged_speed_is_a_mean_over_its_window() -> None:
    logged = as_speed(turning(evenly, 1.0), window=4)
    data = make_intervals(logged)
    assert data.duration == pytest.approx(4 * PERIOD)
    late = data.time[data.first] > 0.05
    assert data.speed[late] == pytest.approx(700.0 * SLOT, rel=0.08)  # 14 counts a window, give or take one
    assert data.blur == pytest.approx(SLOT / sqrt(12.0))
    assert data.time[data.last][-1] == pytest.approx(1.0)


def jittered(largest: float, counted: bool) -> Recording:
    """Speeds of rows whose stamps jitter by up to `largest` of a row; on a lattice of counts or with white noise."""
    logged, random = as_speed(turning(evenly, 1.0)), np.random.default_rng(1)
    time = logged.time + largest * PERIOD * random.permutation(np.linspace(-0.5, 0.5, len(logged)))
    time[-20:] += 5.0 * PERIOD  # a pause
    time -= time[0]
    row = float(np.median(np.diff(time)))
    edges = logged.info.edges_per_revolution if counted else 0
    info = replace(logged.info, edges_per_revolution=edges, sample_period=row, speed_window=row, speed_lag=0.5 * row)
    speed = logged.speed if counted else 700.0 * SLOT + random.normal(size=len(logged))
    return replace(logged, sample_time=np.round(time * 1e9).astype(np.int64), info=info, speed=np.asarray(speed))


@pytest.mark.parametrize(
    ("largest", "counted", "chained"),
    [(BELOW * OWN_ROW, False, True), (0.9, False, False), (BELOW * SAME_ROW, True, True), (0.05, True, False)],
)
def test_speeds_of_a_row_are_means_over_it_though_its_stamps_jitter(
    largest: float, counted: bool, chained: bool
) -> None:
    recording = jittered(largest, counted)
    data = make_intervals(recording)
    breaks = np.count_nonzero(data.last[:-1] != data.first[1:])
    assert breaks == 1 if chained else breaks > 10
    after_pause = data.first[-20]
    assert data.time[data.last[-20]] - data.time[after_pause] == pytest.approx(
        recording.info.speed_window
    )  # not the pause
    if chained:
        assert np.delete(data.duration, -20) == pytest.approx(np.delete(np.diff(recording.time), -20), abs=1e-8)


@pytest.mark.parametrize(("duration", "enough"), [(0.005, False), (0.015, True)])
def test_less_than_three_intervals_are_refused(duration: float, enough: bool) -> None:
    recording = turning(evenly, duration)
    if enough:
        assert len(make_intervals(recording).first) >= 3
    else:
        with pytest.raises(RecordingError, match="by hand shows only . intervals of motion"):
            make_intervals(recording)


@pytest.mark.parametrize("missed", [0.0, 0.03])
def test_where_edges_are_missed_only_those_that_follow_each_other_tell_the_speed(missed: float) -> None:
    def quickly(time: Floats) -> Floats:
        return 4000.0 * time + 400.0 * time**2

    recording = turning(quickly, 4.0)
    counted = np.random.default_rng(1).random(int(recording.edge_count[-1]) + 1) >= missed
    number = np.cumsum(counted) - 1  # as the sensor counts them
    real = np.flatnonzero(counted)
    fine = np.linspace(0.0, 4.0, 400_001)
    stamps = np.round(np.interp(real, quickly(fine), fine) * 1e9).astype(np.int64)
    count = np.maximum(number[recording.edge_count], 1)
    before = stamps[count] - stamps[count - 1]
    fewer = replace(recording, edge_count=count, edge_time=stamps[count], edge_period=before * 1e-9)
    data = make_intervals(fewer)
    slots = np.abs(np.diff(data.edge)[:, 0])
    off = data.speed * data.duration / ((quickly(data.time[data.last]) - quickly(data.time[data.first])) * SLOT)
    assert np.mean(np.abs(off - 1.0) < 1e-3) > 0.99
    if missed:
        assert data.missed is not None and data.missed.share == pytest.approx(missed, abs=3.0 * data.missed.error)
        assert np.all(slots == 1)
    else:
        assert data.missed is None and np.max(slots) > 10
