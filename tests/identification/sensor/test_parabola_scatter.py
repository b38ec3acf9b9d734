"""A parabola leaves nothing of itself, and of white noise as many squares as it has rows to spare."""

import numpy as np
import pytest

from motor_identification.sensor.parabola_scatter import LEAST_WINDOWS, WINDOW, measure_scatter, measure_summed


def test_a_parabola_over_uneven_times_leaves_nothing() -> None:
    time = np.cumsum(np.random.default_rng(0).uniform(0.5, 2.0, 50))
    motion = 3.0 - 2.0 * time + 0.1 * time**2
    assert len(measure_scatter(time, motion)) == 50 - WINDOW + 1
    assert np.max(measure_scatter(time, motion)) < 1e-18 * np.max(motion) ** 2
    assert np.min(measure_scatter(time, time**3)) > 1e-3


def test_noise_leaves_its_variance_for_every_row_to_spare() -> None:
    time, noise = np.arange(20_000) * 0.01, 0.3 * np.random.default_rng(1).standard_normal(20_000)
    assert np.mean(measure_scatter(time, time + noise)) == pytest.approx(0.09 * (WINDOW - 3), rel=0.03)


STEP = 0.7  # [rad/s] of one count in a row of 10 ms


def make_jerky_speeds(time_constant: float = 0.1) -> np.ndarray:
    """Speeds [rad/s] at 1 kHz of a motor that is told another one every 1.2 s, up to 60 of the steps."""
    random, time = np.random.default_rng(5), np.arange(120_000) * 1e-3
    wanted = np.repeat(random.uniform(0.0, 60.0 * STEP, 100), 1200)
    speed = np.zeros(len(time))
    for k in range(1, len(time)):
        speed[k] = speed[k - 1] + (wanted[k] - speed[k - 1]) * 1e-3 / time_constant
    return speed


def test_counts_of_a_quick_motor_stay_a_position_where_it_is_even() -> None:
    """Where it gains speed they are no parabola: counts were taken for a converter's steps, and white noise."""
    speed = make_jerky_speeds()
    position = np.cumsum(speed)[::10] * 1e-3 / (STEP * 0.01)
    counts = STEP * np.diff(np.floor(position))
    assert 0.01 < measure_summed(counts, STEP) < 0.12
    noise = np.random.default_rng(6).standard_normal(len(counts))
    noisy = STEP * np.round(np.diff(position) + 1.3 * noise)
    assert 0.4 < measure_summed(noisy, STEP) < 1.0
    assert measure_summed(counts[: LEAST_WINDOWS + WINDOW], STEP) == 0.0  # too few tell nothing
