"""Which columns may have a role."""

from pathlib import Path

import numpy as np
import pytest
from log_columns import DRIVE, FOLLOWS, TIME

from motor_identification.logs.columns.roles.candidates import list_readable
from motor_identification.logs.columns.roles.roles import find_roles
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.csv.sparse import LOOKED_AT
from motor_identification.logs.csv.table import Table
from motor_model.errors import RecordingError


@pytest.mark.parametrize(("notes", "taken"), [(150, False), (40, True)])
def test_a_column_of_few_numbers_holds_notes(notes: int, taken: bool) -> None:
    cells = [*["63.2% vmax"] * notes, *["12.0"] * (200 - notes)]
    table = Table(Path("log.csv"), np.arange(2, 202), {"t": TIME, "pwm": DRIVE, "speed": FOLLOWS, "V_max": cells})
    if taken:
        with pytest.raises(RecordingError, match="column V_max: '63.2% vmax' is not a number"):
            find_roles(table, Said())
    else:
        assert find_roles(table, Said()).pairs == (Pair("", "pwm", "speed"),)


def test_readable_are_columns_of_numbers_alone() -> None:
    cells = {"time": ["12:03:03.1", "12:03:03.2"], "pwm": ["1", "2"], "note": ["a", "b"], "rpm": ["1", ""]}
    made = Table(Path("log.csv"), np.arange(2, 4), {name: np.array(one) for name, one in cells.items()})
    assert [one.name for one in list_readable(made)] == ["pwm"]
    late = np.array([*["1"] * LOOKED_AT, ""])  # beyond the cells that are looked at first
    made = Table(Path("log.csv"), np.arange(len(late)), {"rpm": late, "pwm": np.ones(len(late))})
    assert [one.name for one in list_readable(made)] == ["pwm"]
