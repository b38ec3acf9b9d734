"""A counter that is reset, or a position that jumps, begins a run; a range that nobody knows is refused."""

import numpy as np
import pytest
from position_rows import form, rows

from motor_identification.logs.rows.resets import split_at_resets
from motor_identification.logs.signals import Floats, Integers
from motor_model.errors import RecordingError


def whole(values: Floats) -> Integers:
    return np.rint(values).astype(np.int64)


def test_a_reset_begins_a_run_and_a_second_one_from_the_same_place_is_a_wrap() -> None:
    once = np.concatenate([10.0 * np.arange(60), 10.0 * np.arange(50)])
    signals, said = split_at_resets(rows(once), form("deg"), whole)
    assert [run.stop - run.start for run in signals.runs.values()] == [60, 50]
    assert said == ["y is reset once: 2 runs, a bag each."]
    again = np.concatenate([10.0 * np.arange(60), 10.0 * np.arange(60), 10.0 * np.arange(60)])
    with pytest.raises(RecordingError, match=r"line 122: y jumps from 590 to 0, and not for the first time: say where"):
        split_at_resets(rows(again), form("deg"), whole)


def with_jumps(number: int) -> Floats:
    there = 10.0 * np.arange(900)
    for k in range(number):
        there[60 * (k + 1) :] += 5000.0 + 700.0 * k
    return there


@pytest.mark.parametrize(("standing", "left_out"), [(10, True), (19, True), (20, False)])
def test_first_rows_that_stand_before_a_leap_are_left_out(standing: int, left_out: bool) -> None:
    """The angle was not read yet, and its counter had gone on from the run before: no motor goes there at once."""
    there = np.append(np.zeros(standing), 5000.0 + 10.0 * np.arange(200))
    signals, said = split_at_resets(rows(there), form("deg"), whole)
    assert (len(signals) == 200) == left_out
    assert (said == [f"Left out: {standing} first rows, whose y is that of something before."]) == left_out


def test_a_jump_to_somewhere_else_begins_a_run() -> None:
    signals, said = split_at_resets(rows(with_jumps(8)), form("deg"), whole)
    assert [run.stop - run.start for run in signals.runs.values()] == [60] * 8 + [420]
    assert list(signals.runs) == [str(k) for k in range(1, 10)]
    assert (
        said[0].startswith("Caution: y jumps 8 times, at line 62, 122, 182, 242,") and "9 runs, a bag each" in said[0]
    )
    with pytest.raises(
        RecordingError, match=r"jumps from -?\d+ to -?\d+, as in more than 8 places: say where it wraps"
    ):
        split_at_resets(rows(with_jumps(9)), form("deg"), whole)


@pytest.mark.parametrize("stored", [1.0, 1000.0])
def test_single_steps_of_a_stalled_motor_are_no_jumps(stored: float) -> None:
    """A motor against its stop gave way by whole degrees, which are a thousand counts each where angles are stored."""
    there = np.repeat(np.arange(20) % 2, 30).astype(np.float64)

    def counts(values: Floats) -> Integers:
        return np.rint(stored * values).astype(np.int64)

    signals, said = split_at_resets(rows(there), form("deg"), counts)
    assert len(signals.runs) == 1 and said == []
    there[300:] += 60.0  # which no motor does in a row
    signals, said = split_at_resets(rows(there), form("deg"), counts)
    assert len(signals.runs) == 2 and "y jumps once" in said[0]


@pytest.mark.parametrize("jump", [-3000.0, 1500.0])
def test_a_jump_is_seen_of_a_motor_that_never_is_slow(jump: float) -> None:
    """Its least way from row to row is no step of its counter: the jump was six of them, and one row went backward."""
    there = np.cumsum(515.0 + 5.0 * np.sin(np.arange(600) / 3.0)).round()
    there[300:] += jump
    signals, said = split_at_resets(rows(there), form("deg"), whole)
    assert len(signals.runs) == 2 and "y jumps once" in said[0]


@pytest.mark.parametrize(("first", "left_out"), [(-101.0, True), (-99.0, False)])
def test_a_first_row_of_something_before_is_left_out(first: float, left_out: bool) -> None:
    """The motor goes 10 a row; the buffer of the program still had the end of the run before."""
    signals, said = split_at_resets(rows(np.append(first, 10.0 * np.arange(200))), form("deg"), whole)
    assert [run.stop - run.start for run in signals.runs.values()] == [200 if left_out else 201]
    assert said == (["Left out: 1 first row, whose y is that of something before."] if left_out else [])
    quick = np.cumsum(np.concatenate([[0.0, 500.0], np.zeros(20), np.full(50, 600.0)]))  # it moves so later on, too
    assert len(split_at_resets(rows(quick), form("deg"), whole)[0]) == len(quick)


@pytest.mark.parametrize(("length", "runs"), [(1, [300, 599]), (3, [300, 597]), (19, [300, 581])])
def test_values_that_are_misread_are_left_out(length: int, runs: list[int]) -> None:
    there = 10.0 * np.arange(900)
    there[300 : 300 + length] += 4000.0
    signals, said = split_at_resets(rows(there), form("deg"), whole)
    assert [run.stop - run.start for run in signals.runs.values()] == runs
    assert said == [
        "Caution: y jumps once, at line 302, further than the motor goes: 2 runs, a bag each "
        "(where it wraps: --wrap R)."
    ]
