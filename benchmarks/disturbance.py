"""Does the diagnosis name what was hidden beside a random torque? The motors of `hidden.py`, with a torque each.

Sizes are those of the confusion table, and at least twice the smallest that is found beside such a torque (`power.py`);
the torque is an Ornstein-Uhlenbeck voltage of the tests' independent plant, another course of it in training and
validation. Seeds that no page had before are drawn by `--first-seed`.
"""

import argparse
import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np
from hidden import OUTSIDE, PAIRS, SIZES, Found, Torque, find, recorded, right, wrong
from machine import commit, machine

RESULTS = Path(__file__).with_name("results") / "disturbance.md"
TORQUES = (Torque(0.03, 0.05), Torque(0.1, 0.005), Torque(0.1, 0.05), Torque(0.1, 0.2), Torque(0.3, 0.05))
GROUPS: dict[str, tuple[tuple[str, ...], ...]] = {
    "nothing": ((),),
    "single": tuple((name,) for name in SIZES),
    "pair": tuple(PAIRS),
    "outside the table": tuple((name,) for name in OUTSIDE),
}
HEAD = (
    "| torque | hidden | right | wrong names | else (verdict: named) | strength found / true | CPU time |",
    "|---|---|---:|---:|---|---:|---:|",
)


def one(hidden: tuple[str, ...], seed: int, torque: Torque) -> Found:
    """Hide it in a random motor beside a torque, and diagnose."""
    made = recorded(hidden, seed, None, torque)
    return find(made.training, made.validation, torque.rms)


def line(torque: Torque, group: str, outcomes: list[tuple[tuple[str, ...], Found]]) -> str:
    """A row of the table."""
    good = [right(hidden, found) for hidden, found in outcomes]
    missed = Counter(
        f"{'+'.join(hidden) or 'nothing'} ({found.verdict}: {' + '.join(found.named) or '–'})"
        for (hidden, found), ok in zip(outcomes, good, strict=True)
        if not ok
    )
    misnamed = sum(wrong(hidden, found.named) for hidden, found in outcomes)
    strength = np.array([found.strength for (_, found), ok in zip(outcomes, good, strict=True) if ok])
    known = strength[np.isfinite(strength)]
    cells = [
        f"{torque.rms:g} V, {torque.time * 1e3:g} ms",
        group,
        f"{sum(good)} of {len(good)}",
        str(misnamed),
        "; ".join(f"{count} × {what}" if count > 1 else what for what, count in missed.items()),
        f"{np.median(known):.2f} ({known.min():.2f}–{known.max():.2f})" if len(known) else "–",
        f"{np.median([found.seconds for _, found in outcomes]):.0f} s",
    ]
    return "| " + " | ".join(cells) + " |"


def main() -> int:
    """Print the rows as they come, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--motors", type=int, default=1, help="of each kind, beside each torque (default 1)")
    parser.add_argument("--first-seed", type=int, default=9000, help="of the motors (default 9000)")
    parser.add_argument("--torques", type=int, nargs="+", default=list(range(len(TORQUES))), help="which of the table")
    parser.add_argument("--groups", nargs="+", choices=list(GROUPS), default=list(GROUPS), help="rows of each torque")
    options = parser.parse_args()
    head = [
        "# Diagnosis beside a random torque",
        "",
        f"Simulated motors of the tests' independent plant; commit {commit()}, seeds from {options.first_seed} on, "
        f"{options.motors} motor{'s' * (options.motors > 1)} of each kind; {machine()}; two diagnoses at a time.",
        "",
        *HEAD,
    ]
    print("\n".join(head), flush=True)
    rows: list[str] = []
    with ProcessPoolExecutor(2) as pool:
        jobs = [
            (torque, group, [
                (hidden, pool.submit(one, hidden, options.first_seed + seed, torque))
                for hidden in GROUPS[group] for seed in range(options.motors)
            ])
            for torque in (TORQUES[i] for i in options.torques) for group in options.groups
        ]  # fmt: skip
        for torque, group, futures in jobs:
            rows.append(line(torque, group, [(hidden, future.result()) for hidden, future in futures]))
            print(rows[-1], flush=True)
            RESULTS.write_text("\n".join([*head, *rows]) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
