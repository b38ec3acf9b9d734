"""Rows as arrays, in runs."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.signals import LARGEST_VOLTAGE, read_signals
from motor_model.errors import RecordingError

FORM = CsvForm("t", "u", "y", Kind.SPEED, "rad/s", time_unit="ms")
TABLE = Table(
    Path("log.csv"),
    np.arange(2, 8),
    {"t": ["0", "5", "10", "15", "20", "25"], "u": ["1"] * 6, "y": list("012345"), "b": ["7900"] * 6, "i": ["20"] * 6},
)


def test_columns_in_volts_and_nanoseconds() -> None:
    form = replace(FORM, voltage_scale=0.5, supply="b", supply_scale=1e-3, current="i", current_scale=1e-3)
    signals = read_signals(TABLE, form, {"": slice(0, 6)})
    assert signals.time.tolist() == [5_000_000 * k for k in range(6)]
    assert signals.voltage == pytest.approx(np.full(6, 3.95)) and signals.supply == pytest.approx(np.full(6, 7.9))
    assert signals.current == pytest.approx(np.full(6, 0.02)) and signals.motion.tolist() == [0, 1, 2, 3, 4, 5]
    assert np.isnan(read_signals(TABLE, FORM, {"": slice(0, 6)}).supply).all()


def test_rows_that_go_take_their_place_in_runs_along() -> None:
    signals = read_signals(TABLE, FORM, {"a": slice(0, 2), "b": slice(2, 6)})
    kept = signals.only(np.array([True, False, True, True, False, True]))
    assert kept.runs == {"b": slice(0, 3)} and kept.motion.tolist() == [2, 3, 5] and len(kept) == 3
    parts = signals.split(np.array([False, False, False, True, False, True]))
    assert parts.runs == {"a": slice(0, 2), "b": slice(2, 4)} and parts.motion.tolist() == [0, 1, 3, 4]
    assert parts.steps().tolist() == [5_000_000, 5_000_000]
    assert len(signals.only(np.zeros(6, np.bool_)).steps()) == 0


@pytest.mark.parametrize(
    ("volts", "refused"), [(LARGEST_VOLTAGE, False), (LARGEST_VOLTAGE * 1.01, True), (1e308, True)]
)
def test_a_voltage_that_no_motor_has_is_refused_with_its_line(volts: float, refused: bool) -> None:
    table = Table(TABLE.path, TABLE.lines, {**TABLE.cells, "u": ["1", "1", repr(volts), "1", "1", "1"]})
    if refused:
        with pytest.raises(RecordingError, match=r"line 4: u comes to .* V, which no such motor has: check the column"):
            read_signals(table, replace(FORM, voltage_scale=1.0 if volts < 1e300 else 1e5), {"": slice(0, 6)})
    else:
        assert read_signals(table, FORM, {"": slice(0, 6)}).voltage[2] == volts
