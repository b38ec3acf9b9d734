"""The noise between neighbours is the sensor's, whatever the motor does slowly."""

import numpy as np
import pytest

from motor_identification.recording import Floats
from motor_identification.sensor.white_noise import (
    LEAST_SAMPLES,
    LEAST_SHARE,
    estimate_relative_noise,
    estimate_white_noise,
)


def noise_of(values: Floats) -> float:
    """Without any voltage to predict from."""
    return estimate_white_noise(values, np.zeros(len(values)))


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("sigma", [0.3, 3.0])
def test_what_the_voltage_does_is_no_noise(sigma: float, seed: int) -> None:
    """A motor whose time constant is two samples, under a voltage that jumps in every sample."""
    random = np.random.default_rng(seed)
    voltage, speed = random.uniform(-6.0, 6.0, 2000), np.zeros(2000)
    for k in range(1, 2000):
        speed[k] = 0.6 * speed[k - 1] + 8.0 * voltage[k - 1]
    values = speed + sigma * random.standard_normal(2000)
    assert noise_of(values) > 5.0
    # The prediction cannot know more than six samples: it leaves a few per cent of the noise in what it predicts from.
    assert 0.95 * sigma < estimate_white_noise(values, voltage) < 1.15 * sigma


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("sigma", [1e-3, 0.5, 40.0])
def test_white_noise_on_a_smooth_motion_is_recovered(sigma: float, seed: int) -> None:
    random, time = np.random.default_rng(seed), np.linspace(0.0, 10.0, 2000)
    motion = 300.0 * sigma * (1.0 - np.exp(-(time % 2.5) / 0.3))  # starts again and again, and jumps between
    assert noise_of(motion + sigma * random.standard_normal(2000)) == pytest.approx(sigma, rel=0.08)


@pytest.mark.parametrize("turning", [0.2, 0.6])
def test_noise_of_some_values_is_told_by_those(turning: float) -> None:
    """A motor that stands shows none of the noise that it has where it turns."""
    marks = np.arange(4000) % 1000 < 1000 * turning
    values = np.cumsum(0.01 * marks) + marks * np.random.default_rng(4).standard_normal(4000)
    assert estimate_white_noise(values, np.zeros(4000), marks) == pytest.approx(1.0, rel=0.08)
    assert estimate_white_noise(values, np.zeros(4000)) < 0.9 and noise_of(np.zeros(30)) == 0.0
    few = np.arange(4000) < 23
    assert estimate_white_noise(values, np.zeros(4000), few) == 0.0


def test_wrong_samples_are_left_out() -> None:
    random = np.random.default_rng(1)
    values = random.standard_normal(2000)
    values[::100] = 1e3
    assert 1.0 < noise_of(values) < 1.4


def test_a_random_walk_counts_for_less_than_half_a_step() -> None:
    """Motion that is no sensor's: the least over the orders is what is left of it."""
    walk = np.cumsum(np.random.default_rng(2).standard_normal(4000))
    assert 0.4 < noise_of(walk) < 0.6  # root of a quarter, and a bit


def test_a_few_samples_tell_nothing() -> None:
    assert noise_of(np.random.default_rng(3).standard_normal(23)) == 0.0
    assert noise_of(np.random.default_rng(3).standard_normal(40)) > 0.5
    assert noise_of(np.arange(100.0)) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("seed", range(3))
def test_a_controller_that_answers_a_sample_does_not_predict_its_noise(seed: int) -> None:
    """Its voltage in the same row is lower the higher the sample, noise and all; a motor does the opposite."""
    random, noise, speed, gain = np.random.default_rng(seed), 1.2, 0.0, 0.1
    values, voltage = np.zeros(400), np.zeros(400)
    for k in range(400):
        values[k] = speed + noise * random.standard_normal()
        voltage[k] = 4.0 + gain * (20.0 * np.sign(np.sin(k / 40.0)) - values[k])
        speed += 0.2 * (5.0 * voltage[k] - speed)
    assert 0.8 * noise < estimate_white_noise(values, voltage) < 1.25 * noise


@pytest.mark.parametrize("share", [0.005, 0.014, 0.05])
def test_noise_that_is_a_share_of_values_is_one_of_slow_ones_too(share: float) -> None:
    """A motor that is slow for most of the time: as one number, half of that noise was found."""
    random, time = np.random.default_rng(3), np.linspace(0.0, 20.0, 4000)
    motion = 100.0 * np.sin(2.0 * np.pi * time / 5.0) ** 3
    values = motion * (1.0 + share * random.standard_normal(4000))
    usual = float(np.sqrt(np.mean(values**2)))
    assert estimate_relative_noise(values) == pytest.approx(share, rel=0.08)
    assert noise_of(values) < 0.7 * share * usual


def test_noise_is_no_share_of_what_is_next_to_nothing_or_too_little() -> None:
    random = np.random.default_rng(5)
    values = 10.0 * (1.0 + 0.01 * random.standard_normal(200))
    nothing = 0.9 * LEAST_SHARE * 10.0 * (1.0 + random.standard_normal(60))
    assert estimate_relative_noise(np.concatenate([values, nothing])) == pytest.approx(0.01, rel=0.15)
    assert estimate_relative_noise(values[:LEAST_SAMPLES]) == 0.0
    for few in range(6):
        assert estimate_relative_noise(values[:few]) == 0.0
