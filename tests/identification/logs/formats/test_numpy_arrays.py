"""Arrays in NumPy's files."""

from io import BytesIO
from typing import Any

import numpy as np
import pytest

from motor_identification.logs.formats.mat_elements import BrokenFileError, TooLargeError
from motor_identification.logs.formats.numpy_arrays import MOST_ARRAYS, is_archive_of_arrays, read_arrays

TABLE = np.arange(12.0).reshape(4, 3)


def saved(array: Any) -> bytes:
    stream = BytesIO()
    np.save(stream, array)
    return stream.getvalue()


def archived(**arrays: Any) -> bytes:
    stream = BytesIO()
    np.savez_compressed(stream, **arrays)
    return stream.getvalue()


def test_an_array_alone_and_an_archive() -> None:
    assert np.array_equal(read_arrays(saved(TABLE))["data"], TABLE)
    assert np.array_equal(read_arrays(saved(np.asfortranarray(TABLE)))["data"], TABLE)
    several = {"t": np.arange(4), "on": np.array([True]), "name": np.array(["a"]), "cube": np.zeros((2, 2, 2))}
    found = read_arrays(archived(**several))
    assert list(found) == ["t", "on"] and np.array_equal(found["t"], [[0.0], [1.0], [2.0], [3.0]])
    fields = np.array([(0.0, 1), (0.5, 2)], dtype=[("t", "f8"), ("pwm", "i4")])
    assert np.array_equal(read_arrays(saved(fields))["pwm"], [[1.0], [2.0]])
    assert is_archive_of_arrays(archived(t=TABLE)) and not is_archive_of_arrays(saved(TABLE))


@pytest.mark.parametrize(
    "data",
    [
        saved(np.array([{"a": 1}], dtype=object)),
        saved(TABLE)[:100],
        saved(TABLE)[:-8],
        saved(TABLE).replace(b"(4, 3)", b"(9, 9)"),
        saved(TABLE).replace(b"(4, 3)", b"(-4,3)"),
        saved(TABLE).replace(b"'<f8'", b"'|V0'"),
        archived(t=TABLE)[:60],
    ],
)
def test_what_is_damaged_or_no_numbers_is_refused(data: bytes) -> None:
    with pytest.raises(BrokenFileError, match="an array cannot be read"):
        read_arrays(data)


def test_too_many_arrays_are_refused() -> None:
    with pytest.raises(TooLargeError):
        read_arrays(archived(**{f"a{k}": np.zeros(1) for k in range(MOST_ARRAYS + 1)}))
