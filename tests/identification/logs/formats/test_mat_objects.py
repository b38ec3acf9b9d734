"""Signals in MATLAB's objects: iddata, timeseries, the output and the data sets of Simulink."""

from contextlib import suppress
from pathlib import Path
from struct import pack

import numpy as np
import pytest

from motor_identification.logs.formats.mat_objects import REFERENCE
from motor_identification.logs.formats.matlab import read_matlab
from motor_model.errors import RecordingError

TIME = np.arange(50) * 0.01
DRIVE = np.repeat([3.0, -2.0], 25)
SPEED = np.sin(TIME)
Cells = list[bytes]


def tagged(kind: int, data: bytes) -> bytes:
    return pack("<II", kind, len(data)) + data + bytes(-len(data) % 8)


def matrix(kind: int, shape: tuple[int, ...], rest: bytes, name: str = "", extra: bytes = b"") -> bytes:
    head = tagged(6, pack("<II", kind, 0)) + tagged(5, pack(f"<{len(shape)}i", *shape))
    return tagged(14, head + tagged(1, name.encode()) + extra + rest)


def numbers(values: np.ndarray, name: str = "") -> bytes:  # type: ignore[type-arg]
    shape = values.shape if values.ndim > 1 else (len(values), 1)
    return matrix(6, shape, tagged(9, values.astype("<f8").tobytes(order="F")), name)


def text(words: str) -> bytes:
    return matrix(4, (1, len(words)), tagged(16, words.encode()))


def cell(*inner: bytes) -> bytes:
    return matrix(1, (len(inner), 1), b"".join(inner))


def struct(fields: dict[str, bytes]) -> bytes:
    return matrix(2, (1, 1), _fields(fields))


def _fields(fields: dict[str, bytes]) -> bytes:
    names = b"".join(name.encode().ljust(32, b"\0") for name in fields)
    return tagged(5, pack("<i", 32)) + tagged(1, names) + b"".join(fields.values())


def iddata(name: str, fields: dict[str, bytes]) -> bytes:
    return matrix(3, (1, 1), _fields(fields), name, tagged(1, b"iddata"))


def refer(number: int) -> bytes:
    return matrix(13, (6, 1), tagged(6, pack("<6I", REFERENCE, 2, 1, 1, number, 1)))


def opaque(name: str, kind: str, inner: bytes) -> bytes:
    words = tagged(1, name.encode()) + tagged(1, b"MCOS") + tagged(1, kind.encode())
    return tagged(14, tagged(6, pack("<II", 17, 0)) + words + inner)


def mat_file(*variables: bytes) -> bytes:
    return b"MATLAB 5.0".ljust(124) + pack("<H", 0x0100) + b"IM" + b"".join(variables)


def objects_of(*objects: tuple[str, dict[str, bytes]]) -> bytes:
    """The store behind the variables: classes, properties, objects counted from 1, and cells of the values."""
    names = sorted({kind for kind, _ in objects} | {name for _, properties in objects for name in properties})
    kinds = sorted({kind for kind, _ in objects})
    cells: Cells = []
    lists = b""
    for _, properties in objects:
        rows = [(names.index(name) + 1, 1, len(cells) + k) for k, name in enumerate(properties)]
        cells += properties.values()
        one = pack(f"<{1 + 3 * len(rows)}I", len(rows), *(number for row in rows for number in row))
        lists += one + bytes(-len(one) % 8)
    texts = b"".join(name.encode() + b"\0" for name in names)
    parts = [
        texts + bytes(-len(texts) % 8),
        bytes(16) + b"".join(pack("<4I", 0, names.index(kind) + 1, 0, 0) for kind in kinds),
        bytes(8),
        bytes(24)
        + b"".join(pack("<6I", kinds.index(kind) + 1, 0, 0, 0, k, 0) for k, (kind, _) in enumerate(objects, 1)),
        bytes(8) + lists,
        b"",
        b"",
        b"",
    ]
    begins = 40 + np.cumsum([len(part) for part in parts])
    table = pack("<2I", 4, len(names)) + pack("<8I", *begins) + b"".join(parts)
    stored = matrix(9, (len(table), 1), tagged(2, table))
    wrapper = opaque("", "FileWrapper__", cell(stored, numbers(np.zeros(0)), *cells))
    inside = b"\0\1IM" + bytes(4) + struct({"MCOS": wrapper})
    return matrix(9, (1, len(inside)), tagged(2, inside))


def series(name: str, data: np.ndarray, times: int) -> tuple[str, dict[str, bytes]]:  # type: ignore[type-arg]
    return "timeseries", {"Name": text(name), "TimeInfo": refer(times), "Data_": numbers(data)}


LISTED = ("timemetadata", {"Time_": numbers(TIME)})
EVEN = (
    "timemetadata",
    {name: numbers(np.array([value])) for name, value in (("Start_", 0.0), ("Increment_", 0.01), ("Length", 50.0))},
)


def read(tmp_path: Path, *variables: bytes) -> dict[str, np.ndarray]:  # type: ignore[type-arg]
    (tmp_path / "log.mat").write_bytes(mat_file(*variables))
    table = read_matlab(tmp_path / "log.mat")
    return {name: table.numbers(name) for name in table.names}


@pytest.mark.parametrize("times", [LISTED, EVEN])
def test_timeseries_are_read_with_their_times(tmp_path: Path, times: tuple[str, dict[str, bytes]]) -> None:
    store = objects_of(series("voltage", DRIVE, 3), series("", SPEED.reshape(1, 1, 50), 3), times)
    found = read(tmp_path, opaque("v", "timeseries", refer(1)), opaque("omega", "timeseries", refer(2)), store)
    assert list(found) == ["time", "voltage", "omega"]
    assert found["time"] == pytest.approx(TIME) and np.array_equal(found["omega"], SPEED)


def test_a_data_set_of_simulink_is_read_by_the_names_of_its_signals(tmp_path: Path) -> None:
    elements = cell(refer(3), refer(4))
    store = objects_of(
        ("Dataset", {"any": struct({"Name": text("logs"), "Storage": refer(2)})}),
        ("RamDatasetStorage", {"any": struct({"Elements": elements})}),
        ("Signal", {"Name": text("u"), "Values": refer(5)}),
        ("Signal", {"Name": text("rpm"), "Values": refer(6)}),
        series("", DRIVE, 7),
        series("", SPEED, 7),
        LISTED,
    )
    found = read(tmp_path, opaque("logsout", "Simulink.SimulationData.Dataset", refer(1)), store)
    assert list(found) == ["time", "u", "rpm"] and np.array_equal(found["rpm"], SPEED)


def test_the_output_of_a_simulation_is_read_by_its_fields(tmp_path: Path) -> None:
    data = struct({"tout": numbers(TIME), "u": numbers(DRIVE), "speed": numbers(SPEED)})
    store = objects_of(("SimulationOutput", {"Data": data, "Metadata": refer(1)}))
    found = read(tmp_path, opaque("out", "Simulink.SimulationOutput", refer(1)), store)
    assert list(found) == ["tout", "u", "speed"] and np.array_equal(found["u"], DRIVE)


def saved_table(**columns: bytes) -> tuple[str, dict[str, bytes]]:
    return "table", {"data": cell(*columns.values()), "varnames": cell(*map(text, columns)), "rownames": cell()}


def test_a_table_is_read_by_the_names_of_its_columns(tmp_path: Path) -> None:
    """Its own times are a column; one of words is none of ours."""
    notes = {"note": cell(*[text("run")] * 50)}
    store = objects_of(saved_table(time=numbers(TIME), u=numbers(DRIVE), **notes, rpm=numbers(SPEED)))
    found = read(tmp_path, opaque("T", "table", refer(1)), store)
    assert list(found) == ["time", "u", "rpm"] and np.array_equal(found["rpm"], SPEED)


def test_several_tables_are_told_apart(tmp_path: Path) -> None:
    columns = {"time": numbers(TIME), "u": numbers(DRIVE)}
    store = objects_of(saved_table(**columns, rpm=numbers(SPEED)), saved_table(**columns, rpm=numbers(-SPEED)))
    found = read(tmp_path, opaque("exp1", "table", refer(1)), opaque("exp2", "table", refer(2)), store)
    assert list(found) == [f"exp{one}.{name}" for one in (1, 2) for name in ("time", "u", "rpm")]
    assert np.array_equal(found["exp2.rpm"], -SPEED)


def test_objects_of_other_classes_are_told_of(tmp_path: Path) -> None:
    store = objects_of(("idtf", {"Numerator": numbers(SPEED)}))
    with pytest.raises(RecordingError, match="holds objects of MATLAB .*save their Time and Data as vectors"):
        read(tmp_path, opaque("model", "idtf", refer(1)), store)


def test_a_store_that_cannot_be_is_left_unread(tmp_path: Path) -> None:
    whole = objects_of(series("voltage", DRIVE, 2), LISTED)
    read_at_all = 0
    for place in range(16, len(whole), 24):
        store = bytearray(whole)
        store[place : place + 4] = b"\xff" * 4
        with suppress(RecordingError):
            read(tmp_path, opaque("v", "timeseries", refer(1)), bytes(store))
            read_at_all += 1
    assert read_at_all > 0


def fields_of(count: int, period: float, **more: bytes) -> dict[str, bytes]:
    sides = {"OutputData": cell(numbers(SPEED[:count])), "InputData": cell(numbers(DRIVE[:count]))}
    return {**sides, "Ts": cell(numbers(np.array([period]))), **more}


def test_an_iddata_is_read_with_its_period_names_and_units(tmp_path: Path) -> None:
    names = {
        "InputName": cell(text("Input Voltage")),
        "InputUnit": cell(text("V")),
        "OutputName": cell(text("y1")),
        "TimeUnit": text("seconds"),
    }
    found = read(tmp_path, iddata("data", fields_of(50, 0.02, **names)))
    assert list(found) == ["Input Voltage (V)", "y", "time (s)"]
    assert found["time (s)"] == pytest.approx(np.arange(50) * 0.02) and np.array_equal(found["y"], SPEED)


@pytest.mark.parametrize(("count", "kept"), [(20, True), (19, False)])
def test_an_iddata_does_not_take_the_place_of_the_vectors_that_it_was_cut_from(
    tmp_path: Path, count: int, kept: bool
) -> None:
    """A lab's file has u, y and t of the whole run beside the iddata of a part; a `u` of fewer is another's."""
    vectors = [numbers(values[:count], name) for name, values in (("t", TIME), ("u", DRIVE), ("y", SPEED))]
    (tmp_path / "log.mat").write_bytes(mat_file(*vectors, iddata("id", fields_of(20, 0.02))))
    table = read_matlab(tmp_path / "log.mat")
    assert (table.names == ["t", "u", "y"]) == kept
    assert ("Left out, beside the vectors that they were cut from: id." in table.notes) == kept


def test_of_several_iddata_the_longest_is_read(tmp_path: Path) -> None:
    (tmp_path / "log.mat").write_bytes(mat_file(iddata("id", fields_of(20, 0.02)), iddata("val", fields_of(50, 0.03))))
    table = read_matlab(tmp_path / "log.mat")
    assert len(table) == 50 and table.numbers("time (s)")[1] == 0.03
    assert table.notes == ("Left out, as another iddata is longer: id.",)
