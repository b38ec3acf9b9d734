"""MATLAB 7.3 files: matrices and structs, and what Simulink logged as it ran."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.said import Said
from motor_identification.logs.formats import mat_7_3
from motor_identification.logs.formats.mat_7_3 import read_variables_7_3
from motor_identification.logs.formats.matlab import read_matlab
from motor_identification.logs.formats.source import read_source
from motor_identification.logs.imported import import_log
from motor_model.errors import RecordingError
from tests.support.hdf5_file import Stored, Tree, hdf5, matrix, text

TIME = np.arange(400) * 0.001
VOLTS = np.repeat([0.0, 6.0, -3.0, 4.5], 100)
SPEED = np.cumsum(VOLTS) * 0.25


def write(tree: Tree, path: Path) -> Path:
    path.write_bytes(hdf5(tree))
    return path


def test_matrices_and_structs(tmp_path: Path) -> None:
    tree: Tree = {
        "t": matrix(TIME[:, None]),
        "log": {"u": matrix(VOLTS), "deep": {"y": matrix(SPEED[:, None])}},
        "both": matrix(np.column_stack([TIME, VOLTS])),
        "name": text("bench"),
        "none": Stored(np.zeros(2, np.uint64), {"MATLAB_class": "double", "MATLAB_empty": 1}),
        "cells": Stored(np.zeros((1, 1), np.uint64), {"MATLAB_class": "cell"}, refers=("name",)),
        "#refs#": {"a": matrix(TIME[:, None])},
    }
    variables = read_variables_7_3(hdf5(tree))
    assert sorted(variables) == ["both", "log", "t"]
    source = read_source(write(tree, tmp_path / "log.mat"))
    assert source.format == "MATLAB 7.3 file"
    table = source.table
    assert sorted(table.names) == ["both 1", "both 2", "log.deep.y", "log.u", "t"]
    assert table.numbers("log.u").tolist() == VOLTS.tolist() and table.numbers("both 2").tolist() == VOLTS.tolist()


@pytest.mark.parametrize(("shape", "names"), [((-1, 1, 1), ["t", "u", "y"]), ((-1, 2, 1), ["t", "u"])])
def test_a_signal_of_more_dimensions_is_read_where_it_is_long_in_one(
    tmp_path: Path, shape: tuple[int, ...], names: list[str]
) -> None:
    """1 × 1 × samples in MATLAB, whose order is the other way round."""
    tree: Tree = {
        "t": matrix(TIME[:, None]),
        "u": matrix(VOLTS),
        "y": Stored(SPEED.reshape(shape), {"MATLAB_class": "double"}),
    }
    table = read_source(write(tree, tmp_path / "log.mat")).table
    assert sorted(table.names) == names
    assert "y" not in names or table.numbers("y").tolist() == SPEED.tolist()


def capture(rows: int = 2) -> Tree:
    """A capture of a real-time board: its clock in one struct, its signals in an array of structs."""
    fields = {
        "Data": [matrix(VOLTS[:, None]), matrix(SPEED[:, None])],
        "Path": [text("Model Root/Volt"), text("Model Root/Speed Out")],
        "Name": [text("In1"), text("Out1")],
        "Type": [Stored(np.zeros(2, np.uint64), {"MATLAB_class": "char", "MATLAB_empty": 1})] * 2,
    }
    kept = {f"{name}{k}": one for name, values in fields.items() for k, one in enumerate(values[:rows])}
    signals: Tree = {
        name: Stored(np.zeros((rows, 1), np.uint64), {}, refers=tuple(f"#refs#/{name}{k}" for k in range(rows)))
        for name in fields
    }
    return {"exp1": {"X": {"Data": matrix(TIME[:, None])}, "Y": signals}, "#refs#": kept}


def test_an_array_of_structs_holds_signals_by_the_names_of_their_blocks(tmp_path: Path) -> None:
    table = read_source(write(capture(), tmp_path / "capture.mat")).table
    assert sorted(table.names) == ["Speed Out", "Volt", "exp1.X.Data"]
    assert table.numbers("Volt").tolist() == VOLTS.tolist() and table.numbers("Speed Out").tolist() == SPEED.tolist()
    (motor,) = import_log(tmp_path / "capture.mat", Said(unit="rad/s")).motors
    assert [(run.samples[1].sample_time, len(run.samples)) for run in motor.log.runs] == [(1_000_000, 400)]


def test_members_of_an_array_of_structs_are_numbered(monkeypatch: pytest.MonkeyPatch) -> None:
    signals = read_variables_7_3(hdf5(capture()))["exp1"]["Y"]  # type: ignore[index,call-overload]
    assert sorted(signals) == ["1", "2"] and signals["1"]["Path"] == "Model Root/Volt" and "Type" not in signals["1"]
    monkeypatch.setattr(mat_7_3, "MOST_MEMBERS", 1)
    assert sorted(read_variables_7_3(hdf5(capture()))["exp1"]["Y"]) == ["1"]  # type: ignore[index,call-overload]


def signal(record: int, kind: str, block: str, name: str = "", count: int = 400) -> Tree:
    """One element of a data set: its clock, its record, and the block that it comes from."""
    return {
        "BlockPath": Stored(np.zeros((1, 1), np.uint64), {"MATLAB_class": "cell"}, refers=(block,)),
        "Name": text(name) if name else Stored(np.zeros(2, np.uint64), {"MATLAB_class": "char", "MATLAB_empty": 1}),
        "Values": {
            "CompressedTime": matrix([[0.0], [0.001], [float(count)]]),
            "DataR2": matrix([[float(record)]]),
            "SignalAttributes": {"ClassName": text(kind)},
        },
    }


def data_set(names: tuple[str, str] = ("", ""), count: int = 400) -> Tree:
    """What Simulink logs to a file: an object that only MATLAB reads, and beside it what it stands for."""
    raw = (VOLTS.astype("<f8").tobytes(), SPEED.astype("<f4").tobytes())
    return {
        "data": Stored(np.zeros((1, 6), np.uint32), {"MATLAB_class": "Simulink.Dataset", "MATLAB_object_decode": 3}),
        "#refs#": {
            "d": signal(0, "double", "#refs#/e", names[0], count),
            "e": text("rig/Voltage"),
            "f": signal(1, "single", "#refs#/g", names[1], count),
            "g": text("rig/board/Speed (rad//s)"),
        },
        "#sigstream#": {
            str(k): {"#data#": Stored(np.frombuffer(one, np.uint8), chunk=(1024,))} for k, one in enumerate(raw)
        },
    }


def test_signals_that_simulink_logged_to_a_file(tmp_path: Path) -> None:
    table = read_matlab(write(data_set(), tmp_path / "log.mat"))
    assert table.names == ["time", "Voltage", "Speed (rad/s)"]
    assert table.numbers("time") == pytest.approx(TIME) and table.numbers("Voltage").tolist() == VOLTS.tolist()
    assert table.numbers("Speed (rad/s)") == pytest.approx(SPEED)
    (motor,) = import_log(write(data_set(("u", "omega")), tmp_path / "named.mat"), Said(unit="rad/s")).motors
    assert motor.log.info.sample_period == pytest.approx(0.001)
    (run,) = motor.log.runs
    assert {sample.voltage for sample in run.samples} == set(VOLTS)


def test_a_stream_of_another_length_is_left_alone(tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match="objects of MATLAB"):
        read_matlab(write(data_set(count=399), tmp_path / "log.mat"))


def test_damage_is_a_sentence(tmp_path: Path) -> None:
    path = tmp_path / "log.mat"
    path.write_bytes(hdf5({"t": matrix(TIME[:, None]), "u": matrix(VOLTS)})[:700])
    with pytest.raises(RecordingError, match="is a damaged MATLAB file .*: save it again with -v7"):
        read_matlab(path)


def test_matrices_in_cells_are_numbered(tmp_path: Path) -> None:
    refers = ("#refs#/a", "#refs#/b", "#refs#/c")
    tree: Tree = {
        "log": {
            "t": matrix(TIME[:, None]),
            "out": Stored(np.zeros((3, 1), np.uint64), {"MATLAB_class": "cell"}, refers=refers),
        },
        "one": Stored(np.zeros((1, 1), np.uint64), {"MATLAB_class": "cell"}, refers=refers[:1]),
        "texts": Stored(np.zeros((1, 1), np.uint64), {"MATLAB_class": "cell"}, refers=refers[2:]),
        "#refs#": {"a": matrix(VOLTS[:, None]), "b": matrix(SPEED[:, None]), "c": text("bench")},
    }
    variables = read_variables_7_3(hdf5(tree))
    assert sorted(variables) == ["log", "one"] and np.array_equal(np.ravel(np.asarray(variables["one"])), VOLTS)
    table = read_matlab(write(tree, tmp_path / "log.mat"), wanted=["log.out.2"])
    assert sorted(table.names) == ["log.out.1", "log.out.2", "log.t", "one"]
    assert table.numbers("log.out.2").tolist() == SPEED.tolist()
