"""An array's bytes, however they are stored."""

import numpy as np
import pytest

from motor_identification.logs.formats.hdf5.reader import read_hdf5
from tests.support.hdf5_file import Stored, hdf5

VALUES = np.arange(35.0).reshape(5, 7) / 3.0


@pytest.mark.parametrize("kind", ["<f8", "<f4", "<i2", "<u2", "<i8", "<u1"])
@pytest.mark.parametrize(("chunk", "shuffled"), [(None, False), ((2, 3), False), ((2, 3), True), ((5, 7), True)])
def test_arrays_of_any_kind(kind: str, chunk: tuple[int, int] | None, shuffled: bool) -> None:
    values = VALUES.astype(kind)
    array = read_hdf5(hdf5({"a": Stored(values, {}, chunk, shuffled)})).arrays["a"]
    assert array.values.dtype == np.dtype(kind) and array.values.tolist() == values.tolist()
    assert not array.references
