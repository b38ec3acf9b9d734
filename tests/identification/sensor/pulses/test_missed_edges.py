"""The share of missed edges is measured where many come in a row, and none where none is missed."""

import numpy as np
import pytest

from motor_identification.recording import Bools, Floats, Integers
from motor_identification.sensor.pulses.missed_edges import (
    LEAST_SHARE,
    MissedShare,
    average_shares,
    mark_long_pairs,
    measure_missed_share,
)

ROWS, ROW = 1500, 0.01  # [s]


def reported(
    share: float, seed: int = 0, rate: float = 3000.0, swing: float = 0.3, irregular: float = 0.0, uneven: float = 0.0
) -> tuple[Floats, Integers, Bools]:
    """The latest two edges of every row of a disc that turns at `rate` [slots/s], give or take a share of that.

    A share of all edges is missed. irregular: by how much flanks are off, of a slot; uneven: by how much every other.
    """
    random = np.random.default_rng(seed)
    fine = np.linspace(0.0, ROWS * ROW, 400_001)
    turned = np.cumsum(rate * (1.0 + swing * np.sin(3.0 * fine))) * (fine[1] - fine[0])
    flanks = np.arange(96) % 2 * uneven + random.normal(0.0, irregular, 96)
    numbers = np.arange(1, int(turned[-1]))
    stamps = np.interp(numbers + flanks[numbers % 96], turned, fine)
    stamps = stamps[random.random(len(stamps)) >= share]
    latest = np.searchsorted(stamps, ROW * np.arange(1, ROWS), side="right")  # edges that were counted by then
    which = np.unique(np.concatenate([latest - 1, latest - 2]))
    which = which[which >= 0]
    return stamps[which], which, np.ones(len(which) - 1, dtype=bool)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(("share", "rate"), [(0.01, 3000.0), (0.04, 3000.0), (0.04, 1200.0), (0.02, 15000.0)])
def test_the_share_of_missed_edges_is_measured(share: float, rate: float, seed: int) -> None:
    found = measure_missed_share(*reported(share, seed, rate, irregular=0.01))
    assert found is not None
    assert found.share == pytest.approx(share, abs=3.5 * found.error)
    assert 0.01 * share < found.error < 0.2 * share


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("irregular", [0.0, 0.01, 0.05])
def test_a_disc_whose_edges_are_all_counted_misses_none(irregular: float, seed: int) -> None:
    for rate in (300.0, 800.0, 3000.0):
        for swing in (0.0, 0.3, 0.95):
            assert measure_missed_share(*reported(0.0, seed, rate, swing, irregular)) is None


def test_flanks_that_are_off_in_turns_make_pairs_shorter_but_none_that_spans_two_slots() -> None:
    """A row ends in the longer slot more often, so that the pair before it is the shorter one."""
    assert measure_missed_share(*reported(0.0, uneven=0.15)) is None


def test_fewer_than_irregular_flanks_may_make_are_not_seen() -> None:
    assert LEAST_SHARE == 0.005
    assert measure_missed_share(*reported(0.003, rate=15000.0)) is None


def test_where_few_edges_are_missed_in_a_row_nothing_is_measured() -> None:
    """There single intervals show them, short by a whole slot."""
    for rate in (30.0, 300.0, 700.0):
        assert measure_missed_share(*reported(0.03, rate=rate)) is None
    time, count, one_way = reported(0.03)
    assert measure_missed_share(time[:3], count[:3], one_way[:2]) is None
    assert measure_missed_share(time, count, np.zeros_like(one_way)) is None


def test_pairs_that_span_two_slots_are_marked_by_the_nearer_speed() -> None:
    slots = np.array([4, 1, 4, 1, 4, 1, 1, 2])
    length = np.array([4.0, 2.0, 4.0, 1.0, 4.0, 2.0, 1.9, 5.0])  # the motor slows down at the end
    assert mark_long_pairs(slots, length).tolist() == [False, True, False, False, False, False, False, False]


def test_several_recordings_shares_are_one_sensors() -> None:
    assert average_shares([None, None]) is None
    found = average_shares([MissedShare(0.03, 0.001), None, MissedShare(0.04, 0.002)])
    assert found is not None
    assert found.share == pytest.approx(0.032) and found.error == pytest.approx(0.2**0.5 * 0.002)
