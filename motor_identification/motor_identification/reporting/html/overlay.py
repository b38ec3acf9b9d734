"""Draw measured and simulated speeds over time, before and after, and the residual below them."""

from typing import TYPE_CHECKING, Any

import numpy as np

from motor_identification.recording import Floats
from motor_identification.reporting.curves import Curves
from motor_identification.reporting.html.svg import AFTER, BEFORE, FLOOR, MEASURED, WORST, svg_style, to_svg

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDE, NARROW = (10.4, 4.6), (4.4, 4.8)  # [in] for a laptop and for a phone
MOST = 4000  # points of a line: more cannot be told apart
FEW = 1500  # points that are drawn large
GAP = 0.15  # [s] without an interval, from which on a line is broken


def draw_overlay(before: Curves, after: Curves | None, title: str, size: tuple[float, float]) -> str:
    """Draw one or two models on one recording as SVG; without `after` there is only one."""
    with svg_style():
        from matplotlib import pyplot as plt

        figure, (speed, rest) = plt.subplots(2, 1, figsize=size, sharex=True, height_ratios=(3, 2))
        few = len(before.time) < FEW
        _draw_speeds(speed, before, after, few)
        _draw_residuals(rest, before, after, few)
        rest.set_xlabel("time [s]")
        rest.margins(x=0.01)
        return to_svg(figure, title)


def _draw_speeds(axes: "Axes", before: Curves, after: Curves | None, few: bool) -> None:
    """Measured speeds as a broad pale band, and the models as thin lines on it: both stay visible where they agree."""
    time, measured = _thin_out(before.time, before.measured)
    axes.plot(
        time, measured, "o", color=MEASURED, markersize=6.0 if few else 4.5, markeredgewidth=0.0,
        label="measured", rasterized=True,
    )  # fmt: skip
    label = "before" if after else "simulated"
    axes.plot(*_break_line(before.time, before.simulated), color=BEFORE, linewidth=1.2, label=label)
    if after is not None:
        axes.plot(*_break_line(after.time, after.simulated), color=AFTER, linewidth=1.0, label="after")
    axes.set_ylabel("speed [rad/s]")
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)


def _draw_residuals(axes: "Axes", before: Curves, after: Curves | None, few: bool) -> None:
    """Simulated minus measured; the worst regions of the first model in colours of their own."""
    size = 4.0 if few else 2.0
    how: dict[str, Any] = {"linestyle": "", "marker": ".", "rasterized": True}
    dots = how | {"markersize": size}
    marked = np.any(before.regions, axis=0) if before.regions else np.zeros(len(before.time), dtype=bool)
    for one, color, which in ((before, BEFORE, ~marked), (after, AFTER, True)):
        if one is not None:  # what a recording's own unknowns were fitted on does not count, and is faint
            for counts, alpha in ((~one.scored, 0.2), (one.scored & which, 1.0)):
                axes.plot(*_thin_out(one.time[counts], one.residual[counts]), color=color, alpha=alpha, **dots)
    for number, (inside, color) in enumerate(zip(before.regions, WORST, strict=False)):
        if inside.any():
            axes.plot(
                *_thin_out(before.time[inside], before.residual[inside]), color=color, markersize=size + 1.5,
                label=f"worst {number + 1}", **how,
            )  # fmt: skip
    shown = after or before
    time, floor = _thin_out(shown.time, 2.0 * shown.floor)
    axes.fill_between(time, -floor, floor, color=FLOOR, alpha=0.45, linewidth=0, label="noise, ±2 σ", rasterized=True)
    axes.set_ylabel("simulated −\nmeasured [rad/s]")
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 0.98), ncols=4, markerscale=2)


def _thin_out(time: Floats, values: Floats) -> tuple[Floats, Floats]:
    step = max(-(-len(time) // (5 * MOST)), 1)
    return time[::step], values[::step]


def _break_line(time: Floats, values: Floats) -> tuple[Floats, Floats]:
    """A line that is not drawn through times in which nothing was measured."""
    step = max(-(-len(time) // MOST), 1)
    time, values = time[::step], values[::step]
    holes = np.flatnonzero(np.diff(time) > max(GAP, 10.0 * step * float(np.median(np.diff(time, prepend=0.0)))))
    middle = 0.5 * (time[holes] + time[np.minimum(holes + 1, len(time) - 1)])
    return np.insert(time, holes + 1, middle), np.insert(values, holes + 1, np.nan)
