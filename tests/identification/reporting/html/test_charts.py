"""The small charts: bars of the noise floor, points of the gap, errors of the residual torque."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from motor_identification.diagnosis.result import Diagnosis
from motor_identification.discrepancy.missing_torque import estimate_missing_torque
from motor_identification.discrepancy.residual_maps import map_residuals
from motor_identification.reporting.html import charts
from motor_identification.reporting.html.charts import draw_map, draw_torque

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@pytest.fixture
def axes(monkeypatch: pytest.MonkeyPatch) -> list[Axes]:
    """The axes that are drawn, before they become SVG."""
    kept: list[Axes] = []
    monkeypatch.setattr(charts, "to_svg", lambda figure, title: kept.extend(figure.axes) or title)
    return kept


def test_a_map_shows_the_gaps_before_and_after(found: Diagnosis, axes: list[Axes]) -> None:
    before, after = (map_residuals(held, found.slot_share)[0] for held in (found.before, found.after))
    assert before.axis.name == "speed" and draw_map(before, after, "") == "gap over speed"
    (one,) = axes
    drawn = np.concatenate([line.get_ydata() for line in one.lines if line.get_linestyle() == "None"])
    known = np.concatenate([each.gap[np.isfinite(each.gap)] for each in (before, after)])
    low, _ = one.get_ylim()
    assert np.sort(drawn) == pytest.approx(np.sort(np.maximum(known, low)))
    assert one.get_yscale() == "log" and one.get_xlabel() == "speed [rad/s]" and len(one.patches) == len(before.gap)


def test_a_triangle_says_the_sign_of_the_error(found: Diagnosis, axes: list[Axes]) -> None:
    """Without friction, the simulation is too fast in both directions: above forward, below backward."""
    draw_map(map_residuals(found.before, found.slot_share)[0], None, "")
    places = {line.get_marker(): line.get_xdata() for line in axes[0].lines if line.get_linestyle() == "None"}
    slow = 60.0  # [rad/s] at high speed a wrong kv stands in for the friction
    assert np.all(places["^"][np.abs(places["^"]) < slow] > 0.0) and np.any(places["^"] > 0.0)
    assert np.all(places["v"][np.abs(places["v"]) < slow] < 0.0) and np.any(places["v"] < 0.0)


def test_the_residual_torque_has_its_intervals(found: Diagnosis, axes: list[Axes]) -> None:
    torque = estimate_missing_torque(found.before)[0]
    assert draw_torque(torque, "bag") == "residual torque over speed"
    (one,) = axes
    known = np.isfinite(torque.torque)
    assert one.get_ylabel() == "residual torque [V]" and one.get_title(loc="left") == "bag"
    (bars,) = one.containers[0].lines[2]
    lengths = [np.ptp(segment[:, 1]) for segment in bars.get_segments() if len(segment)]
    assert np.sort(lengths)[-known.sum() :] == pytest.approx(np.sort(3.92 * torque.error[known]), rel=1e-3)
