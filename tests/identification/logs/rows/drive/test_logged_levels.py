"""Levels that are logged one by one are runs; a reader's stalls under a level that is held are none."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.said import Said
from motor_identification.logs.imported import import_log
from motor_identification.logs.rows.drive.logged_levels import FEWEST, split_between_levels
from motor_identification.logs.signals import Floats, Signals
from motor_identification.sensor.row_clock import LONGEST

ROW = 0.1  # s


def logged(gap: float, volts: Floats, rows: int = 6) -> Signals:
    """Rows at one voltage [V] after the other, with a gap of so many rows between them."""
    count = rows * len(volts)
    pauses = np.repeat(np.arange(len(volts)), rows) * (gap - 1.0) * ROW
    time = np.rint(1e9 * (np.arange(count) * ROW + pauses)).astype(np.int64)
    unknown = np.full(count, np.nan)
    lines = np.arange(count)
    return Signals(Path("l"), lines, time, np.repeat(volts, rows), unknown, unknown, unknown, {"": slice(0, count)})


def test_levels_with_rows_missing_between_them_are_runs() -> None:
    found, said = split_between_levels(logged(10.0, np.arange(12.0)))
    assert list(found.runs) == [f"{volts}V" for volts in range(12)]
    assert found.steps().max() == 100_000_000
    assert said == [
        "The voltage changes only where rows are missing, in 11 gaps (11 s in all): what was applied in them is not "
        "known, and behind each a run begins with a speed of its own: 12 runs, a bag each."
    ]


@pytest.mark.parametrize(("gap", "split"), [(0.8 * LONGEST, False), (1.2 * LONGEST, True)])
def test_rows_of_an_uneven_loop_are_no_gaps(gap: float, split: bool) -> None:
    assert bool(split_between_levels(logged(gap, np.arange(12.0)))[1]) is split


@pytest.mark.parametrize(("gaps", "split"), [(FEWEST - 1, False), (FEWEST, True)])
def test_a_few_gaps_are_chance(gaps: int, split: bool) -> None:
    assert bool(split_between_levels(logged(10.0, np.arange(gaps + 1.0)))[1]) is split


@pytest.mark.parametrize(("held", "split"), [(2, True), (3, False)])
def test_stalls_of_a_reader_come_while_a_level_is_held(held: int, split: bool) -> None:
    """Half of the gaps with another level behind are pauses between levels; behind stalls it is mostly the same."""
    assert bool(split_between_levels(logged(10.0, np.repeat(np.arange(12.0), held)[1:]))[1]) is split


@pytest.mark.parametrize(("others", "split"), [(1, True), (2, False)])
def test_a_voltage_that_changes_between_gaps_too_was_logged_as_it_changed(others: int, split: bool) -> None:
    signals = logged(10.0, np.arange(12.0))
    signals.voltage[6 * np.arange(others) + 5] += 0.5  # the last row of a level
    assert bool(split_between_levels(signals)[1]) is split


@pytest.mark.parametrize(("rows", "split"), [(3, False), (4, True)])
def test_a_log_with_a_row_for_every_change_has_no_gaps_that_are_pauses(rows: int, split: bool) -> None:
    assert bool(split_between_levels(logged(10.0, np.arange(12.0), rows))[1]) is split


def test_a_motor_that_stops_between_its_levels_begins_each_as_it_is_found(tmp_path: Path) -> None:
    lines = ["t [s],u [V],w [rad/s]"]
    for level in range(4):
        rise = (1.0 - np.exp(-np.arange(11) * ROW / 0.2)) * 10.0 * (level + 1)
        lines += [f"{2 * level + ROW * k:.1f},{level + 1},{speed:.4f}" for k, speed in enumerate(rise)]
    (tmp_path / "log.csv").write_text("\n".join(lines) + "\n")
    (motor,) = import_log(tmp_path / "log.csv", Said()).motors
    assert [run.label for run in motor.log.runs] == ["1V", "2V", "3V", "4V"]
    assert all(run.samples[0].speed == 0.0 and run.duration == pytest.approx(1.0) for run in motor.log.runs)
