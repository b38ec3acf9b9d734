"""How long a diagnosis takes on two cores, from the start of the process to its end, and how soon Ctrl-C ends it."""

import argparse
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

from hidden import OUTSIDE
from hidden import recorded as plant_recorded
from machine import machine

from motor_identification.diagnose import Request, diagnose
from motor_model.model_file import save
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters

RESULTS = Path(__file__).with_name("results") / "diagnosis_speed.md"
PROMISED, ENDED = 30.0, 1.0  # [s]
COMMAND = [sys.executable, "-m", "motor_identification.cli.diagnose"]
RIPPLE = {"ripple_voltage": 0.3, "ripple_cycles": 7.3, "ripple_phase": 0.4}
HIDDEN: dict[str, dict[str, float]] = {
    "nothing": {},
    "static_friction": {"ks": 0.4, "breakaway_voltage": 0.9, "stribeck_speed": 4.0},
    "coulomb_friction,transport_delay": {"ks": 0.4, "delay": 0.006},
    "dead_zone,armature_inductance": {"dead_zone_voltage": 0.4, "electrical_time_constant": 0.004},
    "coulomb_friction,torque_ripple": {"ks": 0.4, **RIPPLE},
    "static_friction,quadratic_drag,transport_delay": {
        "ks": 0.3, "breakaway_voltage": 0.8, "stribeck_speed": 4.0, "drag": 5e-5, "delay": 0.006,
    },
}  # fmt: skip


def recorded(effects: str, folder: Path) -> Path:
    """A 28 s recording of the motor with these effects, on a disc 0.5 % irregular."""
    names = tuple(effects.split(",")) if effects != "nothing" else ()
    model, bag = folder / f"{effects}.yaml", folder / effects
    save(model, Parameters({"kv": PAPER_KV, "ka": PAPER_KA, **HIDDEN[effects]}, names))
    offline = ["rich", "--output", bag, "--model", model, "--slot-irregularity", 0.005]
    command = [sys.executable, "-m", "motor_identification.cli.experiment", *map(str, offline)]
    subprocess.run(command, check=True, capture_output=True)
    return bag


def timed(bag: Path) -> float:
    """[s] of one `diagnose`, without report."""
    begun = time.perf_counter()
    subprocess.run([*COMMAND, str(bag)], check=True, capture_output=True)
    return time.perf_counter() - begun


def outsiders(motors: int) -> list[str]:
    """Rows for what is outside the table, in which a diagnosis tries most: the slowest of some motors."""
    lines = []
    for name in OUTSIDE:
        alone, both = [], []
        for seed in range(motors):
            made = plant_recorded((name,), seed)
            alone.append(diagnose([made.training], request=Request(workers=2)).duration)
            both.append(diagnose([made.training], [made.validation], Request(workers=2)).duration)
        word = "holds" if max(alone) <= PROMISED else "does not hold"
        lines.append(f"| {name} | {max(alone):.1f} s | {word} | {max(both):.1f} s |")
        print(lines[-1], flush=True)
    return lines


def ended(bag: Path, after: float) -> float:
    """[s] from Ctrl-C, so long after the start of the process, to its end."""
    process = subprocess.Popen([*COMMAND, str(bag)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(after)
    process.send_signal(signal.SIGINT)
    begun = time.perf_counter()
    if process.wait() != 130:
        raise SystemExit(f"Ctrl-C after {after:g} s came too late, or was not heard: exit status {process.returncode}.")
    return time.perf_counter() - begun


def main() -> int:
    """Print and write the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--times", type=int, default=3, help="each (default 3)")
    parser.add_argument("--motors", type=int, default=5, help="for each row outside the table (default 5)")
    options = parser.parse_args()
    times = options.times
    lines = [
        "# Diagnosis: time",
        "",
        f"{machine()}. `diagnose` of a 28 s `rich` recording, with process start; median of {times}.",
        "",
        f"| hidden | time | at most {PROMISED:g} s |",
        "|---|---:|---|",
    ]
    with tempfile.TemporaryDirectory() as folder:
        bags = {effects: recorded(effects, Path(folder)) for effects in HIDDEN}
        for effects, bag in bags.items():
            span = median(timed(bag) for _ in range(times))
            lines.append(f"| {effects} | {span:.1f} s | {'holds' if span <= PROMISED else 'does not hold'} |")
            print(lines[-1], flush=True)
        slow = bags["coulomb_friction,torque_ripple"]
        longest = max(ended(slow, after) for after in (2.0, 3.5, 5.0, 7.0, 9.0))
    word = "holds" if longest <= ENDED else "does not hold"
    lines += ["", f"Ctrl-C at five moments of the longest ends it within {longest:.1f} s; at most {ENDED:g} s: {word}."]
    lines += [
        "",
        f"Outside the table, where most is tried: the slowest of {options.motors} motors, in process, 2 workers.",
        "",
        f"| hidden | 28 s | at most {PROMISED:g} s | with a validation recording of 14 s more |",
        "|---|---:|---|---:|",
        *outsiders(options.motors),
    ]
    print("\n".join(lines))
    RESULTS.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
