"""Rates of sampled counts."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.rows.count_rate import count_rates
from motor_identification.logs.signals import Floats, Signals


def rates(counts: object, step: float = 0.01) -> tuple[Floats, list[str]]:
    here = np.asarray(counts, np.int64)
    number = len(here)
    unknown, time = np.full(number, np.nan), np.rint(np.arange(number) * step * 1e9).astype(np.int64)
    runs = {"": slice(0, number)}
    signals = Signals(Path("log.csv"), np.arange(number), time, unknown, here * 1.0, unknown, unknown, runs)
    return count_rates(signals, here)


def test_a_fine_encoder_has_its_difference_quotient() -> None:
    rate, said = rates([0, 3, 8, 8 + 2, 4])
    assert rate == pytest.approx([300, 300, 500, 200, -600]) and said == []


def test_a_coarse_encoder_in_a_fast_log_has_no_spikes() -> None:
    """A count every 20 rows of 1 ms: 50 a second, and not 1,000 in one row and 0 in the next."""
    rate, _ = rates(np.arange(2000) // 20, 0.001)
    assert rate[100:] == pytest.approx(np.full(1900, 50.0), rel=0.06)


def test_a_motor_that_stops_is_bounded_by_the_time_since_the_latest_count() -> None:
    rate, _ = rates([*range(10), *[9] * 10])
    assert rate[9] == pytest.approx(100.0) and rate[10:].tolist() == pytest.approx(
        [1 / (0.01 * k) for k in range(1, 11)]
    )
    assert rates([4] * 5)[0].tolist() == [0.0] * 5


def test_an_edge_that_is_crossed_again_is_no_speed() -> None:
    rate, _ = rates([0, 1, 2, 3, 3, 2, 3, 3, 2, 1, 0])
    assert rate[5:8].tolist() == [0.0] * 3 and rate[3] == pytest.approx(100.0) and rate[10] == pytest.approx(-100.0)


def test_held_counts_have_the_rate_of_fresh_ones() -> None:
    counts = np.rint(3000.0 * np.sin(np.arange(800) // 4 * 0.02)).astype(np.int64)
    rate, said = rates(counts, 0.005)
    assert "a new one every 20 ms" in said[0]
    assert rate[40:760] == pytest.approx(3000.0 * np.cos(np.arange(40, 760) // 4 * 0.02 - 0.01), abs=120)
