"""Stamps that are coarse, doubled or shared."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.rows.stamps import drop_stray_stamps, separate_stamps, stamp_resolution
from motor_identification.logs.signals import Signals


def rows(time: "np.ndarray[tuple[int], np.dtype[np.int64]]", motion: object = None) -> Signals:
    count = len(time)
    unknown = np.full(count, np.nan)
    moved = np.arange(count, dtype=np.float64) if motion is None else np.asarray(motion, dtype=np.float64)
    return Signals(
        Path("log.csv"), np.arange(count), time, np.ones(count), moved, unknown, unknown, {"": slice(0, count)}
    )


@pytest.mark.parametrize(("step", "resolution"), [(5_000_000, 10**6), (5_001_000, 10**3), (5_000_001, 0)])
def test_the_resolution_of_stamps_is_a_power_of_ten(step: int, resolution: int) -> None:
    assert stamp_resolution(np.arange(10) * step) == resolution


def test_whole_milliseconds_of_regular_rows_become_regular() -> None:
    """Rows every 2.3 ms, stamped in whole milliseconds."""
    true = np.arange(200) * 2_300_000
    signals, said = separate_stamps(rows(true // 10**6 * 10**6))
    assert np.ptp(np.diff(signals.time)) <= 1 and np.diff(signals.time)[0] == pytest.approx(2_300_000, rel=1e-3)
    assert "multiples of 1 ms; the rows are regular, 2.3" in said[0] and "take those times" in said[0]


@pytest.mark.parametrize(
    ("period", "late", "by", "regular"),
    [(10, 5, 2, True), (10, 15, 2, False), (10, 1, 3, False), (3, 5, 2, False), (3, 5, 1, True)],
    ids=["half a percent", "more than one", "three stamps", "more than half a row", "one stamp"],
)
def test_a_few_late_stamps_leave_rows_regular(period: int, late: int, by: int, regular: bool) -> None:
    """1000 rows in whole milliseconds, a few of them late by so many."""
    true = np.arange(1000) * period * 10**6
    stamps = true.copy()
    stamps[np.linspace(20, 980, late).astype(int)] += by * 10**6
    signals, said = separate_stamps(rows(stamps))
    assert ("the rows are regular" in said[0]) == regular != ("not regular: times are that uncertain" in said[0])
    assert not regular or np.max(np.abs(signals.time - true)) < 10**5


def test_rows_faster_than_their_stamps_get_a_time_each() -> None:
    true = np.arange(400) * 400_000
    signals, _ = separate_stamps(rows(true // 10**6 * 10**6))
    assert len(signals) == 400 and np.all(np.diff(signals.time) > 0)
    assert np.max(np.abs(signals.time - true)) < 10**6


def test_irregular_rows_that_share_a_stamp_are_spread() -> None:
    stamps = np.array([0, 0, 7, 7, 7, 9, 20, 20, 21, 40]) * 10**6
    signals, said = separate_stamps(rows(stamps))
    assert np.all(np.diff(signals.time) > 0) and "spread evenly until the next" in said[0]
    assert signals.time[[0, 2, 5]].tolist() == [0, 7 * 10**6, 9 * 10**6] and signals.time[1] == 3_500_000


def test_fine_stamps_and_irregular_ones_stay() -> None:
    fine = np.arange(50) * 5_000_000
    signals, said = separate_stamps(rows(fine + 1000 * (np.arange(50) % 3)))
    assert said == [] and np.array_equal(signals.time, fine + 1000 * (np.arange(50) % 3))
    rough = np.cumsum(np.tile([2, 5, 3, 9, 2], 20)) * 10**6
    signals, said = separate_stamps(rows(rough))
    assert np.array_equal(signals.time, rough) and "are not regular: times are that uncertain" in said[0]


def test_rows_that_repeat_the_one_before_are_left_out() -> None:
    time = np.array([0, 5, 10, 10, 15, 20, 25, 30, 35, 40]) * 10**6
    signals, said = separate_stamps(rows(time, [0, 1, 2, 2, 3, 4, 5, 6, 7, 8]))
    assert signals.motion.tolist() == list(range(9)) and "Left out: 1 row that repeats" in said[0]


@pytest.mark.parametrize(("strays", "left"), [((50,), 199), ((50, 120), 198), ((50, 120, 150), 200)])
def test_single_stamps_out_of_order_are_left_out_where_they_are_few(strays: tuple[int, ...], left: int) -> None:
    """Of 200 rows; a stamp too late and one too early alike, and a clock that begins again is none."""
    time = np.arange(200) * 1_000_000
    for number, row in enumerate(strays):
        time[row] += 2_500_000 if number % 2 == 0 else -2_500_000
    signals, said = drop_stray_stamps(rows(time))
    assert len(signals) == left
    if left < 200:
        assert np.all(np.diff(signals.time) > 0) and said[0].startswith(f"Left out: {200 - left} row")
    again, _ = drop_stray_stamps(rows(np.concatenate([time[:40], time[:40]])))
    assert len(again) == 80
