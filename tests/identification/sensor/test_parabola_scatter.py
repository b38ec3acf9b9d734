"""A parabola leaves nothing of itself, and of white noise as many squares as it has rows to spare."""

import numpy as np
import pytest

from motor_identification.sensor.parabola_scatter import (
    BEYOND_COUNTS,
    LEAST_WINDOWS,
    WINDOW,
    measure_scatter,
    measure_summed,
)


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


def make_travel(most: float, hold: float) -> np.ndarray:
    """Travel in counts at 100 Hz of a motor of 0.1 s that is told another speed, up to so many a row, ever so often."""
    random, count = np.random.default_rng(5), round(hold / 1e-3)
    speed, travel = 0.0, [0.0]
    for wanted in random.uniform(-most, most, round(120.0 / hold)):
        for _ in range(count):
            speed += (wanted - speed) * 1e-3 / 0.1
            travel.append(travel[-1] + 0.1 * speed)
    return np.array(travel[::10])


def test_counts_stay_a_position_and_noise_walks_away() -> None:
    travel = make_travel(60.0, 1.2)
    noise = np.random.default_rng(6).standard_normal(len(travel) - 1)
    counts, noisy = np.diff(np.floor(travel)), np.round(np.diff(travel) + 1.3 * noise)
    assert 0.01 < measure_summed(STEP * counts, STEP) < 0.12
    assert 0.4 < measure_summed(STEP * noisy, STEP) < 1.0
    assert measure_summed(STEP * counts[: LEAST_WINDOWS + WINDOW], STEP) == 0.0  # too few tell nothing


@pytest.mark.parametrize(
    ("noise", "rest", "run", "told"),
    [(2.7, 25, 45, True), (2.7, 12, 45, False), (2.7, 45, 12, False), (1.0, 22, 45, False)],
)
def test_few_calm_windows_tell_only_noise_that_no_counting_makes(noise: float, rest: int, run: int, told: bool) -> None:
    """A tachogenerator of 11 calm windows at rest and 23 above was said to be 56.107 counts a turn."""
    jump = 1e4 * 2.0 ** np.arange(WINDOW)  # which leaves no window calm that it is in
    speed = np.concatenate([np.zeros(rest), jump, np.full(run, 40.3)])
    noisy = np.rint(speed + noise * np.random.default_rng(3).standard_normal(len(speed)))
    counts = np.diff(np.floor(np.cumsum(speed)), prepend=0.0)
    assert measure_summed(noisy, 1.0) > BEYOND_COUNTS if told else measure_summed(noisy, 1.0) == 0.0
    assert measure_summed(counts, 1.0) == 0.0


def test_counts_of_a_motor_that_always_gains_speed_tell_nothing() -> None:
    """They are no parabola there: they were taken for a converter's steps, behind white noise."""
    counts = np.diff(np.floor(make_travel(600.0, 0.3)))
    assert measure_summed(STEP * counts, STEP) == 0.0
