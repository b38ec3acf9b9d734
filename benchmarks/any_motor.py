"""Motors of any size on our own board: does the diagnosis name what was hidden in them?

Supplies of 1.2 to 48 V, top speeds of 3 to 6,000 rad/s, time constants of 5 ms to 2 s, 6 to 8,192 edges a turn of one
or both channels, 20 to 1,000 Hz, irregular discs, and beside most a random torque of up to 1.5 % of the supply. One
effect of the table, two, none, or physics that the table does not have. Sizes of effects are those of the confusion
table (`hidden.py`), in shares of the motor's own supply, top speed and time constant. The tests' independent plant.
"""

import argparse
import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from time import process_time

import numpy as np
from hidden import FRICTION, OUTSIDE, PAIRS, SIZES, Outcome, right
from machine import commit, machine
from numpy.typing import NDArray
from plant import profiles, record

from motor_identification.diagnose import diagnose
from motor_identification.recording import check

RESULTS = Path(__file__).with_name("results") / "any_motor.md"
RATES = (20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)  # [Hz]
EDGES = (6, 8, 12, 20, 48, 96, 200, 500, 1000, 2048, 2880, 8192)
USUAL = np.array([12.0, 174.0, 0.1])  # [V], [rad/s], [s] of the motor that the confusion table's sizes are made for
FASTEST = 40_000.0  # [1/s] edges that a timer's capture keeps up with
MOST_EDGES = 5_000.0  # in a time constant at top speed: half a million of a recording
SAMPLES = 100.0  # of a time constant at most: 28,000 of a recording
KINDS = ("right", "right, not all", "silent", "wrong")
# How a size grows with [V], [rad/s] and [s] of the motor; what is not here is a share.
GROWTH: dict[str, tuple[float, float, float]] = {
    **dict.fromkeys(
        ("ks", "breakaway_voltage", "bias_voltage", "step_voltage", "dead_zone_voltage", "limit_voltage",
         "ripple_voltage", "angle_friction"),
        (1.0, 0.0, 0.0),
    ),
    **dict.fromkeys(("stribeck_speed",), (0.0, 1.0, 0.0)),
    "drag": (1.0, -2.0, 0.0),
    **dict.fromkeys(("step_time", "electrical_time_constant", "delay", "warm_up_time"), (0.0, 0.0, 1.0)),
    **dict.fromkeys(("backlash_angle", "presliding_angle"), (0.0, 1.0, 1.0)),
    "ripple_cycles": (0.0, -1.0, -1.0),
    "compliance_stiffness": (1.0, -1.0, -1.0),
    "compliance_damping": (1.0, -1.0, 0.0),
    "supply_ripple_frequency": (0.0, 0.0, -1.0),
    "slew_rate": (1.0, 0.0, -1.0),
}  # fmt: skip


@dataclass(frozen=True)
class Case:
    """A motor, what is in it, and its board."""

    seed: int
    hidden: tuple[str, ...]
    values: dict[str, float]  # of the plant
    supply: float  # [V]
    top: float  # [rad/s]
    lag: float  # [s] the time constant
    edges: int
    single_channel: bool
    rate: float  # [Hz]
    irregularity: float  # of the disc, a share of a slot
    torque: float  # RMS, a share of the supply

    def describe(self) -> str:
        """Say what it is in half a line."""
        motor = f"{self.supply:.3g} V, {self.top:.3g} rad/s, {1e3 * self.lag:.3g} ms"
        board = f"{self.edges} edges{'' if self.single_channel else ' both ways'}, {self.rate:g} Hz"
        return f"{motor}; {board}; torque {100.0 * self.torque:.1f} %"


@dataclass(frozen=True)
class Answer:
    """What was made of it."""

    verdict: str
    named: tuple[str, ...]
    gap: float  # after, times the noise floor
    strength: float  # of the torque, found over true
    seconds: float  # of CPU time


def _between(random: np.random.Generator, low: float, high: float) -> float:
    """Uniform in the logarithm."""
    return float(low * (high / low) ** random.uniform())


def _hidden(random: np.random.Generator) -> tuple[str, ...]:
    """Nothing in one of eight, outside the table in one of eight, a pair in two, one effect in four."""
    match random.integers(8):
        case 0:
            return ()
        case 1:
            return (str(random.choice(list(OUTSIDE))),)
        case 2 | 3:
            return PAIRS[random.integers(len(PAIRS))]
        case _:
            return (str(random.choice(list(SIZES))),)


def _sizes(random: np.random.Generator, hidden: tuple[str, ...], ratio: NDArray[np.float64]) -> dict[str, float]:
    """Draw the sizes of effects for a motor of so many times the usual [V], [rad/s] and [s]."""
    return {
        parameter: float(random.uniform(*bounds) * np.prod(ratio ** np.array(GROWTH.get(parameter, (0.0, 0.0, 0.0)))))
        for name in hidden
        for parameter, bounds in (SIZES | OUTSIDE)[name].items()
    }


def draw(seed: int) -> Case:
    """Draw a case; the board reads the motor 3 to 100 times a time constant and sees ten edges in one at top speed."""
    random = np.random.default_rng([19, seed])
    supply, lag = _between(random, 1.2, 48.0), _between(random, 0.005, 2.0)
    rate = float(random.choice([rate for rate in RATES if min(3.0, RATES[-1] * lag) <= rate * lag <= SAMPLES]))
    while True:
        top, edges = _between(random, 3.0, 6000.0), int(random.choice(EDGES))
        turns = top * lag / (2.0 * np.pi)  # in a time constant at top speed
        if 10.0 <= turns * edges <= MOST_EDGES and turns * edges <= FASTEST * lag:
            break
    kv = supply / top
    values = {"kv": kv, "ka": kv * lag * random.uniform(0.8, 1.2), "max_voltage": supply}
    while True:
        hidden = _hidden(random)
        sizes = _sizes(random, hidden, np.array([supply, top, lag]) / USUAL)
        if 1.0 <= sizes.get("ripple_cycles", 1.0) <= edges / 3.0:  # a wave that motors have, and that the encoder sees
            break
    values |= sizes
    torque = float(random.choice([0.0, 0.0025, 0.008, 0.015]))
    if torque:
        values |= {"random_torque": torque * supply, "random_torque_time": lag * _between(random, 0.05, 2.0)}
    return Case(
        seed=seed,
        hidden=hidden,
        values=values,
        supply=supply,
        top=top,
        lag=lag,
        edges=edges,
        single_channel=bool(random.integers(2)),
        rate=rate,
        irregularity=float(random.uniform(0.0, 0.01)),
        torque=torque,
    )


def one(seed: int) -> tuple[Case, Answer]:
    """Record a motor twice, with commands as slow as it is, and diagnose."""
    case = draw(seed)
    slower = case.lag / USUAL[2]
    drives = profiles.rich(case.supply, seed), profiles.random(case.supply, 14.0, seed + 500)
    first, second = (
        check(
            record(
                case.values | later | ({"random_torque_seed": float(start)} if case.torque else {}),
                time * slower,
                volts,
                sample_rate=case.rate,
                seed=start,
                edges=case.edges,
                irregularity=case.irregularity,
                disc_seed=seed,
                single_channel=case.single_channel,
                step=min(4e-5 * slower, 4e-5 if case.edges * case.top > 1e4 else 1e-3),
            )[0]
        )
        for later, (time, volts), start in zip(_later(case, slower), drives, (seed, seed + 77), strict=True)
    )
    begun = process_time()
    found = diagnose([first], [second])
    strength = (
        found.disturbance.rms_voltage / (case.torque * case.supply) if found.disturbance and case.torque else np.nan
    )
    named = tuple(finding.effect for finding in found.findings)
    gap = found.gap_after / found.noise_floor if found.noise_floor > 0.0 else np.nan
    return case, Answer(found.verdict.value, named, gap, strength, process_time() - begun)


def _later(case: Case, slower: float) -> tuple[dict[str, float], dict[str, float]]:
    """What differs in training and validation: a load comes at another time."""
    if "step_time" not in case.values:
        return {}, {}
    return {}, {"step_time": (3.0 + case.seed % 6) * slower}


def kind(case: Case, answer: Answer) -> str:
    """Right as the confusion table has it; a wrong name is one that is not there."""
    if right(case.hidden, Outcome(answer.verdict, answer.named, (), (), 0.0, 0.0)):
        return "right"
    if set(answer.named) - set(case.hidden) - {FRICTION}:
        return "wrong"
    return "right, not all" if answer.named else "silent"


def group(case: Case) -> str:
    """Which of the four kinds of hidden things it has."""
    if not case.hidden:
        return "nothing"
    return "pair" if len(case.hidden) > 1 else "outside the table" if case.hidden[0] in OUTSIDE else "single"


def table(cases: list[tuple[Case, Answer]]) -> list[str]:
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


def main() -> int:
    """Print the cases as they come, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--cases", type=int, default=60, help="how many (default 60)")
    parser.add_argument("--first", type=int, default=0, help="seed of the first")
    options = parser.parse_args()
    cases = []
    with ProcessPoolExecutor(2) as pool:
        for case, answer in pool.map(one, range(options.first, options.first + options.cases)):
            cases.append((case, answer))
            print(
                f"{case.seed}: {kind(case, answer)}: {case.describe()}: {'+'.join(case.hidden) or 'nothing'} -> "
                f"{'+'.join(answer.named) or '–'} ({answer.verdict}), gap {answer.gap:.2f}, strength "
                f"{answer.strength:.2f}, {answer.seconds:.0f} s",
                flush=True,
            )
    last = options.first + options.cases - 1
    head = ["# Motors of any size", "", f"{machine()}; simulated by the tests' plant; commit {commit()}, seeds "]
    head[-1] += f"{options.first} to {last}."
    page = "\n".join([*head, "", *table(cases)]) + "\n"
    print(page)
    RESULTS.write_text(page, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
