"""Motors of any size on our own board: does the diagnosis name what was hidden in them?

Supplies of 1.2 to 48 V, top speeds of 3 to 6,000 rad/s, time constants of 5 ms to 2 s, 6 to 8,192 edges a turn of one
or both channels, 20 to 1,000 Hz, irregular discs, and beside most a random torque of up to 1.5 % of the supply. One
effect of the table, two, none, or physics that the table does not have. Sizes of effects are those of the confusion
table (`hidden.py`), in shares of the motor's own supply, top speed and time constant. The tests' independent plant.
"""

from collections import Counter
from pathlib import Path

import numpy as np
from any_motor_cases import Case, draw, group, recorded
from hidden import Found, find, right, wrong
from machine import commit, machine
from seeded_cases import run_seeds

RESULTS = Path(__file__).with_name("results") / "any_motor.md"
KINDS = ("right", "right, not all", "silent", "wrong")


def one(seed: int) -> tuple[Case, Found]:
    """Draw and record a motor, and diagnose."""
    case = draw(seed)
    return case, find(*recorded(case), case.torque * case.supply)


def kind(case: Case, answer: Found) -> str:
    """Right as the confusion table has it; a wrong name is one that is not there."""
    if right(case.hidden, answer):
        return "right"
    if wrong(case.hidden, answer.named):
        return "wrong"
    return "right, not all" if answer.named else "silent"


def table(cases: list[tuple[Case, Found]]) -> list[str]:
    """How many of each kind, and every case that is not right."""
    lines = ["| hidden | " + " | ".join(KINDS) + " |", "|---" * (len(KINDS) + 1) + "|"]
    for name in ("nothing", "single", "pair", "outside the table"):
        count = Counter(kind(case, answer) for case, answer in cases if group(case) == name)
        lines.append(f"| {name} | " + " | ".join(str(count[one]) for one in KINDS) + " |")
    strength = [answer.strength for case, answer in cases if kind(case, answer) == "right" and answer.strength > 0.0]
    if strength:
        low, middle, high = np.percentile(strength, [10, 50, 90])
        lines += [
            "",
            f"Strength of the torque, found over true: {middle:.2f} in the median, 80 % in {low:.2f}–{high:.2f}.",
        ]
    seconds = [answer.seconds for _, answer in cases]
    lines += [f"CPU time of a diagnosis: {np.median(seconds):.0f} s in the median, {max(seconds):.0f} s at most.", ""]
    lines += [
        "| seed | motor and board | hidden | | named (verdict) | gap after / floor |",
        "|---|---|---|---|---|---:|",
    ]
    lines += [
        f"| {case.seed} | {case.describe()} | {' + '.join(case.hidden) or 'nothing'} | {kind(case, answer)} "
        f"| {' + '.join(answer.named) or '–'} ({answer.verdict}) | {answer.gap:.2f} |"
        for case, answer in cases
        if kind(case, answer) != "right"
    ]
    return lines


def say(outcome: tuple[Case, Found]) -> str:
    """Say an outcome in a line."""
    case, answer = outcome
    return (
        f"{case.seed}: {kind(case, answer)}: {case.describe()}: {'+'.join(case.hidden) or 'nothing'} -> "
        f"{'+'.join(answer.named) or '–'} ({answer.verdict}), gap {answer.gap:.2f}, strength "
        f"{answer.strength:.2f}, {answer.seconds:.0f} s"
    )


def page(outcomes: list[tuple[Case, Found]], first: int) -> str:
    """The whole page."""
    seeds = f"seeds {first} to {first + len(outcomes) - 1}"
    head = f"{machine()}; simulated by the tests' plant; commit {commit()}, {seeds}."
    return "\n".join(["# Motors of any size", "", head, "", *table(outcomes)]) + "\n"


def main() -> None:
    """Print the cases as they come, and write the page."""
    run_seeds(one, say, page, RESULTS, __doc__.split("\n")[0], 60)


if __name__ == "__main__":
    main()
