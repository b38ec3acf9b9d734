"""Many noises at once are scored as one after the other, whatever is in a recording."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from motor_identification.noise.angle_noise import AngleNoise, log_likelihood_of
from motor_identification.noise.noise_grid import NoiseGrid, estimate_drift

COUNT = 300
MORE, DRIFT = np.array([0.0, 1e-8, 1e-6, 1e-4]), np.array([1e-3, 0.0, 1e-5, 1.0])  # [rad²], [rad²/s]
RANDOM = np.random.default_rng(5)
MOVING = (np.arange(COUNT) % 7 > 0).astype(float)
INCREMENTS = 1e-3 * RANDOM.standard_normal(COUNT)
NOISE = AngleNoise(
    RANDOM.uniform(size=COUNT) < 0.1, *RANDOM.uniform(1e-8, 1e-6, (2, COUNT)), RANDOM.uniform(0.001, 0.01, COUNT)
)


def one_by_one(noise: AngleNoise, increments: np.ndarray, clip: float) -> list[float]:
    return [
        log_likelihood_of(
            replace(noise, start=noise.start + more * MOVING, end=noise.end + more * MOVING), drift, increments, clip
        )
        for more, drift in zip(MORE, DRIFT, strict=True)
    ]


@pytest.mark.parametrize("clip", [inf, 4.0])
def test_each_score_is_the_log_likelihood_under_its_noise(clip: float) -> None:
    """Also of intervals whose variances' product no float holds, and of several recordings together."""
    begun = NOISE.fresh.copy()
    begun[0] = True
    noise = replace(NOISE, fresh=begun)
    alone = one_by_one(noise, INCREMENTS, clip)
    grid = NoiseGrid(MORE, DRIFT)
    assert grid.score([noise], [MOVING], [INCREMENTS], clip) == pytest.approx(alone, rel=1e-12)
    tiny = replace(noise, start=1e-18 * noise.start, end=1e-18 * noise.end)
    exact = replace(grid, variance=1e-18 * MORE, drift=1e-18 * DRIFT)
    shifted = exact.score([tiny], [MOVING], [1e-9 * INCREMENTS], clip) - 0.5 * COUNT * np.log(1e18)
    assert shifted == pytest.approx(alone, rel=1e-9)
    both = grid.score([noise, noise], [MOVING, MOVING], [INCREMENTS, 2.0 * INCREMENTS], clip)
    assert both == pytest.approx(np.add(alone, one_by_one(noise, 2.0 * INCREMENTS, clip)), rel=1e-12)


@pytest.mark.parametrize("gain", [-5e-5, 5e-5])  # less than what the price is worth
def test_a_drift_has_its_price(gain: float) -> None:
    """The logarithm of the number of intervals: a log likelihood that is more by less is chance."""
    grid = NoiseGrid(np.zeros(2), np.array([0.0, 0.02]))
    still = [np.zeros(COUNT)]
    noise = replace(NOISE, fresh=np.arange(COUNT) == 0)

    def worth(size: float) -> float:
        none, some = grid.score([noise], still, [size * INCREMENTS], inf)
        return float(some - none - np.log(COUNT + 1.0))

    low, high = 0.0, 100.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if worth(middle) < 0.0 else (low, middle)
    assert (estimate_drift([noise], [low * (1.0 + gain) * INCREMENTS], [0.02]) > 0.0) == (gain > 0.0)
