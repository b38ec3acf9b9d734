"""The reproduction's figures: the step and its fits (the paper's Figs. 5 and 6), the four pairs (its Figs. 7 to 9)."""

from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib
import numpy as np

matplotlib.use("Agg")
from matplotlib import pyplot as plt
from paper_fit import BEFORE, Fit
from paper_loop import PAIRS, TOP_SPEED, Run

from motor_identification.recording import Recording
from motor_model.simulate import simulate

if TYPE_CHECKING:
    from matplotlib.axes import Axes

REPORTED, SHAFT, SIMULATED, OURS, REFERENCE = "#9aa5b1", "#c2410c", "#1d4ed8", "#0f766e", "#475569"
STYLE = {
    "font.size": 9,
    "axes.grid": True,
    "grid.alpha": 0.25,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 10,
    "legend.frameon": False,
    "legend.fontsize": 8,
}


def draw_fit(recording: Recording, papers: Fit, ours: Fit, path: Path) -> None:
    """Recorded speed; both fits over it; the rise, where the period method is late."""
    with plt.rc_context(STYLE):
        figure, (recorded, overlaid, rise) = plt.subplots(1, 3, figsize=(12, 3.8), constrained_layout=True)
        time = recording.time - BEFORE
        for axes in (recorded, overlaid, rise):
            axes.step(
                time, recording.speed, where="post", color=REPORTED, linewidth=0.9, label="recorded: period method"
            )
            axes.set_xlabel("time since the step [s]")
        for axes in (overlaid, rise):
            for fit, colour, line in ((papers, SIMULATED, "-"), (ours, OURS, "--")):
                motion = simulate(fit.model, recording.time, recording.voltage, recording.time)
                label = f"{fit.what}: kv {fit.kv:.4f}, ka {fit.ka:.5f}"
                axes.plot(time, motion.speed, line, color=colour, linewidth=1.3, label=label)
        recorded.set_title("Fig. 5: 10 V from rest, as recorded")
        recorded.set_ylabel("speed [rad/s]")
        overlaid.set_title("Fig. 6: simulated with the fits")
        rise.set_title("the same, first 60 ms: the period method is late")
        rise.set_xlim(-0.005, 0.06)
        rise.set_ylim(-3.0, 95.0)
        for axes in (recorded, overlaid):
            axes.set_xlim(-BEFORE, 1.0)
        overlaid.legend(loc="lower right")
        figure.savefig(path, dpi=120)
        plt.close(figure)


def draw_pairs(simulated: list[Run], hardware: list[Run], reference: float, path: Path) -> None:
    """A column for each pair: the second (Figs. 7 and 8), and its last half normalised (Fig. 9)."""
    with plt.rc_context(STYLE):
        figure, rows = plt.subplots(2, 4, figsize=(13, 6.2), sharey="row", constrained_layout=True)
        for i, (pair, model, real) in enumerate(zip(PAIRS, simulated, hardware, strict=True)):
            whole, last = rows[0][i], rows[1][i]
            _draw_runs(whole, model, real, reference, 1.0)
            _draw_runs(last, model, real, reference, TOP_SPEED)
            whole.set_title(f"Kp {pair[0]:g}, Ki {pair[1]:g}", weight="bold")
            whole.set_xlim(0.0, 1.0)
            last.set_xlim(0.5, 1.0)
            last.set_xlabel("time [s]")
        share = reference / TOP_SPEED
        rows[1][0].set_ylim(0.83 * share, 1.1 * share)
        rows[0][0].set_ylabel("speed [rad/s]\n(Figs. 7 and 8)")
        rows[1][0].set_ylabel("speed / 174.097 rad/s, last half\n(Fig. 9)")
        rows[0][3].legend(loc="lower right")
        figure.savefig(path, dpi=120)
        plt.close(figure)


def _draw_runs(axes: "Axes", simulated: Run, hardware: Run, reference: float, unit: float) -> None:
    axes.axhline(reference / unit, color=REFERENCE, linewidth=0.8, linestyle=":", label="reference")
    axes.plot(hardware.time, hardware.reported / unit, color=REPORTED, linewidth=0.7, label='"hardware", reported')
    axes.plot(hardware.time, hardware.speed / unit, color=SHAFT, linewidth=1.2, label='"hardware", shaft')
    axes.plot(simulated.time, simulated.speed / unit, color=SIMULATED, linewidth=1.2, label="simulation")


def draw_friction(references: list[float], curves: dict[str, list[float]], path: Path) -> None:
    """How far [10, 1] ends from its simulation, over the reference; shares of it."""
    with plt.rc_context(STYLE):
        figure, axes = plt.subplots(figsize=(6.5, 3.8), constrained_layout=True)
        styles = (SHAFT, "o-"), (REFERENCE, "s--"), (REPORTED, "^-"), (SIMULATED, "d:")
        for (label, shares), (colour, style) in zip(curves.items(), styles, strict=True):
            axes.plot(references, 100.0 * np.array(shares), style, color=colour, markersize=4, label=label)
        axes.set_xlabel("reference [rad/s]")
        axes.set_ylabel("[10, 1]: mean less simulation\n[% of the reference]")
        axes.legend(loc="lower right")
        figure.savefig(path, dpi=120)
        plt.close(figure)
