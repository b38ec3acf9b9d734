"""Speeds that nobody described: the sensor they were made by is found, whichever it was."""

from dataclasses import replace
from math import sqrt, tau
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from plant import record
from recorded import as_speed, without_count
from swinging import noisy, recorded

from motor_identification.measurement.build_intervals import make_intervals
from motor_identification.recording import Recording
from motor_identification.sensor.description import note_sensors
from motor_identification.sensor.speed_sensor import (
    COUNT_NOISE,
    EVEN_ROWS,
    MOST_COUNTS,
    NOISE_BEYOND_DIGITS,
    UNTOLD,
    are_blurred,
    are_smoothed,
    are_whole_counts,
    find_counts,
    find_noise,
    find_speed_sensor,
    is_converted,
    lies_between_counts,
    lies_on_steps,
)
from motor_identification.sensor.value_lattice import are_whole_products


@pytest.mark.parametrize(("edges", "seed"), [(96, 0), (96, 1), (960, 0), (960, 2), (2800, 0)])
def test_counts_within_a_window_are_found(edges: int, seed: int) -> None:
    said = as_speed(recorded(seed, edges))
    known, found = find_speed_sensor(said), find_speed_sensor(without_count(said))
    assert found.edges_per_revolution == edges and found.step == pytest.approx(known.step, rel=1e-6)
    assert found.window == 0.02 and found.lag == 0.01 and found.frame == found.sigma == known.sigma == 0.0
    with_it, without = make_intervals(said), make_intervals(without_count(said))
    assert without.blur == pytest.approx(with_it.blur, rel=1e-6)
    assert without.blur == pytest.approx(tau / edges / sqrt(12.0), rel=1e-6)
    assert not without.independent and np.array_equal(without.fresh, with_it.fresh)


@pytest.mark.parametrize("said", [True, False])
def test_counts_are_of_the_encoders_shaft_before_a_gear(said: bool) -> None:
    """The floor of a gearmotor of 48 : 1 was 48 times as high as its encoder's, if its count and gear were said."""
    geared = as_speed(recorded(0, 960))
    info = replace(geared.info, edges_per_revolution=20 if said else 0, gear_ratio=48.0)
    found = find_speed_sensor(replace(geared, info=info))
    assert found.edges_per_revolution == 20
    assert found.step == pytest.approx(find_speed_sensor(geared).step, rel=1e-6) and found.sigma == 0.0


@pytest.mark.parametrize("sigma", [0.05, 0.5, 5.0])
def test_white_noise_is_found_where_there_are_no_counts(sigma: float) -> None:
    recording = noisy(sigma)
    found = find_speed_sensor(recording)
    assert found.step == 0.0 and found.edges_per_revolution == 0
    assert 0.93 * sigma < found.sigma < 1.1 * sigma + 0.08  # friction that turns is some of it
    data = make_intervals(recording)
    assert data.sigma == pytest.approx(found.sigma, rel=1e-6) and data.independent and np.all(data.fresh)


def test_printed_digits_are_no_counts() -> None:
    """Where noise is more than the last digit it is noise; where it is less, digits are all there is."""
    fine, coarse = find_speed_sensor(noisy(0.5, digits=1)), find_speed_sensor(noisy(0.01, digits=0))
    assert fine.step == 0.0 and 0.5 < fine.sigma < 1.3
    assert NOISE_BEYOND_DIGITS * COUNT_NOISE < 1.0 and (coarse.step == 1.0 or coarse.sigma > 1.0 / sqrt(12.0))


@pytest.mark.parametrize(
    ("step", "counts"),
    [(50.0 / 1023, False), (50.0 / 1024, False), (33.0 / 1023, False), (0.04871, True)],
    ids=["5 V in 10 bits", "5 V in 1,024 parts", "3.3 V", "no converter"],
)
def test_a_converters_bits_are_no_counts(step: float, counts: bool) -> None:
    """A tachogenerator's noise of two bits is noise, though as much between neighbours may be a motor's motion."""
    recording = noisy(2.0 * step)
    bits = replace(recording, speed=step * np.round(recording.speed / step))
    found = find_speed_sensor(bits)
    assert (found.step > 0.0) == counts and (counts or 1.8 * step < found.sigma < 2.2 * step + 0.08)


@pytest.mark.parametrize(("noise", "counts"), [(2.6, False), (0.2, True)])
def test_noisy_steps_of_which_no_encoder_has_so_many_a_turn_are_no_counts(noise: float, counts: bool) -> None:
    """As of a tachogenerator behind ten bits: of an encoder of a geared shaft there may be so many, with less noise."""
    exact = noisy(0.0)
    swings, step = exact.speed / np.max(np.abs(exact.speed)), tau / (2.3 * MOST_COUNTS) / exact.info.sample_period
    values = step * np.round(100.0 * swings + noise * np.random.default_rng(1).standard_normal(len(swings)))
    found = find_speed_sensor(replace(exact, speed=values))
    assert (found.step > 0.0) is counts
    assert counts or found.sigma == pytest.approx(noise * step, rel=0.2)


def test_held_speeds_have_the_times_of_their_frames() -> None:
    """A speed of 20 ms in a log of 5 ms: the intervals are those of the sensor."""
    slow = without_count(as_speed(recorded(sample_rate=50.0)))
    rows = np.minimum(np.arange(4 * len(slow) - 3) // 4, len(slow) - 1)
    fast = slow.at_rows(rows)
    every = np.round(slow.sample_time[0] + np.arange(len(rows)) * 5e6).astype(np.int64)
    fast = replace(
        fast, sample_time=every, info=replace(slow.info, sample_period=0.005, speed_window=0.005, speed_lag=0.0025)
    )
    found, alone = find_speed_sensor(fast), find_speed_sensor(slow)
    assert found.frame == pytest.approx(0.02, rel=1e-6) and found.window == found.frame
    assert found.lag == pytest.approx(0.01, rel=1e-6)  # the window ends where the frame was made
    assert found.edges_per_revolution == alone.edges_per_revolution == 960
    assert np.array_equal(fast.speed[found.row][1:], slow.speed[alone.row][1 : len(found.row)])
    assert found.time[1:] == pytest.approx(alone.time[1 : len(found.row)], abs=1e-6)  # the log reads it itself
    assert len(make_intervals(fast).first) == pytest.approx(len(make_intervals(slow).first), abs=2)


def test_what_was_said_is_not_looked_for() -> None:
    said = replace(noisy(0.5), info=replace(noisy(0.5).info, edges_per_revolution=100))
    assert find_speed_sensor(said).step == pytest.approx(tau / 100 / 0.02) and find_speed_sensor(said).sigma == 0.0
    point = replace(noisy(0.5), info=replace(noisy(0.5).info, speed_window=0.0, speed_lag=0.0))
    assert find_speed_sensor(point).window == 0.02 and find_speed_sensor(point).lag == 0.0


def test_a_dozen_speeds_are_good_to_a_hundredth() -> None:
    few = noisy(0.5).at_rows(np.arange(100, 112))
    assert find_speed_sensor(few).sigma == pytest.approx(UNTOLD * np.sqrt(np.mean(few.speed**2)))
    assert make_intervals(few).sigma == pytest.approx(find_speed_sensor(few).sigma, rel=1e-6)


def test_a_run_with_other_rows_than_the_log_has_its_own_window() -> None:
    """Ramps at 20 ms and steps at 5 ms in one log: the typical period is that of the ramps."""
    steps = noisy(0.3)
    for period, window in ((0.08, 0.02), (0.0205, 0.0205)):
        info = replace(steps.info, sample_period=period, speed_window=period, speed_lag=0.5 * period)
        found = find_speed_sensor(replace(steps, info=info))
        assert found.window == pytest.approx(window) and found.lag == pytest.approx(0.5 * window)
    said = find_speed_sensor(replace(steps, info=replace(steps.info, speed_window=0.1, speed_lag=0.05)))
    assert said.window == 0.1 and said.lag == 0.05


@pytest.mark.parametrize(("window", "counts"), [(0.02, True), (0.0007, True), (0.0005, False), (0.0004, False)])
def test_a_lattice_of_values_that_are_no_means_over_their_rows_is_what_they_are_rounded_to(
    window: float, counts: bool
) -> None:
    log = without_count(as_speed(recorded(3)))
    assert log.info.sample_period == pytest.approx(0.02)
    log = replace(log, info=replace(log.info, speed_window=window))
    sensor = find_speed_sensor(log)
    assert (sensor.step > 0.0, sensor.sigma > 0.0) == (counts, not counts)


@pytest.mark.parametrize(
    ("step", "window", "counts"),
    [
        (0.01, 0.05, 0),  # digits of rad/s
        (0.01 * (1.0 + 1e-4), 0.05, 12565),  # and what is near to them
        (1e-3 * tau / 60.0, 0.02, 0),  # of rpm: 3,000,000 counts a turn
        (0.1 * tau / 60.0, 0.025, 0),
        (0.1 * tau / 60.0, 0.035, 17143),
    ],
)
def test_a_lattice_of_printed_digits_is_none_of_counts(step: float, window: float, counts: int) -> None:
    """Whatever their noise: 12,579 counts a turn were assumed of two decimals, of a motor whose speed was smoothed."""
    values = step * np.round(300.0 + 250.0 * np.sin(np.linspace(0.0, 40.0, 1000)))
    assert find_counts(values, window) == (pytest.approx(step) if counts else 0.0)
    found, sigma, edges = find_noise(values, np.ones(1000), window)
    assert (found > 0.0, edges) == (counts > 0, counts)
    assert counts or sigma >= step / sqrt(12.0)


@pytest.mark.parametrize(("step", "window", "counts"), [(tau, 0.01, 100), (tau, 0.001, 1000), (0.1 * tau, 0.01, 0)])
def test_whole_turns_a_second_are_counts_and_their_tenths_may_be_digits(
    step: float, window: float, counts: int
) -> None:
    """An eccentric disc of 100 counts a turn made noise of more than such a digit, and was not looked for."""
    level = 40.0 * np.sin(np.linspace(0.0, 40.0, 1000)) + 1.5 * np.random.default_rng(3).standard_normal(1000)
    found, sigma, edges = find_noise(step * np.rint(level), np.ones(1000), window)
    assert (found > 0.0, edges) == (counts > 0, counts) and (sigma > 0.0) is (counts == 0)


@pytest.mark.parametrize(
    ("noise", "window", "counts"), [(1.3, 0.01, 0), (0.0, 0.01, 447), (1.3, 0.01 * 446.81 / 447.0, 447)]
)
def test_a_converters_steps_below_a_sensors_noise_are_no_counts(noise: float, window: float, counts: int) -> None:
    """A tachogenerator behind ten bits was said to be 447 counts a turn; noise of a disc in whole counts is one."""
    step, random = 2.4 * 600.0 / 1024.0, np.random.default_rng(3)
    level = np.append(np.zeros(100), 340.0 * np.sin(np.linspace(0.0, 20.0, 2000)) ** 2)
    sums = np.cumsum(level) + random.uniform()
    steps = np.rint(level + noise * random.standard_normal(2100)) if noise else np.diff(np.floor(sums), prepend=0.0)
    found, sigma, edges = find_noise(step * steps, np.ones(2100), window)
    assert (found > 0.0, edges) == (counts > 0, counts)
    assert sigma == (0.0 if counts else pytest.approx(noise * step, rel=0.15))


@pytest.mark.parametrize(
    ("step", "converted"),
    [(5.0 / 1023.0, True), (3.3 / 4096.0, True), (0.005, False), (tau / 60.0, False), (0.0, False)],
)
def test_the_steps_of_a_converter_of_volts_are_known(step: float, converted: bool) -> None:
    """A tachogenerator behind ten bits was said to be timed between edges, a slot of 0.0506 rad each."""
    plain = noisy(0.0)
    speed = step * np.rint(plain.speed / 0.05) if step else plain.speed
    assert is_converted(replace(plain, speed=speed)) is converted


@pytest.mark.parametrize("noise", [9.0, 0.0])
@pytest.mark.parametrize("turn", [1871.37, 1871.0])
def test_multiples_of_a_step_are_told_from_printed_digits_and_from_values_of_any_size(
    turn: float, noise: float
) -> None:
    """A tachogenerator in rows that jitter was said to be a slot of 0.02 rad over the time between two edges."""
    random, step = np.random.default_rng(6), tau / turn / 0.02
    level = np.rint(300.0 * np.sin(np.arange(1000) / 90.0) + noise * random.standard_normal(1000))
    assert lies_on_steps(np.round(step * level, 4))
    assert not lies_on_steps(step * (level + 0.3 * random.standard_normal(1000)))
    assert not lies_on_steps(0.01 * level) and not lies_on_steps(tau / 60.0 * level) and not lies_on_steps(0.0 * level)


@pytest.mark.parametrize(("near", "counts"), [(1e-5, 0), (3.5e-4, 12562)])
def test_counts_that_come_near_to_a_digit_keep_the_motion_between_rows(near: float, counts: int) -> None:
    """Where speeds change by counts a row, a lattice of digits is taken for noise; one of 0.10003 rad/s is none."""
    step = 0.1 * (1.0 + near)
    level = 120.0 * np.sin(np.linspace(0.0, 40.0, 1000)) + 1.5 * np.random.default_rng(3).standard_normal(1000)
    found, sigma, edges = find_noise(step * np.rint(level), np.ones(1000), 0.005)
    assert (found > 0.0, edges) == (counts > 0, counts)
    assert (sigma > 0.0) == (counts == 0)


def counted_by_own_rows(uneven: float, edges: int = 96) -> Recording:
    """Counts of rows that differ in length by as much of it, divided by their lengths; a pause before the last 20."""
    log, random = without_count(as_speed(recorded(3, edges))), np.random.default_rng(5)
    rows = 0.02 * (1.0 + uneven * random.uniform(-1.0, 1.0, len(log)))
    rows[-20] = 0.2
    rows = 1e-9 * np.round(1e9 * rows)
    rows *= 0.02 / np.median(rows[1:])
    stamps = np.round(1e9 * np.cumsum(rows)).astype(np.int64)
    counts = np.rint(log.speed * 0.02 * edges / tau)
    divisors = np.append(rows[0], np.diff(stamps) * 1e-9)
    divisors[-20] = 0.02
    return replace(log, speed=np.round(counts * tau / edges / divisors, 5), sample_time=stamps)


def test_counts_that_were_divided_by_their_own_rows_are_counts() -> None:
    """Chained at their ends, but for a pause, with one count's noise at each."""
    log = counted_by_own_rows(0.2)
    found = find_speed_sensor(log)
    assert found.sigma == 0.0 and found.step * found.window == pytest.approx(tau / 96, rel=1e-4)
    assert found.edges_per_revolution == 96 and found.lengths is not None and found.lengths[-20] == found.window
    data = make_intervals(log)
    assert not data.independent and data.blur == pytest.approx(tau / 96 / sqrt(12.0), rel=1e-4)
    assert np.count_nonzero(data.last[:-1] != data.first[1:]) == 1
    assert np.delete(data.duration, -20) == pytest.approx(np.delete(np.diff(log.time), -20), abs=2e-9)
    assert (
        "Every speed, by the length of its row beside the usual one, is a multiple of 3.27"
        in note_sensors([log])[0].notes[-1]
    )


@pytest.mark.parametrize(("own", "stamps"), [(True, 6), (True, 4), (False, 6)])
def test_few_counts_belong_to_the_rows_they_were_divided_by(own: bool, stamps: int) -> None:
    """0, 1 or 2 counts in rows that jitter by 2 %: by their own lengths, or all alike."""
    log, random = without_count(as_speed(recorded(3, 28))), np.random.default_rng(6)
    rows = 0.004 * (1.0 + 0.02 * random.standard_normal(len(log)))
    counts = np.floor(1.0 + 0.9 * np.sin(np.arange(len(log)) / 150.0) + random.uniform(0.0, 1.0, len(log)))
    counts[:20] = 0.0
    time = np.round(np.cumsum(rows), stamps)
    speed = np.round(counts * tau / 28 / (rows if own else 0.004), 2)
    info = replace(log.info, sample_period=0.004, speed_window=0.004, speed_lag=0.002)
    found = find_speed_sensor(replace(log, speed=speed, sample_time=np.round(1e9 * time).astype(np.int64), info=info))
    assert (found.sigma, found.edges_per_revolution, found.lengths is not None, found.wrong) == (0.0, 28, own, 0)


@pytest.mark.parametrize(("digit", "whole"), [(0.01, True), (0.0, False)])
def test_printed_digits_in_rows_of_whole_milliseconds_are_no_counts_of_their_lengths(digit: float, whole: bool) -> None:
    """Digits times milliseconds are a lattice, whatever was measured: 628,319 counts a turn were made of a robot's."""
    random, log = np.random.default_rng(7), without_count(as_speed(recorded(3, 96)))
    rows = random.choice([3, 4], len(log), p=(0.8, 0.2))
    speed = 0.15 * np.sin(np.arange(len(log)) / 40.0) + 0.01 * random.standard_normal(len(log))
    speed = digit * np.rint(speed / digit) if digit else speed
    info = replace(log.info, sample_period=0.003, speed_window=0.003, speed_lag=0.0015)
    found = find_speed_sensor(replace(log, speed=speed, sample_time=1_000_000 * np.cumsum(rows), info=info))
    assert are_whole_products(speed, rows * 1e-3, 0.01 * 1e-3) == whole
    assert (found.step, found.lengths) == (0.0, None) and found.sigma > 0.0


@pytest.mark.parametrize(("uneven", "blurred"), [(0.0, False), (0.02, True)])
def test_quotients_by_lengths_that_stamps_hide_are_near_whole_counts_where_they_are_few(
    uneven: float, blurred: bool
) -> None:
    random = np.random.default_rng(1)
    lengths = 0.01 * (1.0 + uneven * random.standard_normal(2000))
    rates = np.repeat([0.0, 0.5, 1.5, 2.5, 3.5, 20.0, 60.0, 100.0], 250)
    counts = np.diff(np.floor(np.cumsum(rates * lengths / 0.01)), prepend=0.0)
    speed = np.round(counts * 0.00327 / lengths, 3)
    step = find_counts(speed, 0.01)
    assert step == pytest.approx(0.327, rel=0.01) and are_blurred(speed, step) is blurred
    assert not are_blurred(speed, 0.0)


def test_lengths_of_rows_matter_only_where_they_differ() -> None:
    assert find_speed_sensor(counted_by_own_rows(1e-5)).lengths is None
    assert find_speed_sensor(noisy(0.5)).lengths is None


@pytest.mark.parametrize(("share", "smoothed"), [(0.74, True), (0.76, False)])
def test_speeds_between_whole_counts_were_smoothed(share: float, smoothed: bool) -> None:
    """Up to a quarter of the values of a counted speed may be beside whole counts."""
    values = np.floor(np.linspace(10.0, 400.0, 1000)) + np.where(np.arange(1000) % 100 < 100 * share, 0.0, 0.3)
    assert are_smoothed(np.sort(values), np.ones(1000), 1.0) == smoothed


def test_counts_divided_by_rows_of_different_lengths_are_not_smoothed() -> None:
    """They lie between whole ones too, with all the noise of counts."""
    lengths = np.random.default_rng(3).uniform(0.7, 1.3, 1000)
    counted = np.diff(np.floor(np.cumsum(20.3 * lengths)), prepend=0.0) / lengths
    assert not are_smoothed(counted, np.ones(1000), 1.0)
    assert are_smoothed(np.convolve(counted, np.full(9, 1.0 / 9.0), "valid"), np.ones(992), 1.0)


@pytest.mark.parametrize(
    ("keeps", "edges", "swing", "uneven", "between"),
    [
        (0.0, 2304, 1.0, 0.0, False),  # counts as they are
        (0.5, 2304, 1.0, 0.0, True),  # smoothed, and as noisy as they are rough
        (0.5, 2304, 1.0, 0.99, True),
        (0.5, 2304, 1.0, 1.01, False),  # or divided by a length that stamps do not show
        (0.8, 2304, 0.0, 0.0, False),  # smoothed as whoever imports it sees
        (0.5, 0, 1.0, 0.0, False),  # nothing was said
    ],
)
def test_said_counts_that_lie_between_whole_ones_were_smoothed(
    keeps: float, edges: int, swing: float, uneven: float, between: bool
) -> None:
    """A toy's 2,304 counts a turn at 20 Hz, of which its program kept a half: no filter was looked for."""
    rng, row = np.random.default_rng(3), 0.05
    angle = np.cumsum(60.37 + swing * 60.0 * rng.standard_normal(600).clip(-1.0, 1.0))
    speed = np.diff(np.floor(angle), prepend=0.0) * tau / 2304 / row
    for k in range(1, len(speed)):
        speed[k] = keeps * speed[k - 1] + (1.0 - keeps) * speed[k]
    info = replace(as_speed(recorded(0, 96)).info, edges_per_revolution=edges, sample_period=row, speed_window=row)
    late = uneven * EVEN_ROWS * np.tile([0.0, 0.0, 1.0], 200)  # two of three rows are not of the usual length
    log = SimpleNamespace(info=info, time=row * (np.arange(600) + late), voltage=np.ones(600), speed=speed)
    assert lies_between_counts(cast(Recording, log)) is between


@pytest.mark.parametrize(("counts", "counted"), [(990_000, True), (1_010_000, False)])
def test_more_counts_a_turn_than_any_encoder_has_are_digits(counts: int, counted: bool) -> None:
    """Whole counts a second of rows of 1 ms, behind a filter: a thousand times as many as the encoder's 1,796."""
    step = tau / counts / 0.001
    values = step * np.rint(400.0 + 300.0 * np.sin(np.arange(1000) / 90.0))
    found, sigma, edges = find_noise(values, np.ones(1000), 0.001)
    assert edges == (counts if counted else 0) and (found > 0.0) is counted
    assert counted or sigma >= 0.99 * step / sqrt(12.0)
    assert find_noise(values, np.ones(1000), 0.001, gear=2.0)[2] == counts // 2


@pytest.mark.parametrize("hold", [1, 2, 4])
def test_a_motion_that_jumps_from_row_to_row_does_not_hide_that_speeds_are_whole_counts(hold: int) -> None:
    """A motor of 19 ms that rubs, in rows of 10 ms: noise of a tenth of its speed was made of it, and a slot of 53°."""
    levels = np.random.default_rng(hold).uniform(-9.0, 9.0, 300 // hold)
    motor, drive = {"kv": 0.00213, "ka": 4.08e-5, "ks": 1.16}, (np.arange(len(levels)) * 0.01 * hold, levels)
    log, _ = record(motor, *drive, seed=1, edges=175, sample_rate=100.0, single_channel=False)
    counts = without_count(as_speed(log))
    found = find_speed_sensor(counts)
    assert (found.sigma, found.edges_per_revolution) == (0.0, 175) and are_whole_counts(counts.speed, 0.01)
    other = replace(counts, speed=counts.speed * 175.0 / 175.1)  # no whole number a turn
    assert find_speed_sensor(other).sigma > 0.0 and not are_whole_counts(other.speed, 0.01)
    assert are_whole_counts(other.speed, 0.01 * 175.1 / 175.0)
    noisy_counts = np.random.default_rng(2).normal(0.0, 0.1 * found.step, len(counts))
    assert not are_whole_counts(counts.speed + noisy_counts, 0.01)


@pytest.mark.parametrize(("noise", "uneven", "counted"), [(0.04, 0.0, True), (0.025, 0.0, False), (0.04, 0.01, False)])
def test_noise_that_rows_may_make_is_no_motion(noise: float, uneven: float, counted: bool) -> None:
    """Counts of rows of uneven lengths, divided by one for all, have noise that is a share of the speed."""
    level = 500.0 + noise * 500.0 * np.random.default_rng(3).standard_normal(2000)
    step = tau / 175 / 0.01
    found, sigma, edges = find_noise(step * np.rint(level), np.ones(2000), 0.01, uneven=uneven)
    assert (found > 0.0, edges, sigma == 0.0) == (counted, 175 if counted else 0, counted)


@pytest.mark.parametrize(
    ("step", "window", "whole"),
    [(tau / 0.6, 0.01, True), (tau / 60.0, 0.01, False), (33.0 / 1024.0, tau * 1024.0 / 33.0 / 6000.0, False)],
)
def test_digits_and_a_converters_steps_may_be_whole_counts_by_chance(step: float, window: float, whole: bool) -> None:
    """Whole rpm of rows of 10 ms are 6,000 of a turn."""
    assert abs(tau / step / window - round(tau / step / window)) < 1e-6
    assert are_whole_counts(step * np.rint(300.0 * np.sin(np.arange(500) / 9.0)), window) is whole
