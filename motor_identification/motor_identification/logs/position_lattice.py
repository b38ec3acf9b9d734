"""Find the lattice that sampled positions lie on: the step of an encoder, of a converter or of printed digits."""

from dataclasses import dataclass
from math import sqrt

import numpy as np

from motor_identification.logs.signals import Floats
from motor_identification.sensor.value_lattice import LEAST_PLACES, find_lattice

LEAST_LEVELS = 10  # different values, fewer of which show no steps
ON_GRID = 0.05  # counts: how far positions may lie beside whole counts before the user is told
MOST_DIGITS = 1e15  # that a number has without a rounding of its own
FARTHEST = 1e100  # in any unit: the squares of larger numbers are no numbers, and no encoder counts that far


@dataclass(frozen=True)
class Lattice:
    """Multiples of a step, beside 0 by an origin."""

    step: float  # in the positions' unit
    error: float  # standard error of the step
    origin: float  # within half a step of 0

    def holds(self, values: Floats) -> bool:
        """Whether all values, shape (K,), lie on it but for printed digits."""
        exact = (values - self.origin) / self.step
        return bool(np.max(np.abs(exact - np.rint(exact))) < 2 * ON_GRID)


def printed_digit(values: Floats) -> float:
    """The place of the last digit that values, shape (K,), were printed with, down to 1e-6; 0 where they have more."""
    for place in range(7):
        scaled = values * 10.0**place
        if np.all(np.abs(scaled - np.rint(scaled)) < 1e-4):
            return float(10.0**-place)
    return 0.0


def position_step(values: Floats) -> float:
    """Find the smallest step of positions, or that of their printed digits; 0 where there is none."""
    lattice = find_position_lattice(values)
    return lattice.step if lattice else 0.0


def find_position_lattice(values: Floats) -> Lattice | None:
    """Find the lattice of positions, shape (K,), by their smallest step.

    Where no two positions are one step apart, by what all the ways from row to row are multiples of.
    """
    if not np.all(np.abs(values) < FARTHEST):
        return None
    return _lattice_of_neighbours(values) or _lattice_of_ways(values)


def _lattice_of_ways(values: Floats) -> Lattice | None:
    """What all ways from row to row are multiples of, if all positions are, too.

    Those of a motor that runs evenly are a few: not how many differ, but how many positions fit shows a lattice.
    """
    ways = np.diff(values)
    if len(np.unique(values)) < LEAST_LEVELS:
        return None
    step = find_lattice(ways) or _common_digits(ways)
    if step == 0.0:
        return None
    numbers, first = np.unique(np.append(0.0, np.cumsum(np.rint(ways / step))), return_index=True)
    lattice = _fit_lattice(values[first], numbers)
    return lattice if lattice.holds(values) else None


def _common_digits(ways: Floats) -> float:
    """What a few different ways, shape (L,), have in common of their printed digits; 0 where they have more."""
    digit = printed_digit(ways)
    if digit == 0.0 or np.max(np.abs(ways)) > MOST_DIGITS * digit:
        return 0.0
    different = np.unique(np.rint(np.abs(ways) / digit).astype(np.int64))
    return digit * float(np.gcd.reduce(different)) if len(different) < LEAST_PLACES else 0.0


def _lattice_of_neighbours(values: Floats) -> Lattice | None:
    """The smallest step between the levels of all positions, if all steps are multiples of it."""
    levels = np.unique(values)
    if len(levels) < LEAST_LEVELS:
        return None
    steps = np.diff(levels)
    real = steps > 1e-9 * np.ptp(levels)
    levels, steps = levels[np.append(True, real)], steps[real]
    step = _common_step(steps)
    lattice = _fit_lattice(levels, np.append(0.0, np.cumsum(np.rint(steps / step))))
    return lattice if lattice.holds(levels) else None  # steps have the rounding of two levels each


def _common_step(steps: Floats) -> float:
    """What all steps, shape (L,), are about multiples of: by the smallest, then by ever larger ones, more exactly."""
    smallest = float(np.min(steps))
    step, reach = float(np.mean(steps[steps < 1.5 * smallest])), 2.0
    while reach * step < 2.0 * np.max(steps):
        near = steps[steps <= reach * step]
        numbers = np.rint(near / step)
        step, reach = float(numbers @ near / (numbers @ numbers)), 2.0 * reach
    return step


def _fit_lattice(levels: Floats, numbers: Floats) -> Lattice:
    """Least squares of levels = origin + number × step, both of shape (L,); each level once, as its digits were."""
    centred = numbers - numbers.mean()
    spread = float(centred @ centred)
    step = float(centred @ levels) / spread
    left = levels - levels.mean() - step * centred
    error = sqrt(float(left @ left) / max(len(levels) - 2, 1) / spread)
    origin = float(levels.mean() - step * numbers.mean())
    origin -= step * round(origin / step)
    return Lattice(step, error, origin if abs(origin) > ON_GRID * step else 0.0)
