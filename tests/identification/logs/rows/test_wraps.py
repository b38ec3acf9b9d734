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


def test_a_range_of_its_own_is_found_where_the_motor_goes_on() -> None:
    """As of a belt of 230.4 units: two wraps tell it, one may be a reset, and so may jumps behind which it stands."""
    there = 190.0 + np.cumsum(np.linspace(2.0, 4.0, 200))
    signals, said = unwrap(rows(there % 230.4), form("deg"))
    assert np.allclose(np.diff(signals.motion), np.diff(there), rtol=2e-3)
    assert "wraps at 230.4 deg (3 times; assumed" in said[0]
    back = unwrap(rows(-there % 230.4), form("count"))[0]
    assert np.allclose(np.diff(back.motion), -np.diff(there), rtol=2e-3)
    assert unwrap(rows(there[:100] % 230.4), form("deg"))[1] == [], "a single jump"
    reset = np.concatenate([np.minimum(4.0 * np.arange(-10.0, 60.0), 200.0).clip(0.0) for _ in range(4)])
    assert unwrap(rows(reset), form("deg"))[1] == [], "it stands behind each"
    uneven = np.concatenate([np.arange(0.0, top, 4.0) for top in (200.0, 230.0, 180.0, 220.0)])
    assert unwrap(rows(uneven), form("deg"))[1] == [], "the jumps differ"
