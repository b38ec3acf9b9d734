"""A picture in two shapes, with its title."""

import pytest

from motor_identification.reporting.html import pictures
from motor_identification.reporting.html.overlay import NARROW, WIDE


def test_it_is_drawn_for_wide_and_narrow_screens(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pictures, "draw_overlay", lambda before, after, title, size: f"{title} {size[0]}")
    picture = pictures.draw_picture(None, None, "a bag")  # type: ignore[arg-type]
    assert (picture.title, picture.wide, picture.narrow) == ("a bag", f"a bag {WIDE[0]}", f"a bag {NARROW[0]}")
    assert WIDE[0] / WIDE[1] > 2.0 > 1.0 > NARROW[0] / NARROW[1]
