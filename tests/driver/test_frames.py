"""Frames as values: what their flags mean, and what is said of another version."""

from dataclasses import replace

import pytest
from board_frames import TELEMETRY

from motor_driver.frames import FRAMES, LONGEST_FRAME, VERSION, Flag, OtherVersion


@pytest.mark.parametrize(
    ("flags", "enabled", "edge"), [(0, False, False), (Flag.ENABLED, True, False), (Flag.EDGE_VALID, False, True)]
)
def test_flags(flags: int, enabled: bool, edge: bool) -> None:
    frame = replace(TELEMETRY, flags=flags)
    assert (frame.enabled, frame.edge_valid) == (enabled, edge)


def test_every_frame_has_a_number_and_fits_on_the_wire() -> None:
    assert len(FRAMES) == 13 and all(number == kind.TYPE for number, kind in FRAMES.items())
    assert all(4 + kind.BODY.size + 4 + 2 <= LONGEST_FRAME for kind in FRAMES.values())


def test_who_is_older_is_to_be_renewed() -> None:
    older, newer = (str(OtherVersion(version).error("ttyACM0")) for version in (VERSION - 1, VERSION + 1))
    assert "flash the board with this workbench's firmware" in older and "update this workbench" in newer
    assert all("ttyACM0 speaks protocol version" in said for said in (older, newer))
