"""Pictures of a fit: what was measured, what the model says, and what is left."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from motor_identification.findings import as_table
from motor_identification.identify import Fit
from motor_identification.recording import Recording
from motor_identification.residual import Intervals, intervals_of, residuals
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
    figure, (speed, voltage, rest) = plt.subplots(
        3, 1, figsize=(10, 7.5), sharex=True, height_ratios=(3, 1, 1.4), constrained_layout=True
    )
    draw_overlay(speed, recording, data, fit.parameters, start)
    speed.legend(loc="upper right", framealpha=0.9, ncols=2)
    speed.set_title(f"{recording.info.name}: residual {fit.residual_rms:.3g} rad/s RMS, R² {fit.r_squared:.5f}")
    speed.text(
        0.01, 0.02, as_table(fit), transform=speed.transAxes, family="monospace", fontsize=8, va="bottom",
        bbox={"facecolor": "white", "alpha": 0.9, "edgecolor": "none"},
    )  # fmt: skip
    voltage.step(recording.time, recording.voltage, where="post", color=VOLTAGE, linewidth=1)
    voltage.set_ylabel("voltage [V]")
    voltage.grid(alpha=0.25)
    _draw_residual(rest, recording, data, fit.parameters, start)
    try:
        figure.savefig(path, dpi=120)
    except OSError as error:
        raise MotorError(f"cannot write {path}: {error.strerror}.") from error
    finally:
        plt.close(figure)


def _draw_residual(axes: "Axes", recording: Recording, data: Intervals, model: Parameters, start: float) -> None:
    """Simulated minus measured over time, and what the encoder alone would leave."""
    motion = simulate(model, recording.time, recording.voltage, data.time, start)
    middle = 0.5 * (data.time[data.first] + data.time[data.last])
    order = np.argsort(middle)[:: -(-len(middle) // MOST_POINTS)]
    time, left, band = middle[order], residuals(data, motion.angle)[order], 2.0 * data.sigma[order]
    axes.plot(time, left, ".", color=SIMULATED, markersize=2)
    axes.fill_between(time, -band, band, color=MEASURED, alpha=0.5, linewidth=0, label="±2 σ of the encoder alone")
    axes.set_ylabel("simulated −\nmeasured [rad/s]")
    axes.set_xlabel("time [s]")
    axes.legend(loc="upper right", framealpha=0.9, fontsize=8)
    axes.grid(alpha=0.25)
