"""What a user is told to check of a drive."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.cautions import FEWEST_ROWS, caution_running_without_drive
from motor_identification.logs.columns.notes import Notes
from motor_identification.logs.columns.said import Pair
from motor_identification.logs.csv.table import Table

TIME = 0.01 * np.arange(200)


@pytest.mark.parametrize(
    ("before", "rows", "told"),
    [
        (np.full(200, 60.0), 100, True),
        (np.full(200, -60.0), 100, True),
        (np.full(200, 60.0), FEWEST_ROWS - 1, False),
        (np.full(200, 60.0), 200, False),  # no drive at all: that is told elsewhere
        (60.0 * np.exp(-TIME / 2.0), 100, False),  # it was switched off before
        (np.full(200, 5.0), 100, False),  # noise, or a tachogenerator's zero
        (np.zeros(200), 100, False),
    ],
)
def test_a_motor_that_runs_before_anything_drives_it(before: "np.ndarray", rows: int, told: bool) -> None:
    """A column that marks where the step was, 0 and 1, beside a motor that ran before it."""
    mark = np.where(np.arange(200) < rows, 0.0, 1.0)
    speed = np.where(mark > 0.0, 60.0 + 20.0 * (1.0 - np.exp(-(TIME - 0.01 * rows) / 0.1)), before)
    notes = Notes([], [])
    table = Table(Path("log.csv"), np.arange(200), {"mark": mark, "speed": speed})
    caution_running_without_drive(table, Pair("", "mark", "speed"), notes)
    assert len(notes.findings) == told
    if told:
        assert f"in the first {rows} rows, where mark is 0" in notes.findings[0]
