"""The table of frames."""

from motor_driver.frames.codes import LONGEST_FRAME
from motor_driver.frames.table import FRAMES


def test_every_frame_has_a_number_and_fits_on_the_wire() -> None:
    assert len(FRAMES) == 13 and all(number == kind.TYPE for number, kind in FRAMES.items())
    assert all(4 + kind.BODY.size + 4 + 2 <= LONGEST_FRAME for kind in FRAMES.values())
