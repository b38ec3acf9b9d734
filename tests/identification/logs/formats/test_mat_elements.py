"""The elements of MATLAB files: what they say of themselves is checked before it is believed."""

import zlib
from pathlib import Path
from struct import pack, unpack_from

import numpy as np
import pytest
from scipy.io import savemat

from motor_identification.logs.formats import mat_elements
from motor_identification.logs.formats.matlab import read_matlab
from motor_model.errors import RecordingError

TIME = np.arange(50) * 0.01


@pytest.mark.parametrize(
    ("at", "number", "words"),
    [
        (0, 9, ""),  # sound
        (0, 0, "no such type of numbers"),  # which ended SciPy's reader, and the process with it
        (0, 10, "no such type of numbers"),
        (4, 392, "other dimensions than numbers"),
        (4, 2**31, "longer than what it is in"),
        (-16, -1, "a dimension cannot be"),
        (-16, 2**30, "a dimension cannot be"),
    ],
)
@pytest.mark.parametrize("compressed", [False, True])
def test_what_a_variable_says_of_itself(tmp_path: Path, at: int, number: int, words: str, compressed: bool) -> None:
    """Behind dimensions, 16 bytes, and a name, 8 bytes, stand the type of the numbers, 9, and their size, 400."""
    path = tmp_path / "log.mat"
    savemat(path, {"t": TIME, "u": TIME})
    data = bytearray(path.read_bytes())
    place = data.index(pack("<II", 9, 400)) + at
    data[place : place + 4] = (number % 2**32).to_bytes(4, "little")
    if compressed:
        size = unpack_from("<I", data, 132)[0] + 8
        packed = zlib.compress(bytes(data[128 : 128 + size]))
        data[128 : 128 + size] = pack("<II", 15, len(packed)) + packed
    path.write_bytes(data)
    if not words:
        assert len(read_matlab(path)) == 50
        return
    with pytest.raises(RecordingError, match=f"is a damaged MATLAB file .*{words}.*: save it again with -v7"):
        read_matlab(path)


@pytest.mark.parametrize(("most", "enough"), [(1500, True), (1000, False)])
def test_a_file_that_grows_too_large(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, most: int, enough: bool) -> None:
    savemat(tmp_path / "log.mat", {"t": TIME * 0.0, "u": TIME * 0.0}, do_compression=True)
    monkeypatch.setattr(mat_elements, "MOST_BYTES", most)
    if enough:
        assert len(read_matlab(tmp_path / "log.mat")) == 50
        return
    with pytest.raises(RecordingError, match="MiB unpacked"):
        read_matlab(tmp_path / "log.mat")


def matrix(name: str, shape: tuple[int, ...], kind: int, numbers: bytes, order: str = "<", sort: int = 6) -> bytes:
    """A variable, not compressed."""

    def tagged(kind: int, data: bytes) -> bytes:
        return pack(order + "II", kind, len(data)) + data + bytes(-len(data) % 8)

    head = tagged(6, pack(order + "II", sort, 0)) + tagged(5, pack(f"{order}{len(shape)}i", *shape))
    return tagged(14, head + tagged(1, name.encode()) + tagged(kind, numbers))


def mat_file(variables: bytes, order: str = "<") -> bytes:
    return b"MATLAB 5.0".ljust(124) + pack(order + "H", 0x0100) + (b"IM" if order == "<" else b"MI") + variables


def two(kind: int, numbers: bytes, count: int, order: str = "<") -> bytes:
    return mat_file(
        matrix("t", (count, 1), kind, numbers, order) + matrix("u", (count, 1), kind, numbers, order), order
    )


def test_numbers_as_matlab_packs_them(tmp_path: Path) -> None:
    """Doubles that are whole numbers are stored in bytes, and on other computers the other way round."""
    for order in "<>":
        (tmp_path / "log.mat").write_bytes(two(3, pack(order + "3h", 1, -2, 3), 3, order))
        assert read_matlab(tmp_path / "log.mat").numbers("u").tolist() == [1.0, -2.0, 3.0]


@pytest.mark.parametrize(
    ("limit", "most", "words"),
    [
        ("MOST_NUMBERS", 100, ""),  # as they will be, not as they are packed
        ("MOST_NUMBERS", 99, "more than 0 million numbers\\): cut it into parts"),
        ("MOST_ELEMENTS", 4, ""),
        ("MOST_ELEMENTS", 3, "more than 3 variables and fields\\)"),
    ],
)
def test_numbers_and_variables_are_counted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, limit: str, most: int, words: str
) -> None:
    (tmp_path / "log.mat").write_bytes(two(2, bytes(50), 50))
    monkeypatch.setattr(mat_elements, limit, most)
    if not words:
        assert len(read_matlab(tmp_path / "log.mat")) == 50
        return
    with pytest.raises(RecordingError, match=f"is too large \\({words}"):
        read_matlab(tmp_path / "log.mat")


@pytest.mark.parametrize("beyond", [1, 0])
def test_a_file_that_is_too_large_before_anything_is_unpacked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, beyond: int
) -> None:
    """What is left to unpack is then negative, or 0, which zlib takes for no limit."""
    packed = zlib.compress(matrix("t", (50, 1), 2, bytes(50)))
    data = mat_file(pack("<II", 15, len(packed)) + packed)
    (tmp_path / "log.mat").write_bytes(data)
    monkeypatch.setattr(mat_elements, "MOST_BYTES", len(data) - beyond)
    with pytest.raises(RecordingError, match="is too large \\(more than 0 MiB"):
        read_matlab(tmp_path / "log.mat")


@pytest.mark.parametrize(("shape", "names"), [((1, 1, 50), ["t", "u", "y"]), ((2, 1, 25), ["t", "u"])])
def test_a_signal_of_more_dimensions_is_read_where_it_is_long_in_one(
    tmp_path: Path, shape: tuple[int, ...], names: list[str]
) -> None:
    """Simulink logs a signal that is a matrix of one number as 1 × 1 × samples."""
    (tmp_path / "log.mat").write_bytes(two(2, bytes(50), 50) + matrix("y", shape, 2, bytes(range(50))))
    table = read_matlab(tmp_path / "log.mat")
    assert table.names == names
    assert "y" not in names or table.numbers("y").tolist() == list(range(50))


@pytest.mark.parametrize("dimensions", [1, 2, 32, 33, 10**6])
def test_a_matrix_has_a_few_dimensions(tmp_path: Path, dimensions: int) -> None:
    """A product of a million of them would take minutes. Other matrices of more than two are left out."""
    odd = matrix("odd", (1,) * dimensions if dimensions < 10**6 else (2**31 - 1,) * dimensions, 2, bytes(1))
    (tmp_path / "log.mat").write_bytes(two(2, bytes(50), 50) + odd)
    if dimensions in (2, 32):
        assert read_matlab(tmp_path / "log.mat").names == ["t", "u"]
        return
    with pytest.raises(RecordingError, match="a dimension cannot be"):
        read_matlab(tmp_path / "log.mat")


def test_an_object_is_left_out(tmp_path: Path) -> None:
    """Where a matrix has its dimensions, a table or a string has a text."""
    (tmp_path / "log.mat").write_bytes(two(2, bytes(50), 50) + matrix("when", (0x7F7F7F7F,) * 3, 2, b"", sort=17))
    assert read_matlab(tmp_path / "log.mat").names == ["t", "u"]
