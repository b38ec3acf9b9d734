"""The times of edges beside their count, and positions beside the numbers of rows."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.behaviour.edge_times import counts_on, find_edge_times
from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.said import Said
from motor_identification.logs.csv.table import Table
from motor_identification.logs.rows.drive.constant_voltage import CONSTANT
from motor_model.errors import RecordingError

ROWS = np.arange(110.0)
FINE = np.linspace(0.0, 10.0, 200_001)
ANGLE = 100.0 * (FINE - 0.2 * (1.0 - np.exp(-FINE / 0.2)))  # slots, of a motor that stood until 0 s
EDGES = np.rint(1e3 * np.interp(ROWS, ANGLE, FINE))  # [ms]
WAY = np.floor(np.interp(0.05 * ROWS, FINE, 8.0 * ANGLE))  # of rows that are 50 ms apart
SLOWER = np.cumsum(np.linspace(9.0, 5.0, 110))
EVEN = 13.0 * ROWS + ROWS % 2.0


def _find(voltage: float = 6.0, said: Said | None = None, **columns: np.ndarray) -> tuple[str, str] | None:  # type: ignore[type-arg]
    count = len(next(iter(columns.values())))
    table = Table(Path("log.csv"), np.arange(count), {**columns, CONSTANT: np.full(count, voltage)})
    return find_edge_times(table, [read_heading(name) for name in table.names], said or Said())


@pytest.mark.parametrize("until", [110, 25])  # of a whole log, and of one that ends while the motor gets going
def test_a_motor_that_gets_going_has_long_times_at_first(until: int) -> None:
    rows = slice(0, until)
    assert _find(a=EDGES[rows], b=ROWS[rows]) == ("a", "b") == _find(b=ROWS[rows], a=EDGES[rows])
    assert _find(a=EDGES[rows], b=ROWS[rows] + (ROWS[rows] > 10.0)) == ("a", "b"), "one edge was missed"


def test_a_motor_that_gets_going_has_short_ways_at_first() -> None:
    assert _find(a=WAY, b=ROWS) is None is _find(b=ROWS, a=WAY)


def test_an_even_column_beside_a_counting_one_is_asked_for() -> None:
    for other in (EVEN, np.delete(EDGES, np.s_[:20])):
        with pytest.raises(
            RecordingError, match="which column is the time .b goes on by 1.*Say --time and one of a, b"
        ):
            _find(a=other, b=ROWS[: len(other)])
    uneven = np.cumsum(np.where(ROWS % 2.0 == 0.0, 1.0, 9.0))
    assert _find(a=uneven, b=ROWS) is None, "no times are like that"


def test_not_where_anything_else_tells_or_moves() -> None:
    assert _find(voltage=0.0, a=EDGES, b=ROWS) is None, "nothing gets going: a motor that runs out"
    assert _find(a=EDGES, b=ROWS, c=np.sin(ROWS)) is None
    assert _find(a=EDGES, b=ROWS, c=np.full(110, 3.0)) == ("a", "b")
    assert _find(time=EDGES, b=ROWS) is None
    assert _find(said=Said(motion="b"), a=EDGES, b=ROWS) is None
    assert _find(a=EDGES, b=2.0 * ROWS) is None and _find(a=SLOWER, b=np.zeros(110)) is None
    table = Table(Path("log.csv"), np.arange(110), {"a": EDGES, "b": ROWS})
    assert find_edge_times(table, [read_heading(name) for name in table.names], Said()) is None, "no voltage was said"


def test_what_counts_on() -> None:
    assert counts_on(ROWS) and counts_on(ROWS + 7.0) and counts_on(ROWS + 2.0 * (ROWS > 50.0))
    assert not counts_on(0.01 * ROWS) and not counts_on(-ROWS) and not counts_on(ROWS + 0.5 * (ROWS > 50.0))
    assert not counts_on(np.repeat(ROWS, 2)) and not counts_on(ROWS + ROWS // 5.0)
