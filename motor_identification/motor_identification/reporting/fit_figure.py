"""Pictures of a fit: what was measured, what the model says, and what is left."""

from math import isnan, nan, sqrt
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from motor_identification.estimation.residual import residuals
from motor_identification.measurement.build_intervals import intervals_of
from motor_identification.measurement.intervals import Intervals
from motor_identification.recording import Recording
from motor_identification.reporting.fit_text import as_table
from motor_identification.uncertainty.result import Fit
from motor_model.errors import MotorError
from motor_model.parameters import Parameters
from motor_model.simulate import simulate

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MEASURED, SIMULATED, REFERENCE, VOLTAGE = "#9aa5b1", "#c2410c", "#1d4ed8", "#475569"
MOST_POINTS = 20_000  # more than this cannot be told apart in a picture


def draw_overlay(axes: "Axes", recording: Recording, data: Intervals, model: Parameters, start: float) -> None:
    """Measured mean speeds and the model's motion under the same voltage, from an initial speed [rad/s]."""
    time = np.unique(np.concatenate([recording.time, data.time]))
    motion = simulate(model, recording.time, recording.voltage, time, start)
    middle = 0.5 * (data.time[data.first] + data.time[data.last])
    seen = data.slack == 0.0
    thin = slice(None, None, -(-len(middle) // MOST_POINTS))
    axes.plot(middle[seen][thin], data.speed[seen][thin], ".", color=MEASURED, markersize=3, label="measured")
    axes.plot(time, motion.speed, color=SIMULATED, linewidth=1.1, label="simulated with the fitted model")
    axes.set_ylabel("speed [rad/s]")
    axes.grid(alpha=0.25)


def draw_fit(recording: Recording, fit: Fit, path: Path) -> None:
    """Draw one recording and the fitted model's motion over it: speed, voltage, residual.

    Raises:
        MotorError: the file cannot be written.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    data = intervals_of(recording)
    start = fit.start_speeds[fit.uris.index(recording.uri)] if recording.uri in fit.uris else 0.0
    rows = len(fit.parameters.values) + 1
    figure, (head, speed, voltage, rest) = plt.subplots(
        4, 1, figsize=(10, 8), height_ratios=(0.18 * rows, 3, 1, 1.4), constrained_layout=True
    )
    for axes in (voltage, rest):
        axes.sharex(speed)
    head.axis("off")
    head.text(0.0, 1.0, as_table(fit), transform=head.transAxes, family="monospace", fontsize=9, va="top")
    draw_overlay(speed, recording, data, fit.parameters, start)
    head.legend(*speed.get_legend_handles_labels(), loc="upper right", frameon=False)
    head.set_title(f"{recording.info.name}: residual {fit.residual_rms:.3g} rad/s RMS, R² {fit.r_squared:.5f}")
    voltage.step(recording.time, recording.voltage, where="post", color=VOLTAGE, linewidth=1)
    voltage.set_ylabel("voltage [V]")
    voltage.grid(alpha=0.25)
    irregularity = fit.slot_irregularity[fit.uris.index(recording.uri)] if recording.uri in fit.uris else nan
    _draw_residual(rest, recording, data, fit.parameters, start, 0.0 if isnan(irregularity) else irregularity)
    try:
        figure.savefig(path, dpi=120)
    except OSError as error:
        raise MotorError(f"cannot write {path}: {error.strerror}.") from error
    finally:
        plt.close(figure)


def _draw_residual(
    axes: "Axes", recording: Recording, data: Intervals, model: Parameters, start: float, irregularity: float
) -> None:
    """Simulated minus measured over time, and what tick and irregular slots (share of one) alone would leave."""
    motion = simulate(model, recording.time, recording.voltage, data.time, start)
    middle = 0.5 * (data.time[data.first] + data.time[data.last])
    order = np.argsort(middle)[:: -(-len(middle) // MOST_POINTS)]
    time, left = middle[order], residuals(data, motion.angle)[order]
    band = 2.0 * np.hypot(data.sigma, sqrt(2.0) * irregularity * data.slot / data.duration)[order]
    axes.plot(time, left, ".", color=SIMULATED, markersize=2)
    axes.plot(time, band, ".", color=VOLTAGE, markersize=0.8)
    axes.plot(time, -band, ".", color=VOLTAGE, markersize=0.8, label="±2 σ of encoder and disc alone")
    axes.set_ylabel("simulated −\nmeasured [rad/s]")
    axes.set_xlabel("time [s]")
    axes.legend(loc="upper right", framealpha=0.9, fontsize=8, markerscale=8)
    axes.grid(alpha=0.25)
