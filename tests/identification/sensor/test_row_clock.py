"""Clocks through stamps that are late: even ones, those of loops that run away, with rows that are lacking."""

import numpy as np
import pytest

from motor_identification.sensor.row_clock import lay_clocks

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


def test_exact_stamps_and_few_have_none() -> None:
    even = PERIOD * np.arange(ROWS)
    assert lay_clocks(even) == [] and lay_clocks(np.zeros(ROWS)) == []
    assert lay_clocks((even + 0.2 * PERIOD * np.random.default_rng(3).random(ROWS))[:49]) == []
