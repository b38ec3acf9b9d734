"""Does the diagnosis name what was hidden beside a random torque? The motors of `hidden.py`, with a torque each.

Sizes are those of the confusion table, but at least twice the smallest that `power.py` found beside a torque of that
strength; the torque is an Ornstein-Uhlenbeck voltage of the tests' independent plant, another course of it in training
and validation. Seeds that no page had before are drawn by `--first-seed`.
"""

import argparse
import sys
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np
from hidden import OUTSIDE, PAIRS, SIZES, Found, Torque, drawn, find, generator, recorded, right, wrong
from machine import commit, machine
from power import SIZE, smallest_found

RESULTS = Path(__file__).with_name("results") / "disturbance.md"
STRENGTHS, TIMES = (0.03, 0.1, 0.3), (0.005, 0.05, 0.2)  # [V] RMS, [s]
GROUPS: dict[str, tuple[tuple[str, ...], ...]] = {
    "nothing": ((),),
    "single": tuple((name,) for name in SIZES),
    "pair": tuple(PAIRS),
    "outside the table": tuple((name,) for name in OUTSIDE),
}
# Where what is outside the table shows: "past" and "speed_voltage" are kinds of the drive's history.
DRIVE = {"drive", "past", "speed_voltage"}
VARIABLES = dict.fromkeys(OUTSIDE, DRIVE) | {"angle_friction": {"angle"}, "supply_ripple": {"time", "spectrum"}}
EXACT = {0.03: 0.95, 0.1: 0.9, 0.3: 0.8}  # of singles and pairs, as required
LEAST_OUTSIDE, MOST_WRONG, MOST_WRONG_OUTSIDE, STRENGTH = 0.9, 0.01, 0.02, 0.2
NOTHING = "nothing"
HEAD = (
    "| hidden | torque | right | wrong names | else (verdict: named) | strength found / true | CPU time |",
    "|---|---|---:|---:|---|---:|---:|",
)
Result = tuple[tuple[str, ...], Found]  # what was hidden, and what was found


def enlarged(hidden: tuple[str, ...], seed: int, rms: float) -> dict[str, float]:
    """Sizes of what is hidden that are drawn too small: twice the smallest found, at most the table's largest."""
    values, sizes = drawn(hidden, generator(hidden, seed)), {}
    for effect in hidden:
        if effect not in SIZE:
            continue  # outside the table
        least, none = smallest_found(effect, rms)
        name = SIZE[effect][0]
        none = values["ks"] if effect == "static_friction" else none
        if abs(values[name] - none) < 2.0 * least:
            sizes[name] = float(np.clip(none + np.copysign(2.0 * least, values[name] - none), *SIZES[effect][name]))
    return sizes


def one(hidden: tuple[str, ...], seed: int, torque: Torque) -> Found:
    """Hide it in a random motor beside a torque, and diagnose."""
    made = recorded(hidden, seed, enlarged(hidden, seed, torque.rms), torque)
    return find(made.training, made.validation, torque.rms)


def many(group: str, least: int, first: int) -> Iterator[tuple[tuple[str, ...], int]]:
    """At least so many motors: what is hidden in each, all of the group equally often, and its seed."""
    kinds = GROUPS[group]
    for round_ in range(-(-least // len(kinds))):
        yield from ((hidden, first + round_) for hidden in kinds)


def strengths(results: list[Result]) -> np.ndarray:
    """The torque's strength found over true, where a torque was found and nothing is outside the table."""
    found = [found.strength for hidden, found in results if right(hidden, found) and not set(hidden) & set(OUTSIDE)]
    return np.array([one for one in found if np.isfinite(one)])


def located(result: Result) -> bool:
    """Whether what is outside the table was seen, and over the variable in which it is."""
    (effect,), found = result
    return found.verdict == "unexplained" and found.variable in VARIABLES[effect]


def line(torque: Torque, group: str, results: list[Result]) -> str:
    """A row of the table."""
    good = [right(*result) for result in results]
    missed = Counter(
        f"{'+'.join(hidden) or NOTHING} ({found.verdict}: {' + '.join(found.named) or '–'})"
        for (hidden, found), ok in zip(results, good, strict=True)
        if not ok
    )
    known = strengths(results)
    cells = [
        group,
        f"{torque.rms:g} V, {torque.time * 1e3:g} ms",
        f"{sum(good)} of {len(good)}",
        str(sum(wrong(hidden, found.named) for hidden, found in results)),
        "; ".join(f"{count} × {what}" if count > 1 else what for what, count in missed.items()),
        f"{np.median(known):.2f} ({known.min():.2f}–{known.max():.2f})" if len(known) else "–",
        f"{np.median([found.seconds for _, found in results]):.0f} s",
    ]
    return "| " + " | ".join(cells) + " |"


def share(what: str, good: list[bool], limit: float, most: bool = False) -> str:
    """A share beside what is required of it."""
    mean = float(np.mean(good))
    holds = mean <= limit if most else mean >= limit
    required = f"{'at most' if most else 'at least'} {limit:.0%}: {'holds' if holds else 'does not hold'}"
    return f"{what} {sum(good)} of {len(good)}, {mean:.1%} (required: {required})"


def summary(rms: float, results: list[Result]) -> list[str]:
    """What all rows beside torques of one strength show, beside what is required."""
    inside = [result for result in results if not set(result[0]) & set(OUTSIDE)]
    effects = [result for result in inside if result[0]]
    outside = [result for result in results if set(result[0]) & set(OUTSIDE)]
    said = []
    if effects:
        said.append(share("named exactly", [right(*result) for result in effects], EXACT[rms]))
    if inside:
        said.append(share("a wrong name", [wrong(hidden, it.named) for hidden, it in inside], MOST_WRONG, most=True))
    if len(known := strengths(inside)):
        near = list(np.abs(known - 1.0) < STRENGTH)
        said.append(f"strength within {STRENGTH:.0%} of the true one in {sum(near)} of {len(near)}")
    if outside:
        said.append(share("outside the table, seen in its variable", [located(one) for one in outside], LEAST_OUTSIDE))
        misnamed = [wrong(hidden, it.named) for hidden, it in outside]
        said.append(share("outside, a wrong name", misnamed, MOST_WRONG_OUTSIDE, most=True))
        elsewhere = Counter(f"{one[0][0]} ({one[1].variable or '–'})" for one in outside if not located(one))
        said += [f"not so: {', '.join(f'{n} × {what}' for what, n in elsewhere.items())}"] * bool(elsewhere)
    return [f"- {rms:g} V: " + "; ".join(said)]


def page(first: int, rows: list[str], results: dict[float, list[Result]]) -> str:
    """The page so far."""
    return "\n".join([
        "# Diagnosis beside a random torque",
        "",
        "Simulated motors of the tests' independent plant, each effect at least twice as large as the smallest that is",
        "[found beside a torque of that strength](power.md), or as the largest of the confusion table; where that page",
        "has no entry, the smallest is taken to grow as the torque. What is outside the table is not enlarged.",
        f"Commit {commit()}, seeds from {first} on; {machine()}; two diagnoses at a time.",
        "",
        *(line for rms, ones in results.items() for line in summary(rms, ones)),
        "",
        *HEAD,
        *rows,
        "",
    ])  # fmt: skip


def main() -> int:
    """Print the rows as they come, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--motors", type=int, default=20, help="at least so many in each row (default 20)")
    parser.add_argument("--first-seed", type=int, default=9000, help="of the motors (default 9000)")
    parser.add_argument("--strengths", type=float, nargs="+", choices=STRENGTHS, default=STRENGTHS, metavar="V")
    parser.add_argument("--times", type=float, nargs="+", choices=TIMES, default=TIMES, metavar="S")
    parser.add_argument("--groups", nargs="+", choices=list(GROUPS), default=list(GROUPS), help="rows of each torque")
    parser.add_argument("--page", type=Path, default=RESULTS, help="where to write (default results/disturbance.md)")
    options = parser.parse_args()
    rows: list[str] = []
    results: dict[float, list[Result]] = {}
    print("\n".join(HEAD), flush=True)
    with ProcessPoolExecutor(2) as pool:
        jobs = [
            (torque, group, [
                (hidden, pool.submit(one, hidden, seed, torque))
                for hidden, seed in many(group, options.motors, options.first_seed)
            ])
            for group in options.groups
            for torque in (Torque(rms, time) for rms in options.strengths for time in options.times)
        ]  # fmt: skip
        for torque, group, futures in jobs:
            found = [(hidden, future.result()) for hidden, future in futures]
            results.setdefault(torque.rms, []).extend(found)
            rows.append(line(torque, group, found))
            print(rows[-1], flush=True)
            options.page.write_text(page(options.first_seed, rows, results), encoding="utf-8")
    print("\n".join(said for rms, ones in results.items() for said in summary(rms, ones)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
