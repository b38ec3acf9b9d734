"""Rows of a slow sensor in a fast log."""

import numpy as np
import pytest

from motor_identification.logs.rows.held import find_fresh_rows

TIME = np.arange(800) * 5_000_000
ANGLE = 3000.0 * np.sin(TIME * 1e-9)


@pytest.mark.parametrize("rows", [2, 4, 5])
def test_values_that_are_held_for_some_rows(rows: int) -> None:
    held = np.rint(ANGLE[(np.arange(800) // rows) * rows])
    fresh, period = find_fresh_rows(TIME, held)
    assert period == pytest.approx(0.005 * rows, rel=1e-3)
    assert len(fresh) == pytest.approx(800 / rows, abs=2) and np.all(np.diff(fresh)[1:] == rows)


def test_rows_that_are_all_fresh() -> None:
    fresh, period = find_fresh_rows(TIME, np.rint(ANGLE))
    assert period == 0.0 and np.array_equal(fresh, np.arange(800))
