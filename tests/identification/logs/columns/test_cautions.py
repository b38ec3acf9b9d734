"""What a user is told to check of a drive."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.cautions import caution_no_means, caution_running_without_drive
from motor_identification.logs.columns.notes import Notes
from motor_identification.logs.columns.said import Pair
from motor_identification.logs.csv.table import Table
from motor_identification.measurement.sanity_checks import FEWEST_ROWS

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


@pytest.mark.parametrize(
    ("drive", "taken_out", "told"),
    [
        (np.repeat([2.0, 5.0, 3.0, 4.5], 50), (True, True), True),
        (np.repeat([2.0, 5.0, 3.0, 4.5], 50), (True, False), False),
        (np.repeat([2.0, 5.0, 3.0, 4.5], 50), (False, True), False),
        (np.repeat([5.0, -5.0, 0.0, 0.0], 50), (True, True), False),  # as much one way as the other
    ],
)
def test_means_that_were_taken_out(drive: "np.ndarray", taken_out: tuple[bool, bool], told: bool) -> None:
    speed = 3.0 * np.convolve(drive, np.exp(-TIME / 0.1), "full")[:200]
    drive, speed = (one - np.mean(one) * out for one, out in zip((drive, speed), taken_out, strict=True))
    notes = Notes([], [])
    caution_no_means(Table(Path("log.csv"), np.arange(200), {"u": drive, "y": speed}), Pair("", "u", "y"), notes)
    assert [("a mean of 0" in one) for one in notes.findings] == [True] * told
