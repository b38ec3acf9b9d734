"""What the board says, as values: what flags mean, and what is said of another version."""

from dataclasses import replace

import pytest
from board_frames import TELEMETRY

from motor_driver.frames.codes import VERSION, Flag
from motor_driver.frames.from_board import OtherVersion


@pytest.mark.parametrize(
    ("flags", "enabled", "edge"), [(0, False, False), (Flag.ENABLED, True, False), (Flag.EDGE_VALID, False, True)]
)
def test_flags(flags: int, enabled: bool, edge: bool) -> None:
    frame = replace(TELEMETRY, flags=flags)
    assert (frame.enabled, frame.edge_valid) == (enabled, edge)


def test_who_is_older_is_to_be_renewed() -> None:
    older, newer = (str(OtherVersion(version).error("ttyACM0")) for version in (VERSION - 1, VERSION + 1))
    assert "flash the board with this workbench's firmware" in older and "update this workbench" in newer
    assert all("ttyACM0 speaks protocol version" in said for said in (older, newer))
