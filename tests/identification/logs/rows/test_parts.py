"""Rows that belong together, and where a run ends."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.rows.parts import (
    GAP,
    LATE,
    check_rest,
    check_steps,
    drop_first_rows,
    split_at_gaps,
    split_at_restarts,
    split_by_column,
)
from motor_identification.logs.signals import Signals, read_signals
from motor_model.errors import RecordingError

FORM = CsvForm("t", "u", "y", Kind.SPEED, "rad/s")


def table(**cells: list[str]) -> Table:
    return Table(Path("log.csv"), tuple(range(2, 2 + len(next(iter(cells.values()))))), cells)


def timed(*seconds: float, volts: float = 1.0) -> Signals:
    rows = {"t": [f"{time:.9f}" for time in seconds], "u": [str(volts)] * len(seconds), "y": ["2"] * len(seconds)}
    return read_signals(table(**rows), FORM, {"": slice(0, len(seconds))})


def test_without_a_column_to_split_by_all_rows_are_one_run() -> None:
    assert split_by_column(table(t=["0", "1", "2"]), None) == {"": slice(0, 3)}


def test_a_run_is_as_long_as_its_value_and_one_that_comes_again_gets_a_number() -> None:
    rows = table(d=["10 %", "10 %", "-5", "-5", "-5", "10 %", "10 %"])
    assert split_by_column(rows, "d") == {"10__": slice(0, 2), "-5": slice(2, 5), "10___2": slice(5, 7)}


@pytest.mark.parametrize(("rows", "gaps", "cut"), [(19, 11, False), (20, 11, True), (6, 9, True)])
def test_bursts_are_no_runs(rows: int, gaps: int, cut: bool) -> None:
    """A board that pauses now and then has a clock of its own; a computer's tells when its link handed on what."""
    times = np.concatenate([0.5 * k + 0.001 * np.arange(rows) for k in range(gaps + 1)])
    parts, said = split_at_gaps(timed(*times))
    assert len(parts.runs) == (gaps + 1 if cut else 1)
    if cut:
        assert len(split_at_gaps(timed(*(times + 1.77e9)))[0].runs) == gaps + 1
        return
    assert said == [f"Caution: {gaps} gaps of more than 20 sample periods; none is cut out."]
    with pytest.raises(RecordingError, match=r"in bursts, about 19 at a time.* --sample-period S \(0.02[0-9]* s on"):
        split_at_gaps(timed(*(times + 1.77e9)))


def test_a_run_of_a_single_row_is_refused_with_its_line() -> None:
    with pytest.raises(RecordingError, match="log.csv, line 4: the run with d = b has a single row"):
        split_by_column(table(d=["a", "a", "b", "c", "c"]), "d")


def test_a_column_that_changes_all_the_time_is_none_to_split_by() -> None:
    assert len(split_by_column(table(d=[str(k // 2) for k in range(2000)]), "d")) == 1000
    with pytest.raises(RecordingError, match="d changes more than 1000 times"):
        split_by_column(table(d=[str(k // 2) for k in range(2002)]), "d")


def test_steps_are_counted_inside_runs_only() -> None:
    parts, said = split_at_restarts(timed(0.0, 1.0, 0.0, 2.0), FORM)
    assert parts.runs == {"1": slice(0, 2), "2": slice(2, 4)}
    assert check_steps(parts).tolist() == [10**9, 2 * 10**9]
    assert said == ["t begins again once: 2 runs, a bag each."]


def test_runs_of_one_voltage_each_are_named_by_it() -> None:
    rows = table(t=["0", "1", "0", "1"], u=["3", "3", "-4.5", "-4.5"], y=["1"] * 4)
    parts, _ = split_at_restarts(read_signals(rows, FORM, {"": slice(0, 4)}), FORM)
    assert list(parts.runs) == ["3V", "-4.5V"]


@pytest.mark.parametrize(("back", "refused"), [(0.49, False), (0.51, True)])
def test_rows_out_of_order_are_no_new_beginning(back: float, refused: bool) -> None:
    """A run that begins again falls back by more than half of itself."""
    rows = timed(0.0, 0.5, 1.0, back, 1.2)
    if refused:
        with pytest.raises(RecordingError, match=r"line 5: time runs backwards \(t is 0.51 s after 1\)"):
            split_at_restarts(rows, FORM)
    else:
        assert len(split_at_restarts(rows, FORM)[0].runs) == 2


def test_times_since_1970_are_said_with_their_digits() -> None:
    rows = timed(*(1711555227.0 + np.array([0.0, 0.25, 0.5, 0.3125, 1.2])))
    with pytest.raises(RecordingError, match=r"\(t is 1711555227\.3125 s after 1711555227\.5\)"):
        split_at_restarts(rows, FORM)


@pytest.mark.parametrize(("gap", "runs"), [(GAP - 0.1, 1), (GAP + 0.1, 2)])
def test_missing_rows_end_a_run(gap: float, runs: int) -> None:
    times = [*np.arange(30), *(29 + gap + np.arange(30))]
    parts, said = split_at_gaps(timed(*(0.01 * np.array(times))))
    assert len(parts.runs) == runs and len(said) == runs - 1
    if said:
        assert said == ["Rows are missing once (0.201 s in all): 2 runs, a bag each."]


@pytest.mark.parametrize(("late", "left"), [(LATE - 0.1, 12), (LATE + 0.1, 11)])
def test_a_first_row_of_long_before_is_left_out(late: float, left: int) -> None:
    kept, said = drop_first_rows(timed(0.0, *(0.01 * (late + np.arange(11)))))
    assert len(kept) == left and bool(said) == (left == 11)


def test_the_first_of_rows_that_come_with_the_counts_is_kept() -> None:
    """A motor that stood takes long to its first edge, and the rest before it is known."""
    signals = timed(0.0, *(0.01 * (9.0 + np.arange(11))))
    counted = replace(signals, motion=np.arange(12.0))
    for either_way in (counted, replace(signals, motion=-np.arange(12.0))):
        assert len(drop_first_rows(either_way)[0]) == 12 and drop_first_rows(either_way)[1] == []
    assert len(drop_first_rows(replace(signals, motion=np.arange(12.0) % 5.0))[0]) == 11


def test_a_run_may_begin_when_the_rest_ends_but_not_before() -> None:
    signals, rows = timed(0.1, 0.2), table(t=["0.1", "0.2"])
    check_rest(signals, rows, replace(FORM, rest_until=0.1))
    with pytest.raises(RecordingError, match=r"the run begins at t = 0\.1 s, before --rest-until 0\.11"):
        check_rest(signals, rows, replace(FORM, rest_until=0.11))


@pytest.mark.parametrize(("slow", "runs"), [(20, 1), (2, 2)])
def test_a_board_that_became_slow_lost_no_rows(slow: int, runs: int) -> None:
    """The interrupts of its encoder leave a loop less time: rows come 25 times slower, and go on so."""
    steps = np.concatenate((np.full(60, 0.01), np.full(slow, 0.25), np.full(30, 0.01)))
    parts, said = split_at_gaps(timed(*np.cumsum(steps)))
    assert len(parts.runs) == runs and len(said) == runs - 1
