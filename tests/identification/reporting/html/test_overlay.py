"""Measured and simulated speeds over time: everything stays visible, and lines are not drawn through gaps."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from motor_identification.reporting.curves import Curves
from motor_identification.reporting.html import overlay
from motor_identification.reporting.html.overlay import WIDE, draw_overlay
from motor_identification.reporting.html.svg import AFTER, BEFORE, MEASURED

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def curves(offset: float, count: int = 400) -> Curves:
    """A second of motion and, after half a second without any, another one."""
    time = np.concatenate([np.linspace(0.0, 1.0, count // 2), np.linspace(1.5, 2.5, count // 2)])
    every, none = np.ones(count, dtype=bool), np.zeros(count, dtype=bool)
    return Curves(
        time=time, duration=np.full(count, 0.005), measured=10.0 * time, simulated=10.0 * time + offset,
        residual=np.full(count, offset), floor=np.full(count, 0.1), still=none, scored=every, regions=(time < 0.5,),
    )  # fmt: skip


@pytest.fixture
def axes(monkeypatch: pytest.MonkeyPatch) -> list[Axes]:
    """Both axes of the figure that is drawn, before it becomes SVG."""
    kept: list[Axes] = []
    monkeypatch.setattr(overlay, "to_svg", lambda figure, title: kept.extend(figure.axes) or title)
    return kept


def test_measured_lies_below_the_models_and_is_broader(axes: list[Axes]) -> None:
    assert draw_overlay(curves(5.0), curves(0.0), "title", WIDE) == "title"
    lines = {line.get_label(): line for line in axes[0].lines}
    assert [line.get_label() for line in axes[0].lines] == ["measured", "before", "after"]  # in the order of drawing
    assert [lines[name].get_color() for name in lines] == [MEASURED, BEFORE, AFTER]
    assert lines["measured"].get_markersize() >= 4.0 * max(lines[name].get_linewidth() for name in ("before", "after"))
    assert [text.get_text() for text in axes[0].get_legend().get_texts()] == ["measured", "before", "after"]


def test_a_line_is_not_drawn_through_a_gap(axes: list[Axes]) -> None:
    draw_overlay(curves(0.0), None, "title", WIDE)
    (line,) = (line for line in axes[0].lines if line.get_label() == "simulated")
    time, speed = line.get_data()
    assert np.isnan(speed).sum() == 1 and 1.0 < float(time[np.isnan(speed)][0]) < 1.5


def test_a_long_recording_is_thinned_out(axes: list[Axes]) -> None:
    draw_overlay(curves(0.0, 100_000), None, "title", WIDE)
    assert 1_000 < len(axes[0].lines[1].get_xdata()) <= overlay.MOST + 1


def test_the_worst_region_has_its_own_colour(axes: list[Axes]) -> None:
    draw_overlay(curves(5.0), curves(0.0), "title", WIDE)
    (worst,) = (line for line in axes[1].lines if line.get_label() == "worst 1")
    assert float(np.max(worst.get_xdata())) < 0.5 and worst.get_color() not in (BEFORE, AFTER)
