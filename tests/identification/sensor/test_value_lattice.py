"""The step of counts is found in speeds, through printed digits and a window that jitters; or none."""

import numpy as np
import pytest

from motor_identification.sensor.value_lattice import CHANGES_OF_ONE, find_lattice, measure_blur

SAMPLES = 2000


def numbers(seed: int, low: float = 0.0, high: float = 60.0) -> np.ndarray:
    """Counts within a window of a motor whose speed swings between these."""
    random = np.random.default_rng(seed)
    swing = 0.5 * (low + high) + 0.5 * (high - low) * np.sin(np.linspace(0.0, 40.0, SAMPLES))
    return np.floor(swing + random.uniform(0.0, 1.0, SAMPLES))


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("step", [6.428571, 0.7272205, 1.0 / 3.0, 99.99, 2e-6])
def test_the_step_is_found_whatever_its_size(step: float, seed: int) -> None:
    signs = np.where(np.arange(SAMPLES) % 700 < 350, 1.0, -1.0)
    assert find_lattice(signs * numbers(seed) * step) == pytest.approx(step, rel=1e-6)
    assert find_lattice(numbers(seed, 90.0, 100.0) * step) == pytest.approx(step, rel=1e-6)  # far from 0


def test_printed_digits_do_not_hide_it() -> None:
    step = 6.428571
    assert find_lattice(np.round(numbers(0) * step, 2)) == pytest.approx(step, rel=1e-4)
    assert find_lattice(np.round(numbers(0) * step, 0)) == pytest.approx(step, rel=1e-2)
    assert find_lattice(np.round(numbers(0) * 0.0643, 2)) == pytest.approx(0.0643, rel=1e-2)


@pytest.mark.parametrize("seed", range(5))
def test_a_window_that_jitters_does_not_hide_it_until_it_blurs_the_small_values_too(seed: int) -> None:
    random = np.random.default_rng(seed)
    for jitter, found in ((0.001, True), (0.005, True), (0.3, False)):
        values = numbers(seed) * 6.43 * (1.0 + jitter * random.standard_normal(SAMPLES))
        step = find_lattice(values)
        assert step == pytest.approx(6.43, rel=0.01) if found else step == 0.0


def test_values_without_a_lattice_have_none() -> None:
    for seed in range(25):
        random = np.random.default_rng(seed)
        assert find_lattice(random.normal(50.0, 20.0, SAMPLES)) == 0.0
        assert find_lattice(random.uniform(0.0, 1.0, 30)) == 0.0


def test_many_values_of_a_long_recording_have_none() -> None:
    """Every so many of evenly distributed values would be a lattice of their own."""
    for seed in range(5):
        random, swing = np.random.default_rng(seed), np.sin(np.arange(100_000) / 500.0)
        assert find_lattice(50.0 * swing + random.standard_normal(100_000)) == 0.0
        assert find_lattice(random.uniform(0.0, 1.0, 100_000)) == 0.0
        coarse = np.round((50.0 * swing + random.standard_normal(100_000)) / 0.3) * 0.3
        assert find_lattice(coarse) == pytest.approx(0.3, rel=1e-6)


def test_a_handful_of_places_decides() -> None:
    """Three multiples are chance, ten are none; a single value, or none, tells nothing."""
    assert find_lattice(np.repeat([3.0, 4.0, 5.0], 100) * 6.43) == 0.0
    assert find_lattice(np.repeat(np.arange(1.0, 11.0), 10) * 6.43) == pytest.approx(6.43)
    assert find_lattice(np.zeros(100)) == find_lattice(np.full(100, 3.0)) == find_lattice(np.empty(0)) == 0.0


@pytest.mark.parametrize("most", [2, 3])
def test_a_few_counts_that_change_all_the_time_are_a_lattice(most: int) -> None:
    counts = np.random.default_rng(most).integers(-most, most + 1, 300).astype(float)
    assert find_lattice(counts * 4.488) == pytest.approx(4.488)
    assert find_lattice(np.round(counts * 42.857143, 5)) == pytest.approx(42.857143, rel=1e-6)
    assert find_lattice(np.sort(counts) * 4.488) == 0.0  # so few changes are the steps of a staircase
    assert find_lattice(np.where(np.abs(counts) == 1.0, 1.03 * counts, counts) * 4.488) == 0.0  # no multiples
    assert find_lattice(np.where(counts == 0.0, 1.0, counts) * 4.488) == 0.0  # it never stands
    assert find_lattice(np.where(np.abs(counts) == 1.0, 0.0, counts) * 4.488) == 0.0  # one size is missing
    digits = 2e-4 * most * np.random.default_rng(9).uniform(-1.0, 1.0, len(counts))
    assert find_lattice((counts + digits) * 4.488) == pytest.approx(4.488, rel=1e-3)  # what a filter's undoing leaves
    assert find_lattice((counts + 20.0 * digits) * 4.488) == 0.0


def test_one_count_that_comes_and_goes_all_the_time_is_a_lattice() -> None:
    """As of an encoder that has less than one a row; a motor that runs and stands changes a few times."""
    counts = np.random.default_rng(5).integers(-1, 2, 1000).astype(float)
    assert find_lattice(np.round(counts * 71.39983, 4)) == pytest.approx(71.39983, rel=1e-5)
    changes = np.flatnonzero(np.diff(np.abs(counts)) != 0.0) + 1  # each way alike, as sizes
    for number, found in ((0.99 * CHANGES_OF_ONE, False), (1.01 * CHANGES_OF_ONE, True)):
        few = np.abs(counts[: int(changes[round(number) - 1]) + 1])
        assert (find_lattice(few * 4.488) > 0.0) is found
    rest = np.where(
        counts == 0.0, 3e-7 * np.arange(len(counts)) / len(counts), counts
    )  # what a filter's undoing leaves
    assert find_lattice(rest * 4.488) == pytest.approx(4.488, rel=1e-5)


def few(low: float, high: float, jitter: float, rows: int = 1000) -> np.ndarray:
    """Counts a row of a slow motor, over rows that jitter by a share of their own length; it stands at the start."""
    random = np.random.default_rng(3)
    counts = np.floor(np.linspace(low, high, rows) + random.uniform(0.0, 1.0, rows))
    counts[:20] = 0.0
    return 4.488 * counts / (1.0 + jitter * np.clip(random.standard_normal(rows), -2.5, 2.5))


@pytest.mark.parametrize("jitter", [0.005, 0.02, 0.05])
@pytest.mark.parametrize("most", [1.6, 2.0, 3.0])
def test_rows_that_jitter_do_not_hide_a_few_counts(jitter: float, most: float) -> None:
    """They are told by going to and fro between the same sizes, which the speed of no motor does from row to row."""
    assert find_lattice(few(0.2, most, jitter)) == pytest.approx(4.488, rel=0.01)
    assert measure_blur(few(0.2, most, jitter), 4.488) == pytest.approx(jitter, rel=0.15)
    assert find_lattice(np.sort(few(0.2, most, jitter))) == 0.0


@pytest.mark.parametrize(("jitter", "found"), [(0.05, True), (0.07, False)])
def test_rows_that_jitter_by_more_than_some_per_cent_hide_them(jitter: float, found: bool) -> None:
    assert (find_lattice(few(0.2, 2.0, jitter)) > 0.0) is found


def test_one_wild_value_does_not_hide_counts() -> None:
    counts = np.random.default_rng(6).integers(0, 7, 2000).astype(float)
    counts[700] = 200_000.0
    assert find_lattice(counts * 4.488) == pytest.approx(4.488, rel=1e-3)


def test_speeds_of_a_motor_at_a_few_voltages_are_no_counts() -> None:
    """A quick motor between 0, 5 and 10 V has three speeds, with noise, but keeps each for some rows."""
    random = np.random.default_rng(4)
    held = np.repeat(random.integers(0, 3, 400), 3)
    assert find_lattice(9.0 * held * (1.0 + 0.01 * random.standard_normal(len(held)))) == 0.0
