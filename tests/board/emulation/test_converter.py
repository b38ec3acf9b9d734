"""The emulated chip's converter reads as a real one: 1,024 steps of 5/1,024 V, each from its own voltage on."""

import pytest

from motor_board.emulation.chip import CONVERTER_REFERENCE, CONVERTER_STEPS, _millivolts

STEP = CONVERTER_REFERENCE / CONVERTER_STEPS  # [V]


def reads(volts: float) -> int:
    """What simavr makes of the millivolts that it is told, in whole numbers."""
    return _millivolts(volts) * 0x3FF // 5000


def test_every_step_begins_at_its_own_voltage() -> None:
    for step in range(CONVERTER_STEPS):
        assert reads(step * STEP) == reads((step + 0.99) * STEP) == step


@pytest.mark.parametrize(("volts", "read"), [(-1.0, 0), (0.0, 0), (4.9999, 1023), (5.0, 1023), (12.0, 1023)])
def test_the_clamps_keep_it_in_its_range(volts: float, read: int) -> None:
    assert reads(volts) == read
