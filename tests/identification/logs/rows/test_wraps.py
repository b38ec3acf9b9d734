"""Positions that wrap are unwrapped."""

from math import tau

import numpy as np
import pytest
from position_rows import form, rows

from motor_identification.logs.rows.wraps import unwrap
from motor_model.errors import RecordingError


@pytest.mark.parametrize(
    ("unit", "size", "step"),
    [("deg", 360.0, 17.0), ("rad", tau, 0.3), ("rev", 1.0, 0.04), ("count", 65536.0, 2900.0), ("count", 4096.0, 90.0)],
)
def test_a_turn_and_the_sizes_of_registers_are_known(unit: str, size: float, step: float) -> None:
    there = np.concatenate([step * np.arange(80), step * np.arange(80, 10, -1)])
    for shift in (0.0, 0.5 * size):  # from 0, or about 0
        signals, said = unwrap(rows((there + shift) % size - shift), form(unit))
        assert np.allclose(np.diff(signals.motion), np.diff(there), atol=1e-9 * size), unit
        assert said and said[0].startswith(f"y wraps at {size:.6g} {unit} (")


@pytest.mark.parametrize(("step", "refused"), [(0.44, False), (0.46, True)])
def test_nearly_half_a_turn_from_value_to_value_is_no_direction(step: float, refused: bool) -> None:
    there = np.concatenate([0.1 * np.arange(30), 3.0 + step * np.arange(60)])
    if refused:
        with pytest.raises(RecordingError, match="goes by up to 0.46 of that from one value to the next"):
            unwrap(rows(there % 1.0), form("rev"))
    else:
        assert np.allclose(np.diff(unwrap(rows(there % 1.0), form("rev"))[0].motion), np.diff(there))


def test_positions_that_do_not_wrap_stay() -> None:
    there = 40.0 * np.sin(np.arange(300) / 30.0)
    for unit in ("deg", "rad", "count"):
        signals, said = unwrap(rows(there), form(unit))
        assert said == [] and np.array_equal(signals.motion, there)
    fast = 200.0 * np.arange(40)  # more than half a turn a row
    assert unwrap(rows(fast), form("deg"))[1] == []
