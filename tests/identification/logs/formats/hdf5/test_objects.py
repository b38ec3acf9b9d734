"""What stands in the headers of groups and arrays."""

import numpy as np

from motor_identification.logs.formats.hdf5.reader import read_hdf5
from tests.support.hdf5_file import Stored, hdf5


def test_links_and_attributes() -> None:
    found = read_hdf5(hdf5({"one": {"deep": Stored(np.arange(3.0), {"name": "it", "size": 7})}}))
    assert list(found.arrays) == ["one/deep"]
    assert found.arrays["one/deep"].attributes == {"name": "it", "size": "7"}
