"""Does a diagnosed model, simulated by the independent plant, reproduce the gap that was reported for it?

Random motors of `hidden.py`. The model that the diagnosis returns is given to the tests' plant, which shares no
formula with the library, under the validation recording's voltages, from rest; what it leaves of the recorded edges is
scored by the definition of the gap alone (`tests/support/plant/score.py`). Beside it: the gap of the true motor, the
noise floor reported, and the one of the disc that was really there.
"""

import argparse
import os
import sys
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "support"))

import numpy as np
from hidden import SIZES
from machine import machine
from plant import profiles, record
from plant.motor import move
from plant.score import score

from motor_identification.diagnose import diagnose
from motor_identification.recording import check
from motor_model.effects import normalised
from motor_model.parameters import PAPER_KA, PAPER_KV

RESULTS = Path(__file__).with_name("results") / "resimulation.md"
ROWS: list[tuple[str, ...]] = [
    (),
    ("coulomb_friction",),
    ("static_friction",),
    ("coulomb_friction", "transport_delay"),
    ("dead_zone",),
    ("quadratic_drag",),
    ("backlash",),
    ("direction_asymmetry",),
    ("voltage_limit",),
    ("coast_drive",),
    ("armature_inductance",),
    ("dead_zone", "armature_inductance"),
]


def one(hidden: tuple[str, ...], seed: int) -> tuple[bool, float, float, float, float]:
    """Whether it was named right, and [rad/s] the gap reported, re-simulated, of the true motor, and the floor."""
    random = np.random.default_rng([seed, len(hidden), *map(ord, "".join(hidden))])
    values = {"kv": PAPER_KV * random.uniform(0.7, 1.4), "ka": PAPER_KA * random.uniform(0.6, 1.5)}
    for name in hidden:
        for parameter, bounds in SIZES[name].items():
            values[parameter] = float(random.uniform(*bounds))
    how = {"irregularity": float(random.uniform(0.001, 0.01)), "disc_seed": int(random.integers(1000))}
    train, _ = record(values, *profiles.rich(12.0, seed), seed=seed, **how)  # type: ignore[arg-type]
    kept, truth = record(values, *profiles.random(12.0, 14.0, seed + 500), seed=seed + 77, **how)  # type: ignore[arg-type]
    found = diagnose([check(train)], [check(kept)])
    again = score(kept, move(found.model.parameters.values, kept.time, kept.voltage)).gap()
    right = {finding.effect for finding in found.findings} == set(normalised(hidden))
    return right, found.gap_after, again, score(kept, truth.motion).gap(), found.noise_floor


def main() -> int:
    """Print and write the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--motors", type=int, default=3, help="for each row (default 3)")
    options = parser.parse_args()
    lines = [
        "# Diagnosed models simulated again by the independent plant",
        "",
        f"{machine()}; {options.motors} random motors a row; each ratio's largest deviation from 1.",
        "",
        "| hidden | named | re-simulated / reported gap | true motor's / reported gap | reported gap / floor |",
        "|---|---:|---:|---:|---:|",
    ]
    print("\n".join(lines), flush=True)
    every: list[float] = []
    for hidden in ROWS:
        rows = [one(hidden, seed) for seed in range(options.motors)]
        ratios = [again / gap for _, gap, again, _, _ in rows]
        every += [ratio for ratio, row in zip(ratios, rows, strict=True) if row[0]]
        lines.append(
            f"| {' + '.join(hidden) or 'nothing'} | {sum(row[0] for row in rows)} of {len(rows)} "
            f"| {furthest(ratios):.4f} | {furthest([truth / gap for _, gap, _, truth, _ in rows]):.4f} "
            f"| {furthest([gap / floor for _, gap, _, _, floor in rows]):.3f} |"
        )
        print(lines[-1], flush=True)
    inside = sum(0.98 < ratio < 1.02 for ratio in every)
    lines += [
        "",
        f"- where the effect was named correctly: {inside} of {len(every)} within 2 %, from {min(every):.4f} to "
        f"{max(every):.4f}",
    ]
    print(lines[-1])
    RESULTS.parent.mkdir(exist_ok=True)
    RESULTS.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return 0


def furthest(ratios: list[float]) -> float:
    """The one that is furthest from 1."""
    return max(ratios, key=lambda ratio: abs(np.log(ratio)))


if __name__ == "__main__":
    sys.exit(main())
