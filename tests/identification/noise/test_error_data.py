"""Increments of a recording as the filter takes them, and what comes out of it."""

from dataclasses import replace

import numpy as np
import pytest

from motor_identification.measurement.intervals import index_intervals
from motor_identification.noise.error_data import ErrorData, log_likelihood, make_error_data, make_whitening, unit_of
from motor_identification.noise.error_model import ErrorModel, Lag

LAG = Lag(12.0, 0.0055)
MODEL = ErrorModel(0.01, 0.0, 0.15, 0.05)
SLOT = 0.06  # [rad]


def rows(counted: np.ndarray | None = None) -> ErrorData:
    """Twenty intervals of 10 ms, then one in which the motor stands, and after 0.5 s twenty more."""
    start = np.concatenate([0.01 * np.arange(20), [0.2], 0.7 + 0.01 * np.arange(20)])
    end = start + np.where(np.arange(41) == 20, 0.5, 0.01)
    data = index_intervals(start, end, np.where(np.arange(41) == 20, 0.0, 9.0), np.full(41, 1e-5))
    data = replace(data, slot=SLOT, slack=np.where(np.arange(41) == 20, SLOT, 0.0))
    return make_error_data(data, 1e-3 * np.random.default_rng(3).normal(size=41), counted)


def test_pauses_are_those_between_moving_intervals() -> None:
    data = rows()
    assert np.flatnonzero(data.still).tolist() == [20] and data.unit == SLOT
    assert data.pause[0] == np.inf and data.pause[1:20] == pytest.approx(0.0, abs=1e-9)
    assert data.pause[21] == pytest.approx(0.5) and data.pause[22:] == pytest.approx(0.0, abs=1e-9)


def test_without_slots_a_share_is_one_of_the_typical_travel() -> None:
    start = 0.01 * np.arange(9)
    data = index_intervals(start, start + 0.01, np.full(9, 7.0), np.zeros(9))
    assert unit_of(data) == pytest.approx(0.07) and unit_of(replace(data, slot=SLOT)) == SLOT


def test_the_likelihood_is_the_sum_of_what_counts() -> None:
    half = np.arange(41) < 20
    parts = [rows(half), rows(~half)]
    densities = rows().densities(MODEL, LAG)
    assert log_likelihood([rows()], MODEL, LAG) == pytest.approx(densities.sum())
    assert log_likelihood(parts, MODEL, LAG) == pytest.approx(densities.sum())
    assert not parts[0].densities(MODEL, LAG)[20:].any()


def test_a_whitening_is_that_of_the_increments_it_was_made_of() -> None:
    data = rows()
    _value, white = data.whiten(MODEL, LAG)
    whitening = make_whitening(data, MODEL, LAG)
    assert whitening.white(data.increments) == pytest.approx(white[0], rel=1e-9)
    assert whitening.white(3.0 * data.increments) == pytest.approx(3.0 * white[0], rel=1e-9)  # linear
    assert 0.0 < np.abs(white[0]).max() < 5.0
