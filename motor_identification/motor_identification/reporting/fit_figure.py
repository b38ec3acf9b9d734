"""Draw a fit as a picture: measured and simulated speed, voltage and residual over time."""

from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from motor_identification.measurement.build_intervals import make_intervals
from motor_identification.measurement.intervals import Intervals
from motor_identification.recording import Recording
from motor_identification.reporting.curves import Curves, make_fit_curves
from motor_identification.reporting.fit_text import describe_residual, format_fit
from motor_identification.timing.timing import read_again
from motor_identification.uncertainty.result import Fit
from motor_model.errors import MotorError
from motor_model.parameters import Parameters
from motor_model.regular_file import say_refusal, write_bytes
from motor_model.simulate import simulate

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MEASURED, SIMULATED, REFERENCE, VOLTAGE = "#9aa5b1", "#c2410c", "#1d4ed8", "#475569"
MOST_POINTS = 20_000  # more than this cannot be told apart in a picture


def draw_overlay(axes: "Axes", recording: Recording, data: Intervals, model: Parameters, start: float) -> None:
    """Draw measured mean speeds, and the model's motion under the same voltage from an initial speed [rad/s].

    Measured points are broad and pale, the line on them thin: both stay visible where they agree.
    """
    time = np.unique(np.concatenate([recording.time, data.time]))
    motion = simulate(model, recording.time, recording.voltage, time, start)
    middle = 0.5 * (data.time[data.first] + data.time[data.last])
    seen = data.slack == 0.0
    thin = slice(None, None, -(-len(middle) // MOST_POINTS))
    axes.plot(
        middle[seen][thin], data.speed[seen][thin], "o", color=MEASURED, markersize=5, markeredgewidth=0,
        label="measured",
    )  # fmt: skip
    axes.plot(time, motion.speed, color=SIMULATED, linewidth=0.9, label="simulated with the fitted model")
    axes.set_ylabel("speed [rad/s]")
    axes.grid(alpha=0.25)


def draw_fit(recording: Recording, fit: Fit, path: Path) -> None:
    """Draw one recording and the fitted model's motion over it: speed, voltage, residual.

    Raises:
        MotorError: the file cannot be written.
    """
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams["text.parse_math"] = False  # a name may have $ in it
    from matplotlib import pyplot as plt

    start = fit.start_speeds[fit.uris.index(recording.uri)] if recording.uri in fit.uris else 0.0
    rows = len(fit.parameters.values) + 1
    figure, (head, speed, voltage, rest) = plt.subplots(
        4, 1, figsize=(10, 8), height_ratios=(0.18 * rows, 3, 1, 1.4), constrained_layout=True
    )
    for axes in (voltage, rest):
        axes.sharex(speed)
    head.axis("off")
    head.text(0.0, 1.0, format_fit(fit), transform=head.transAxes, family="monospace", fontsize=9, va="top")
    draw_overlay(speed, recording, make_intervals(read_again(recording, fit.timing)), fit.parameters, start)
    head.legend(*speed.get_legend_handles_labels(), loc="upper right", frameon=False)
    head.set_title(f"{recording.info.name}: {describe_residual(fit)}")
    voltage.step(recording.time, recording.voltage, where="post", color=VOLTAGE, linewidth=1)
    voltage.set_ylabel("voltage [V]")
    voltage.grid(alpha=0.25)
    _draw_residual(rest, make_fit_curves(recording, fit))
    try:
        figure.savefig(drawn := BytesIO(), format="png", dpi=120)
        write_bytes(path, drawn.getvalue())
    except OSError as error:
        raise MotorError(f"cannot write {path} {say_refusal(error)}.") from error
    finally:
        plt.close(figure)


def _draw_residual(axes: "Axes", curves: Curves) -> None:
    """Simulated minus measured over time, and what encoder and irregular slots alone would leave."""
    thin = slice(None, None, -(-len(curves.time) // MOST_POINTS))
    time, band = curves.time[thin], 2.0 * curves.floor[thin]
    axes.fill_between(time, -band, band, color=MEASURED, alpha=0.5, linewidth=0, zorder=3, label="noise, ±2 σ")
    axes.plot(time, curves.residual[thin], ".", color=SIMULATED, markersize=2)
    axes.set_ylabel("simulated −\nmeasured [rad/s]")
    axes.set_xlabel("time [s]")
    axes.legend(loc="upper right", framealpha=0.9, fontsize=8)
    axes.grid(alpha=0.25)
