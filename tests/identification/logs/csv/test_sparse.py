"""Tables of several senders: what was said holds, a motion is known only in its own rows."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.csv.mending import mend_table
from motor_identification.logs.csv.sparse import Filled, fill_gaps
from motor_identification.logs.csv.table import Table


def made(**columns: list[str]) -> Table:
    rows = len(next(iter(columns.values())))
    return Table(Path("log.csv"), np.arange(2, rows + 2), {name: np.array(one) for name, one in columns.items()})


def two_senders() -> Filled:
    """A duty in every fifth row, from the third on; a speed in the others."""
    duty = [str(k) if k % 5 == 2 else "" for k in range(50)]
    speed = ["NaN" if k % 5 == 2 else str(10 * k) for k in range(50)]
    return fill_gaps(made(t=[str(k) for k in range(50)], duty=duty, speed=speed, note=["", "x"] * 25))


def test_values_hold_until_the_next() -> None:
    filled = two_senders()
    assert filled.table.numbers("duty")[:9].tolist() == [2, 2, 2, 2, 2, 2, 2, 7, 7]
    assert filled.table.numbers("speed")[:4].tolist() == [0, 10, 10, 30]
    assert sorted(filled.told) == ["duty", "speed"] and filled.told["duty"].sum() == 10


def test_rows_are_those_of_the_motion_once_the_drive_is_known() -> None:
    rows = two_senders().rows_of("t", "speed", "duty", None)
    assert rows.numbers("t")[:5].tolist() == [3, 4, 5, 6, 8] and len(rows) == 38
    assert list(rows.lines[:2]) == [5, 6]
    assert rows.notes == (
        "speed has a value in 40 of 50 rows: those rows are taken.",
        "duty has a value in 10 of 50 rows: it holds until the next.",
    )
    whole = two_senders().rows_of("t", "t", "t", None)
    assert len(whole) == 50 and not whole.notes


def test_a_clock_that_is_silent_in_some_rows_leaves_those_out() -> None:
    clock = ["" if k % 4 == 1 else str(20 * k) for k in range(40)]
    filled = fill_gaps(made(t=clock, duty=["5"] * 40, speed=[str(k) for k in range(40)]))
    assert filled.table.numbers("t").tolist() == [20.0 * k for k in range(40)]
    assert filled.rows_of("t", "speed", "duty", None).numbers("speed")[:4].tolist() == [0, 2, 3, 4]


@pytest.mark.parametrize(("gap", "empty", "told"), [("", 2, True), ("", 1, False), ("x", 2, False), ("n/a", 3, True)])
def test_what_is_no_gap_stays_as_it_is(gap: str, empty: int, told: bool) -> None:
    """One row of a hundred is garbled, and a word is no gap: both are told with their lines."""
    speed = [str(k) for k in range(100)]
    speed[50 : 50 + empty] = [gap] * empty
    filled = fill_gaps(made(t=[str(k) for k in range(100)], speed=speed))
    assert ("speed" in filled.told) == told
    assert filled.table.text("speed", 50) == ("49.0" if told else gap)


def test_columns_without_any_value_are_none() -> None:
    filled = fill_gaps(made(t=["0", "1", "2"], current=["", "", ""], speed=["1", "2", "3"]))
    assert filled.table.names == ["t", "speed"]


def test_numbers_of_other_formats_have_gaps_too() -> None:
    speed = np.where(np.arange(50) % 2, np.nan, np.arange(50.0))
    table = Table(Path("log.mat"), np.arange(1, 51), {"t": np.arange(50.0), "speed": speed, "u": np.ones(50, np.int64)})
    filled = fill_gaps(table)
    assert list(filled.told) == ["speed"] and filled.table.numbers("speed")[:4].tolist() == [0.0, 0.0, 2.0, 2.0]


@pytest.mark.parametrize(("after", "from_row"), [(4, 10), (6, 11)])
def test_a_command_holds_from_the_row_that_it_is_nearer_to(after: int, from_row: int) -> None:
    """Speeds every 10 ms, and a command some ms after the eleventh of them."""
    times = sorted([10 * k for k in range(20)] + [0, 100 + after], key=float)
    duty = ["5" if time == 100 + after else "0" if k == 1 else "" for k, time in enumerate(times)]
    speed = ["" if one else "7" for one in duty]
    filled = fill_gaps(made(ms=[str(time) for time in times], duty=duty, speed=speed))
    rows = filled.rows_of("ms", "speed", "duty", None)
    changed = np.flatnonzero(rows.numbers("duty") == 5.0)[0]
    assert rows.numbers("ms")[changed] == 10.0 * from_row
    by_order = filled.rows_of(None, "speed", "duty", None)  # without times: the row after it
    assert by_order.numbers("ms")[np.flatnonzero(by_order.numbers("duty") == 5.0)[0]] == 110.0


def test_a_command_that_was_given_twice_holds() -> None:
    """Its rows are so few that they look garbled: what others say all the time is empty there."""
    said = {120: "4.0", 300: "4.0"}
    command = [said.get(k, "") for k in range(400)]
    angle = ["" if k in said else str(k) for k in range(400)]
    table = made(t=[str(k) for k in range(400)], command=command, position=angle)
    mended = mend_table(table)
    assert len(mended) == 400 and not mended.notes
    rows = fill_gaps(mended).rows_of("t", "position", "command", None)
    assert len(rows) == 400 - 121 - 1 and set(rows.numbers("command")) == {4.0}
    garbled = made(t=[str(k) for k in range(400)], command=["4.0"] * 400, position=angle)
    assert len(mend_table(garbled)) == 398


@pytest.mark.parametrize("words", [("fwd", "rev"), ("1", "0"), ("forward", "none")])
def test_a_direction_holds_until_the_next_as_its_duty_does(words: tuple[str, str]) -> None:
    """Each is taken for the row of motion in which it holds mostly."""
    count = 60
    way = [words[k // 20 % 2] if k % 2 == 0 else "" for k in range(count)]
    duty = [str(k) if k % 2 == 0 else "" for k in range(count)]
    motion = ["" if k % 2 == 0 else str(k) for k in range(count)]
    filled = fill_gaps(made(t=[str(k) for k in range(count)], duty=duty, dir=way, ticks=motion))
    assert filled.told["dir"].sum() == count // 2
    rows = filled.rows_of("t", "ticks", "duty", None, "dir")
    drives, ways = rows.numbers("duty"), list(map(str, rows.column("dir")))
    assert ways == [words[int(one) // 20 % 2] for one in drives]
    assert rows.notes[-1] == f"dir has a value in {count // 2} of {count} rows: it holds until the next."


def test_a_direction_without_gaps_stays_as_it_is() -> None:
    table = made(t=[str(k) for k in range(60)], dir=["fwd", "none", "rev"] * 20, ticks=["", "3"] * 30)
    filled = fill_gaps(table)
    assert list(filled.table.column("dir")) == list(table.column("dir")) and list(filled.told) == ["ticks"]


@pytest.mark.parametrize("word", ["R", "1", "reverse"])
def test_a_mark_of_one_way_holds_for_its_own_rows(word: str) -> None:
    """Nothing stands there for the other way; beside rows of another sender there was none."""
    count = 60
    way, times = [word if k // 10 % 2 else "" for k in range(count)], [str(k) for k in range(count)]
    filled = fill_gaps(made(t=times, duty=["5"] * count, dir=way, ticks=times))
    assert list(filled.table.column("dir")) == way and not filled.told
    sparse = fill_gaps(made(t=times, duty=["5" if one else "" for one in way], dir=way, ticks=times))
    assert set(map(str, sparse.table.column("dir"))) == {word} and set(sparse.told) == {"duty", "dir"}
