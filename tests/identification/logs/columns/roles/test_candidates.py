"""Which columns may have a role."""

from pathlib import Path

import numpy as np
import pytest
from log_columns import DRIVE, FOLLOWS, TIME

from motor_identification.logs.columns.roles.roles import find_roles
from motor_identification.logs.columns.said import Pair, Said
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
