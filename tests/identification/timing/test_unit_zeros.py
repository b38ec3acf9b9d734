"""Running means leave zeros in speeds, which nothing else does."""

from dataclasses import replace

import numpy as np
import pytest
from recorded import as_speed, without_count
from scipy.signal import butter, lfilter
from swinging import noisy, recorded

from motor_identification.recording import Recording, check
from motor_identification.timing import unit_zeros
from motor_identification.timing.unit_zeros import find_means, measure_gain_of_mean


def filtered(recording: Recording, numerator: object, denominator: object = (1.0,)) -> Recording:
    speed = lfilter(numerator, denominator, recording.speed)
    return check(replace(recording, speed=np.round(speed, 3)))


@pytest.mark.parametrize("rows", [2, 3, 5, 10, 20])
def test_the_rows_of_a_mean_are_found(rows: int) -> None:
    assert find_means([filtered(noisy(0.5), np.full(rows, 1.0 / rows))]) == (rows,)


@pytest.mark.parametrize("rows", [2, 5, 10])
def test_the_rows_of_a_mean_are_found_though_rows_are_missing(rows: int) -> None:
    """One in a hundred hid them, and a lag and what is outside the table were missing instead."""
    plain, random = noisy(0.5), np.random.default_rng(0)
    logged = np.append(True, random.random(len(plain) - 1) > 0.02)
    assert find_means([filtered(plain, np.full(rows, 1.0 / rows)).at_rows(np.flatnonzero(logged))]) == (rows,)
    assert find_means([check(plain.at_rows(np.flatnonzero(logged)))]) == ()


@pytest.mark.parametrize("rows", [2, 8])
def test_a_mean_of_counts_is_found_wherever_a_log_begins(rows: int) -> None:
    counted = filtered(without_count(as_speed(recorded(edges=96))), np.full(rows, 1.0 / rows))
    assert find_means([counted.at_rows(np.arange(200, len(counted)))])[-1] == rows


def test_what_the_bilinear_transform_makes_is_found() -> None:
    assert find_means([filtered(noisy(0.5), [0.1, 0.1], [1.0, -0.8])]) == (2,)
    assert find_means([filtered(noisy(0.5), *butter(2, 0.3))]) == (2,)


def test_where_there_is_no_mean_none_is_found() -> None:
    """Neither in noise, counts, a long mean of few rows, nor behind poles."""
    assert find_means([check(noisy(0.5))]) == ()
    assert find_means([check(noisy(0.01, instant=True))]) == ()
    assert find_means([without_count(as_speed(recorded(edges=96)))]) == ()
    assert find_means([filtered(noisy(0.5), [0.2], [1.0, -0.8])]) == ()
    assert find_means([filtered(noisy(0.5), [0.16], [1.0, -1.2, 0.36])]) == ()
    few = filtered(noisy(0.5), np.full(30, 1.0 / 30.0))
    assert find_means([few]) == (30,) and find_means([few.at_rows(np.arange(280))]) == ()


@pytest.mark.parametrize(("count", "found"), [(150, (6,)), (80, (6,)), (50, ())])
def test_a_mean_shows_in_a_short_log(count: int, found: tuple[int, ...]) -> None:
    """Of 150 rows the mean of six was taken for two filters in series, and kv was 23 % off."""
    logged = filtered(noisy(0.5), np.full(6, 1.0 / 6.0))
    assert find_means([logged.at_rows(np.arange(count))]) == found
    assert find_means([check(noisy(0.5)).at_rows(np.arange(count))]) == ()


@pytest.mark.parametrize(("rows", "found"), [(12, (12,)), (14, ())])
def test_a_short_log_shows_a_mean_of_a_dozen_rows(rows: int, found: tuple[int, ...]) -> None:
    """Not half of it, which goes half the way."""
    logged = filtered(noisy(0.5, seed=1), np.full(rows, 1.0 / rows)).at_rows(np.arange(100))
    assert find_means([logged]) == found


@pytest.mark.parametrize(("limit", "value"), [("LEAST_GAIN", 1e4), ("LEAST_GAIN_OF_ROW", 1.0), ("LEAST_SPEEDS", 2000)])
def test_every_limit_decides(limit: str, value: float, monkeypatch: pytest.MonkeyPatch) -> None:
    logged = filtered(noisy(0.5), [0.5, 0.5])
    assert find_means([logged]) == (2,)
    monkeypatch.setattr(unit_zeros, limit, value)
    assert find_means([logged]) == ()


@pytest.mark.parametrize("rows", [2, 4])
@pytest.mark.parametrize("seed", range(3))
def test_plain_counts_are_less_likely_as_means_and_means_are_likelier(rows: int, seed: int) -> None:
    """What is had back of plain counts goes to and fro with the window's period."""
    log = without_count(as_speed(recorded(seed, edges=96)))
    log = log.at_rows(np.arange(400))
    single, weights = log.speed, np.full(rows, 1.0 / rows)
    means = np.convolve(single, weights)[: len(single)]
    assert measure_gain_of_mean(means, single, log.voltage, rows) > 15.0
    had_back = lfilter([1.0], weights, single)
    assert np.convolve(had_back, weights)[: len(single)] == pytest.approx(single)
    assert measure_gain_of_mean(single, had_back, log.voltage, rows) < -3.0
    few = slice(0, 28 + unit_zeros.PAST)
    assert measure_gain_of_mean(means[few], single[few], log.voltage[few], rows) == 0.0
