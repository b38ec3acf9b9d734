"""Does the diagnosis name what was hidden? A confusion table over the random motors of `hidden.py`."""

import argparse
import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import hidden
import numpy as np
from hidden import BESIDE, OUTSIDE, PAIRS, SIZES, Outcome, right
from machine import commit, machine

RESULTS = Path(__file__).with_name("results") / "diagnosis.md"
PROMISED = {"nothing": 0.98, "single": 0.97, "pair": 0.9, "outside the table": 0.9}
HEAD = (
    "| hidden | right | else named (verdict) | gap after / floor | median error | within 5 % or 3 σ | time |",
    "|---|---:|---|---:|---:|---:|---:|",
)
NOTE = """
Outside the table a friction's `ks` is compared with the plant's even part of it alone: `angle_friction` adds up to
0.8 V that varies with the angle, 0.2 to 0.4 V in the mean, which the `ks` that is found contains.
"""
Row = tuple[str, tuple[str, ...], int]  # group, what is hidden, how many motors


def rows(many: int, nothing: int) -> list[Row]:
    """The whole table's plan."""
    return [
        ("nothing", (), nothing),
        *(("single", (name,), many) for name in SIZES),
        *(("pair", pair, many) for pair in PAIRS),
        *(("outside the table", (name,), many) for name in OUTSIDE),
        *(("outside, beside one inside", pair, many) for pair in BESIDE),
    ]


def errors(outcomes: list[Outcome], good: list[bool]) -> list[float]:
    """Of the parameters of what was named right, relative."""
    return [abs(e) for outcome, ok in zip(outcomes, good, strict=True) if ok for e in outcome.errors]


def line(what: tuple[str, ...], outcomes: list[Outcome], good: list[bool]) -> str:
    """A row of the table."""
    both = list(zip(outcomes, good, strict=True))
    wrong = Counter(f"{' + '.join(outcome.named) or '–'} ({outcome.verdict})" for outcome, ok in both if not ok)
    sizes, trusted = errors(outcomes, good), [t for outcome, ok in both if ok for t in outcome.trusted]
    cells = [
        " + ".join(what) or "nothing",
        f"{sum(good)} of {len(good)}",
        "; ".join(f"{n} × {name}" for name, n in wrong.items()),
        f"{np.median([outcome.gap for outcome in outcomes]):.2f}",
        *((f"{np.median(sizes):.1e}", f"{np.mean(trusted):.0%}") if sizes else ("–", "–")),
        f"{np.median([outcome.seconds for outcome in outcomes]):.1f} s",
    ]
    return "| " + " | ".join(cells) + " |"


def claims(groups: dict[str, list[bool]], sizes: list[float]) -> list[str]:
    """What the groups show, beside what is promised of them."""
    lines = []
    for group, good in groups.items():
        share = np.mean(good)
        promise = PROMISED.get(group)
        holds = "" if promise is None else f" (required: at least {promise:.0%}: {_holds(bool(share >= promise))})"
        lines.append(f"- {group}: {sum(good)} of {len(good)}, {share:.1%}{holds}")
    if sizes:
        lines.append(f"- parameters of what was named: median relative error {np.median(sizes):.1e}")
    return lines


def _holds(does: bool) -> str:
    return "holds" if does else "does not hold"


def table(plan: list[Row], first: int, lines: list[str]) -> list[str]:
    """Run the plan with motors from a first seed on, print and append a line for each row; the claims."""
    groups: dict[str, list[bool]] = {}
    sizes: list[float] = []
    with ProcessPoolExecutor(2) as pool:
        jobs = [
            (group, what, [pool.submit(hidden.one, what, seed) for seed in range(first, first + n)])
            for group, what, n in plan
        ]
        for group, what, futures in jobs:
            outcomes = [future.result() for future in futures]
            good = [right(what, outcome) for outcome in outcomes]
            groups.setdefault(group, []).extend(good)
            sizes += errors(outcomes, good)
            lines.append(line(what, outcomes, good))
            print(lines[-1], flush=True)
    return claims(groups, sizes)


def main() -> int:
    """Print and write the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--motors", type=int, default=5, help="for each row (default 5)")
    parser.add_argument("--nothing", type=int, default=50, help="motors in which nothing is hidden (default 50)")
    parser.add_argument("--first-seed", type=int, default=0, help="of the motors (default 0)")
    parser.add_argument("--only", metavar="A+B", help="one row alone, such as dead_zone; not written")
    options = parser.parse_args()
    plan = rows(options.motors, options.nothing)
    if options.only:
        plan = [row for row in plan if "+".join(row[1]) == options.only]
    many = f"{options.motors} motors a row, commit {commit()}, seeds from {options.first_seed} on"
    lines = ["# Diagnosis: what was hidden, and what was named", ""]
    lines += [f"{machine()}; two diagnoses at a time, one core each; {many}.", "", *HEAD]
    print("\n".join(lines), flush=True)
    told = table(plan, options.first_seed, lines)
    print("\n".join(told))
    if not options.only:
        RESULTS.write_text("\n".join([*lines, NOTE, *told]) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
