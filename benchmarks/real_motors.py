"""Real motors, recorded by others, each log imported by one line: what `diagnose` finds, and what is known of the rig.

The logs are those of `tests/data`; another directory with the same files can be the argument, or in the environment as
MOTOR_LOGS. A few minutes on two cores.
"""

import argparse
import os
import shlex
import sys
from dataclasses import dataclass
from math import degrees
from pathlib import Path
from time import perf_counter

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices

from machine import commit, machine
from real_motors_figure import draw
from real_motors_known import fit_like_sysid, fit_static_curve

from motor_identification.cli.options.log import add_log_options
from motor_identification.cli.options.log_said import read_log_options
from motor_identification.diagnose import Request, diagnose
from motor_identification.diagnosis.result import Diagnosis
from motor_identification.logs.imported import import_log
from motor_identification.recording import Recording, check, recording_of
from motor_identification.reporting.diagnosis_table import format_diagnosis
from motor_identification.reporting.diagnosis_text import summarize_diagnosis
from motor_identification.reporting.numbers import format_measured, format_quantity

RESULTS = Path(__file__).with_name("results")
DATA = Path(os.environ.get("MOTOR_LOGS", Path(__file__).resolve().parents[1] / "tests" / "data"))
MOUSE = "--supply-voltage 7.9 --unit rpm"
EV3 = "--supply-voltage 7.4 --rest-until 0"
HEAD = ("log", "verdict", "named", "model", "disturbance", "floors [rad/s]", "gap [rad/s]", "known of the rig")


@dataclass(frozen=True)
class Case:
    """Logs of one motor that are diagnosed together, each with the options of its line; what is known of the rig."""

    logs: tuple[tuple[str, str], ...]
    known: str
    motor: str = ""  # which of a file's motors

    @property
    def title(self) -> str:
        """Files and motor."""
        return " + ".join(name for name, _ in self.logs) + (f", {self.motor}" if self.motor else "")


UNDC = "gain 160–161 deg/s/V, τ 36.6–37.5 ms, 0.22–0.27 V of friction, 8–10 ms late (independent fits); one way only"
COASTING = "a coasting bridge: strongly concave static curve"
CASES = {
    "prbs": Case((("undc/prbs_2026-08-14.csv", ""),), UNDC),
    "prbs 18": Case((("undc/prbs_2026-08-18.csv", ""),), UNDC),
    "prbs + static": Case(
        (("undc/prbs_2026-08-14.csv", ""), ("undc/static_2026-08-17.csv", "--unit deg/s")),
        f"{UNDC}; its static curve begins at 0.17 V",
    ),
    "step": Case((("undc/step_open_2026-08-18.csv", ""),), UNDC),
    "step closed": Case((("undc/step_closed_2026-08-11.csv", "--voltage-before"),), f"{UNDC}; 2 s of one step"),
    "profile": Case((("undc/profile_closed_2026-08-18.csv", "--voltage-before"),), f"{UNDC}; y is a position here"),
    "stairs": Case((("undc/stairs_closed_2026-08-11.csv", "--voltage-before --max-voltage 5"),), COASTING),
    "coast": Case(
        tuple((f"undc/prbs_coast_2024-08-0{day}.csv", "--max-voltage 5") for day in (3, 5)), f"{COASTING}; friction"
    ),
    "ev3": Case(
        (("ev3/steps_1s.csv", EV3),),
        "dead band about 4 % (0.3 V), forward 5 % faster, 10–34 ms late, each run otherwise, τ 56–75 ms",
    ),
    "esp32": Case(
        (("esp32/step_response.csv", ""),),
        "one 9 V step: cannot tell friction from gain; the first two speeds are of the time before",
    ),
    **{
        f"{name} {motor}": Case(((f"micromouse/{name}.csv", MOUSE),), "{mouse}", motor)
        for name in ("testPid1", "testPid3", "controllerDelayImpact10ms", "controllerDelayImpact1ms")
        for motor in ("left", "right")
    },
    **{f"frc {motor}": Case((("frc/drivetrain_sysid.json", ""),), "{frc}", motor) for motor in ("left", "right")},
}  # fmt: skip


def read(case: Case, data: Path) -> list[Recording]:
    """Every run of every log of a case."""
    made = []
    for name, options in case.logs:
        parser = argparse.ArgumentParser()
        add_log_options(parser)
        arguments = parser.parse_args([str(data / name), "--dry-run", *shlex.split(options)])
        for motor in import_log(data / name, read_log_options(parser, arguments)).motors:
            if motor.label == case.motor:
                log = motor.log
                made += [check(recording_of(run.samples, log.info, run.label or Path(name).stem)) for run in log.runs]
    return made


def known_of(case: Case, data: Path) -> str:
    """What is known of the rig, as far as it is computed from other logs or in another way."""
    if case.known == "{mouse}":
        curve = data / "micromouse/wheelSpeedCalibration3.csv"
        return f"static curve up to 2 V: {fit_static_curve(curve, case.motor)}"
    if case.known == "{frc}":
        return f"SysId's regression: {fit_like_sysid(data / 'frc/drivetrain_sysid.json', case.motor)}"
    return case.known


def row_of(case: Case, found: Diagnosis, known: str) -> str:
    """One line of the table."""
    named = [
        " or ".join((one.effect, *one.ambiguous_with))
        + f" ({', '.join(format_quantity(name, *value) for name, value in one.parameters.items())})"
        for one in found.findings
    ]
    values, errors = found.model.parameters.values, found.model.standard_errors
    base = [format_quantity(name, values[name], errors[name]) for name in ("kv", "ka")]
    base.append(f"gain {degrees(1.0 / values['kv']):.4g} deg/s/V, τ {1e3 * values['ka'] / values['kv']:.3g} ms")
    torque = "–"
    if found.disturbance is not None:
        strength = format_measured(found.disturbance.rms_voltage, found.disturbance.rms_error, "V")
        torque = f"{strength}, {format_measured(found.disturbance.correlation_time, found.disturbance.time_error, 's')}"
    floors = f"sensor {found.sensor_floor:.3g}, with disturbance {found.noise_floor:.3g}"
    gap = f"{found.gap_before:.3g} → {found.gap_after:.3g}, {'fitted' if found.after.seen else 'held out'}"
    return " | ".join(
        (
            f"| {case.title}",
            found.verdict.value,
            "; ".join(named) or "–",
            "; ".join(base),
            torque,
            floors,
            gap,
            f"{known} |",
        )
    )


def section_of(case: Case, found: Diagnosis, seconds: float) -> list[str]:
    """What `diagnose` prints."""
    lines = "\n".join(f"import_log {name} --output BAG {options}".rstrip() for name, options in case.logs)
    return [
        f"## {case.title}", "", "```", lines, "```", "", "```", format_diagnosis(found), "```", "",
        summarize_diagnosis(found), *found.model.notes, f"({seconds:.0f} s)", "",
    ]  # fmt: skip


def main() -> int:
    """Diagnose, print, and write the page and the picture."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("data", nargs="?", type=Path, default=DATA, help="where undc/, ev3/ … are")
    parser.add_argument("--only", nargs="*", default=list(CASES), choices=list(CASES), help="these alone; no page")
    options = parser.parse_args()
    rows, sections, found = ["| " + " | ".join(HEAD) + " |", "|" + "---|" * len(HEAD)], [], {}
    for name in options.only:
        case, begun = CASES[name], perf_counter()
        found[name] = diagnose(read(case, options.data), request=Request(workers=2))
        rows.append(row_of(case, found[name], known_of(case, options.data)))
        sections += section_of(case, found[name], perf_counter() - begun)
        print(rows[-1], flush=True)
    if set(options.only) != set(CASES):
        return 0
    ev3, coast = read(CASES["ev3"], options.data), options.data / "undc/static_coast_2024-08-05.csv"
    before, after = draw(
        RESULTS / "real_motors.png",
        (found["prbs"], read(CASES["prbs"], options.data)[0]),
        (found["coast"], coast),
        (found["ev3"], ev3),
    )
    page = [
        "# Real motors, diagnosed", "",
        f"{machine()}, commit {commit()}. Logs recorded by others, each imported by one line without the encoder's "
        "counts; the diagnosis starts from kv and ka.", "",
        *rows, "",
        f"The coasting motor's static curve up to 5 V, which no fit has seen, is {before:.3g} rad/s off (RMS) before "
        f"and {after:.2g} after.", "", "![Three of the motors](real_motors.png)", "", *sections,
    ]  # fmt: skip
    (RESULTS / "real_motors.md").write_text("\n".join(page))
    return 0


if __name__ == "__main__":
    sys.exit(main())
