"""Speeds that are running means of counts, and others that are none."""

import numpy as np
import pytest
from scipy.signal import lfilter

from motor_identification.recording import Floats
from motor_identification.sensor.running_mean import (
    FEWEST_WINDOWS,
    LONGEST,
    PEAK,
    ROOM,
    _find_longest,
    find_running_mean,
    size_of_count,
    take_single_rows,
)
from motor_identification.sensor.value_lattice import FINEST, find_lattice

PERIOD = 0.001  # [s]


def angle(rows: int = 2000, top: float = 120.0, stands: int = 300, seed: int = 0) -> Floats:
    """[rad] of a motor that stands, speeds up, and then goes between levels; one way."""
    generator = np.random.default_rng(seed)
    levels = np.repeat(generator.uniform(0.3, 1.0, rows // 400 + 1), 400)[:rows] * top
    levels[:stands] = 0.0
    speed = np.zeros(rows)
    for k in range(1, rows):
        speed[k] = speed[k - 1] + (levels[k - 1] - speed[k - 1]) * PERIOD / 0.03
    return np.asarray(np.cumsum(speed) * PERIOD)


def running(window: int, edges: float, seed: int = 0, way: float = 1.0) -> Floats:
    """[rad/s] by the counts of the last rows."""
    counts = np.floor(angle(seed=seed) * edges / 2.0 / np.pi + 0.3)
    before = np.concatenate([np.full(window, counts[0]), counts[:-window]])
    return np.asarray(way * (counts - before) * 2.0 * np.pi / edges / window / PERIOD)


@pytest.mark.parametrize("window", [5, 10, 32, 50])
@pytest.mark.parametrize(("edges", "way"), [(48.4, 1.0), (300.0, -1.0)], ids=["few counts", "many, backward"])
def test_a_running_mean_is_recognised(window: int, edges: float, way: float) -> None:
    assert [find_running_mean(running(window, edges, seed, way)) for seed in range(3)] == [window] * 3


@pytest.mark.parametrize("digits", [3, 6])
def test_a_mean_of_many_counts_is_taken_apart_where_its_single_rows_have_no_more_than_matter(digits: int) -> None:
    """It has as many times the levels of a single row as it has rows: more than are looked for in speeds."""
    window, edges = 32, 40_000.0
    means, single = np.round(running(window, edges), digits), running(1, edges)
    one = 2.0 * np.pi / edges / PERIOD
    assert np.max(single) < FINEST * one and np.max(means) > 20.0 * FINEST * one / window
    assert find_lattice(means) == 0.0 and find_running_mean(means) == window
    taken = take_single_rows(means, window)
    assert taken is not None and np.array_equal(np.rint(taken / one), np.rint(single / one))
    assert size_of_count(means, window) == pytest.approx(one, rel=1e-4)


@pytest.mark.parametrize("digits", [2, 4])
def test_printed_digits_do_not_hide_it(digits: int) -> None:
    assert find_running_mean(np.round(running(32, 48.4) * 30.0 / np.pi, digits)) == 32


@pytest.mark.parametrize("edges", [48.4, 300.0, 3000.0])
def test_counts_of_single_rows_are_none(edges: float) -> None:
    assert [find_running_mean(running(1, edges, seed)) for seed in range(5)] == [0] * 5


def test_many_counts_in_each_of_few_rows_are_none() -> None:
    """A random walk has room between 0 and 150 counts; it is far from the mean of its windows."""
    for seed in range(10):
        every = angle(8000, seed=seed)[::20] * 400.0 / 2.0 / np.pi
        assert find_running_mean(np.diff(np.floor(every), prepend=0.0) * 26.2) == 0


def test_windows_that_follow_each_other_are_none() -> None:
    for window in (5, 10):
        assert find_running_mean(running(window, 300.0)[::window]) == 0
        held = np.repeat(running(window, 300.0)[::window], window)
        assert find_running_mean(held) == 0


def test_noise_printed_digits_and_a_motion_that_only_rises_are_none() -> None:
    generator = np.random.default_rng(1)
    smooth = np.gradient(angle(), PERIOD)
    assert find_running_mean(smooth + generator.normal(0.0, 0.5, len(smooth))) == 0
    assert find_running_mean(np.round(smooth + generator.normal(0.0, 0.05, len(smooth)), 1)) == 0
    assert find_running_mean(np.round(smooth, 1)) == 0
    assert find_running_mean(np.floor(np.clip(np.arange(2000) - 300.0, 0.0, None) / 40.0)) == 0
    assert find_running_mean(np.zeros(100)) == 0


def test_a_recording_that_begins_in_motion_or_is_short_tells_nothing() -> None:
    whole = running(32, 48.4)
    begins = int(np.flatnonzero(whole)[0])
    assert find_running_mean(whole[begins - 1 :]) == 32, "it stood before the log began"
    assert find_running_mean(whole[begins:]) == 0
    assert find_running_mean(whole[: begins + (FEWEST_WINDOWS - 1) * 32]) == 0


@pytest.mark.parametrize("begin", [0, 900])
@pytest.mark.parametrize("window", [2, 10, 32])
def test_the_counts_of_single_rows_are_had_back(window: int, begin: int) -> None:
    """From a standstill on, and of a motor that turns; to the count."""
    means, single = running(window, 300.0)[begin:], running(1, 300.0)[begin:]
    found = take_single_rows(means, window)
    assert found is not None and found == pytest.approx(single, abs=1e-6)


def test_no_single_rows_are_had_of_others() -> None:
    """Of noise, of a window that is none, of too few."""
    means = running(10, 300.0)
    assert take_single_rows(means + np.random.default_rng(0).standard_normal(len(means)), 10) is None
    assert take_single_rows(means, 7) is None and take_single_rows(means[:19], 10) is None


@pytest.mark.parametrize("seed", [1, 3, 9])
def test_a_quick_motor_that_starts_within_its_first_window_is_had_back(seed: int) -> None:
    """Rows of it are faster than the mean of any window, which a fifth of that window hides: ten were read as two."""
    command = np.repeat(np.random.default_rng(seed).uniform(-35.0, 35.0, 100), 5)
    single = np.rint(lfilter([0.45], [1.0, -0.55], command)).astype(np.int64)
    single[:2] = 0
    counts = np.convolve(single, np.ones(10, np.int64))[: len(single)]
    assert np.max(np.abs(single)) > np.max(np.abs(counts)) / 10.0 + ROOM
    speeds = 0.41666 * counts
    assert _find_longest(counts, 49, 1.0) == 2 and find_running_mean(speeds) == 10
    taken = take_single_rows(speeds, 10)
    assert taken is not None and taken / 4.1666 == pytest.approx(single, abs=1e-6)


@pytest.mark.parametrize("seed", [161, 274, 289, 340])
def test_rows_that_are_faster_than_any_mean_alone_show_no_window(seed: int) -> None:
    """Of 1,500 logs of plain counts 31 were taken for running means where that was enough; one is where it is not."""
    random = np.random.default_rng(seed)
    rows, hold = int(random.integers(200, 900)), int(10.0 ** random.uniform(0.3, 2.0))
    pole = np.exp(-1.0 / 10.0 ** random.uniform(0.0, 1.5))
    drive = np.repeat(random.choice([-1.0, 1.0, 0.5, 0.0], rows // hold + 1), hold)
    angle = np.cumsum(lfilter([1.0 - pole], [1.0, -pole], 10.0 ** random.uniform(0.3, 1.8) * drive))
    counts = np.diff(np.floor(angle), prepend=0.0).astype(np.int64)
    longest = min(LONGEST, (rows - int(np.flatnonzero(counts)[0])) // FEWEST_WINDOWS)
    assert _find_longest(counts, longest, PEAK) > 0
    assert find_running_mean(0.1 * counts) == 0
