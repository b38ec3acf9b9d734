"""Clocks through stamps that are late: even ones, those of loops that run away, with rows that are lacking."""

import numpy as np
import pytest

from motor_identification.sensor.row_clock import (
    MOST_NEIGHBOURS,
    NEIGHBOURS,
    count_neighbours,
    lay_clocks,
    measure_period,
    number_rows,
)

ROWS, PERIOD = 800, 0.01  # [s]


def test_stamps_that_are_late_on_their_own_have_an_even_clock_first() -> None:
    even = PERIOD * np.arange(ROWS)
    clocks = lay_clocks(even + 0.2 * PERIOD * np.random.default_rng(0).exponential(size=ROWS))
    assert np.ptp(np.diff(clocks[0].time)) < 1e-12 and np.mean(np.diff(clocks[0].time)) == pytest.approx(
        PERIOD, rel=1e-3
    )


def test_a_loop_that_runs_away_is_followed_by_the_last_clock() -> None:
    """Better than by stamps and by an even clock."""
    random = np.random.default_rng(1)
    true = np.cumsum(PERIOD * (1.0 + 0.1 * random.standard_normal(ROWS)))
    late = 0.3 * PERIOD * random.standard_normal(ROWS)
    clocks = lay_clocks(true + late)
    off = [np.std(clock.time - true) for clock in clocks]
    assert off[-1] < 0.6 * np.std(late) and off[-1] < 0.6 * off[0]


def test_lacking_rows_are_gaps_of_the_first_clock() -> None:
    stamps = PERIOD * np.arange(ROWS) + 0.1 * PERIOD * np.random.default_rng(2).exponential(size=ROWS)
    steps = np.diff(lay_clocks(np.delete(stamps, [200, 500, 501]))[0].time) / PERIOD
    assert np.allclose(steps[[199, 498]], [2.0, 3.0], atol=0.01)
    assert np.allclose(np.delete(steps, [199, 498]), 1.0, atol=0.01)


@pytest.mark.parametrize("seed", range(4))
def test_no_row_is_lacking_where_each_is_just_very_late(seed: int) -> None:
    """Of ten rows 0.3 rows late, once in a thousand the medians before and after differ by more than half a row."""
    late = 0.3 * np.random.default_rng(seed).exponential(size=6000)
    stamps = PERIOD * (np.arange(6000) + late)
    assert np.ptp(np.diff(lay_clocks(stamps)[0].time)) < 1e-12
    steps = np.diff(lay_clocks(np.delete(stamps, 3000))[0].time) / PERIOD
    (at,) = np.flatnonzero(steps > 1.5)
    assert abs(at - 2999) < 5 and steps[at] == pytest.approx(2.0, abs=0.01)


def test_the_later_rows_are_the_more_of_them_tell_a_lacking_one() -> None:
    assert count_neighbours(0.0) == count_neighbours(0.17) == NEIGHBOURS < count_neighbours(0.19)
    assert count_neighbours(0.56) <= MOST_NEIGHBOURS < count_neighbours(0.57)
    late = 0.75 * np.random.default_rng(5).exponential(size=6000)
    stamps = np.delete(PERIOD * (np.arange(6000) + late), 3000)
    assert np.ptp(np.diff(lay_clocks(stamps)[0].time)) < 1e-12  # so late that one row does not show


@pytest.mark.parametrize(("gaps", "laid"), [(1, True), (2, False)])
def test_a_clock_is_not_laid_through_gaps(gaps: int, laid: bool) -> None:
    """Of 800 rows, 16 may be lacking: a gap of ten rows says that, two are pauses, which no clock goes through."""
    stamps = PERIOD * np.arange(ROWS) + 0.2 * PERIOD * np.random.default_rng(7).random(ROWS)
    for place in range(gaps):
        stamps[300 * (place + 1) :] += 10.0 * PERIOD
    assert bool(lay_clocks(stamps)) is laid


def test_exact_stamps_and_few_have_none() -> None:
    even = PERIOD * np.arange(ROWS)
    assert lay_clocks(even) == [] and lay_clocks(np.zeros(ROWS)) == []
    assert lay_clocks((even + 0.2 * PERIOD * np.random.default_rng(3).random(ROWS))[:49]) == []


@pytest.mark.parametrize(("late", "share", "told"), [(0.0, 0.03, True), (0.05, 0.15, True), (0.05, 0.25, False)])
def test_rows_that_are_missing_are_numbered_where_the_others_are_even(late: float, share: float, told: bool) -> None:
    random = np.random.default_rng(4)
    logged = np.append(True, random.random(ROWS - 1) > share)
    number = number_rows((PERIOD * (np.arange(ROWS) + late * random.exponential(size=ROWS)))[logged])
    assert (number is not None) is told
    if number is not None:
        assert np.array_equal(number, np.flatnonzero(logged))


@pytest.mark.parametrize(("late", "told"), [(0.1, True), (0.3, False)])
@pytest.mark.parametrize("missing", [0, 10])
def test_rows_that_are_missing_are_numbered_by_an_even_clock_where_stamps_are_off_by_less_than_half(
    late: float, told: bool, missing: int
) -> None:
    """Steps between stamps that are off by a tenth of a row are no whole rows long; each is nearest to its own."""
    random = np.random.default_rng(7)
    stamps = PERIOD * (np.arange(2 * ROWS) + late * random.standard_normal(2 * ROWS))
    logged = np.delete(np.arange(2 * ROWS), 150 * np.arange(1, missing + 1))
    number = number_rows(np.sort(stamps)[logged])
    assert (number is not None) is (told and missing > 0)
    assert number is None or np.array_equal(number, logged)


def test_no_row_is_missing_where_none_is_or_rows_are_uneven() -> None:
    random = np.random.default_rng(5)
    assert number_rows(PERIOD * np.arange(ROWS)) is None
    assert number_rows(PERIOD * np.cumsum(1.0 + 0.3 * random.standard_normal(ROWS))) is None
    assert number_rows(np.zeros(2)) is None


def test_a_clock_is_laid_through_what_is_left_of_many_missing_rows() -> None:
    """Of 3 % of the rows, and stamps that are late by a twentieth of one, a clock was laid without a gap."""
    random = np.random.default_rng(6)
    logged = np.append(True, random.random(ROWS - 1) > 0.03)
    clock = lay_clocks((PERIOD * (np.arange(ROWS) + 0.05 * random.exponential(size=ROWS)))[logged])[0]
    steps = np.diff(clock.time) / PERIOD
    assert np.array_equal(np.rint(steps), np.diff(np.flatnonzero(logged))) and np.max(np.abs(steps % 1.0 - 0.5)) > 0.49


@pytest.mark.parametrize("longer", [0.04, 0.09, 0.2])
@pytest.mark.parametrize("uneven", [0.0, 0.5, 1.0])
def test_rows_a_little_longer_than_a_tick_of_their_stamps_are_all_there(longer: float, uneven: float) -> None:
    """Of ticks of 10 ms and rows of 10.9 ms one in twelve was said to be missing: inertia was 20 % off, kv 8 %."""
    random = np.random.default_rng(8)
    more = longer * ((1.0 - uneven) + uneven * random.exponential(size=ROWS))
    true = PERIOD * np.cumsum(1.0 + more)
    stamps = np.floor(true / PERIOD + 1e-6) * PERIOD
    assert np.ptp(np.diff(stamps)) > 0.9 * PERIOD and number_rows(stamps) is None
    clocks = lay_clocks(stamps)
    assert clocks and (uneven or np.std(clocks[0].time - true) < 0.01 * PERIOD)


def test_rows_are_missing_by_chance_though_their_stamps_are_whole_ticks() -> None:
    logged = np.append(True, np.random.default_rng(9).random(ROWS - 1) > 0.05)
    number = number_rows(PERIOD * np.flatnonzero(logged))
    assert number is not None and np.array_equal(number, np.flatnonzero(logged))


@pytest.mark.parametrize("together", [1, 3])
def test_rows_that_come_late_and_together_are_none_that_are_missing(together: int) -> None:
    """A computer that was busy stamps them one soon after the other: as many more were said to be missing."""
    stamps = PERIOD * np.arange(2 * ROWS)
    for row in range(300, 2 * ROWS, 400):
        stamps[row : row + together] = stamps[row + together] - 0.001 * PERIOD * np.arange(together, 0, -1)
    assert number_rows(stamps) is None
    logged = np.delete(np.arange(2 * ROWS), [50, 299, 310])
    number = number_rows(stamps[logged])
    assert number is not None and np.array_equal(number, logged)


@pytest.mark.parametrize("jitter", [0.02, 0.05])
@pytest.mark.parametrize("lost", [0, 20])
def test_the_period_of_jittered_rows_is_their_mean(jitter: float, lost: int) -> None:
    """Of rows 10 ms apart, each stamped by some chance early or late, the median is off by 0.1 % and more."""
    late = jitter * np.random.default_rng(4).standard_normal(1000)
    stamps = 0.01 * (np.arange(1000) + late) + np.where(np.arange(1000) >= 400, 7.0, 0.0)  # with a pause
    rows = np.diff(np.delete(stamps, 40 * np.arange(1, lost + 1)))
    assert abs(np.median(rows) / 0.01 - 1.0) > 9e-4
    assert measure_period(rows) == pytest.approx(0.01, rel=6e-4 if lost else 3e-5)


@pytest.mark.parametrize("period", [0.005, 0.02])
def test_an_even_clock_has_its_own_period_whatever_is_beside(period: float) -> None:
    assert measure_period(np.full(500, period)) == period
    assert measure_period(np.append(np.full(500, period), [2.0 * period, 1.001 * period, 3.0])) == period
    assert measure_period(np.array([period])) == period


def test_rows_that_took_longer_than_most_leave_the_period_of_most() -> None:
    """A loop's constant is what it keeps where nothing delays it, not the mean with what did."""
    lengths = 0.01 * (1.0 + 0.05 * np.random.default_rng(1).exponential(size=1000))
    assert measure_period(lengths) == np.median(lengths)
