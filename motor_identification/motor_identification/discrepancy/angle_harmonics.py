"""Find harmonics of the shaft's angle in the residual: does it repeat with every turn, and how often in a turn?"""

from dataclasses import dataclass
from math import pi

import numpy as np

from motor_identification.discrepancy.operating_conditions import OperatingConditions, find_conditions
from motor_identification.recording import Floats, Integers
from motor_identification.validation.held_out import HeldOut

LEARNING_BLOCK = 0.3  # [s] learnt from and judged by, in turns
MOST_CYCLES = 24  # a turn: from there on it is the slots themselves that repeat
HARMONIC_GAP = 2.0  # times the floor, below which it is not worth asking
LINE_CONTRAST = 3.0  # times what waves between the lines explain
CHANCE_SHARE = 0.004  # of the excess: what they explain by chance
LEAST_RUN_INTERVALS = 100  # intervals of a run from which on it is worth asking
MOST_RUNS_USED = 40


@dataclass(frozen=True)
class AngleHarmonic:
    """A line at so many cycles a turn, in every run of the measured angle with a phase of its own."""

    cycles: int
    share: float  # of the excess (in squares); learnt on every other block of time, counted on the rest


def find_angle_harmonic(held: HeldOut, share: float) -> AngleHarmonic | None:
    """Find the strongest line; None where there is none. `share`: irregularity behind the floor, of a slot.

    What moves slowly can be imitated by any wave; so a line has to explain more than waves that fall between the lines.
    """
    seen = find_conditions(held)
    squares = seen.duration * (held.residuals**2 - held.floors(share) ** 2)
    chosen = _longest_runs(seen)
    if not chosen or held.gap < HARMONIC_GAP * held.floor(share):
        return None
    lines = np.arange(1, count_visible_cycles(seen) + 1)
    if not len(lines):
        return None
    explained = [_share(held, seen, squares, chosen, float(cycles)) for cycles in lines]
    imitated = max(_share(held, seen, squares, chosen, cycles - 0.5) for cycles in lines)
    best = int(np.argmax(explained))
    return (
        AngleHarmonic(int(lines[best]), min(explained[best], 1.0))
        if explained[best] > LINE_CONTRAST * max(imitated, CHANCE_SHARE)
        else None
    )


def count_visible_cycles(seen: OperatingConditions) -> int:
    """Count the cycles a turn that intervals still show: half a wave in most of those in motion."""
    travel = np.abs(seen.speed * seen.duration)
    moving = travel[travel > 0.0]
    return min(int(pi / float(np.median(moving))), MOST_CYCLES) if len(moving) else 0


def _longest_runs(seen: OperatingConditions) -> list[Integers]:
    """Which intervals belong to each of the longest runs of the measured angle: from one to the next it may slip."""
    numbers, sizes = np.unique(seen.run, return_counts=True)
    longest = numbers[np.argsort(-sizes, kind="stable")[:MOST_RUNS_USED]]
    order = np.argsort(seen.run, kind="stable")
    bounds = np.searchsorted(seen.run[order], np.column_stack([longest, longest + 1]))
    return [order[low:high] for low, high in bounds if high - low >= LEAST_RUN_INTERVALS]


def _share(held: HeldOut, seen: OperatingConditions, squares: Floats, runs: list[Integers], cycles: float) -> float:
    """Of the excess, what waves of so many cycles a turn explain in blocks of time that they were not learnt on."""
    size = np.abs(seen.speed) / max(float(np.abs(seen.speed).max(initial=0.0)), 1e-9)
    waves = np.column_stack([np.sin(cycles * seen.angle), np.cos(cycles * seen.angle)])
    # A disc's error grows with speed, a torque's falls.
    return max(_of_one_law(held, seen, squares, runs, waves * law[:, None]) for law in (size, 0.05 / (size + 0.05)))


def _of_one_law(
    held: HeldOut, seen: OperatingConditions, squares: Floats, runs: list[Integers], waves: Floats
) -> float:
    explained = total = 0.0
    for run in runs:
        first = np.floor(seen.time[run] / LEARNING_BLOCK) % 2 == 0
        learnt, judged = run[first], run[~first]
        if min(len(learnt), len(judged)) > LEAST_RUN_INTERVALS // 4:
            explained += _explained(waves, held.residuals, seen.duration, learnt, judged)
            total += float(squares[judged].sum())
    return explained / total if total > 0.0 else 0.0


def _explained(columns: Floats, left: Floats, duration: Floats, learnt: Integers, judged: Integers) -> float:
    """[rad²/s] by how much the line learnt in some intervals lowers the squares of others."""
    root = np.sqrt(duration)
    line = np.linalg.lstsq(columns[learnt] * root[learnt, None], left[learnt] * root[learnt], rcond=1e-10)[0]
    rest = left[judged] - columns[judged] @ line
    return float(duration[judged] @ (left[judged] ** 2 - rest**2))
