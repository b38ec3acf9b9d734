"""Counts of less than a row are told by their steps, through windows that were measured; counts of a row are none."""

import numpy as np
import pytest

from motor_identification.recording import Floats
from motor_identification.sensor.short_window import LEAST_RATIO, find_step_ratio, may_be_other_edges

MEASURED = (
    399.84,
    799.68,
    1099.89,
    1199.88,
    1399.3,
    1499.85,
    *(1599.52, 1699.66, 1598.88, 1698.3) * 12,
    1688.4,
    1667.3,
)


def rise(top: float, rows: int = 60) -> Floats:
    """Speeds [counts a row] of one step of the voltage, whose motor takes two rows."""
    return np.asarray(top * (1.0 - np.exp(-np.arange(rows) / 2.0)))


@pytest.mark.parametrize("ratio", [1.45, 2.0, 5.03, 7.3])
@pytest.mark.parametrize("seed", range(4))
def test_counts_of_a_part_of_a_row_are_told(ratio: float, seed: int) -> None:
    random = np.random.default_rng(730_000 + seed)
    swing = np.abs(np.cumsum(random.standard_normal(300)))
    for travel in (rise(90.0), 80.0 * swing / swing.max()):
        counts = np.floor(travel / ratio + random.uniform(0.0, 1.0, len(travel)))
        blur = 1.0 - 0.002 * np.abs(random.standard_normal(len(travel)))
        blur[::20] *= 0.97  # one in 20 was held up
        found = find_step_ratio(4.2 * ratio * counts * blur, 4.2)
        assert found == 0.0 or found == pytest.approx(ratio, rel=0.01)
        assert found > 0.0 or len(np.unique(counts)) < 12


@pytest.mark.parametrize("seed", range(20))
def test_counts_of_rows_and_noise_are_none_of_a_part(seed: int) -> None:
    random = np.random.default_rng(731_000 + seed)
    for travel in (rise(10.0 ** random.uniform(0.5, 2.5)), np.abs(np.cumsum(random.standard_normal(300)))):
        counts = np.diff(np.floor(np.cumsum(travel) + random.uniform()), prepend=0.0)
        assert find_step_ratio(counts * (1.0 + 0.01 * random.standard_normal(len(counts))), 1.0) == 0.0
        assert find_step_ratio(travel + 2.0 * random.standard_normal(len(travel)), 1.0) == 0.0


def test_a_step_that_rows_may_make_of_one_count_is_no_part() -> None:
    counts = np.repeat(np.arange(1.0, 20.0), 3)
    assert find_step_ratio(1.01 * LEAST_RATIO * counts, 1.0) == pytest.approx(1.01 * LEAST_RATIO)
    assert find_step_ratio(0.99 * LEAST_RATIO * counts, 1.0) == 0.0
    assert find_step_ratio(np.zeros(9), 1.0) == find_step_ratio(np.full(9, 50.0), 1.0) == 0.0


def test_a_few_rows_that_were_held_up_do_not_hide_it() -> None:
    """60 rows of 50 ms of counts over 10 ms: 16 or 17 of them were taken for 80.7 and 85.7 of a row, and smoothed."""
    assert find_step_ratio(np.array(MEASURED), 1.0 / 0.050446) == pytest.approx(5.043, rel=1e-3)
    assert find_step_ratio(np.array(MEASURED) + 40.0 * np.sin(np.arange(len(MEASURED))), 1.0 / 0.050446) == 0.0


@pytest.mark.parametrize(
    ("ratio", "edges", "may"),
    [
        (2.0, 96, True),
        (4.1, 96, True),
        (2.2, 96, False),
        (3.0, 96, True),
        (3.0, 100, False),  # of which no third is whole
        (5.03, 1320, True),
        (5.03, 96, False),
        (1.4, 96, False),
    ],
)
def test_a_whole_number_of_counts_may_be_one_of_another_number_of_edges(ratio: float, edges: int, may: bool) -> None:
    """Edges said 3 or 5 times too many made a window of a third or a fifth of a row, without a word."""
    assert may_be_other_edges(ratio, edges) is may
