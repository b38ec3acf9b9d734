"""Logs as other people make them, of motors of any size, simulated: does the diagnosis name what is in them?

Top speeds of 5 to 2,000 rad/s, supplies of 3 to 48 V, time constants of 20 to 600 ms, rows of 20 to 1,000 Hz, speeds
or positions of any encoder; one excitation alone (steps, a staircase, a PRBS, ramps, a sweep, a speed loop), and a
random torque of up to 1.5 % of the supply. Friction is in four of five; a delay, drag, a dead zone, an asymmetry or a
load now and then. The tests' independent plant moves; `import_log` is told the counts of a turn where a log counts.
"""

import argparse
import os
import sys
import tempfile
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from time import process_time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "support"))

import numpy as np
from machine import commit, machine
from numpy.typing import NDArray
from plant.motor import move

from motor_identification.diagnose import diagnose
from motor_identification.diagnosis.result import Diagnosis
from motor_identification.logs.columns.said import Said
from motor_identification.logs.imported import import_log
from motor_identification.recording import check, recording_of
from motor_model.effects import normalised
from motor_model.errors import MotorError

Floats = NDArray[np.float64]
RESULTS = Path(__file__).with_name("results") / "foreign_logs.md"
SUPPLIES = (3.0, 5.0, 6.0, 7.4, 12.0, 24.0, 48.0)
RATES = (20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)
EXCITATIONS = ("step", "steps one way", "staircase", "prbs one way", "prbs", "ramps", "sweep", "speed loop")
# Chance of each effect, and its size: of the supply, of the time constant, or a number.
EFFECTS = {
    "coulomb_friction": (0.8, {"ks": (0.02, 0.12)}),
    "transport_delay": (0.25, {"delay": (0.1, 0.5)}),
    "quadratic_drag": (0.1, {"drag": (0.05, 0.3)}),
    "dead_zone": (0.1, {"dead_zone_voltage": (0.03, 0.12)}),
    "direction_asymmetry": (0.1, {"reverse_gain": (0.85, 0.95)}),
    "load_bias": (0.1, {"bias_voltage": (0.03, 0.1)}),
}
KINDS = ("right", "right, not all", "silent", "wrong", "refused")


@dataclass(frozen=True)
class Case:
    """A motor, what is in it, and how it was logged."""

    seed: int
    values: dict[str, float]  # of the plant
    hidden: tuple[str, ...]
    excitation: str
    rate: float  # [Hz]
    counts: int  # of a turn
    as_position: bool
    supply: float  # [V]
    torque: float  # [V] RMS

    @property
    def lag(self) -> float:
        """[s] the time constant."""
        return self.values["ka"] / self.values["kv"]

    def describe(self) -> str:
        """Say what it is in half a line."""
        top = self.supply / self.values["kv"]
        sensor = f"{'positions' if self.as_position else 'speeds'} of {self.counts} counts at {self.rate:g} Hz"
        motor = f"{self.supply:g} V, {top:.3g} rad/s, {1e3 * self.lag:.0f} ms"
        return f"{self.excitation}, {motor}, {sensor}, torque {100 * self.torque / self.supply:.1f} %"


def draw(seed: int) -> Case:
    """Draw a case."""
    random = np.random.default_rng([16, seed])
    supply, top = float(random.choice(SUPPLIES)), 10.0 ** random.uniform(0.7, 3.3)
    lag = 10.0 ** random.uniform(np.log10(0.02), np.log10(0.6))
    kv = supply / top
    scale = {"ks": supply, "dead_zone_voltage": supply, "bias_voltage": supply, "delay": lag, "drag": kv / top}
    values, hidden = {"kv": kv, "ka": kv * lag, "max_voltage": supply}, []
    for name, (chance, sizes) in EFFECTS.items():
        if random.random() < chance:
            hidden.append(name)
            values |= {key: random.uniform(*bounds) * scale.get(key, 1.0) for key, bounds in sizes.items()}
    torque = float(random.choice([0.0, 0.002, 0.005, 0.015])) * supply
    if torque:
        time = lag * 10.0 ** random.uniform(-1.0, 0.5)
        values |= {"random_torque": torque, "random_torque_time": time, "random_torque_seed": float(seed)}
    rate = min(float(random.choice(RATES)), 1000.0)
    rate = next(one for one in RATES if one >= min(max(rate, 4.0 / lag), RATES[-1]))
    per_row = 10.0 ** random.uniform(0.5, 2.5)  # counts from row to row at full speed
    counts = int(np.clip(np.rint(per_row * rate * 2.0 * np.pi / top), 12, 100_000))
    return Case(
        seed=seed,
        values=values,
        hidden=tuple(hidden),
        excitation=str(random.choice(EXCITATIONS)),
        rate=rate,
        counts=counts,
        as_position=bool(random.integers(2)),
        supply=supply,
        torque=torque,
    )


def command(case: Case, time: Floats) -> Floats:
    """The voltages of the rows, as shares of the supply; a speed loop's are found while it runs."""
    random, span = np.random.default_rng([17, case.seed]), time[-1]
    part = (time / span * 8).astype(int)
    match case.excitation:
        case "step":
            return np.where(time > 0.1 * span, random.uniform(0.5, 1.0), 0.0)
        case "steps one way":
            return np.append(0.0, random.uniform(0.2, 1.0, 8))[part]
        case "staircase":
            return np.array([0.0, 0.3, 0.6, 0.9, 0.0, -0.3, -0.6, -0.9, 0.0])[part]
        case "prbs one way" | "prbs":
            low, high = random.uniform(0.25, 0.45), random.uniform(0.55, 0.9)
            bits = random.integers(2, size=int(span / (1.5 * case.lag)) + 2)
            levels = np.where(bits, high, low if case.excitation == "prbs one way" else -high)
            return np.asarray(levels[(time / (1.5 * case.lag)).astype(int)])
        case "ramps":
            return np.asarray(np.interp(time / span, [0.0, 0.05, 0.3, 0.55, 0.8, 1.0], [0.0, 0.0, 0.9, -0.9, 0.9, 0.0]))
        case _:
            sweep = 2.0 * np.pi * span / (4.0 * case.lag) / 8.0 * (np.exp(2.0 * time / span) - 1.0) / 3.0
            return np.asarray(random.uniform(0.5, 0.9) * np.sin(sweep))


def run(case: Case) -> tuple[Floats, Floats, Floats]:
    """Time [s], voltage [V] and angle [rad] of every row."""
    span = float(np.clip(60.0 * case.lag, 4.0, 30.0))
    time = np.arange(int(span * case.rate)) / case.rate
    if case.excitation != "speed loop":
        volts = case.supply * np.clip(command(case, time), -1.0, 1.0)
        return time, volts, _move(case, time, volts)
    volts = np.zeros(len(time))
    speed = np.array([0.5, 0.2, 0.7, 0.4, -0.3, -0.6, 0.3, 0.5, 0.0])[(time / span * 8).astype(int)]
    for _ in range(3):  # a loop without a model: the command of a run answers the speed of the run before
        angle = _move(case, time, volts)
        error = speed * case.supply / case.values["kv"] - np.gradient(angle, time)
        volts = np.clip(volts + 0.5 * case.values["kv"] * error, -case.supply, case.supply)
    return time, volts, _move(case, time, volts)


def _move(case: Case, time: Floats, volts: Floats) -> Floats:
    motion = move(case.values, time, volts, step=min(1e-4, case.lag / 400.0))
    return np.asarray(motion.angle[motion.at])


def write(case: Case, path: Path) -> None:
    """Write the log."""
    time, volts, angle = run(case)
    count = np.floor(angle * case.counts / (2.0 * np.pi) + np.random.default_rng(case.seed).random())
    shown = count * 360.0 / case.counts
    if not case.as_position:
        shown = np.append(0.0, np.diff(shown)) * case.rate / 6.0
    name = "position [deg]" if case.as_position else "speed [rpm]"
    rows = zip(time, volts, shown, strict=True)
    text = "\n".join(f"{t:.6f},{u:.4f},{y:.5f}" for t, u, y in rows)
    path.write_text(f"time [s],voltage [V],{name}\n{text}\n", encoding="utf-8")


@dataclass(frozen=True)
class Outcome:
    """What a log gave."""

    case: Case
    kind: str
    said: str
    error: float  # relative, of kv
    seconds: float  # of a processor


def judge(case: Case, found: Diagnosis) -> str:
    """Sort a diagnosis into its kind; one of a finding's rivals counts as its name."""
    hidden = set(normalised(case.hidden))
    names = [{one.effect, *one.ambiguous_with} for one in found.findings]
    if any(not name & hidden for name in names):
        return "wrong"
    if not hidden and found.verdict.value == "unexplained":
        return "wrong"
    if all(any(effect in name for name in names) for effect in hidden):
        return "right" if found.verdict.value != "unexplained" else "right, not all"
    return "right, not all" if names else "silent"


def one(seed: int) -> Outcome:
    """Draw, write, import and diagnose a case."""
    case, begun = draw(seed), process_time()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "log.csv"
        write(case, path)
        try:
            (motor,) = import_log(path, Said()).motors
            runs = [check(recording_of(part.samples, motor.log.info, part.label)) for part in motor.log.runs]
            found = diagnose(runs)
        except MotorError as error:
            return Outcome(case, "refused", str(error).replace(str(path), "log.csv"), np.nan, process_time() - begun)
    said = " + ".join(" or ".join((one.effect, *one.ambiguous_with)) for one in found.findings) or "–"
    error = found.model.parameters.value("kv") / case.values["kv"] - 1.0
    return Outcome(case, judge(case, found), f"{said} ({found.verdict.value})", error, process_time() - begun)


def row(title: str, outcomes: list[Outcome]) -> str:
    """A row of the table."""
    count = Counter(one.kind for one in outcomes)
    errors = [abs(one.error) for one in outcomes if one.kind.startswith("right")]
    cells = [str(count[kind]) for kind in KINDS]
    cells += [f"{np.median(errors):.1%}" if errors else "–", f"{np.median([one.seconds for one in outcomes]):.0f} s"]
    return f"| {title} | {len(outcomes)} | " + " | ".join(cells) + " |"


def page(outcomes: list[Outcome], first: int) -> str:
    """The whole page."""
    groups = {"all": outcomes}
    groups |= {f"… {name}": [one for one in outcomes if one.case.excitation == name] for name in EXCITATIONS}
    shares = sorted({one.case.torque / one.case.supply for one in outcomes})
    for share in shares:
        groups[f"… torque {share:.1%}"] = [one for one in outcomes if one.case.torque / one.case.supply == share]
    lines = [
        f"# {(__doc__ or '').splitlines()[0]}",
        "",
        f"`python benchmarks/foreign_logs.py --cases {len(outcomes)} --first {first}`",
        f"(commit {commit()}; {machine()}).",
        *(__doc__ or "").splitlines()[1:],
        '"Right": all that is in the motor is named, or one of a few that the log cannot tell apart; "silent": nothing',
        "is named, which a single step or the size of an effect may deserve; wrong: a name whose effect is not there,",
        'or "unexplained" where nothing is missing.',
        "",
        f"| logs | number | {' | '.join(KINDS)} | error of kv where right | CPU time |",
        "|---|---:|" + "---:|" * (len(KINDS) + 2),
        *(row(title, some) for title, some in groups.items() if some),
        "",
        "What was not right:",
        "",
    ]
    for one in sorted(outcomes, key=lambda one: -KINDS.index(one.kind)):
        if one.kind != "right":
            truth = " + ".join(one.case.hidden) or "nothing"
            lines.append(f"- {one.case.seed}, {one.kind}: {one.said} for {truth} ({one.case.describe()})")
    return "\n".join([*lines, ""])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=100)
    parser.add_argument("--first", type=int, default=0, help="seed of the first case")
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args()
    outcomes = []
    with ProcessPoolExecutor(options.workers) as pool:
        for outcome in pool.map(one, range(options.first, options.first + options.cases)):
            outcomes.append(outcome)
            truth = " + ".join(outcome.case.hidden) or "nothing"
            print(
                outcome.case.seed, outcome.kind, "|", truth, "|", outcome.said, "|", outcome.case.describe(), flush=True
            )
    text = page(outcomes, options.first)
    RESULTS.write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
