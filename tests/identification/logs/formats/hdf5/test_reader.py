"""Arrays of HDF5 files, as MATLAB 7.3 writes them: paths, references, damage."""

import random
from contextlib import suppress

import numpy as np
import pytest

from motor_identification.logs.formats.hdf5.reader import read_hdf5
from motor_identification.logs.formats.mat_elements import BrokenFileError, TooLargeError
from tests.support.hdf5_file import Stored, hdf5, text

VALUES = np.arange(35.0).reshape(5, 7) / 3.0


def test_references_are_addresses_of_paths() -> None:
    tree = {"cell": Stored(np.zeros((1, 2), np.uint64), refers=("b", "a")), "a": text("left"), "b": text("right")}
    found = read_hdf5(hdf5(tree))
    assert found.arrays["cell"].references
    assert [found.paths[int(one)] for one in found.arrays["cell"].values.ravel()] == ["b", "a"]


def test_what_is_no_such_file() -> None:
    whole = hdf5({"a": Stored(VALUES)})
    newer = bytearray(whole)
    newer[512 + 8] = 2
    for data, complaint in ((b"MATLAB 7.3".ljust(4096), "no header"), (bytes(newer), "not known here")):
        with pytest.raises(BrokenFileError, match=complaint):
            read_hdf5(data)


@pytest.mark.parametrize("seed", range(40))
def test_damage_is_told_or_harmless(seed: int) -> None:
    """Nothing but the two complaints comes of any damage, and soon."""
    rng = random.Random(seed)
    tree = {"a": Stored(VALUES, {"name": "it"}, (2, 3), True), "b": {"c": Stored(VALUES), "d": text("some")}}
    whole = hdf5(tree)
    for _ in range(50):
        data = bytearray(whole)
        for _ in range(rng.choice((1, 2, 5))):
            place, size = rng.randrange(512, len(data)), rng.choice((1, 2, 4, 8))
            data[place : place + size] = rng.choice((bytes(size), b"\xff" * size, rng.randbytes(size)))
        if rng.random() < 0.2:
            data = data[: rng.randrange(512, len(data))]
        with suppress(BrokenFileError, TooLargeError):
            read_hdf5(bytes(data))
