"""Three real motors, recorded by others: what `diagnose` finds in their logs, as a table and a picture.

The logs are those of `tests/data`; another directory with `undc/…` and `ev3/…` can be the argument.
"""

import argparse
import os
import sys
from dataclasses import dataclass
from math import degrees, tau
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices

import matplotlib as mpl

mpl.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from machine import machine
from matplotlib.axes import Axes

from motor_identification.diagnose import Request, diagnose
from motor_identification.diagnosis.result import Diagnosis
from motor_identification.logs import CsvForm, Kind, read_log
from motor_identification.recording import Floats, Recording, check, recording_of
from motor_identification.reporting.diagnosis_text import format_diagnosis, summarize_diagnosis
from motor_identification.uncertainty.result import Fit
from motor_model.simulate import simulate

RESULTS = Path(__file__).with_name("results")
DATA = Path(__file__).resolve().parents[1] / "tests" / "data"
BEFORE, AFTER, MEASURED = "#d95f02", "#1b6ca8", "#222222"
UNDC = CsvForm("t", "u", "y", Kind.SPEED, "deg/s", edges_per_revolution=2800, max_voltage=5.0)
STEADY = CsvForm(None, "u", "y", Kind.SPEED, "deg/s", edges_per_revolution=2800, speed_window=1.0, max_voltage=5.0)
EV3 = CsvForm("t_s", "duty_pct", "pos_deg", Kind.POSITION, "deg", voltage_scale=0.074, split="duty_pct", rest_until=0.0)


@dataclass(frozen=True)
class Case:
    """Logs that are diagnosed together."""

    title: str
    logs: tuple[tuple[str, CsvForm], ...]


CASES = {
    "prbs": Case("UNDC gearmotor, drive/brake: random telegraph voltage, one way",
                 (("undc/prbs_2026-08-14.csv", UNDC),)),
    "prbs + static": Case("the same with its static curve",
                          (("undc/prbs_2026-08-14.csv", UNDC), ("undc/static_2026-08-17.csv", STEADY))),
    "coast": Case("UNDC gearmotor, drive/coast: two random telegraphs at two levels",
                  (("undc/prbs_coast_2024-08-03.csv", UNDC), ("undc/prbs_coast_2024-08-05.csv", UNDC))),
    "ev3": Case("LEGO EV3 large motor: steps of 1 s to 20 duties, both ways", (("ev3/steps_1s.csv", EV3),)),
}  # fmt: skip


def recordings(case: Case, data: Path) -> list[Recording]:
    """Every run of every log."""
    made = []
    for file, form in case.logs:
        log = read_log(data / file, form)
        made += [check(recording_of(run.samples, log.info, run.label or Path(file).stem)) for run in log.runs]
    return made


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


def main() -> int:
    """Diagnose, print, and write the page and the picture."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("data", nargs="?", type=Path, default=DATA, help="where undc/ and ev3/ are")
    data = parser.parse_args().data
    lines = [
        "# Real motors, diagnosed",
        "",
        f"{machine()}. Logs recorded by others; the diagnosis starts from kv and ka.",
        "",
    ]
    found = {}
    for name, case in CASES.items():
        found[name] = diagnose(recordings(case, data), request=Request(workers=2))
        text = format_diagnosis(found[name])
        lines += [f"## {case.title}", "", "```", *text.splitlines(), "```", "", summarize_diagnosis(found[name]), ""]
        print("\n".join(lines[-8:]), flush=True)
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(12.0, 3.6), layout="constrained")
    draw_telegraph(left, found["prbs"], recordings(CASES["prbs"], data)[0])
    before, after = draw_static(middle, found["coast"], data / "undc/static_coast_2024-08-05.csv")
    draw_steps(right, found["ev3"], recordings(CASES["ev3"], data))
    for axes in (left, middle, right):
        axes.grid(alpha=0.3)
        axes.spines[["top", "right"]].set_visible(False)
    figure.savefig(RESULTS / "real_motors.png", dpi=110)
    lines.append(
        f"The coasting motor's static curve up to 5 V, which no fit has seen, is {before:.3g} rad/s off (RMS) before "
        f"and {after:.2g} after."
    )
    print(lines[-1])
    (RESULTS / "real_motors.md").write_text("\n".join([*lines, "", "![The three motors](real_motors.png)", ""]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
