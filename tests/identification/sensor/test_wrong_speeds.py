"""Speeds that no motor has are left out; what a voltage, a lattice or noise makes is not."""

import numpy as np
import pytest
from swinging import noisy

from motor_identification.sensor.speed_sensor import find_speed_sensor
from motor_identification.sensor.wrong_speeds import FAR, mark_silent_rows, mark_wrong_speeds

TIME = np.arange(300)
VOLTAGE = np.where(TIME < 60, 0.0, 9.0)
STEP = 11.6 * (1.0 - np.exp(-np.maximum(TIME - 60, 0) / 2.0))


@pytest.mark.parametrize("wrong", [[16.0], [16.0, 16.7]])
def test_a_start_that_overshoots_for_one_or_two_samples_is_wrong(wrong: list[float]) -> None:
    speed = STEP.copy()
    speed[61 : 61 + len(wrong)] = wrong
    assert np.flatnonzero(mark_wrong_speeds(speed, VOLTAGE)).tolist() == list(range(61, 61 + len(wrong)))
    assert not mark_wrong_speeds(STEP, VOLTAGE).any()


def test_three_in_a_row_are_a_motion_and_many_are_no_accident() -> None:
    speed = STEP.copy()
    speed[61:64] = 16.0
    assert not mark_wrong_speeds(speed, VOLTAGE).any()
    for count, left_out in ((3, True), (4, False)):
        speed = STEP.copy()
        speed[100 : 100 + 20 * count : 20] = 20.0
        assert mark_wrong_speeds(speed, VOLTAGE).any() == left_out


def test_it_takes_more_than_a_few_of_the_usual_changes() -> None:
    random = np.random.default_rng(0)
    noise = STEP + 0.5 * random.standard_normal(300)
    usual = np.quantile(np.abs(np.diff(noise)), 0.9)
    for times, left_out in ((0.8 * FAR, False), (1.3 * FAR, True)):
        speed = noise.copy()
        speed[200] = max(noise[199], noise[201]) + times * usual
        assert mark_wrong_speeds(speed, VOLTAGE)[200] == left_out
    assert not mark_wrong_speeds(noise, VOLTAGE).any()


def test_a_pulse_of_the_voltage_makes_a_pulse_of_the_speed() -> None:
    voltage, speed = VOLTAGE.copy(), STEP.copy()
    voltage[200], speed[201] = 20.0, 25.0
    assert not mark_wrong_speeds(speed, voltage).any()
    assert mark_wrong_speeds(speed, VOLTAGE)[201]


def test_a_sensor_goes_without_them() -> None:
    clean = noisy(0.3)
    assert find_speed_sensor(clean).wrong == 0 and len(find_speed_sensor(clean).row) == len(clean)
    speed = clean.speed.copy()
    speed[500] = 400.0
    found = find_speed_sensor(type(clean)(**{**clean.__dict__, "speed": speed}))
    assert found.wrong == 1 and 500 not in found.row and len(found.row) == len(found.time) == len(clean) - 1


def test_nothing_to_judge_by() -> None:
    for few in (np.empty(0), np.ones(1), np.ones(50), np.arange(3.0)):
        assert not mark_wrong_speeds(few, np.ones(len(few))).any()


def running(silent: slice | list[int], noise: float = 0.3) -> np.ndarray:
    """A motor that stands, and then runs at 20 rad/s with noise, but for some rows of 0."""
    speed = np.where(TIME < 60, 0.0, 20.0 + noise * np.random.default_rng(1).standard_normal(300))
    speed[silent] = 0.0
    return np.asarray(speed)


@pytest.mark.parametrize(("rows", "found"), [([100], True), ([100, 101, 102], True), ([100, 101, 102, 103], False)])
def test_rows_without_a_pulse_are_no_standstill(rows: list[int], found: bool) -> None:
    marked = np.flatnonzero(mark_silent_rows(running(rows))).tolist()
    assert marked == (rows if found else [])


@pytest.mark.parametrize(("every", "found"), [(5, True), (4, False)])
def test_more_than_a_quarter_of_the_rows_is_another_sensor(every: int, found: bool) -> None:
    assert mark_silent_rows(running(slice(100, 290, every if found else 2))).any() == found


@pytest.mark.parametrize(("counts", "found"), [(6.0, True), (3.0, False)])
def test_few_counts_within_a_window_are_0_now_and_then(counts: float, found: bool) -> None:
    random = np.random.default_rng(2)
    speed = 0.7 * np.where(TIME < 60, 0.0, counts + random.integers(0, 2, 300))
    speed[[100, 150]] = 0.0
    assert np.flatnonzero(mark_silent_rows(speed)).tolist() == ([100, 150] if found else [])


def test_a_motion_that_turns_or_swings_is_0_in_between() -> None:
    turning = running([])
    turning[200:] *= -1.0
    turning[200] = 0.0
    assert not mark_silent_rows(turning).any()
    assert not mark_silent_rows(running([100], noise=6.0)).any()
    assert not mark_silent_rows(np.zeros(50)).any()


def test_a_sensor_goes_without_silent_rows() -> None:
    clean = noisy(0.3)
    level = np.flatnonzero(np.abs(clean.speed) > 20.0)[50]
    speed = clean.speed.copy()
    speed[level] = 0.0
    found = find_speed_sensor(type(clean)(**{**clean.__dict__, "speed": speed}))
    assert found.wrong == 1 and level not in found.row
