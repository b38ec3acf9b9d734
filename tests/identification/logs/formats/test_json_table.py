"""JSON documents with a table in them."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from motor_identification.logs.columns.said import Said
from motor_identification.logs.formats.json_table import DEEPEST, read_json_table
from motor_identification.logs.formats.source import read_source
from motor_identification.logs.imported import import_log
from motor_model.errors import RecordingError

TIME = np.round(np.arange(200) * 0.02, 3)
VOLTS = np.repeat([6.0, -3.0, 9.0, -6.0], 50)
SPEED = np.round(VOLTS * 4.0 * (1.0 - np.exp(-(np.arange(200) % 50 + 1) / 9.0)), 2)
ROWS = np.column_stack([TIME, VOLTS, SPEED]).tolist()
NAMES = ["time", "voltage", "rpm"]
OBJECTS = [dict(zip(NAMES, row, strict=True)) for row in ROWS]
COLUMNS = dict(zip(NAMES, np.transpose(ROWS).tolist(), strict=True))


def write(path: Path, document: Any, **how: Any) -> Path:
    (path / "log.json").write_text(json.dumps(document, **how))
    return path / "log.json"


@pytest.mark.parametrize("indent", [None, 2])
@pytest.mark.parametrize(
    "document",
    [
        OBJECTS,
        COLUMNS,
        {name: {str(k): value for k, value in enumerate(column)} for name, column in COLUMNS.items()},  # pandas
        {"columns": NAMES, "index": list(range(200)), "data": ROWS},  # pandas, split
        {"motor": {"name": "left", "gains": [1.0, 2.0]}, "run": {"samples": OBJECTS}},
        {**COLUMNS, "gains": [0.1, 0.2, 0.3], "date": "today"},
    ],
)
def test_a_table_wherever_it_stands(tmp_path: Path, document: Any, indent: int | None) -> None:
    (motor,) = import_log(write(tmp_path, document, indent=indent), Said()).motors
    (run,) = motor.log.runs
    assert len(run.samples) == 200 and motor.log.info.max_voltage == 9.0
    assert max(sample.speed for sample in run.samples) == pytest.approx(np.max(SPEED) * 2.0 * np.pi / 60.0)


def test_rows_without_names(tmp_path: Path) -> None:
    table = read_source(write(tmp_path, ROWS)).table
    assert table.names == ["column 1", "column 2", "column 3"] and table.numbers("column 3").tolist() == SPEED.tolist()


def test_the_largest_of_several_tables_is_the_log(tmp_path: Path) -> None:
    table = read_json_table(write(tmp_path, {"short": OBJECTS[:20], "long": COLUMNS, "text": "x"}))
    assert table.names == NAMES and len(table) == 200
    sparse = [*OBJECTS[:2], {"time": 1.0, "on": True, "voltage": None}]
    table = read_json_table(write(tmp_path, sparse))
    assert [table.text(name, 2) for name in table.names] == ["1.0", "", "", "1"]


def test_a_matrix_in_brackets_is_no_document(tmp_path: Path) -> None:
    rows = "\n ".join(f"[{time} {volts} {speed}]" for time, volts, speed in ROWS)
    (tmp_path / "log.txt").write_text(f"[{rows}]\n")
    source = read_source(tmp_path / "log.txt")
    assert source.format == "text table" and len(source.table) == 200


@pytest.mark.parametrize(
    ("document", "complaint"),
    [
        ({"a": 1}, "is JSON without a table of samples"),
        ({"a": [1, 2]}, "is JSON without a table of samples"),
        ([[1, 2], [1]], "is JSON without a table of samples"),
        ([{"a": 1}, {"a": 2}], "is JSON without a table of samples"),
        ([{f"a{k}": 1} for k in range(1001)], "is JSON without a table of samples"),
    ],
)
def test_what_has_no_table(tmp_path: Path, document: Any, complaint: str) -> None:
    with pytest.raises(RecordingError, match=complaint):
        read_json_table(write(tmp_path, document))
    buried: Any = OBJECTS
    for _ in range(DEEPEST + 2):
        buried = {"in": buried}
    with pytest.raises(RecordingError, match=complaint):
        read_json_table(write(tmp_path, buried))


def test_a_damaged_document_is_told(tmp_path: Path) -> None:
    for text in ('{"time": [1, 2', "[" * 100_000, '{"a":' * 100_000):
        (tmp_path / "log.json").write_text(text)
        with pytest.raises(RecordingError, match="is no complete JSON"):
            read_json_table(tmp_path / "log.json")
