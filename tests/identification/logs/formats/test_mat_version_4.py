"""MATLAB files of version 4: what Simulink's block To File writes."""

from pathlib import Path
from struct import pack

import numpy as np
import pytest
from scipy.io import savemat

from motor_identification.logs.formats.mat_elements import BrokenFileError
from motor_identification.logs.formats.mat_version_4 import is_version_4, read_matrices
from motor_identification.logs.formats.source import read_source
from motor_model.errors import RecordingError

TIME = np.arange(100) * 0.002


def test_a_row_for_each_signal(tmp_path: Path) -> None:
    signals = np.stack([TIME, np.sin(TIME), 4.0 * np.sign(np.sin(TIME))])
    savemat(tmp_path / "log.mat", {"data": signals}, format="4")
    source = read_source(tmp_path / "log.mat")
    assert (source.format, source.table.names) == ("MATLAB 4 file", ["data 1", "data 2", "data 3"])
    np.testing.assert_array_equal(source.table.numbers("data 2"), np.sin(TIME))


@pytest.mark.parametrize("type_of_numbers", ["f8", "f4", "i4", "i2", "u2", "u1"])
def test_all_types_beside_texts(tmp_path: Path, type_of_numbers: str) -> None:
    values = np.arange(12, dtype=type_of_numbers).reshape(3, 4)
    savemat(tmp_path / "log.mat", {"note": "a text", "a": values, "b_2": TIME}, format="4")
    found = read_matrices((tmp_path / "log.mat").read_bytes())
    assert list(found) == ["a", "b_2"]
    np.testing.assert_array_equal(found["a"], values)
    assert found["b_2"].shape == (1, 100)  # type: ignore[union-attr]


def test_the_other_byte_order() -> None:
    data = pack(">5i", 1000, 2, 1, 0, 2) + b"x\0" + pack(">2d", 1.5, -2.0)
    np.testing.assert_array_equal(read_matrices(data)["x"], [[1.5], [-2.0]])


@pytest.mark.parametrize(
    "head", [b"", b"1,2,3\n4,5,6\n7,8,9\n", b"t u y 100 200 300", pack("<5i", 0, 2, 1, 0, 2) + b"xy", b"\0" * 64]
)
def test_what_is_none(head: bytes) -> None:
    assert not is_version_4(head)


def test_a_file_that_was_cut_off(tmp_path: Path) -> None:
    data = pack("<5i", 0, 4, 2, 0, 2) + b"x\0" + bytes(64)
    assert read_matrices(data)["x"].shape == (4, 2)  # type: ignore[union-attr]
    with pytest.raises(BrokenFileError, match="longer than the file"):
        read_matrices(data[:-1])
    (tmp_path / "log.mat").write_bytes(data[:-1])
    with pytest.raises(RecordingError, match="damaged MATLAB file"):
        read_source(tmp_path / "log.mat")
    with pytest.raises(BrokenFileError, match="no head"):
        read_matrices(data + b"rest")


def test_damage_is_a_sentence(tmp_path: Path) -> None:
    path = tmp_path / "log.mat"
    savemat(path, {"t": TIME, "data": np.stack([TIME, TIME * 2.0])}, format="4")
    whole = path.read_bytes()
    generator = np.random.default_rng(4)
    for _ in range(150):
        data = bytearray(whole)
        for place in generator.integers(0, 60, 2):
            data[place] = int(generator.integers(0, 256))
        path.write_bytes(bytes(data[: int(generator.integers(30, len(whole) + 1))]))
        try:
            assert len(read_source(path).table) >= 2
        except RecordingError as error:
            assert "\n" not in str(error) and str(error).endswith(".")
