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


def test_numbers_as_matlab_packs_them(tmp_path: Path) -> None:
    """Doubles that are whole numbers are stored in bytes, and on other computers the other way round."""
    for order, mark in (("<", b"IM"), (">", b"MI")):

        def tagged(kind: int, data: bytes, order: str = order) -> bytes:
            return pack(order + "II", kind, len(data)) + data + bytes(-len(data) % 8)

        data = b"MATLAB 5.0".ljust(124) + pack(order + "H", 0x0100) + mark
        for name in "tu":
            head = tagged(6, pack(order + "II", 6, 0)) + tagged(5, pack(order + "ii", 3, 1)) + tagged(1, name.encode())
            data += tagged(14, head + tagged(3, pack(order + "3h", 1, -2, 3)))
        (tmp_path / "log.mat").write_bytes(data)
        assert read_matlab(tmp_path / "log.mat").numbers("u").tolist() == [1.0, -2.0, 3.0]
