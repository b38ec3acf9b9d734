"""How long a user waits: the paper's swarm beside SciPy and NumPy, and `identify` of half a minute from start to end.

The paper's search is 200 epochs of 50 particles over 1 s of motion at 10 V. Ours simulates each particle in closed form
from edge to edge (joined to 20 ms, as every search here does); SciPy solves the same motor with `lsim` and NumPy steps
the whole swarm at 1 kHz, both for the speed alone.
"""

import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from statistics import median
from time import perf_counter

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices

import numpy as np
from machine import machine
from scipy.signal import lsim

from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.search.global_search import COARSE_SAMPLES
from motor_identification.estimation.search.swarm import SwarmConfig, minimise
from motor_identification.recording import check, recording_of
from motor_model.model_file import save
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters, paper_motor
from motor_model.sensing.board import BoardConfig, SimulatedBoard

RESULTS = Path(__file__).with_name("results") / "speed.md"
PARTICLES, EPOCHS, RATE = 50, 200, 1000
FIVE = {
    "coulomb_friction,transport_delay,dead_zone": {"ks": 0.4, "delay": 0.006, "dead_zone_voltage": 0.3},
    "static_friction": {"ks": 0.4, "breakaway_voltage": 0.9, "stribeck_speed": 4.0},
}


def timed(work: Callable[[], object], times: int = 7) -> float:
    """[s] median."""
    spans = []
    for _ in range(times):
        begun = perf_counter()
        work()
        spans.append(perf_counter() - begun)
    return median(spans)


def swarms() -> dict[str, float]:
    """[s] for 200 epochs of 50 particles, by who simulates."""
    board = SimulatedBoard(paper_motor(), BoardConfig())
    samples = [board.sample(0.0 if k < 20 else 10.0) for k in range(220)]
    recording = check(recording_of(samples, BoardConfig().info(paper_motor()), "step"))
    problem = make_problem([recording], (), workers=2).coarsen(COARSE_SAMPLES)
    low, high = problem.unknowns.low, problem.unknowns.high
    config = SwarmConfig(PARTICLES, EPOCHS, seed=0, stall=0)
    places = np.exp(np.random.default_rng(0).uniform(low, high, (PARTICLES, 2)))
    time = np.arange(RATE) / RATE
    volts = np.full(RATE, 10.0)

    def scipys() -> None:
        for kv, ka in places:
            lsim(([1.0], [ka, kv]), volts, time)

    def numpys() -> None:
        speed, fade = np.zeros(PARTICLES), np.exp(-places[:, 0] / places[:, 1] / RATE)
        for u in volts:
            steady = u / places[:, 0]
            speed = steady + (speed - steady) * fade

    return {
        "ours (whole search, 2 threads)": timed(lambda: minimise(problem.costs, low, high, config)),
        "ours (one thread)": timed(
            lambda: minimise(make_problem([recording], ()).coarsen(COARSE_SAMPLES).costs, low, high, config)
        ),
        "NumPy, exact steps at 1 kHz (simulation only)": EPOCHS * timed(numpys),
        "SciPy, lsim (simulation only)": EPOCHS * timed(scipys, 3),
    }


def identifications() -> dict[str, float]:
    """[s] from the start of the process to its end, by effects."""
    spans = {}
    command = [sys.executable, "-m", "motor_identification.cli"]
    with tempfile.TemporaryDirectory() as folder:
        for effects, values in FIVE.items():
            model, bag = Path(folder, effects + ".yaml"), Path(folder, effects)
            save(model, Parameters({"kv": PAPER_KV, "ka": PAPER_KA, **values}, tuple(effects.split(","))))
            _run([*_module(command, "experiment"), "rich", "--output", bag, "--model", model])
            job = [*_module(command, "identify"), bag, "--effects", effects]
            spans[effects] = timed(lambda job=job: _run(job), 5)  # type: ignore[misc]
    return spans


def _module(command: list[str], name: str) -> list[str]:
    return [*command[:-1], f"{command[-1]}.{name}"]


def _run(command: list[object]) -> None:
    subprocess.run([str(word) for word in command], check=True, capture_output=True)


def main() -> int:
    """Print and write the tables."""
    lines = ["# Speed", "", f"{machine()}. Medians; caches warm.", ""]
    lines += [f"The paper's search: {EPOCHS} epochs of {PARTICLES} particles, 1 s of motion.", ""]
    found = swarms()
    ours = found["ours (whole search, 2 threads)"]
    lines += ["| by | time | beside ours |", "|---|---:|---:|"]
    lines += [f"| {by} | {1e3 * span:.0f} ms | {span / ours:.1f} |" for by, span in found.items()]
    lines += [
        "",
        f"Required: at most 40 ms of compute: {'holds' if ours <= 0.04 else 'does not hold'}.",
        "",
        "`identify` of a 28 s `rich` recording, five parameters, from the start of the process to its end:",
        "",
        "| effects | time | at most 3 s |",
        "|---|---:|---|",
    ]
    for effects, span in identifications().items():
        lines.append(f"| {effects} | {span:.1f} s | {'holds' if span <= 3.0 else 'does not hold'} |")
    RESULTS.parent.mkdir(exist_ok=True)
    RESULTS.write_text("\n".join(lines) + "\n", encoding="utf-8")
    print("\n".join(lines))
    return 0


if __name__ == "__main__":
    sys.exit(main())
