"""A picture in two shapes, of which the page shows the one that fits its screen."""

from dataclasses import dataclass

from motor_identification.reporting.curves import Curves
from motor_identification.reporting.html.overlay import NARROW, WIDE, draw_overlay


@dataclass(frozen=True)
class Picture:
    """SVG for wide and narrow screens."""

    title: str
    wide: str
    narrow: str


def draw_picture(before: Curves, after: Curves | None, title: str) -> Picture:
    """Draw one or two models over a recording, for both kinds of screen."""
    return Picture(title, *(draw_overlay(before, after, title, size) for size in (WIDE, NARROW)))
