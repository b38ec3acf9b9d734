"""Find that speeds were counted for less than a row, where the counts of a turn are known, by the steps they come in.

A program that counts for 10 ms, and writes a row every 50, has speeds of whole counts within 10 ms: multiples of a step
that is larger than one count within a row, however the time that it measured for them blurs each. The values of one
number of counts share what is off of it, so that their median is one piece of evidence, as a level is of a lattice
(`value_lattice.py`).
"""

from math import e, log, sqrt, tau

import numpy as np

from motor_identification.recording import Floats
from motor_identification.sensor.value_lattice import CHANCE, FINEST, LEAST_PLACES, LEAST_SCATTER, MOST_SCATTER, SCAN

# Times one count within a row, that a step is at least: a loop's rows are no more uneven, nor their usual length off.
LEAST_RATIO = 1.4
MOST_VALUES = 1000  # that are looked at, at random
NEAR, MOSTLY = 0.1, 0.9  # of a step, so near to whole ones most values are
AS_WHOLE = 0.03  # within so much a step may be that of a turn with a whole part of the edges


def find_step_ratio(values: Floats, count: float) -> float:
    """Find how many times one count within a row the step is that values (K,) come in; 0 where they come in no larger.

    count: in the values' unit.
    """
    sizes = np.abs(values[values != 0.0])
    if len(sizes) > MOST_VALUES:
        sizes = np.random.default_rng(0).choice(sizes, MOST_VALUES, replace=False)
    top = float(sizes.max(initial=0.0))
    finest = min(FINEST, top / (LEAST_RATIO * count)) if count > 0.0 else 0.0
    tried = np.arange(LEAST_PLACES, finest, SCAN) / top if top > 0.0 else sizes[:0]
    near = [1.0 / float(one) for one in tried if _are_near(sizes, 1.0 / float(one))]
    steps = {_refine(sizes, _refine(sizes, step)) for step in near}
    found = [(_measure_scatter(sizes, step, len(tried)), -step) for step in steps if _are_near(sizes, step)]
    scatter, below = min(found, default=(1.0, 0.0))  # of equals the largest: its half fits as well
    return -below / count if scatter < MOST_SCATTER and -below >= LEAST_RATIO * count else 0.0


def may_be_other_edges(ratio: float, edges: int) -> bool:
    """Whether a step so many times one count may be that of a turn with a whole part of the edges that were said.

    Half or a quarter of them is one channel's rising ones.
    """
    parts = round(ratio)
    return parts > 1 and edges % parts == 0 and abs(ratio / parts - 1.0) < AS_WHOLE


def _are_near(sizes: Floats, step: float) -> bool:
    """Whether most of the sizes (K,) are near to whole steps."""
    return float(np.mean(np.abs(sizes / step - np.rint(sizes / step)) < NEAR)) >= MOSTLY


def _refine(sizes: Floats, step: float) -> float:
    """Least squares of the median of each number of steps, which is that many steps."""
    numbers, middles = _find_middles(sizes, step)
    return float(numbers @ middles / (numbers @ numbers))


def _find_middles(sizes: Floats, step: float) -> tuple[Floats, Floats]:
    """Find the numbers of steps (N,) that sizes above 0 are nearest to, and the median of each one's sizes."""
    nearest = np.rint(sizes / step)
    numbers = np.unique(nearest[nearest > 0.0])
    return numbers, np.array([np.median(sizes[nearest == number]) for number in numbers])


def _measure_scatter(sizes: Floats, step: float, tried: int) -> float:
    """Measure what the medians of each number of steps scatter by, in steps; 1 where chance makes that, of so many."""
    numbers, middles = _find_middles(sizes, step)
    scatter = max(sqrt(float(np.mean((middles / step - numbers) ** 2))), LEAST_SCATTER) if len(numbers) else 1.0
    likely = len(numbers) >= LEAST_PLACES and -log(scatter * sqrt(tau * e)) * len(numbers) > log(tried / CHANCE)
    return scatter if likely else 1.0
