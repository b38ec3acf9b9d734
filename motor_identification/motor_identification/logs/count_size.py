"""How large one count is, and how many there are in a turn: said, seen in the data, or fine enough to stand for it."""

from math import log10, pi

import numpy as np

from motor_identification.logs.form import CsvForm
from motor_identification.logs.signals import Floats
from motor_identification.sensor.value_lattice import find_lattice
from motor_identification.sensor.white_noise import estimate_white_noise
from motor_model.errors import RecordingError

# How far, relatively, the counts of a turn may be from those said or from a whole number: they scale what is measured
# where positions are counted, and only the noise floor where speeds are given.
AGREE_COUNTS, AGREE_SPEED = 1e-4, 1e-3
ON_GRID = 0.05  # counts: how far positions may lie beside whole counts before the user is told
MOST_EDGES = 10_000_000  # a turn: a finer encoder than is sold, and within what motor/info can say
LEAST_LEVELS = 10  # different values, fewer of which show no steps
# Counts from row to row, at most, where counts stand for a position without steps: as many as an encoder of a thousand
# lines has on such a motor. More would make a jump of every reversal, and are finer than any model.
COUNTS_A_ROW = 30.0
FINE = (360, 1_000_000)  # counts a turn that stand for a position without steps: at least, at most


def count_size(form: CsvForm, values: Floats, voltage: Floats) -> tuple[float, int, str]:
    """The size of one count in the form's unit, the counts of a turn, and in words where that comes from.

    Raises:
        RecordingError: it is not to be had, or contradicts the edges per revolution.
    """
    unit = form.unit_size
    if unit is None:  # the file counts by itself
        if form.edges_per_revolution is None:
            raise RecordingError("The size of a count is unknown: give --edges-per-revolution.")
        return form.count_quantum or 1.0, form.edges_per_revolution, ""
    turn = 2.0 * pi / unit / float(form.gear)  # of the encoder's shaft
    if form.count_quantum:
        return form.count_quantum, agree_on_edges(form, turn / form.count_quantum, AGREE_COUNTS), ""
    if form.edges_per_revolution:
        return turn / form.edges_per_revolution, form.edges_per_revolution, ""
    step = position_step(values)
    if step > 0.0:
        edges = turn / step
        if abs(edges - round(edges)) <= AGREE_COUNTS * edges and round(edges) >= 1:
            return step, round(edges), " (assumed: the smallest step in the data)"
        if edges < MOST_EDGES:  # such as a gear's ratio: the counts of a turn need not be whole to be fine
            return _fine(
                turn, step, f" (assumed: values are multiples of {step:.4g} {form.unit}, no whole share of a turn)"
            )
    noise = estimate_white_noise(values, voltage)
    coarse = max(noise, float(np.quantile(np.abs(np.diff(values)), 0.9)) / COUNTS_A_ROW)
    return _fine(turn, coarse, f" (assumed: the values show no steps, and noise of {noise:.2g} {form.unit})")


def position_step(values: Floats) -> float:
    """The smallest step of positions, or that of their printed digits; 0 where there is none.

    Where no two positions are one step apart, what all the ways from row to row are multiples of.
    """
    return _step_of_neighbours(values) or _step_of_ways(values)


def _step_of_ways(values: Floats) -> float:
    """What all ways from row to row are multiples of, if all positions are, too; else 0."""
    ways = np.diff(values)
    if len(np.unique(ways)) < LEAST_LEVELS:
        return 0.0
    step = find_lattice(ways)
    if step == 0.0:
        return 0.0
    numbers = np.cumsum(np.rint(ways / step))
    places = values[1:] - values[0]
    step = float(numbers @ places / (numbers @ numbers))
    return step if np.max(np.abs(places / step - numbers)) < 2 * ON_GRID else 0.0


def _step_of_neighbours(values: Floats) -> float:
    """The smallest step between the levels of all positions, if all steps are multiples of it; else 0."""
    levels = np.unique(values)
    if len(levels) < LEAST_LEVELS:
        return 0.0
    steps = np.diff(levels)
    steps = steps[steps > 1e-9 * np.ptp(levels)]
    step = float(np.min(steps))
    near = steps[steps < 1.5 * step]
    step = float(np.mean(near))
    numbers = np.cumsum(np.rint(steps / step))
    places = levels[-1] - levels[0] if not len(numbers) else np.concatenate(([0.0], np.cumsum(steps)))
    step = float(numbers @ places[1:] / (numbers @ numbers))
    beside = np.diff(places) / step
    return step if np.max(np.abs(beside - np.rint(beside))) < 2 * ON_GRID else 0.0


def _fine(turn: float, size: float, how: str) -> tuple[float, int, str]:
    """Counts fine enough to stand for values without steps, whose noise or step is `size`."""
    wanted = turn / size if size > 0.0 else float(FINE[1])
    edges = int(min(max(wanted, FINE[0]), FINE[1]))
    digits = 10 ** max(int(log10(edges)) - 1, 0)
    edges = edges // digits * digits
    return turn / edges, edges, how


def agree_on_edges(form: CsvForm, exact: float, tolerance: float) -> int:
    """Whole counts of a turn, if a count's size leads to them and they are those that were said.

    Raises:
        RecordingError: it does not.
    """
    edges = form.edges_per_revolution or max(round(min(exact, MOST_EDGES + 1.0)), 1)
    if edges > MOST_EDGES:
        raise RecordingError(
            f"The counts come to {exact:.3g} per revolution, more than any encoder has: check --count-quantum."
        )
    if abs(exact - edges) > tolerance * edges:
        expected = f"{edges}" if form.edges_per_revolution else "a whole number"
        raise RecordingError(
            f"The counts come to {exact:.6g} per revolution, not {expected}: "
            "check --count-quantum, --edges-per-revolution and --unit."
        )
    return edges
