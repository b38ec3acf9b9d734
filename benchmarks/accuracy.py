"""Accuracy of kv and ka from the paper's experiment (10 V step, 1 s, 4 µs timer) over the resolution of the encoder.

Four columns for each: the Gaussian-equivalent Cramér–Rao bound of all reported edges, our fit, the paper's method
(least squares of a simulation on the sampled period speed) and the regression that WPILib's SysId does (acceleration,
differentiated from that speed, on speed and voltage; see `regression.py`; one level of voltage leaves friction out).
RMS relative errors over starting angles; bounds for irregular discs have the slot table marginalised.
"""

import os
import sys
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices

import numpy as np
from machine import machine
from numpy.typing import NDArray
from regression import regress
from scipy.optimize import least_squares

from motor_identification.estimation.problem import make_problem
from motor_identification.identify import Request, SearchConfig, identify
from motor_identification.noise.slots.slot_table import index_slots
from motor_identification.recording import Recording, check, recording_of
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters, paper_motor
from motor_model.sensing.board import BoardConfig, SimulatedBoard
from motor_model.simulate import simulate

EDGES = (6, 24, 48, 96, 200, 500, 1000)
ANGLES = {96: 60}  # starting angles; 15 for the others
TRUE = np.array([PAPER_KV, PAPER_KA])
RESULTS = Path(__file__).with_name("results")
STYLES = (
    ("bound", "black", "--"),
    ("ours", "#c2410c", "-"),
    ("the paper's method", "#1d4ed8", "-"),
    ("SysId's regression", "#4d7c0f", "-"),
)
Floats = NDArray[np.float64]


def experiment(edges: int, irregularity: float, seed: int) -> Recording:
    """0.1 s of rest, then 1 s at 10 V."""
    config = BoardConfig(edges_per_revolution=edges, slot_irregularity=irregularity, seed=seed)
    board = SimulatedBoard(paper_motor(), config)
    samples = [board.sample(0.0 if k < 20 else 10.0) for k in range(220)]
    return check(recording_of(samples, config.info(paper_motor()), f"step {seed}"))


def ours(recording: Recording) -> Floats:
    """Relative errors of kv and ka."""
    fit = identify([recording], Request(search=SearchConfig(particles=20)))
    return np.array([fit.parameters.value("kv"), fit.parameters.value("ka")]) / TRUE - 1.0


def papers(recording: Recording) -> Floats:
    """The same for least squares on the speed that every sample reports."""
    time, voltage = recording.time, recording.voltage

    def residuals(x: Floats) -> Floats:
        motor = Parameters({"kv": float(np.exp(x[0])), "ka": float(np.exp(x[1]))})
        return np.asarray(simulate(motor, time, voltage, time).speed - recording.speed)

    return np.asarray(np.exp(least_squares(residuals, np.log(TRUE), x_scale=0.1).x) / TRUE - 1.0)


def sysids(recording: Recording) -> Floats:
    """The same for the regression of acceleration on speed and voltage."""
    gains = regress(recording, friction=False)
    return np.array([gains["kv"], gains["ka"]]) / TRUE - 1.0


METHODS = (ours, papers, sysids)


def bound(recording: Recording, slots: bool) -> Floats:
    """Standard deviations that no unbiased fit of these edges beats (Gaussian noise of the tick's variance)."""
    problem = make_problem([recording], ())
    (data,) = problem.intervals
    moving = data.edge[:, 0] >= 0
    at = np.append(data.first[moving], data.last[moving][-1])
    place, step = np.log(TRUE), 1e-6

    def angle(x: Floats) -> Floats:
        return problem.angles(x)[0][at]

    columns = [(angle(place + d) - angle(place - d)) / (2 * step) for d in step * np.eye(2)]
    columns.append(np.ones(len(at)))
    blur = np.append(data.blur[moving], data.blur[moving][-1])
    design = np.column_stack(columns)
    if slots:
        index = index_slots(data, problem.angles(place)[0])
        slot = np.append(index.first[moving], index.last[moving][-1])
        seen = np.unique(slot)
        design = np.column_stack([design[:, :2], (slot[:, None] == seen).astype(float)])
    white = design / blur[:, None]
    return np.asarray(np.sqrt(np.diag(np.linalg.pinv(white.T @ white)))[:2])


def row(edges: int, irregularity: float) -> list[float]:
    """Bound, ours, the paper's, the regression's: kv of each, then ka of each."""
    recordings = [experiment(edges, irregularity, seed) for seed in range(ANGLES.get(edges, 15))]
    bounds = np.sqrt(np.mean([bound(r, irregularity > 0.0) ** 2 for r in recordings[:10]], axis=0))
    errors = [np.sqrt(np.mean(np.square([method(r) for r in recordings]), axis=0)) for method in METHODS]
    return [float(v) for pair in zip(bounds, *errors, strict=True) for v in pair]


def main() -> int:
    """Print and write the table, draw the figure."""
    RESULTS.mkdir(exist_ok=True)
    lines = [
        "# Accuracy over the encoder's resolution",
        "",
        "The paper's experiment (10 V for 1 s from rest, 4 µs timer); RMS relative errors over 60 starting angles at",
        f"96 edges and 15 elsewhere. {machine()}.",
        "",
        "| edges/rev | slots | kv: bound | ours | paper's method | regression "
        "| ka: bound | ours | paper's method | regression |",
        "|---:|---|---:|---:|---:|---:|---:|---:|---:|---:|",
    ]
    table: dict[float, list[list[float]]] = {}
    for irregularity in (0.0, 0.01):
        for edges in EDGES:
            numbers = row(edges, irregularity)
            table.setdefault(irregularity, []).append(numbers)
            what = f"{100 * irregularity:g} % irregular" if irregularity else "perfect"
            lines.append(f"| {edges} | {what} | " + " | ".join(f"{n:.1e}" for n in numbers) + " |")
            print(lines[-1], flush=True)
    (RESULTS / "accuracy.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    draw(table)
    return 0


def draw(table: dict[float, list[list[float]]]) -> None:
    """Errors over edges per revolution."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(1, 2, figsize=(10, 4.5), sharey=True, constrained_layout=True)
    for axis, name, first in zip(axes, ("kv", "ka"), (0, len(STYLES)), strict=True):
        for irregularity, rows in table.items():
            alpha, marker = (1.0, "o") if irregularity == 0.0 else (0.45, "s")
            disc = "perfect disc" if irregularity == 0.0 else "1 % irregular"
            for i, (label, color, line) in enumerate(STYLES):
                values = [r[first + i] for r in rows]
                axis.loglog(
                    EDGES, values, line, color=color, marker=marker, ms=4, alpha=alpha, label=f"{label}, {disc}"
                )
        axis.set_title(f"relative error of {name}")
        axis.set_xlabel("edges per revolution")
        axis.grid(alpha=0.25, which="both")
    axes[0].set_ylabel("RMS over starting angles")
    axes[1].legend(fontsize=8)
    figure.savefig(RESULTS / "accuracy.png", dpi=120)


if __name__ == "__main__":
    sys.exit(main())
