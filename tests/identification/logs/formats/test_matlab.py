"""MATLAB files."""

from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat

from motor_identification.logs.columns.said import Said
from motor_identification.logs.form import Kind
from motor_identification.logs.formats.matlab import read_matlab
from motor_identification.logs.imported import import_log
from motor_model.errors import RecordingError

TIME = np.arange(50) * 0.01


def test_vectors_columns_and_structs(tmp_path: Path) -> None:
    content = {
        "t": TIME,
        "voltage": TIME[:, None] * 3,
        "log": {"speed": TIME * 5, "deep": {"pos": TIME * 7}},
        "data": np.column_stack([TIME, TIME * 2]),
        "gain": 3.0,
        "label": "bench",
        "other": np.arange(7.0),
    }
    savemat(tmp_path / "log.mat", content, do_compression=True)
    table = read_matlab(tmp_path / "log.mat")
    assert sorted(table.names) == ["data 1", "data 2", "log.deep.pos", "log.speed", "t", "voltage"]
    assert table.numbers("log.deep.pos") == pytest.approx(TIME * 7) and table.notes == (
        "Left out, as they have other lengths: other.",
    )


def test_a_captures_signals_have_the_names_of_their_blocks(tmp_path: Path) -> None:
    """A real-time board's: an array of structs, whose texts end in the block's port, in quotes or not."""
    fields = np.dtype([(name, "O") for name in ("Name", "Path", "Data")])
    signals = np.zeros((1, 4), fields)
    signals[0, 0] = ('"Model Root"/"Voltage"/"Out1"', "", TIME[None] * 3)
    signals[0, 1] = ("In1", "Model Root/Speed Out", TIME[None] * 5)
    signals[0, 2] = ("Out2", "Model Root/Speed Out", TIME[None] * 7)
    signals[0, 3] = ("Out1", "", TIME[None] * 9)
    savemat(tmp_path / "log.mat", {"exp1": {"X": {"Data": TIME[None]}, "Y": signals}})
    table = read_matlab(tmp_path / "log.mat")
    names = ["Speed Out", "Voltage", "exp1.X.Data", "exp1.Y.3 Speed Out", "exp1.Y.4.Data"]
    assert sorted(table.names) == names and table.numbers("Speed Out") == pytest.approx(TIME * 5)


def test_a_signal_that_has_times_of_its_own_keeps_them_and_its_name(tmp_path: Path) -> None:
    signals = {
        "a": {"Name": "speed [rad/s]", "Time": TIME[None], "Data": TIME[None] * 5},
        "b": {"Path": "Model Root/Drive [V//V]", "Data": TIME[None] * 3},
    }
    savemat(tmp_path / "log.mat", signals)
    table = read_matlab(tmp_path / "log.mat")
    assert sorted(table.names) == ["Drive [V/V]", "speed [rad/s].Data", "speed [rad/s].Time"]


@pytest.mark.parametrize("motion", ["obs_vel", "fitted"])
def test_of_several_lengths_the_names_tell_the_motors(tmp_path: Path, motion: str) -> None:
    """A curve that was fitted, of more vectors, beside what was measured."""
    fit = {name: np.arange(80.0) for name in ("x1", "x2", "y1", "y2")}
    savemat(tmp_path / "log.mat", {"obs_volt": TIME * 3, motion: TIME * 5, **fit})
    measured = sorted(["obs_volt", motion])
    assert sorted(read_matlab(tmp_path / "log.mat").names) == (measured if motion == "obs_vel" else sorted(fit))


def test_what_has_no_vectors(tmp_path: Path) -> None:
    savemat(tmp_path / "log.mat", {"a": 1.0})
    with pytest.raises(RecordingError, match="has no vectors of numbers"):
        read_matlab(tmp_path / "log.mat")
    savemat(tmp_path / "log.mat", {"a": TIME})
    with pytest.raises(RecordingError, match="has no two vectors of one length.* --constant-voltage V, and --sample-p"):
        read_matlab(tmp_path / "log.mat")
    assert read_matlab(tmp_path / "log.mat", fewest=1).names == ["a"]


def test_damage_is_a_sentence(tmp_path: Path) -> None:
    path = tmp_path / "log.mat"
    savemat(path, {"t": TIME, "u": TIME * 2}, do_compression=True)
    whole = path.read_bytes()
    generator = np.random.default_rng(3)
    for _ in range(150):
        data = bytearray(whole)
        for place in generator.integers(0, len(whole), 3):
            data[place] ^= 1 << int(generator.integers(0, 8))
        path.write_bytes(bytes(data[: int(generator.integers(100, len(whole) + 1))]))
        try:
            assert len(read_matlab(path)) >= 2
        except RecordingError as error:
            assert "\n" not in str(error) and str(error).endswith(".")


def test_the_longest_three_vectors_are_the_log(tmp_path: Path) -> None:
    """Beside the samples lie the few points of a table, or a pair from elsewhere."""
    few = {name: np.arange(11.0) for name in ("x", "y", "xtest", "ytest", "ztest")}
    log = {name: np.arange(500.0) for name in ("t", "u", "w")}
    savemat(tmp_path / "log.mat", {**few, **log, "long": np.arange(9000.0), "other": np.arange(9000.0)})
    table = read_matlab(tmp_path / "log.mat")
    assert (len(table), table.names) == (500, ["t", "u", "w"])
    assert table.notes[0].startswith("Left out, as they have other lengths: x, y,")


def test_variables_without_a_name_are_not_listed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """MATLAB keeps something of its own of objects, beside the signals."""
    there = {"t": TIME[:, None], "u": TIME[:, None], "": np.zeros((1, 9)), "x": np.zeros((1, 7))}
    monkeypatch.setattr("motor_identification.logs.formats.matlab.read_variables", lambda _: there)
    (tmp_path / "log.mat").write_bytes(b"MATLAB 5.0 MAT-file" + bytes(200))
    left_out, objects = read_matlab(tmp_path / "log.mat").notes
    assert left_out == "Left out, as they have other lengths: x."
    assert objects.startswith("Not read: objects of MATLAB (a timeseries, Simulink's output); save their Time and Data")
    del there["t"], there["x"]
    with pytest.raises(RecordingError, match="log.mat holds objects of MATLAB .*: save their Time and Data as vectors"):
        read_matlab(tmp_path / "log.mat")


def test_times_in_the_first_column_of_each_matrix_are_one(tmp_path: Path) -> None:
    """Simulink's "array with time": every signal brings the times along."""
    content = {
        "Vm": np.column_stack([TIME, TIME * 3]),
        "wl": np.column_stack([TIME, TIME * 5, TIME * 6]),
        "log": {"time": TIME, "values": TIME * 7},
    }
    savemat(tmp_path / "log.mat", content)
    table = read_matlab(tmp_path / "log.mat")
    assert sorted(table.names) == ["Vm", "log.values", "time", "wl 2", "wl 3"]
    assert table.numbers("time") == pytest.approx(TIME) and table.numbers("Vm") == pytest.approx(TIME * 3)
    savemat(tmp_path / "log.mat", content | {"wl": np.column_stack([TIME * 2, TIME * 5])})
    assert sorted(read_matlab(tmp_path / "log.mat").names) == [
        "Vm 1", "Vm 2", "log.time", "log.values", "wl 1", "wl 2",
    ]  # fmt: skip
    same = np.cos(20.0 * TIME)
    savemat(tmp_path / "log.mat", {"a": np.column_stack([same, TIME]), "b": np.column_stack([same, TIME])})
    assert sorted(read_matlab(tmp_path / "log.mat").names) == ["a 1", "a 2", "b 1", "b 2"]


def test_a_sampling_period_beside_the_vectors_is_kept(tmp_path: Path) -> None:
    savemat(tmp_path / "log.mat", {"u": TIME * 3, "y": TIME * 5, "Ts": 0.005, "gain": 3.0})
    table = read_matlab(tmp_path / "log.mat")
    assert sorted(table.names) == ["Ts", "u", "y"] and table.numbers("Ts").tolist() == [0.005] * 50


@pytest.mark.parametrize(
    ("labels", "names"),
    [
        (("Voltage", "Motor speed"), ["ScopeData.time", "Voltage", "Motor speed"]),
        (("", ""), ["ScopeData.time", "ScopeData.signals.1.values", "ScopeData.signals.2.values"]),
        (("u", "u"), ["ScopeData.time", "u", "ScopeData.signals.2 u"]),
    ],
)
def test_the_signals_of_a_scope(tmp_path: Path, labels: tuple[str, str], names: list[str]) -> None:
    """As Simulink's scopes and "To Workspace" save "structures with time": a struct for each signal, with its label."""
    signals = np.zeros((1, 2), dtype=[("values", object), ("dimensions", object), ("label", object)])
    for k, label in enumerate(labels):
        signals[0, k] = (TIME[:, None] * (k + 2), 1.0, label)
    savemat(tmp_path / "log.mat", {"ScopeData": {"time": TIME[:, None], "signals": signals, "blockName": "rig/Scope"}})
    table = read_matlab(tmp_path / "log.mat")
    assert table.names == names
    assert [float(table.numbers(name)[-1] / TIME[-1]) for name in names] == pytest.approx([1.0, 2.0, 3.0])


def test_a_column_that_is_named_is_found_in_any_experiment(tmp_path: Path) -> None:
    """A struct of experiments, of which the longest is taken unless the user names columns of another one."""
    experiments = {
        name: {"t": np.arange(count) * 0.01, "u": np.sign(np.sin(np.arange(count) * 0.05)), "wl": np.ones(count) * size}
        for name, count, size in (("short", 400, 2.0), ("long", 900, 3.0))
    }
    savemat(tmp_path / "log.mat", {"data": experiments})
    assert "data.long.u" in read_matlab(tmp_path / "log.mat").names
    table = read_matlab(tmp_path / "log.mat", ("data.short.u",))
    assert sorted(table.names) == ["data.short.t", "data.short.u", "data.short.wl"]
    assert table.notes == ("Left out, as they have other lengths: data.long.t, data.long.u, data.long.wl.",)
    wave = experiments["short"]
    wave["speed"] = np.cumsum(wave["u"] - 0.1 * wave["t"])
    savemat(tmp_path / "log.mat", {"data": experiments})
    said = Said(voltage="data.short.u", motion="data.short.speed", kind=Kind.SPEED, unit="rad/s")
    (motor,) = import_log(tmp_path / "log.mat", said).motors
    assert sum(len(run.samples) for run in motor.log.runs) == 400


def test_a_played_signal_is_put_beside_what_was_logged_meanwhile(tmp_path: Path) -> None:
    """Simulink logs a sample more than the signal has that was played, and each has times of its own."""
    volts = np.sign(np.sin(20.0 * TIME[:-1]))
    savemat(tmp_path / "log.mat", {"t": TIME[:-1], "u": volts, "log": {"time": TIME, "speed": TIME * 5}})
    table = read_matlab(tmp_path / "log.mat")
    assert sorted(table.names) == ["log.speed", "time", "u"] and table.notes == ()
    assert table.numbers("time") == pytest.approx(TIME)
    (motor,) = import_log(tmp_path / "log.mat", Said(unit="rad/s")).motors
    assert sum(len(run.samples) for run in motor.log.runs) == 50  # the last voltage holds


def cells(*values: object) -> np.ndarray:  # type: ignore[type-arg]
    """An array of cells, as a column."""
    array = np.empty((len(values), 1), dtype=object)
    array[:, 0] = values
    return array


def test_vectors_in_cells_are_read_where_too_few_are_elsewhere(tmp_path: Path) -> None:
    """As a serial logger keeps its channels, one of them a matrix, beside their times."""
    both = np.vstack([TIME * 7, TIME * 9])
    channels = cells((TIME * 3)[None], (TIME * 5)[None], both, "bench", np.zeros((0, 0)))
    savemat(tmp_path / "log.mat", {"data": {"time": TIME[None], "out": channels}})
    table = read_matlab(tmp_path / "log.mat")
    assert table.names == ["data.time", "data.out.1", "data.out.2", "data.out.3 1", "data.out.3 2"]
    assert np.array_equal(table.numbers("data.out.2"), TIME * 5)
    assert np.array_equal(table.numbers("data.out.3 2"), TIME * 9)


def test_vectors_in_cells_are_left_where_there_are_others(tmp_path: Path) -> None:
    longer = cells(*(np.arange(3.0 * len(TIME)) * k for k in range(1, 5)))
    savemat(tmp_path / "log.mat", {"t": TIME, "u": TIME * 3, "speed": TIME * 5, "training": longer})
    assert read_matlab(tmp_path / "log.mat").names == ["t", "u", "speed"]
    assert len(read_matlab(tmp_path / "log.mat", wanted=["training.2"])) == 3 * len(TIME)
