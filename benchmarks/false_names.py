"""How often does the diagnosis name an effect where none is? Motors of any size in which nothing is hidden.

Half of them on boards of ours, of any size (`any_motor_cases.py`), with a second recording to validate by; half logged
as other people log, one excitation alone, imported without hints (`foreign_logs_cases.py`). Beside three of four runs
a random torque of up to 2.5 % of the supply. The tests' independent plant.
"""

import os
from dataclasses import dataclass, replace
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices

import any_motor_cases
import foreign_logs
import foreign_logs_cases
import numpy as np
from hidden import QUIET, find
from machine import commit, machine
from scipy.stats import binomtest
from seeded_cases import run_seeds

RESULTS = Path(__file__).with_name("results") / "false_names.md"
TORQUES = (0.0, 0.0025, 0.008, 0.025)  # RMS, shares of the supply
BOARD, LOG = "board of ours", "log of others"
PROMISED = 0.01  # of the recordings


@dataclass(frozen=True)
class Outcome:
    """What the diagnosis of a motor in which nothing is hidden said."""

    seed: int
    family: str
    torque: float  # RMS, a share of the supply
    said: str  # the names, or nothing
    verdict: str
    motor: str
    seconds: float  # of a processor


def one(seed: int) -> Outcome:
    """Draw a motor, on a board of ours or in a log of others by turns, and diagnose."""
    return _on_board(seed) if seed % 2 else _in_log(seed)


def _on_board(seed: int) -> Outcome:
    drawn = any_motor_cases.draw(seed)
    bare = {name: drawn.values[name] for name in ("kv", "ka", "max_voltage")}
    torque = TORQUES[seed // 2 % len(TORQUES)]
    correlation = drawn.lag * 10.0 ** np.random.default_rng(seed).uniform(-1.3, 0.3) if torque else QUIET.time
    case = replace(drawn, hidden=(), values=bare, torque=torque, correlation=float(correlation))
    found = find(*any_motor_cases.recorded(case), torque * case.supply)
    return Outcome(seed, BOARD, torque, " + ".join(found.named), found.verdict, case.describe(), found.seconds)


def _in_log(seed: int) -> Outcome:
    drawn = foreign_logs_cases.draw(seed)
    bare = {name: drawn.values[name] for name in ("kv", "ka", "max_voltage")}
    torque = TORQUES[seed // 2 % len(TORQUES)]
    if torque:
        time = drawn.lag * 10.0 ** np.random.default_rng(seed).uniform(-1.0, 0.5)
        random = {"random_torque": torque * drawn.supply, "random_torque_time": float(time)}
        bare |= random | {"random_torque_seed": float(seed)}
    case = replace(drawn, hidden=(), values=bare, torque=torque * drawn.supply)
    found = foreign_logs.find(case)
    said, _, verdict = found.said.rpartition(" (")
    return Outcome(seed, LOG, torque, said.strip("–"), verdict.rstrip(")"), case.describe(), found.seconds)


def row(title: str, outcomes: list[Outcome]) -> str:
    """A row of the table: false names and false "unexplained", with the interval of the share."""
    names = sum(bool(one.said) for one in outcomes)
    share = binomtest(names, len(outcomes)).proportion_ci(0.95)
    unexplained = sum(one.verdict == "unexplained" for one in outcomes)
    undecided = sum(one.verdict == "undecided" for one in outcomes)
    seconds = np.median([one.seconds for one in outcomes])
    return (
        f"| {title} | {len(outcomes)} | {names} | {share.low:.1%} to {share.high:.1%} | {unexplained} | {undecided} "
        f"| {seconds:.0f} s |"
    )


def page(outcomes: list[Outcome], first: int) -> str:
    """The whole page."""
    groups = {"all": outcomes}
    groups |= {name: [one for one in outcomes if one.family == name] for name in (BOARD, LOG)}
    groups |= {f"torque {share:.2%}": [one for one in outcomes if one.torque == share] for share in TORQUES}
    false = [one for one in outcomes if one.said or one.verdict == "unexplained"]
    share = sum(bool(one.said) for one in outcomes) / len(outcomes)
    return "\n".join(
        [
            f"# {(__doc__ or '').splitlines()[0]}",
            "",
            f"`python benchmarks/false_names.py --cases {len(outcomes)} --first {first}`",
            f"(commit {commit()}; {machine()}).",
            *(__doc__ or "").splitlines()[1:],
            f"At most {PROMISED:.0%} of false names is asked for: {share:.2%}, "
            f"{'holds' if share <= PROMISED else 'does not hold'}. The interval is that of 95 % (Clopper and Pearson).",
            "",
            "| recordings | number | false names | share | false unexplained | undecided | CPU time |",
            "|---|---:|---:|---:|---:|---:|---:|",
            *(row(title, some) for title, some in groups.items() if some),
            "",
            *(f"- {one.seed}: {one.said or '–'} ({one.verdict}; {one.motor})" for one in false),
        ]
    ).rstrip("\n") + "\n"  # fmt: skip


def main() -> None:
    """Print the cases as they come, and write the page."""
    run_seeds(one, str, page, RESULTS, (__doc__ or "").splitlines()[0], 600)


if __name__ == "__main__":
    main()
