"""Counts of single rows are no position where rows are lost, and are where a loop was late."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.log import read_log
from motor_identification.logs.rows.drive.lost_rows import COUNTS, FEWEST, LONGEST, read_speeds_where_rows_are_lost
from motor_identification.logs.signals import Signals
from motor_model.sample import Measurement

PERIOD = 0.005
FORM = CsvForm("t", "u", "dcount", Kind.COUNT, "count", edges_per_revolution=100, increments=True)


def counted(lost: bool, gaps: int = 30, rows: int = 2, size: float = 20.0) -> tuple[Any, Any]:
    """Times [s] and counts of each row: of a loop that was late, or whose rows between are lost."""
    time, count, random = [0.0], [0.0], np.random.default_rng(3)
    late = set(random.choice(np.arange(3, 397, 3), gaps, replace=False).tolist()) if gaps else set()
    for k in range(1, 400):
        step = rows if k in late else 1
        time.append(time[-1] + step * PERIOD)
        count.append(np.rint(size * (1.0 + 0.2 * np.sin(0.05 * k)) * (1 if lost else step)))
    return np.array(time), np.array(count)


def as_signals(time: Any, count: Any) -> Signals:
    nothing = np.full(len(time), np.nan)
    stamps = np.rint(time * 1e9).astype(np.int64)
    voltage = np.full(len(time), 6.0)
    runs = {"": slice(0, len(time))}
    return Signals(Path("log.csv"), np.arange(len(time)), stamps, voltage, np.cumsum(count), nothing, nothing, runs)


@pytest.mark.parametrize(
    ("lost", "gaps", "rows", "size", "read"),
    [
        (True, 30, 2, 20.0, True),
        (True, 30, 3, 20.0, True),
        (False, 30, 2, 20.0, False),
        (False, 30, 3, 20.0, False),
        (True, FEWEST, 2, 20.0, True),
        (True, FEWEST - 1, 2, 20.0, False),
        (True, 30, int(LONGEST) + 1, 20.0, False),  # what is beside it tells little
        (True, 30, 2, 0.5 * COUNTS, False),
        (True, 0, 2, 20.0, False),
    ],
)
def test_behind_lost_rows_a_count_is_that_of_one(lost: bool, gaps: int, rows: int, size: float, read: bool) -> None:
    time, count = counted(lost, gaps, rows, size)
    signals, form, said = read_speeds_where_rows_are_lost(as_signals(time, count), FORM)
    assert bool(said) is read and (form.kind is Kind.SPEED) is read
    if read:
        np.testing.assert_allclose(signals.motion, count / PERIOD, rtol=1e-9)
        assert f"({gaps} times)" in said[0] and "counts one row of 5 ms" in said[0] and form.unit == "count/s"


def test_counts_that_go_on_are_left_as_they_are() -> None:
    sums = CsvForm("t", "u", "n", Kind.COUNT, "count")
    signals, form, said = read_speeds_where_rows_are_lost(as_signals(*counted(lost=True)), sums)
    assert (form, said) == (sums, []) and signals.motion[-1] == counted(lost=True)[1].sum()


def test_an_import_reads_them_as_speeds_and_says_so(tmp_path: Path) -> None:
    """A motor without anything was said to have an effect outside the table: its sum lost 1 % of the way."""
    for lost in (True, False):
        time, count = counted(lost)
        rows = [f"{t:.4f},6,{n:.0f}" for t, n in zip(time, count, strict=True)]
        (tmp_path / "log.csv").write_text("\n".join(["t,u,dcount", *rows]), encoding="utf-8")
        log = read_log(tmp_path / "log.csv", FORM)
        assert any("what these counted is lost" in line for line in log.findings) is lost
        assert log.info.measurement is (Measurement.SPEED if lost else Measurement.COUNTS)


def test_a_late_stamp_that_the_next_row_makes_up_for_is_no_lost_row() -> None:
    time, count = counted(lost=True, gaps=0)
    late = np.arange(10, 390, 12)
    time[late] += 0.6 * PERIOD
    assert read_speeds_where_rows_are_lost(as_signals(time, count), FORM)[2] == []
