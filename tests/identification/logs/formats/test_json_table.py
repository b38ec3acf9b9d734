"""JSON documents with a table in them."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from motor_identification.logs.columns.said import Said
from motor_identification.logs.formats.json_table import DEEPEST, FEWEST_ROWS, NEXT, RUN, read_json_table
from motor_identification.logs.formats.source import read_source
from motor_identification.logs.imported import import_log
from motor_identification.logs.rows.parts import MOST_RUNS
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


RUNS = [{"type": kind, "voltage": VOLTS[at].tolist(), "rpm": SPEED[at].tolist()} for kind, at in (
    ("chirp", slice(0, 150)), ("step", slice(40, 70)), ("step", slice(90, 130)),
)]  # fmt: skip


@pytest.mark.parametrize("around", [lambda runs: runs, lambda runs: {"rate": 50, "data": runs}])
def test_every_run_of_a_list_is_a_recording(tmp_path: Path, around: Any) -> None:
    imported = import_log(write(tmp_path, around(RUNS)), Said(sample_period=0.02))
    (motor,) = imported.motors
    assert [(run.label, len(run.samples)) for run in motor.log.runs] == [
        ("chirp_1", 150),
        ("step_2", 30),
        ("step_3", 40),
    ]
    assert any("has a list of 3 runs" in line for line in imported.findings)
    assert not any("Left out" in line for line in imported.findings)


def test_runs_that_hold_their_samples_as_objects_or_have_no_name(tmp_path: Path) -> None:
    runs = [{"id": 7, "samples": OBJECTS[:100]}, {"id": 8, "samples": OBJECTS[100:]}]
    (motor,) = import_log(write(tmp_path, {"runs": runs}), Said()).motors
    assert [(run.label, len(run.samples)) for run in motor.log.runs] == [("run_1", 100), ("run_2", 100)]


def test_what_of_the_same_columns_is_not_read_is_said(tmp_path: Path) -> None:
    """Not one run beside another: which of them is the log, nothing tells; and runs of hardly any rows."""
    two = read_json_table(write(tmp_path, {"short": OBJECTS[:20], "long": COLUMNS}))
    assert two.notes == (
        "Left out: 1 more table of the same columns (the largest is read): give each in a file of its own.",
    )
    assert read_json_table(write(tmp_path, {"gains": {"p": [1, 2], "i": [3, 4]}, "log": COLUMNS})).notes == ()
    stub = {name: column[:4] for name, column in COLUMNS.items()}
    few = read_json_table(write(tmp_path, [COLUMNS, stub]))
    assert len(few) == 200 and few.names == NAMES and few.notes[0].startswith("Left out: 1 of the list")
    few = read_json_table(write(tmp_path, [COLUMNS, stub, COLUMNS]))
    assert len(few) == 400 and few.notes[1] == "Left out: 1 of the list, of fewer than 5 rows."


def batches(rows: int, pause: float = 1.0) -> list[dict[str, list[float]]]:
    """The log in tables of so many rows, each behind a pause in lengths of rows."""
    found = []
    for number, at in enumerate(range(0, 200, rows)):
        times = TIME[at : at + rows] + number * 0.02 * (pause - 1.0)
        found.append(
            {"time": times.tolist(), "voltage": VOLTS[at : at + rows].tolist(), "rpm": SPEED[at : at + rows].tolist()}
        )
    return found


@pytest.mark.parametrize("rows", [40, FEWEST_ROWS - 1])
@pytest.mark.parametrize("around", [lambda members: members, lambda members: {"packets": members}])
def test_batches_whose_times_go_on_are_one_recording(tmp_path: Path, rows: int, around: Any) -> None:
    table = read_json_table(write(tmp_path, around(batches(rows))))
    assert table.names == NAMES and table.numbers("time").tolist() == TIME.tolist()
    assert table.notes == (
        f"The file has a list of {200 // rows} tables, whose times go on from one to the next: one recording.",
    )


@pytest.mark.parametrize(("pause", "one"), [(0.95 * NEXT, True), (1.05 * NEXT, False), (-1.0, False)])
def test_times_that_go_on_do_so_by_about_a_row(tmp_path: Path, pause: float, one: bool) -> None:
    assert (RUN not in read_json_table(write(tmp_path, batches(40, pause))).names) == one


def test_what_is_called_a_run_is_one_however_its_times_go_on(tmp_path: Path) -> None:
    for members in (
        {"trials": batches(100)},
        [{"type": kind, **one} for kind, one in zip(("step", "chirp"), batches(100), strict=True)],
        [{name: one[name] for name in ("voltage", "rpm")} for one in batches(100)],  # without times nothing tells
        [{**one, "time": [f"12:00:{time:06.3f}" for time in one["time"]]} for one in batches(100)],
    ):
        table = read_json_table(write(tmp_path, members))
        assert RUN in table.names and table.notes == (
            "The file has a list of 2 runs: a bag each (otherwise: --split).",
        )
    same = [{"board": "A", **one} for one in batches(100)]
    assert RUN not in read_json_table(write(tmp_path, same)).names


def test_more_tables_than_a_log_has_runs_are_told_and_batches_are_not_too_many(tmp_path: Path) -> None:
    few = {name: column[:FEWEST_ROWS] for name, column in COLUMNS.items()}
    assert len(read_json_table(write(tmp_path, [few] * MOST_RUNS))) == MOST_RUNS * FEWEST_ROWS
    with pytest.raises(
        RecordingError, match="has a list of 1001 tables, whose times do not go on from one to the next"
    ):
        read_json_table(write(tmp_path, [few] * (MOST_RUNS + 1)))
    on = [{"time": [0.2 * k, 0.2 * k + 0.1], "u": [k % 7, 1], "rpm": [k, k]} for k in range(MOST_RUNS + 1)]
    assert len(read_json_table(write(tmp_path, on))) == 2 * MOST_RUNS + 2


@pytest.mark.parametrize(
    ("document", "motors"),
    [
        ({"motors": [{"name": "a", **COLUMNS}, {"name": "b", **COLUMNS}]}, True),
        ({"motors": [{"name": "a", "samples": OBJECTS}, {"name": "b", "samples": OBJECTS}]}, True),
        ([{"name": "left", **COLUMNS}, {"name": "right", **COLUMNS}], True),
        ({"motor": {"runs": [{"name": "a", **COLUMNS}, {"name": "b", **COLUMNS}]}}, False),
        ([{"name": "left", **COLUMNS}, {"name": "left", **COLUMNS}], False),
    ],
)
def test_members_that_may_be_motors_are_said_to_be(tmp_path: Path, document: Any, motors: bool) -> None:
    notes = read_json_table(write(tmp_path, document)).notes
    assert any("may be different motors: identify each bag alone" in line for line in notes) == motors


def test_channels_are_no_runs(tmp_path: Path) -> None:
    voltage = {"name": "voltage [V]", "time": COLUMNS["time"], "value": COLUMNS["voltage"]}
    speed = {"name": "speed [rpm]", "time": COLUMNS["time"], "value": COLUMNS["rpm"]}
    with pytest.raises(RecordingError, match=r"has a list of channels \(voltage \[V\], speed \[rpm\]\)"):
        read_json_table(write(tmp_path, {"series": [voltage, speed]}))
    assert RUN in read_json_table(write(tmp_path, [speed, speed])).names
    steps = [{"name": name, "time": COLUMNS["time"], "rpm": COLUMNS["rpm"]} for name in ("voltage 5", "speed 3")]
    assert RUN in read_json_table(write(tmp_path, steps)).names  # their column tells what it is


def test_runs_are_members_of_one_list_with_the_same_columns(tmp_path: Path) -> None:
    other = {"time": COLUMNS["time"][:50], "position": COLUMNS["rpm"][:50]}
    assert read_json_table(write(tmp_path, [COLUMNS, other])).names == NAMES
    table = read_json_table(write(tmp_path, {"a": COLUMNS, "b": COLUMNS}))  # of an object
    assert table.names == NAMES and len(table) == 200 and "Left out: 1 more table" in table.notes[0]
    apart = {"a": [COLUMNS, COLUMNS], "b": [COLUMNS]}  # of another list
    assert len(read_json_table(write(tmp_path, apart))) == 400
    named = read_json_table(write(tmp_path, {"columns": NAMES, "data": OBJECTS}))  # names beside rows that have them
    assert named.names == NAMES and len(named) == 200 and named.notes == ()


@pytest.mark.filterwarnings("error")
def test_times_of_any_size_do_not_go_on(tmp_path: Path) -> None:
    huge = {"time": [-1.7e308, 1.7e308] * 3, "u": [1.0] * 6, "rpm": [2.0] * 6}
    assert RUN in read_json_table(write(tmp_path, [huge, huge])).names
