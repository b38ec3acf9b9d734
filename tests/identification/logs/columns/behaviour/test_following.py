"""One column follows another."""

from pathlib import Path

import numpy as np
import pytest
from log_columns import DRIVE, TIME, answer

from motor_identification.logs.columns.roles.roles import find_roles
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.csv.table import Table
from motor_model.errors import RecordingError


@pytest.mark.parametrize("order", [("column 2", "column 4"), ("column 4", "column 2")])
def test_of_two_columns_without_names_one_follows_the_other(order: tuple[str, str]) -> None:
    """Each channel with an X of its own, both noisy, as a measurement card records them."""
    drive = DRIVE + np.random.default_rng(1).normal(0.0, 0.002, 200)
    both = dict(zip(order, (drive, answer(DRIVE)), strict=True))
    cells = {"column 1": TIME, "column 2": both["column 2"], "column 3": TIME + 1e-3, "column 4": both["column 4"]}
    roles = find_roles(Table(Path("log.csv"), np.arange(2, 202), cells), Said())
    assert (roles.time, roles.pairs) == ("column 1", (Pair("", *order),))
    said = f"{order[0]} drives and {order[1]} moves, as that follows it (assumed; otherwise: --voltage)."
    assert roles.findings == (said,)


def test_neither_of_two_that_go_together_is_said_to_follow() -> None:
    wave = np.sin(TIME * 3.0)
    cells = {"column 1": TIME, "column 2": wave, "column 3": TIME + 1e-3, "column 4": answer(wave)}
    with pytest.raises(RecordingError, match="one of column 2, column 4"):  # and not of times
        find_roles(Table(Path("log.csv"), np.arange(2, 202), cells), Said())
