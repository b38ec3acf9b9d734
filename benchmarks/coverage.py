"""Are the standard errors true? How often the 95 % intervals of many simulated recordings hold the true motor.

Every recording has another disc (1 % irregular slots), another starting angle and another disturbance; kv, ka, ks and
delay are fitted to staircase and PRBS (10 s at 200 Hz, 4 µs timer). White residuals are those of timer and slots alone.
Coloured residuals come from an unmodelled random load, as brushes, bearings and a supply make it: an Ornstein-Uhlenbeck
process with a standard deviation of 0.1 V (under 1 % of the 12 V) and the correlation time given; it is not recorded,
and the motor's inertia colours it further.
"""

import argparse
import os
import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from math import exp, sqrt
from pathlib import Path
from time import perf_counter

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices

import numpy as np
from machine import machine
from numpy.typing import NDArray

from motor_identification.identify import Request, SearchConfig, identify
from motor_identification.recording import check, recording_of
from motor_model.excitation import profile
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.sensing.board import BoardConfig, SimulatedBoard

EFFECTS = ("coulomb_friction", "transport_delay")
TRUE = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4, "delay": 0.0043}
PROFILES = ("staircase", "prbs")
RATE = 200.0  # [Hz]
RESULTS = Path(__file__).with_name("results")
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Scenario:
    """What disturbs the recordings."""

    name: str
    irregularity: float  # share of a slot
    disturbance: float  # [V] standard deviation
    correlation_time: float  # [s]
    share: float = 1.0  # of the recordings asked for


SCENARIOS = (
    Scenario("white", 0.01, 0.0, 1.0),
    Scenario("coloured, 20 ms", 0.01, 0.1, 0.02),
    Scenario("coloured, 100 ms", 0.01, 0.1, 0.1, 0.25),
)


def disturbance(scenario: Scenario, count: int, random: np.random.Generator) -> Floats:
    """[V] an Ornstein-Uhlenbeck process at the samples, shape (count,)."""
    keep = exp(-1.0 / RATE / scenario.correlation_time)
    fresh = random.normal(0.0, scenario.disturbance * sqrt(1.0 - keep**2), count)
    values = np.empty(count)
    last = random.normal(0.0, scenario.disturbance)
    for k in range(count):
        values[k] = last = keep * last + fresh[k]
    return values


def score(job: tuple[Scenario, int]) -> Floats:
    """Errors over standard errors (NaN where not identifiable), then the relative errors themselves; shape (8,)."""
    scenario, seed = job
    rest = np.zeros(20)
    parts = [profile(name).voltage(np.arange(round(profile(name).duration * RATE)) / RATE, 12.0) for name in PROFILES]
    command = np.concatenate([rest, *parts])
    hidden = disturbance(scenario, len(command), np.random.default_rng([seed, 77]))
    motor = Parameters(TRUE, EFFECTS, max_voltage=13.0)  # the disturbance comes on top of 12 V
    config = BoardConfig(slot_irregularity=scenario.irregularity, seed=seed)
    board = SimulatedBoard(motor, config)
    samples = [board.sample(float(volts)) for volts in command + hidden]
    recording = check(replace(recording_of(samples, config.info(motor), f"{seed}"), voltage=command))
    fit = identify([recording], Request(EFFECTS, SearchConfig(particles=16, epochs=30)))
    errors = np.array([fit.parameters.value(name) - true for name, true in TRUE.items()])
    sure = np.array([fit.standard_errors[name] for name in TRUE])
    return np.concatenate([errors / sure, errors / np.array(list(TRUE.values()))])


def row(scenario: Scenario, scores: Floats) -> str:
    """One line of the table: per parameter the share covered, spread and median of z, and the error itself."""
    cells = []
    for z, error in zip(scores[:, :4].T, scores[:, 4:].T, strict=True):
        covered = float(np.mean(np.abs(z) < 1.959964))
        sigma = sqrt(max(covered * (1.0 - covered), 1e-9) / len(z))
        cells.append(
            f"{100 * covered:.1f} ± {100 * sigma:.1f} % ({np.nanstd(z):.2f}, {np.nanmedian(z):+.2f}, {error.std():.1e})"
        )
    return f"| {scenario.name} | {len(scores)} | " + " | ".join(cells) + " |"


def main() -> int:
    """Print and write the table, draw the figure."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--recordings", type=int, default=1000, help="recordings in each scenario")
    parser.add_argument("--workers", type=int, default=2)
    asked = parser.parse_args()
    RESULTS.mkdir(exist_ok=True)
    lines = [
        "# Coverage of the 95 % intervals",
        "",
        *__doc__.splitlines()[2:],
        "",
        "In each cell: covered (should be 95 %) with its binomial error; then the spread (should be 1) and the median",
        f"(should be 0) of error/standard error, and the relative error's standard deviation. {machine()}.",
        "",
        "| residuals | recordings | kv | ka | ks | delay |",
        "|---|---:|---|---|---|---|",
    ]
    scores: dict[str, Floats] = {}
    for scenario in SCENARIOS:
        begun = perf_counter()
        jobs = [(scenario, seed) for seed in range(round(asked.recordings * scenario.share))]
        with ProcessPoolExecutor(asked.workers) as pool:
            scores[scenario.name] = np.array(list(pool.map(score, jobs, chunksize=4)))
        lines.append(row(scenario, scores[scenario.name]))
        print(lines[-1], f"{perf_counter() - begun:.0f} s", flush=True)
        (RESULTS / "coverage.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    draw(scores)
    return 0


def draw(scores: dict[str, Floats]) -> None:
    """Covered share over the interval's width: the nominal curve, and each parameter's."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt
    from scipy.stats import norm

    figure, axes = plt.subplots(1, len(scores), figsize=(4.2 * len(scores), 4.2), sharey=True, constrained_layout=True)
    nominal = np.linspace(0.01, 0.995, 100)
    for axis, (name, both) in zip(np.atleast_1d(axes), scores.items(), strict=True):
        axis.fill_between([0, 1], [-0.02, 0.98], [0.02, 1.02], color="0.9", label="± 2 %")
        for parameter, z in zip(TRUE, both[:, :4].T, strict=True):
            width = norm.ppf(0.5 + 0.5 * nominal)
            axis.plot(nominal, [np.mean(np.abs(z) < one) for one in width], lw=1.2, label=parameter)
        axis.set(title=name, xlabel="nominal", xlim=(0, 1), ylim=(0, 1))
        axis.grid(alpha=0.25)
    np.atleast_1d(axes)[0].set_ylabel("covered")
    np.atleast_1d(axes)[0].legend(fontsize=8)
    figure.savefig(RESULTS / "coverage.png", dpi=120)


if __name__ == "__main__":
    sys.exit(main())
