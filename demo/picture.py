"""The demo's picture: the identified model over the experiment, and over the held speed."""

from pathlib import Path

import matplotlib
import numpy as np

from motor_identification.bag import read_recording
from motor_identification.estimation.residual import compute_residuals
from motor_identification.measurement.build_intervals import make_intervals
from motor_identification.reporting.fit_figure import REFERENCE, draw_overlay
from motor_model.parameters import Parameters
from motor_model.simulate import simulate

matplotlib.use("Agg")
from matplotlib import pyplot as plt  # noqa: E402  (the backend comes first)
from matplotlib.axes import Axes  # noqa: E402


def _overlay(axes: Axes, bag: Path, model: Parameters) -> float:
    """Draw one recording and the model over it; returns the residual's time-weighted RMS [rad/s]."""
    recording = read_recording(str(bag))
    data, start = make_intervals(recording), float(recording.speed[0])
    draw_overlay(axes, recording, data, model, start)
    motion = simulate(model, recording.time, recording.voltage, data.time, start)
    return float(np.sqrt(np.average(compute_residuals(data, motion.angle) ** 2, weights=data.duration)))


def draw_demo(directory: Path, model: Parameters, references: list[tuple[float, float]], path: Path) -> None:
    """Draw both recordings of the demo; `references` are times [s] and references [rad/s], NaN: none."""
    figure, (above, below) = plt.subplots(2, 1, figsize=(10, 8), constrained_layout=True)
    rms = _overlay(above, directory / "staircase", model)
    above.set_title(f"Experiment: staircase, identified with Coulomb friction (residual {rms:.2g} rad/s RMS)")
    above.legend(loc="upper right")
    rms = _overlay(below, directory / "closed_loop", model)
    time, reference = np.array(references).T
    below.step(time, reference, where="post", color=REFERENCE, linewidth=1.2, label="reference")
    begin = float(time[np.isfinite(reference)][0])
    below.set_xlim(max(begin - 0.2, 0.0), begin + 2.0)
    below.set_title(
        f"PI holds {reference[-1]:g} rad/s; the fitted model under the recorded voltage (residual {rms:.2g} rad/s RMS)"
    )
    below.set_xlabel("time [s]")
    below.legend(loc="lower right")
    figure.savefig(path, dpi=120)
    plt.close(figure)
