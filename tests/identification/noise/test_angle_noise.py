"""Whitening: independent residuals of variance 1 from an encoder's correlated ones, for any drift of the model."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motor_identification.noise.angle_noise import AngleNoise, make_whitening, whiten, whiten_adjoint
from motor_identification.noise.noise_grid import estimate_drift

COUNT = 400


def noise(random: np.random.Generator, runs: int = 5) -> AngleNoise:
    fresh = np.zeros(COUNT, dtype=bool)
    fresh[[0, *random.choice(np.arange(1, COUNT), runs - 1, replace=False)]] = True
    variance = random.uniform(0.5, 2.0, COUNT)
    return AngleNoise(fresh, random.uniform(0.5, 2.0, COUNT), variance, random.uniform(0.001, 0.01, COUNT))


def increments(data: AngleNoise, growth: float, random: np.random.Generator) -> np.ndarray:
    """What the model of `angle_noise.py` draws: angle errors at the edges and a random walk, run by run."""
    steps, before = np.empty(COUNT), 0.0
    for k in range(COUNT):
        if data.fresh[k]:
            before = random.normal(0.0, np.sqrt(data.start[k]))
        error = random.normal(0.0, np.sqrt(data.end[k]))
        steps[k] = error - before + random.normal(0.0, np.sqrt(growth * data.duration[k]))
        before = error
    return steps


def covariance(data: AngleNoise, growth: float) -> np.ndarray:
    """The same model's covariance, written down directly."""
    full = np.diag(growth * data.duration + data.end)
    for k in range(COUNT):
        full[k, k] += data.start[k] if data.fresh[k] else data.end[k - 1]
        if k and not data.fresh[k]:
            full[k, k - 1] = full[k - 1, k] = -data.end[k - 1]
    return full


@pytest.mark.parametrize("growth", [0.0, 1.0, 1e6])
def test_whitening_is_the_inverse_root_of_the_covariance(growth: float) -> None:
    data = noise(np.random.default_rng(1))
    whitening = make_whitening(data, growth)
    matrix = np.column_stack([whiten(whitening, column) for column in np.eye(COUNT)])
    assert np.abs(matrix @ covariance(data, growth) @ matrix.T - np.eye(COUNT)).max() < 1e-9


@given(seed=st.integers(0, 1000), growth=st.floats(0.0, 1e6))
@settings(max_examples=40, deadline=None)
def test_the_adjoint_is_the_transpose(seed: int, growth: float) -> None:
    random = np.random.default_rng(seed)
    whitening = make_whitening(noise(random), growth)
    x, y = random.standard_normal(COUNT), random.standard_normal(COUNT)
    assert y @ whiten(whitening, x) == pytest.approx(whiten_adjoint(whitening, y) @ x, rel=1e-9, abs=1e-9)


def test_the_drift_of_the_model_is_found_and_none_is_invented() -> None:
    random = np.random.default_rng(2)
    data = noise(random)
    grid = [10.0**k for k in np.arange(-4.0, 6.0, 0.5)]
    found = [estimate_drift([data], [increments(data, 300.0, random)], grid) for _ in range(20)]
    assert 100.0 < np.median(found) < 900.0 and set(found) <= set(grid)
    none = [estimate_drift([data], [increments(data, 0.0, random)], grid) for _ in range(20)]
    assert sum(drift > 0.0 for drift in none) <= 1
