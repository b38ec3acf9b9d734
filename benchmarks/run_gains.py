"""Runs of a battery, simulated: is what is in the motor named though each run has another supply, and nothing else?

6 to 20 steps from rest, some both ways and in any order, logged as if all had one supply: that differs by 1 to 3 %
(RMS) from run to run, at random, or falls from the first to the last. Motors of any size, positions or speeds of any
encoder, a random torque of 0.3 % of the supply in a third. Nothing is hidden in half of them, in the others friction, a
delay, both, drag, a dead zone or an asymmetry. The tests' independent plant moves; `import_log` is told nothing.
"""

import os
import tempfile
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices

import numpy as np
from foreign_logs import KINDS, judge
from foreign_logs_cases import SENSORS, SUPPLIES, Case, Floats
from machine import commit, machine
from plant.motor import move
from seeded_cases import run_seeds

from motor_identification.diagnose import diagnose
from motor_identification.logs.columns.said import Said
from motor_identification.logs.imported import import_log
from motor_identification.recording import check, recording_of
from motor_model.errors import MotorError

RESULTS = Path(__file__).with_name("results") / "run_gains.md"
HIDDEN = (
    ("coulomb_friction",), ("transport_delay",), ("coulomb_friction", "transport_delay"), ("quadratic_drag",),
    ("dead_zone",), ("direction_asymmetry",),
)  # fmt: skip
SCATTERS = (0.01, 0.02, 0.03)
STEP = 0.02  # of a run, after which its voltage comes
REST = 0.6  # of a run, after which it goes in half of the logs


@dataclass(frozen=True)
class Runs:
    """The steps of one log, each with the gain that its supply had; arrays of shape (R,)."""

    case: Case
    levels: Floats  # shares of the supply
    gains: Floats
    scatter: float
    stops: bool


@dataclass(frozen=True)
class Outcome:
    """What a log gave."""

    runs: Runs
    kind: str
    said: str
    scatter: float  # found, of the gains
    error: float  # relative, of kv


def draw(seed: int) -> Runs:
    """Draw a motor, its steps and their gains."""
    random = np.random.default_rng([41, seed])
    supply, top = float(random.choice(SUPPLIES[1:5])), 10.0 ** random.uniform(1.0, 2.5)
    lag, kv = 10.0 ** random.uniform(np.log10(0.03), np.log10(0.2)), supply / top
    hidden = () if seed % 2 else HIDDEN[int(random.integers(len(HIDDEN)))]
    sizes = {
        "coulomb_friction": ("ks", supply * random.uniform(0.02, 0.1)),
        "transport_delay": ("delay", lag * random.uniform(0.15, 0.5)),
        "quadratic_drag": ("drag", kv / top * random.uniform(0.1, 0.3)),
        "dead_zone": ("dead_zone_voltage", supply * random.uniform(0.03, 0.12)),
        "direction_asymmetry": ("reverse_gain", random.uniform(0.85, 0.95)),
    }
    values = {"kv": kv, "ka": kv * lag, "max_voltage": supply} | dict(sizes[name] for name in hidden)
    torque = float(random.choice([0.0, 0.0, 0.003])) * supply
    if torque:
        values |= {"random_torque": torque, "random_torque_time": lag * 10.0 ** random.uniform(-0.5, 0.5)}
    count, scatter = int(random.choice([6, 8, 10, 14, 20])), float(random.choice(SCATTERS))
    both = random.random() < 0.6 or "direction_asymmetry" in hidden
    half = np.linspace(0.2, 1.0, count // 2)
    levels = random.permutation(np.append(-half, half) if both else np.linspace(0.2, 1.0, count))
    falls = random.random() < 0.5
    drawn = np.sqrt(3.0) * np.linspace(1.0, -1.0, count) if falls else random.standard_normal(count)
    rate = float(random.uniform(8.0, 20.0) / lag)
    counts = int(np.clip(np.rint(10.0 ** random.uniform(0.7, 1.8) * rate * 2.0 * np.pi / top), 24, 20_000))
    name = f"{count} steps {'both ways' if both else 'one way'}, the supply {'falls' if falls else 'varies'}"
    case = Case(seed, values, hidden, name, rate, counts, SENSORS[int(random.integers(2))], supply, torque)
    return Runs(case, levels, 1.0 + scatter * drawn, scatter, bool(random.random() < 0.5))


def write(runs: Runs, path: Path) -> None:
    """Write the log, a run of 8 to 20 time constants after the other."""
    case, random = runs.case, np.random.default_rng([42, runs.case.seed])
    span = case.lag * random.uniform(8.0, 20.0)
    name = "position [deg]" if case.sensor == SENSORS[0] else "speed [deg/s]"
    lines = [f"run,time [s],voltage [V],{name}"]
    for number, (level, gain) in enumerate(zip(runs.levels, runs.gains, strict=True)):
        periods = 1.0 + 0.05 * random.standard_normal(int(span * case.rate))
        time = np.cumsum(np.maximum(periods, 0.5)) / case.rate
        driven = (time > STEP * span) & (not runs.stops or time < REST * span)
        volts = np.where(driven, level * case.supply, 0.0)
        own = {"random_torque_seed": 100.0 * case.seed + number} if case.torque else {}
        motion = move(case.values | own, time, volts * gain, step=min(1e-4, case.lag / 400.0))
        count = np.floor(motion.angle[motion.at] * case.counts / (2.0 * np.pi) + random.random())
        shown = count * 360.0 / case.counts
        if case.sensor != SENSORS[0]:
            shown = np.append(0.0, np.diff(shown) / np.diff(time))
        lines += [f"{number},{t:.6f},{u:.4f},{y:.5f}" for t, u, y in zip(time, volts, shown, strict=True)]
    path.write_text("\n".join([*lines, ""]), encoding="utf-8")


def find(seed: int) -> Outcome:
    """Write, import and diagnose a case."""
    runs = draw(seed)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "log.csv"
        write(runs, path)
        try:
            (motor,) = import_log(path, Said()).motors
            found = diagnose([check(recording_of(one.samples, motor.log.info, one.label)) for one in motor.log.runs])
        except MotorError as error:
            return Outcome(runs, "refused", str(error).replace(str(path), "log.csv"), np.nan, np.nan)
    said = " + ".join(" or ".join((one.effect, *one.ambiguous_with)) for one in found.findings) or "–"
    error = found.model.parameters.value("kv") / runs.case.values["kv"] - 1.0
    return Outcome(
        runs, judge(runs.case, found), f"{said} ({found.verdict.value})", found.gain_scatter / runs.scatter, error
    )


def row(title: str, outcomes: list[Outcome]) -> str:
    """A row of the table."""
    count = Counter(one.kind for one in outcomes)
    told = [one.scatter for one in outcomes if one.scatter > 0.0 and one.kind == "right"]
    errors = [abs(one.error) for one in outcomes if one.kind.startswith("right")]
    cells = [str(count[kind]) for kind in KINDS]
    cells += [f"{np.median(told):.2f} ({len(told)})" if told else "–"]
    cells += [f"{np.median(errors):.1%}" if errors else "–"]
    return f"| {title} | {len(outcomes)} | " + " | ".join(cells) + " |"


def page(outcomes: list[Outcome], first: int) -> str:
    """The whole page."""
    groups = {"all": outcomes, "nothing hidden": [one for one in outcomes if not one.runs.case.hidden]}
    groups |= {" + ".join(names): [one for one in outcomes if one.runs.case.hidden == names] for names in HIDDEN}
    groups |= {f"supply ±{size:.0%}": [one for one in outcomes if one.runs.scatter == size] for size in SCATTERS}
    lines = [
        f"# {(__doc__ or '').splitlines()[0]}",
        "",
        f"`python benchmarks/run_gains.py --cases {len(outcomes)} --first {first}`",
        f"(commit {commit()}; {machine()}).",
        *(__doc__ or "").splitlines()[1:],
        "",
        f"| logs | number | {' | '.join(KINDS)} | scatter told, over true (number) | error of kv where right |",
        "|---|---:|" + "---:|" * (len(KINDS) + 2),
        *(row(title, some) for title, some in groups.items() if some),
    ]
    wrong = [f"- {say(one)}" for one in outcomes if one.kind != "right"]
    return "\n".join([*lines, *(["", "What was not right:", "", *wrong] if wrong else []), ""])


def say(one: Outcome) -> str:
    """Say an outcome in a line."""
    truth = " + ".join(one.runs.case.hidden) or "nothing"
    about = f"supply ±{one.runs.scatter:.0%}; {one.runs.case.describe()}"
    return f"{one.runs.case.seed}, {one.kind}: {one.said} for {truth} ({about})"


def main() -> None:
    """Print the cases as they come, and write the page."""
    run_seeds(find, say, page, RESULTS, (__doc__ or "").splitlines()[0], 60)


if __name__ == "__main__":
    main()
