"""Numbers in a column of duties that are none."""

import numpy as np
import pytest

from motor_identification.logs.columns.behaviour.codes import find_codes


@pytest.mark.parametrize(
    ("duties", "codes"),
    [
        ([0, 255, -255, 1000], (1000.0,)),
        ([0, 60, 120, 255, 999, -9999], (-9999.0, 999.0)),
        ([0, 60, 120, 255, 510], (510.0,)),
        ([0, 60, 120, 255, 509], ()),
        ([0, 255, 1000], ()),  # a quarter of a timer, and the whole
        ([0, 60, 120, 254, 1000], ()),  # a register that is not filled: of 1000
        ([0, 60, 120, 255, 1023], ()),
        ([0, 60, 120, 255, 1024], ()),
        ([0, 60, 120, 255, 600, 700, 800], ()),
        ([0, 60.5, 120, 255, 1000], ()),
        ([0, 60, 120, 255], ()),
        ([0, 1000], ()),
    ],
)
def test_codes(duties: list[float], codes: tuple[float, ...]) -> None:
    assert find_codes(np.repeat(np.array(duties, float), 5)) == codes
