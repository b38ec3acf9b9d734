"""A parabola leaves nothing of itself, and of white noise as many squares as it has rows to spare."""

import numpy as np
import pytest

from motor_identification.sensor.parabola_scatter import WINDOW, measure_scatter


def test_a_parabola_over_uneven_times_leaves_nothing() -> None:
    time = np.cumsum(np.random.default_rng(0).uniform(0.5, 2.0, 50))
    motion = 3.0 - 2.0 * time + 0.1 * time**2
    assert len(measure_scatter(time, motion)) == 50 - WINDOW + 1
    assert np.max(measure_scatter(time, motion)) < 1e-18 * np.max(motion) ** 2
    assert np.min(measure_scatter(time, time**3)) > 1e-3


def test_noise_leaves_its_variance_for_every_row_to_spare() -> None:
    time, noise = np.arange(20_000) * 0.01, 0.3 * np.random.default_rng(1).standard_normal(20_000)
    assert np.mean(measure_scatter(time, time + noise)) == pytest.approx(0.09 * (WINDOW - 3), rel=0.03)
