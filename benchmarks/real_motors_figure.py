"""The picture of three real motors: measured, and simulated before and after the diagnosis."""

from math import degrees, tau
from pathlib import Path

import matplotlib as mpl

mpl.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from motor_identification.diagnosis.result import Diagnosis
from motor_identification.recording import Floats, Recording
from motor_identification.uncertainty.result import Fit
from motor_model.simulate import simulate

BEFORE, AFTER, MEASURED = "#d95f02", "#1b6ca8", "#222222"


def simulated(fit: Fit, recording: Recording, at: int, time: Floats) -> Floats:
    """[rad] the angle of a fitted motor in the recording of that number, at times [s]."""
    start = fit.start_speeds[at] if at < len(fit.start_speeds) else 0.0
    return simulate(fit.parameters, recording.time, recording.voltage, time, start).angle


def draw_telegraph(axes: Axes, found: Diagnosis, recording: Recording) -> None:
    """Five seconds of a random telegraph: measured, and simulated before and after."""
    begin, end, window = 20.0, 24.0, recording.info.speed_window
    inside = (recording.time >= begin) & (recording.time < end)
    time = recording.time[inside]
    axes.plot(time - begin, np.degrees(recording.speed[inside]), ".", color=MEASURED, ms=4, label="measured")
    for fit, colour, label in ((found.baseline, BEFORE, "kv, ka"), (found.model, AFTER, "with what was found")):
        ends = np.concatenate([[recording.time[0]], time - window, time])
        order = np.argsort(ends)
        angle = np.empty(len(ends))
        angle[order] = simulated(fit, recording, 0, ends[order])
        speed = (angle[len(time) + 1 :] - angle[1 : len(time) + 1]) / window
        axes.plot(time - begin, np.degrees(speed), color=colour, lw=1.4, label=label)
    axes.set(title="drive/brake: friction and delay", xlabel="time [s]", ylabel="speed [deg/s]")


def steady_speed(fit: Fit, voltage: float) -> float:
    """[rad/s] where the motor ends at a voltage."""
    travel = simulate(fit.parameters, np.zeros(1), np.array([voltage]), np.array([0.0, 20.0, 21.0])).angle
    return float(travel[2] - travel[1])


def draw_static(axes: Axes, found: Diagnosis, log: Path) -> tuple[float, float]:
    """The static curve of the coasting bridge, which no fit has seen; returns RMS before and after [rad/s]."""
    table = np.genfromtxt(log, delimiter=",", names=True)
    axes.plot(table["u"], table["y"], "o", color=MEASURED, ms=4, label="measured (in no fit)")
    voltages = np.linspace(-5.0, 5.0, 101)
    errors = []
    for fit, colour, label in ((found.baseline, BEFORE, "kv, ka"), (found.model, AFTER, "with what was found")):
        axes.plot(voltages, [degrees(steady_speed(fit, u)) for u in voltages], color=colour, lw=1.4, label=label)
        missed = [steady_speed(fit, u) - np.radians(y) for u, y in zip(table["u"], table["y"], strict=True)]
        errors.append(float(np.sqrt(np.mean(np.square(missed)))))
    axes.set(
        title="drive/coast: static curve, predicted", xlabel="voltage [V]", ylabel="speed [deg/s]", ylim=(-1300, 1300)
    )
    axes.legend(loc="upper left", fontsize=8)
    return errors[0], errors[1]


def draw_steps(axes: Axes, found: Diagnosis, runs: list[Recording]) -> None:
    """The beginning of small steps both ways, as angles."""
    for at, run in enumerate(runs):
        duty = run.voltage[-1] / 0.074
        if round(duty) not in (-20, -10, 10, 20):
            continue
        until = run.time <= 0.4
        time = run.time[until]
        counts = tau / run.info.edges_per_revolution
        axes.plot(time, np.degrees(run.edge_count[until] * counts), ".", color=MEASURED, ms=3)
        grid = np.linspace(run.time[0], 0.4, 80)
        for fit, colour in ((found.baseline, BEFORE), (found.model, AFTER)):
            axes.plot(grid, np.degrees(simulated(fit, run, at, grid)), color=colour, lw=1.4)
        axes.annotate(f"{duty:+.0f} %", (0.405, np.degrees(simulated(found.model, run, at, grid)[-1])), fontsize=8)
    axes.set(title="EV3: dead band and asymmetry", xlabel="time [s]", ylabel="angle [deg]", xlim=(0.0, 0.46))


def draw(
    path: Path,
    telegraph: tuple[Diagnosis, Recording],
    coast: tuple[Diagnosis, Path],
    steps: tuple[Diagnosis, list[Recording]],
) -> tuple[float, float]:
    """Draw all three; returns how far the coasting motor's static curve is off before and after, RMS [rad/s]."""
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(12.0, 3.6), layout="constrained")
    draw_telegraph(left, *telegraph)
    errors = draw_static(middle, *coast)
    draw_steps(right, *steps)
    for axes in (left, middle, right):
        axes.grid(alpha=0.3)
        axes.spines[["top", "right"]].set_visible(False)
    figure.savefig(path, dpi=110)
    return errors
