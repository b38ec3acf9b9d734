"""Speeds over the times between edges are means between edges that came before their rows."""

from dataclasses import replace

import numpy as np
import pytest
from recorded import as_period_speed
from swinging import recorded

from motor_identification.measurement.build_intervals import make_intervals
from motor_identification.measurement.pulse_intervals import (
    FRESH,
    LEAST_NOISE,
    LEAST_ZEROS,
    MOST_REPEATED,
    STOPS,
    make_pulse_intervals,
    measure_slot,
)
from motor_identification.measurement.standstill import LEAST_STANDSTILL
from motor_identification.recording import Recording
from motor_identification.sensor.pulses.pulse_periods import divide_slot
from motor_identification.timing.timing import OTHERS

EDGES = 24
SLOT = 2.0 * np.pi / EDGES


def timed(falls: bool = False, rate: float = 200.0) -> Recording:
    """As a timing with the slot reads it."""
    logged = as_period_speed(recorded(edges=EDGES, sample_rate=rate), falls)
    return replace(OTHERS[0], slot=SLOT).set_on([logged])[0]


@pytest.mark.parametrize("falls", [False, True])
def test_each_is_the_mean_from_one_edge_to_the_next(falls: bool) -> None:
    """The stamps of the plant say when: ends are off by half the time in which the latest edge may have come."""
    stamped, data = recorded(edges=EDGES, sample_rate=200.0), make_intervals(timed(falls))
    moving = data.slack == 0.0
    assert np.allclose(data.duration[moving] * np.abs(data.speed[moving]), SLOT)
    row = np.searchsorted(stamped.time, data.time[data.last][moving])
    latest = (stamped.edge_time[row] - stamped.sample_time[0]) * 1e-9
    within = np.minimum(stamped.edge_period[row], stamped.info.sample_period)
    off = np.abs(data.time[data.last][moving] - latest) / within
    assert np.mean(off <= 0.55) > 0.95
    assert 0.2 < float(np.mean(off)) < 0.37  # 0.25 of what is uniform over 1, from its middle
    assert data.independent


def test_values_that_repeat_or_fall_bring_nothing_new() -> None:
    held, falling = timed(), timed(falls=True)
    for recording in (held, falling):
        count = np.count_nonzero(make_pulse_intervals(recording).slack == 0.0)
        edges = np.abs(np.diff(recording.edge_count))
        assert count <= np.count_nonzero(edges)
        assert count > 0.8 * np.count_nonzero(edges)


@pytest.mark.parametrize(
    ("values", "measured"),
    [
        ([14.0, 12.0, 10.0, 3.8], True),
        ([14.0, 12.0, 10.0, 3.7], False),
        ([14.0, 12.0, 10.0, -9.0], False),
    ],
)
def test_a_value_before_a_stop_or_a_turn_may_be_an_old_one(values: list[float], measured: bool) -> None:
    """Of 0.4 rows: from its speed the motor stops within a slot if it loses 6.25 rad/s of 10 in a row."""
    recording = timed()
    row = recording.info.sample_period
    assert (FRESH, STOPS) == (0.5, 0.25)
    for sign in (1.0, -1.0):
        speed = np.full(len(recording), sign * values[-1])
        speed[: 20 + len(values)] = sign * np.array([10.0] * 20 + values)
        slow = replace(recording, speed=speed, edge_period=divide_slot(4.0 * row, speed))
        ends = make_pulse_intervals(slow).time
        assert bool(np.any(np.abs(ends - 21.8 * row) < 0.01 * row)) is measured  # 0.2 rows before its own


@pytest.mark.parametrize(
    ("values", "measured"),
    [
        ([14.0, 12.0, 10.0, 10.0, 7.4], True),  # loses 2.6 rad/s in its 0.9 rows, and had one of 10
        ([14.0, 12.0, 10.0, 10.0, 7.1], False),
        ([14.0, 13.0, 10.0, 10.0, 9.0], False),
        ([14.0, 12.0, 10.0, 10.0, -7.0], False),
    ],
)
@pytest.mark.parametrize("rows", [1, 2])
def test_a_value_that_stays_before_a_stop_or_a_turn_is_an_old_one(
    values: list[float], measured: bool, rows: int
) -> None:
    """Also where values of whole ticks often repeat by chance: one that stayed for 8 ms was 13 times too fast."""
    recording = timed()
    row, count = recording.info.sample_period, len(recording)
    for sign in (1.0, -1.0):
        speed = np.full(count, sign * values[-1])
        speed += 1e-3 * np.random.default_rng(5).standard_normal(count)
        speed[:200] = sign * (20.0 + np.round(0.5 * np.random.default_rng(4).standard_normal(200)))  # whole ticks
        values_of_it = [*values[:2], *[values[2]] * rows, *values[3:]]
        speed[200 : 200 + len(values_of_it)] = sign * np.array(values_of_it)
        logged = replace(recording, speed=speed, edge_period=divide_slot(9.0 * row, speed))
        ends = make_pulse_intervals(logged).time / row
        assert bool(np.any(np.abs(ends - (202 + rows - 0.45)) < 0.01)) is measured


@pytest.mark.parametrize("period", [0.4, 0.9])
@pytest.mark.parametrize("chance", [0.0, 0.5 * MOST_REPEATED, 1.5 * MOST_REPEATED])
def test_a_value_that_repeats_is_an_old_one_where_new_ones_never_do(chance: float, period: float) -> None:
    """A motor that stopped within a row showed for another one what it had been: 20 to 40 times off its noise."""
    recording = timed()
    row, count = recording.info.sample_period, len(recording)
    speed = 10.0 + 1e-3 * np.random.default_rng(2).standard_normal(count)
    speed[101 : 101 + round(chance * count)] = speed[100]  # whole ticks of a timer
    speed[-101] = speed[-102]
    logged = replace(recording, speed=speed, edge_period=divide_slot(10.0 * period * row, speed))
    ends = make_pulse_intervals(logged).time / row
    new = bool(np.any(np.abs(ends - (count - 101 - 0.5 * period)) < 0.01))
    assert new is (chance > MOST_REPEATED and period < FRESH)


@pytest.mark.parametrize(
    ("values", "measured"),
    [
        ([-4.0, -9.0, -10.0], True),
        ([-3.4, -9.0, -10.0], False),  # in 0.25 of the time since it gained so much
        ([-9.8, -9.0, -10.0], True),
        ([-10.0, -9.0, -10.0], False),  # a motor that turned is slower than a row later
    ],
)
def test_a_time_over_a_turn_is_no_period(values: list[float], measured: bool) -> None:
    """The same edge there and back: whatever the time between, no slot was passed in it."""
    recording = timed()
    row = recording.info.sample_period
    speed = np.full(len(recording), values[-1])
    speed[:30], speed[30 : 30 + len(values)] = 4.0, values
    turned = replace(recording, speed=speed, edge_period=divide_slot(0.5 * row, speed))
    ends = make_pulse_intervals(turned).time / row
    end = 30.0 - 0.25 / abs(values[0])
    assert bool(np.any(np.abs(ends - end) < 1e-3)) is measured


def test_what_follows_a_zero_between_two_ways_is_measured() -> None:
    recording = timed()
    row = recording.info.sample_period
    speed = np.sign(30.0 - np.arange(len(recording))) * 10.0
    turned = replace(recording, speed=speed, edge_period=divide_slot(4.0 * row, speed))
    ends = make_pulse_intervals(turned).time / row
    assert np.any(np.abs(ends - 32.8) < 0.02)


@pytest.mark.parametrize(("seconds", "pieces"), [(0.01, 0), (0.07, 2), (0.12, 1), (0.45, 4)])
def test_a_motor_that_stands_turns_by_less_than_a_slot(seconds: float, pieces: int) -> None:
    """At any time of it: in pieces of a few rows, or of a standstill, from the row before; a row may be lost."""
    recording = timed()
    stands = (recording.time > 5.0) & (recording.time < 5.0 + seconds)
    stopped = replace(
        recording,
        speed=np.where(stands, 0.0, recording.speed),
        edge_period=np.where(stands, 0.0, recording.edge_period),
    )
    data = make_pulse_intervals(stopped)
    within = (data.time[data.first] > 4.97) & (data.time[data.last] < 5.02 + seconds)
    still = np.flatnonzero((data.slack > 0.0) & within)
    assert len(still) == pieces
    if pieces:
        assert data.slack[still] == pytest.approx(2.0 * SLOT)
        begin, end = data.time[data.first[still]], data.time[data.last[still]]
        assert begin[0] == pytest.approx(5.0, abs=0.02) and end[-1] == pytest.approx(5.0 + seconds, abs=0.01)
        assert np.array_equal(begin[1:], end[:-1])
        rows = (end - begin) / recording.sample_period
        assert np.all(rows > LEAST_ZEROS) and np.all((rows > LEAST_STANDSTILL) | (seconds < 0.1))


def test_noise_is_a_share_of_a_slot_and_what_the_motor_gains() -> None:
    data = make_pulse_intervals(timed(rate=500.0))
    moving = data.slack == 0.0
    assert np.min(data.blur[moving]) >= LEAST_NOISE * SLOT / np.sqrt(2.0)
    assert np.max(data.blur[moving]) < SLOT
    assert np.max(data.blur[moving]) > 2.0 * np.min(data.blur[moving])


def test_no_slot_without_periods() -> None:
    assert measure_slot(as_period_speed(recorded(edges=EDGES))) == 0.0
    assert measure_slot(timed()) == pytest.approx(SLOT)
