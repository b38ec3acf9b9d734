"""Counts that a converter's noise moves back and forth."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.rows.flicker import FEWEST_CHANGES, remove_flicker
from motor_identification.logs.signals import Integers, Signals


def signals(count: int) -> Signals:
    time, nothing = np.arange(count, dtype=np.int64) * 2_000_000, np.zeros(count)
    return Signals(Path("log.csv"), time, time, nothing, nothing, nothing, nothing, {"": slice(0, count)})


def noisy(noise: float) -> tuple[Integers, Integers]:
    """Counts of a shaft that goes 30 counts there and back, with noise and without."""
    place = 30.0 * np.sin(np.linspace(0.0, np.pi, 4000)) + 0.5
    blur = noise * np.random.default_rng(1).standard_normal(4000)
    return np.floor(place + blur).astype(np.int64), np.floor(place).astype(np.int64)


def test_counts_follow_the_motion_and_not_the_noise() -> None:
    counts, _ = noisy(0.15)
    followed, (said,) = remove_flicker(signals(4000), counts)
    steps = np.diff(followed)[np.diff(followed) != 0]
    assert np.count_nonzero(np.diff(np.sign(steps))) == 1 and np.abs(steps).max() == 1  # there, and back
    assert set(np.unique(counts - followed)) == {0, 1}
    changes = np.diff(counts)[np.diff(counts) != 0]
    back = np.count_nonzero(changes[1:] == -changes[:-1])
    assert said.startswith(f"{back} of {len(changes)} changes take back the count before")


def test_an_encoders_counts_stay() -> None:
    _, counts = noisy(0.0)
    followed, said = remove_flicker(signals(4000), counts)
    assert followed is counts and said == []


@pytest.mark.parametrize(("share", "noise"), [(0.45, False), (0.55, True)])
def test_noise_is_where_most_changes_take_back_the_one_before(share: float, noise: bool) -> None:
    """Some changes go on, and some there and back: of 1 + 2 n changes, 2 n take back the one before."""
    on = np.ones(round(100 * (1.0 - share)), np.int64)
    steps = np.concatenate([on, np.tile([-1, 1], round(50 * share))])
    counts = np.append(0, np.cumsum(steps))
    assert bool(remove_flicker(signals(len(counts)), counts)[1]) is noise


def test_few_changes_tell_nothing() -> None:
    for number in (FEWEST_CHANGES - 1, FEWEST_CHANGES):
        counts = np.arange(number + 1, dtype=np.int64) % 2
        assert bool(remove_flicker(signals(len(counts)), counts)[1]) is (number == FEWEST_CHANGES)
