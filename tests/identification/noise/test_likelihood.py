"""How likely increments are, against the Gaussian written down, and the noise under which they are most likely."""

from dataclasses import replace
from math import log
from typing import Any

import numpy as np
import pytest
from handmade import SLOTS

from motor_identification.measurement.edit_intervals import append_standstills
from motor_identification.measurement.intervals import Intervals, index_intervals
from motor_identification.noise import likelihood
from motor_identification.noise.likelihood import OUTLIER_CLIP, Noise, estimate_noise, log_likelihood, make_noise
from motor_identification.noise.noise_grid import estimate_drift
from motor_identification.recording import Floats

SLOT = 2.0 * np.pi / SLOTS
COUNT = 400


def evenly(count: int = COUNT, blur: float = 1e-4 * SLOT) -> Intervals:
    """Successive intervals of one slot each, 0.01 s long."""
    time = 0.01 * np.arange(count + 1)
    numbers = np.column_stack([np.arange(count), np.arange(1, count + 1)])
    speed = np.full(count, SLOT / 0.01)
    return index_intervals(time[:-1], time[1:], speed, np.full(count, blur), edge=numbers, slot=SLOT)


def drawn(data: Intervals, noise: Noise, seed: int) -> Floats:
    """Increments of irregular flanks and of a random walk."""
    random, count = np.random.default_rng(seed), len(data.first)
    flanks = noise.share * SLOT * random.standard_normal(count + 1)
    return np.diff(flanks) + random.standard_normal(count) * np.sqrt(noise.drift * data.duration)


@pytest.mark.parametrize("noise", [Noise(0.01, 0.0), Noise(0.01, 1e-4), Noise(0.0, 1e-3)])
def test_it_is_the_gaussians(noise: Noise) -> None:
    data = evenly(30)
    increments = drawn(data, noise, 0)
    flank = make_noise(data, noise.share).end[0]
    covariance = np.diag(2.0 * flank + noise.drift * data.duration)
    covariance -= flank * (np.eye(30, k=1) + np.eye(30, k=-1))
    _, logarithm = np.linalg.slogdet(covariance)
    expected = -0.5 * (increments @ np.linalg.solve(covariance, increments) + logarithm)
    assert log_likelihood(data, increments, noise) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(("size", "counts"), [(0.5, True), (2.0, False)])
def test_an_outlier_says_no_more_than_its_clip(size: float, counts: bool) -> None:
    """Beyond 5 standard deviations a larger error costs nothing more."""
    data, noise = evenly(1), Noise(0.01, 0.0)
    sigma = np.sqrt(2.0) * 0.01 * SLOT
    at = size * np.sqrt(OUTLIER_CLIP) * sigma
    one, larger = (log_likelihood(data, np.array([error]), noise) for error in (at, 1.1 * at))
    assert (larger < one - 0.1) is counts


def test_a_standstill_does_not_depend_on_the_disc() -> None:
    still = append_standstills(evenly(0), (np.array([1.0]), np.array([2.0])), SLOT)
    assert make_noise(still, 0.01).end == pytest.approx(make_noise(still, 0.05).end)
    moving = evenly(3)
    assert np.all(make_noise(moving, 0.05).end > 20.0 * make_noise(moving, 0.01).end)


@pytest.mark.parametrize("share", [0.005, 0.01])
@pytest.mark.parametrize("drift", [0.0, 3e-3])
def test_the_noise_is_estimated(share: float, drift: float) -> None:
    data = evenly()
    found = [estimate_noise([(data, drawn(data, Noise(share, drift), seed))]) for seed in range(3)]
    if drift == 0.0:
        assert all(one.drift == 0.0 and one.share == pytest.approx(share, rel=0.15) for one in found)
    else:
        assert 0.3 < np.median([one.drift for one in found]) / drift < 3.0


def test_recordings_share_their_noise() -> None:
    data = evenly()
    rows = [(data, drawn(data, Noise(share, 0.0), 5)) for share in (0.008, 0.012)]
    assert 0.008 < estimate_noise(rows).share < 0.012


def test_without_slots_only_drift_is_estimated() -> None:
    data = replace(evenly(), slot=0.0)
    assert estimate_noise([(data, drawn(evenly(), Noise(0.01, 0.0), 1))]).share == 0.0


@pytest.mark.parametrize(("slot", "least", "most"), [(0.0, 1, 1), (SLOT, 2, 3)])
def test_no_round_asks_again_for_what_the_one_before_found(
    slot: float, least: int, most: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[float] = []

    def count(*given: Any) -> float:
        asked.append(estimate_drift(*given))
        return asked[-1]

    monkeypatch.setattr(likelihood, "estimate_drift", count)
    data = replace(evenly(), slot=slot)
    estimate_noise([(data, drawn(evenly(), Noise(0.01, 0.0), 1))])
    assert least <= len(asked) <= most


def test_drift_has_a_price() -> None:
    """What a drift gains by chance is less than the logarithm of the number of intervals."""
    data = evenly()
    for seed in range(5):
        increments = drawn(data, Noise(0.01, 0.0), seed)
        best = max(log_likelihood(data, increments, Noise(0.01, 10.0**k)) for k in range(-9, -2))
        assert best - log_likelihood(data, increments, Noise(0.01, 0.0)) < log(COUNT + 1.0)
