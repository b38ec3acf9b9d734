"""A counter that is read every 20 ms, in a log of 5 ms: what is fitted are its own readings."""

from dataclasses import replace

import numpy as np
import pytest
from recorded import as_counts
from swinging import RUBBING, recorded

from motor_identification.identify import Request, identify
from motor_identification.measurement.build_intervals import make_intervals
from motor_identification.recording import Recording, check
from motor_identification.sensor.held_counts import drop_held_counts


def held(every: int, seed: int = 0) -> Recording:
    """Rows of 5 ms that repeat the count of every so many."""
    fine = as_counts(recorded(seed, 960, sample_rate=200.0))
    latest = np.arange(len(fine)) // every * every
    return check(replace(fine, edge_count=fine.edge_count[latest], speed=fine.speed[latest]))


def test_repeated_rows_are_dropped_and_fresh_ones_are_kept() -> None:
    fresh = held(1)
    assert drop_held_counts(fresh) is fresh
    dropped = drop_held_counts(held(4))
    assert len(dropped) == pytest.approx(len(fresh) / 4, abs=2) and dropped.sample_time[0] == fresh.sample_time[0]
    assert np.all(np.diff(dropped.sample_time) > 0)
    assert np.diff(dropped.time[1:]) == pytest.approx(0.02, rel=1e-3)
    assert np.array_equal(dropped.edge_count[1:], held(4).edge_count[4::4][: len(dropped) - 1])


def test_intervals_are_those_of_the_counter() -> None:
    data = make_intervals(held(4))
    moving = data.slack == 0.0
    assert np.median(data.duration[moving]) == pytest.approx(0.02, rel=0.1)
    assert np.median(make_intervals(held(1)).duration) == pytest.approx(0.005, rel=0.1)


def test_the_fit_is_that_of_the_counter() -> None:
    fit = identify([held(4)], Request(("coulomb_friction",)))
    for name, value in RUBBING.items():
        assert fit.parameters.values[name] == pytest.approx(value, rel=0.01)
    assert fit.residual_rms < 1.5 * fit.noise_floor
