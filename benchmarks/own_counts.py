"""A loop on its own counts, simulated: is the motor found behind a command that answers the rounding of every row?

A PI controller at 100 to 500 Hz counts 0.6 to 16 edges a row at half of the top speed, and its command answers what it
counted: as it is, over rows of 2 % of jitter, behind y = 0.7 y' + 0.3 x, or a mean of four rows. Motors of 6 to 600
rad/s, friction of 2 to 10 % of the supply, set points of both signs. Each log is read three times: as `import_log`
reads it, as speeds (`--speed-window`), and as the positions that the controller's encoder had. No torque, no encoder's
error; a friction is known to be there.
"""

import os
import tempfile
from dataclasses import dataclass
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices

import numpy as np
from machine import commit, machine
from seeded_cases import run_seeds

from motor_identification.estimation.request import Request
from motor_identification.identify import identify
from motor_identification.logs.columns.said import Said
from motor_identification.logs.imported import import_log
from motor_identification.recording import Floats, check, recording_of

RESULTS = Path(__file__).with_name("results") / "own_counts.md"
SUPPLY, SPAN, INNER = 12.0, 20.0, 20
LEVELS = (0.4, 0.2, 0.6, 0.3, -0.3, -0.5, 0.25, 0.5)  # of the top speed
CASES = {"as they are": (0.0, 0.0, 1), "rows of 2 % of jitter": (0.02, 0.0, 1), "a filter of 0.7": (0.0, 0.7, 1)}
CASES |= {"a mean of four rows": (0.0, 0.0, 4)}  # jitter, memory, rows
READ = ("as imported", "as speeds", "as positions")
NAMES = ("kv", "ka", "ks")
NEAR = 0.05


@dataclass(frozen=True)
class Loop:
    """What a loop logged, arrays of shape (K,), and the motor in it."""

    time: Floats
    voltage: Floats
    speed: Floats
    position: Floats
    motor: dict[str, float]
    row: float  # [s]


@dataclass(frozen=True)
class Outcome:
    """Relative errors of kv, ka and ks, by how speeds were made and how the log was read."""

    seed: int
    errors: dict[tuple[str, str], tuple[float, ...]]


def run(seed: int, jitter: float, memory: float, rows: int) -> Loop:
    """Run the loop of a motor that is drawn by a seed."""
    random = np.random.default_rng([78, seed])
    top, lag = 10.0 ** random.uniform(0.8, 2.8), 10.0 ** random.uniform(-1.5, -0.5)
    kv, rate = SUPPLY / top, float(random.choice([100, 250, 500]))
    ks, row = random.uniform(0.02, 0.1) * SUPPLY, 1.0 / rate
    counts = max(int(10.0 ** random.uniform(-0.2, 1.2) * rate * 2.0 * np.pi / (0.5 * top)), 4)
    slot, kp = 2.0 * np.pi / counts, random.uniform(0.3, 3.0) * kv
    ki = kp / lag * random.uniform(0.3, 1.0)
    number = int(SPAN * rate)
    lengths = row * (1.0 + jitter * random.uniform(-1.0, 1.0, number))
    time = np.concatenate([[0.0], np.cumsum(lengths)[:-1]])
    volts, shown, count = np.zeros(number), np.zeros(number), np.zeros(number)
    speed, angle, integral, kept, last, before = 0.0, random.uniform(0.0, slot), 0.0, 0.0, 0.0, row
    latest = [0.0] * rows
    for k in range(number):
        count[k] = np.floor(angle / slot)
        kept += (1.0 - memory) * ((count[k] - last) * slot / before - kept)
        latest = [*latest[1:], kept]
        shown[k], last, before = sum(latest) / rows, count[k], lengths[k]
        error = LEVELS[k * len(LEVELS) // number] * top - shown[k]
        asked = kp * error + integral
        integral += ki * error * row if abs(asked) < SUPPLY else 0.0
        volts[k] = min(max(asked, -SUPPLY), SUPPLY)
        step = lengths[k] / INNER
        for _ in range(INNER):
            drive = volts[k] - kv * speed
            still = speed == 0.0 and abs(drive) <= ks
            new = speed if still else speed + (drive - ks * np.sign(speed or drive)) / (kv * lag) * step
            new = 0.0 if speed * new < 0.0 else new
            angle += 0.5 * (speed + new) * step
            speed = new
    return Loop(time, volts, shown, count * slot, {"kv": kv, "ka": kv * lag, "ks": ks}, row)


def read(loop: Loop, how: str) -> tuple[float, ...]:
    """Write, import and fit a log, and return the relative errors of kv, ka and ks."""
    positions = how == READ[2]
    name, values = ("position [rad]", loop.position) if positions else ("speed [rad/s]", loop.speed)
    lines = [f"{t:.6f},{u:.4f},{y:.6f}" for t, u, y in zip(loop.time, loop.voltage, values, strict=True)]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "log.csv"
        path.write_text("\n".join([f"time [s],voltage [V],{name}", *lines, ""]), encoding="utf-8")
        (motor,) = import_log(path, Said(speed_window=loop.row if how == READ[1] else None)).motors
    runs = [check(recording_of(one.samples, motor.log.info, one.label)) for one in motor.log.runs]
    found = identify(runs, request=Request(effects=("coulomb_friction",))).parameters
    return tuple(found.value(name) / loop.motor[name] - 1.0 for name in NAMES)


def find(seed: int) -> Outcome:
    """Fit the motor of a seed by each of its logs, read in each way."""
    loops = {name: run(seed, *case) for name, case in CASES.items()}
    return Outcome(seed, {(name, how): read(loop, how) for name, loop in loops.items() for how in READ})


def page(outcomes: list[Outcome], first: int) -> str:
    """The whole page."""
    lines = [
        f"# {(__doc__ or '').splitlines()[0]}",
        "",
        f"`python benchmarks/own_counts.py --cases {len(outcomes)} --first {first}`",
        f"(commit {commit()}; {machine()}).",
        *(__doc__ or "").splitlines()[1:],
        "",
        "Errors are relative to the truth, the largest of all loops.",
        "",
        "| speeds | read | all within 5 % | kv | ka | ks |",
        "|---|---|---:|---:|---:|---:|",
    ]
    for case in CASES:
        for how in READ:
            errors = np.abs([one.errors[case, how] for one in outcomes])
            near = f"{np.count_nonzero(errors.max(axis=1) < NEAR)} of {len(errors)}"
            cells = " | ".join(f"{most:.1%}" for most in errors.max(axis=0))
            lines.append(f"| {case} | {how} | {near} | {cells} |")
    return "\n".join([*lines, ""])


def say(one: Outcome) -> str:
    """Say an outcome in a line."""
    worst = {how: max(np.abs(one.errors[case, how]).max() for case in CASES) for how in READ}
    return f"{one.seed}: largest error " + ", ".join(f"{how} {error:.1%}" for how, error in worst.items())


def main() -> None:
    """Print the cases as they come, and write the page."""
    run_seeds(find, say, page, RESULTS, (__doc__ or "").splitlines()[0], 12)


if __name__ == "__main__":
    main()
