"""Draw the small charts: the gap over speed, time and angle before and after, and the residual torque."""

from typing import TYPE_CHECKING

import numpy as np

from motor_identification.discrepancy.missing_torque import AXIS_NAMES, MissingTorque
from motor_identification.discrepancy.residual_maps import Map
from motor_identification.recording import Floats
from motor_identification.reporting.html.svg import AFTER, BEFORE, FLOOR, svg_style, to_svg

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SIZE = (3.5, 2.35)  # [in]
UNEVEN = ("direction", "acceleration", "since")  # maps whose bins have no common scale
WAYS = ("backward", "still", "forward")


def draw_map(before: Map, after: Map | None, recording: str) -> str:
    """Draw the gap over one axis before and after, above what a perfect model would leave, as SVG."""
    with svg_style():
        from matplotlib import pyplot as plt

        figure, axes = plt.subplots(figsize=SIZE)
        place, width = _places(before)
        floor = np.nan_to_num(before.floor)
        lowest = _lowest(before, after)
        axes.bar(place, np.maximum(floor, lowest), width, color=FLOOR, alpha=0.45, linewidth=0, label="noise floor")
        for one, color in ((before, BEFORE), (after, AFTER)):
            if one is not None:
                line = 0.0 if one.axis.name == "direction" else 0.9
                axes.plot(_places(one)[0], np.maximum(one.gap, lowest), color=color, linewidth=line, alpha=0.7)
                _draw_signs(axes, one, _places(one)[0], lowest, color)
        _scale(axes, lowest)
        axes.set_ylabel("gap [rad/s]")
        unit = f" [{before.axis.unit}]" if before.axis.unit else ""
        axes.set_xlabel(before.axis.label + unit)
        _label(axes, before, place)
        if recording:
            axes.set_title(recording)
        return to_svg(figure, f"gap over {before.axis.label}")


def _draw_signs(axes: "Axes", one: Map, place: Floats, lowest: float, color: str) -> None:
    """A triangle up where the simulation is too high on average, down where too low, else a dot."""
    with np.errstate(invalid="ignore"):
        sign = np.where(np.abs(one.mean) > 0.5 * one.gap, np.sign(one.mean), 0.0)
    for value, marker in ((0.0, "o"), (1.0, "^"), (-1.0, "v")):
        here = (sign == value) & np.isfinite(one.gap)
        axes.plot(place[here], np.maximum(one.gap, lowest)[here], marker, color=color, markersize=4)


def _scale(axes: "Axes", lowest: float) -> None:
    """Logarithmic, with numbers as a person writes them, and enough of them."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axes.set_yscale("log")
    axes.set_ylim(bottom=lowest)
    low, high = axes.get_ylim()
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if high < 50.0 * low else (1.0,)))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.yaxis.set_minor_formatter(NullFormatter())


def _lowest(before: Map, after: Map | None) -> float:
    """[rad/s] where the picture ends below."""
    values = np.concatenate([one.gap for one in (before, after) if one is not None] + [before.floor])
    values = values[np.isfinite(values) & (values > 0.0)]
    top = float(values.max(initial=1e-3))
    return max(0.6 * float(values.min(initial=top)), 1e-4 * top)


def _places(one: Map) -> tuple[Floats, Floats]:
    """Where the bins are drawn and how wide; one after the other where they have no common scale."""
    bins = len(one.gap)
    if one.axis.name in UNEVEN:
        return np.arange(bins, dtype=np.float64), np.full(bins, 0.9)
    return 0.5 * (one.edges[1:] + one.edges[:-1]), np.diff(one.edges)


def _label(axes: "Axes", one: Map, place: Floats) -> None:
    if one.axis.name == "direction":
        axes.set_xticks(place, WAYS)
    elif one.axis.name == "since":
        axes.set_xticks(place, [f"< {edge:g}" for edge in one.edges[1:-1]] + ["more"], rotation=45)
    elif one.axis.name == "acceleration":
        axes.set_xticks(np.arange(len(one.edges))[::2] - 0.5, [f"{edge:.0f}" for edge in one.edges[::2]], rotation=30)
    elif one.axis.name == "angle":
        axes.set_xticks([0.0, np.pi, 2 * np.pi], ["0", "π", "2π"])


def draw_torque(missing: MissingTorque, recording: str) -> str:
    """Draw the residual torque over one axis, with 95 % intervals, as SVG."""
    with svg_style():
        from matplotlib import pyplot as plt

        figure, axes = plt.subplots(figsize=SIZE)
        middle = 0.5 * (missing.edges[1:] + missing.edges[:-1])
        axes.axhline(0.0, color=FLOOR, linewidth=0.8)
        axes.errorbar(
            middle,
            missing.torque,
            1.96 * np.nan_to_num(missing.error),
            fmt=".",
            color=BEFORE,
            elinewidth=1,
            markersize=5,
        )
        axes.set_xlabel(AXIS_NAMES[missing.axis])
        axes.set_ylabel("residual torque [V]")
        if recording:
            axes.set_title(recording)
        return to_svg(figure, f"residual torque over {missing.axis}")
