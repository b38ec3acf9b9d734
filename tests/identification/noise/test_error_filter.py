"""The filter's arithmetic: its quadratures against SciPy's, its likelihood against a dense Gaussian."""

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.stats import multivariate_normal

from motor_identification.noise.contaminated_density import OUTLIERS
from motor_identification.noise.error_filter import GAINS, fill_white, run_filter

RATE, KA = 12.0, 0.0055  # [1/s], [V·s²/rad]
RMS, TIME = 0.15, 0.05  # [V], [s]
STRENGTH = (RMS / KA) ** 2


def filtered(
    increments: np.ndarray, duration: np.ndarray, variance: float, strength: float = STRENGTH, growth: float = 0.0
) -> tuple[float, np.ndarray, np.ndarray]:
    """One run of intervals through the filter: log likelihood, white residuals, gains."""
    count = len(duration)
    fresh, still = np.arange(count) == 0, np.zeros(count, dtype=bool)
    rows = np.atleast_2d(increments)
    white, gains, noise = np.empty_like(rows), np.empty((count, GAINS)), np.full(count, variance)
    pause = np.where(fresh, np.inf, 0.0)
    value = run_filter(
        fresh, still, pause, duration, noise, noise, RATE, 1.0 / TIME, strength, growth, rows, ~still, white, gains,
        density := np.empty(count),
    )  # fmt: skip
    assert value == pytest.approx(density.sum(), rel=1e-12)
    return value, white, gains


def dense_covariance(duration: np.ndarray, variance: float) -> np.ndarray:
    """Of the angle errors e_k − e_0 at the ends of a run, from the matrix exponential of the state and fine steps."""
    matrix = np.array([[0.0, 1.0, 0.0], [0.0, -RATE, 1.0], [0.0, 0.0, -1.0 / TIME]])
    d, t = STRENGTH / (RATE * (RATE + 1.0 / TIME)), STRENGTH / (RATE + 1.0 / TIME)
    state = np.array([[0.0, 0.0, 0.0], [0.0, d, t], [0.0, t, STRENGTH]])
    steps, covariances, factors = 200, [state], []
    for h in duration:
        fine = expm(matrix * h / steps)
        noise = np.zeros((3, 3))
        for i in range(steps):  # midpoint rule of the convolution with white noise
            kick = expm(matrix * h * (i + 0.5) / steps)[:, 2]
            noise += np.outer(kick, kick) * 2.0 * STRENGTH / TIME * h / steps
        whole = np.linalg.matrix_power(fine, steps)
        covariances.append(whole @ covariances[-1] @ whole.T + noise)
        factors.append(whole)
    count = len(duration)
    result = np.empty((count, count))
    for i in range(count):
        for j in range(i, count):
            through = np.eye(3)
            for k in range(i + 1, j + 1):
                through = factors[k] @ through
            result[i, j] = result[j, i] = (through @ covariances[i + 1])[0, 0]
    return result + variance * (np.eye(count) + 1.0)  # the run's start is as uncertain as each end


def test_the_likelihood_is_that_of_the_gaussian_process() -> None:
    duration = np.array([0.004, 0.02, 0.001, 0.1, 0.03])
    variance = 1e-6
    covariance = dense_covariance(duration, variance)
    errors = 0.5 * np.random.default_rng(3).multivariate_normal(np.zeros(5), covariance)  # none of them an outlier
    value, _white, _gains = filtered(np.diff(errors, prepend=0.0), duration, variance)
    exact = multivariate_normal.logpdf(errors, np.zeros(5), covariance) + 5 * np.log(1.0 - OUTLIERS)
    assert value == pytest.approx(exact, abs=2e-3)


def test_white_residuals_are_white() -> None:
    random = np.random.default_rng(5)
    count, h = 20_000, 0.005
    shocks = random.normal(size=10 * count) * RMS * np.sqrt(1.0 - np.exp(-0.2 * h / TIME))
    torque, speed, angle, ends = 0.0, 0.0, 0.0, []
    for i, shock in enumerate(shocks):  # a tenth of an interval a step
        torque = torque * np.exp(-0.1 * h / TIME) + shock
        speed += 0.1 * h * (torque / KA - RATE * speed)
        angle += 0.1 * h * speed
        if i % 10 == 9:
            ends.append(angle)
    measured = np.array(ends) + random.normal(size=count) * 3e-4
    _value, white, _gains = filtered(np.diff(measured, prepend=0.0), np.full(count, h), 9e-8)
    z = white[0, 100:]
    assert 0.97 < z.std() < 1.03
    assert all(abs(np.mean(z[lag:] * z[:-lag])) < 0.03 for lag in (1, 2, 5))


def test_the_gains_are_the_filter() -> None:
    random = np.random.default_rng(1)
    count = 300
    duration = random.uniform(0.001, 0.02, count)
    x = random.normal(size=count)
    _value, white, gains = filtered(np.stack([1e-3 * random.normal(size=count), x]), duration, 1e-6)
    fresh, still = np.arange(count) == 0, np.zeros(count, dtype=bool)
    again = np.empty(count)
    fill_white(fresh, still, gains, x, again)
    assert np.allclose(again, white[1], rtol=1e-12, atol=1e-9)


@pytest.mark.parametrize(("jump", "lost"), [(0.0, False), (0.004, False), (0.065, True)])
def test_a_jump_of_the_angle_spoils_one_interval_only(jump: float, lost: bool) -> None:
    random = np.random.default_rng(2)
    increments = 1e-3 * random.normal(size=200)
    increments[100] += jump
    _value, white, _gains = filtered(increments, np.full(200, 0.005), 1e-6)
    assert (np.abs(white[0, 100]) > 6.0) == lost
    assert np.abs(white[0, 101:]).max() < 5.0


def test_a_stop_that_only_one_of_the_two_made_spoils_its_two_ends() -> None:
    """The simulated motor stands for 0.2 s, while the true one turns at 20 rad/s."""
    increments = 1e-3 * np.random.default_rng(2).normal(size=200)
    increments[100:140] -= 20.0 * 0.005
    _value, white, _gains = filtered(increments, np.full(200, 0.005), 1e-6)
    spoilt = np.flatnonzero(np.abs(white[0]) > 5.0)
    assert 100 in spoilt and 140 in spoilt and len(spoilt) <= 6
    assert np.abs(white[0, 106:140]).max() < 5.0 and np.abs(white[0, 146:]).max() < 5.0


def test_an_angle_that_jumps_has_no_weight_in_what_is_whitened_by_the_gains() -> None:
    increments = 1e-3 * np.random.default_rng(2).normal(size=200)
    increments[100] += 0.065
    _value, white, gains = filtered(increments, np.full(200, 0.005), 1e-6)
    again = np.empty(200)
    fill_white(np.arange(200) == 0, np.zeros(200, dtype=bool), gains, increments, again)
    assert abs(again[100]) < 0.1 < 6.0 < abs(white[0, 100])
    assert np.allclose(again[:100], white[0, :100])


def test_without_a_torque_it_is_a_drift_of_the_angle() -> None:
    """A scalar random walk, written out."""
    random = np.random.default_rng(4)
    increments, duration, variance, growth = 1e-3 * random.normal(size=50), np.full(50, 0.01), 1e-6, 1e-5
    value, _white, _gains = filtered(increments, duration, variance, strength=0.0, growth=growth)
    level, mean, spread, exact = 0.0, 0.0, variance, 0.0
    for step, h in zip(increments, duration, strict=True):
        level, spread = level + step, spread + growth * h
        total = spread + variance
        exact -= 0.5 * ((level - mean) ** 2 / total + np.log(2.0 * np.pi * total))
        mean, spread = mean + spread / total * (level - mean), spread * variance / total
    assert value == pytest.approx(exact + 50 * np.log(1.0 - OUTLIERS), abs=1e-9)
