"""What a column of motion holds and in which unit, where its name does not say it: by what its numbers can be."""

from dataclasses import dataclass
from math import pi, sqrt, tau

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.correlation import correlate
from motor_identification.logs.count_size import FEWEST_COUNTS
from motor_identification.logs.form import UNITS, Kind
from motor_identification.logs.position_lattice import find_position_lattice
from motor_identification.logs.rows.wraps import RANGES, REACHED, SLACK
from motor_identification.sensor.value_lattice import find_lattice

Floats = NDArray[np.float64]

# How near the counts of a turn have to come to a whole number for a unit to be believed, and how far all others have
# to be from one: of any unit 3 % come that near by chance, by steps of positions, which are known better, 1 %. Of a
# finer encoder, printed digits leave too little.
WHOLE, WHOLE_BY_POSITIONS = 0.015, 0.004
RELATIVE = 5e-6  # of the counts of a turn: what printed digits leave of the step of speeds, and 3.1416 of radians
SURE = 4.0  # standard errors of the step
MOST_COUNTS = 10_000  # a turn
CLOCK = 3e-6  # of a row: how well the mean length of uneven ones is known at best; more than 5,000 counts are chance
MOST_TOLD = 4096  # a turn, by which columns without names are told: of more, 5 % come near to a whole number by chance
FEWEST_MAGNETS = 3  # counts a turn of a sensor that may be meant where steps are so coarse: of one or two magnets
FORGETS = 5.0  # time constants in a recording, from which on a column is a speed: a position forgets nothing
UNSURE = (1.0, 20.0)  # time constants that a column of either may seem to have
PROPORTIONAL = -0.99  # correlation of what such a controller drives with its output
ASKED = {Kind.SPEED: ("rad/s", "deg/s", "rpm"), Kind.POSITION: ("rad", "deg", "rev", "count")}
OF_COUNTS = ("count/s", "deg/s", "rpm")  # units of speeds of which one within a row may be what was counted
SLIDES = {Kind.SPEED: "mm/s or m/s", Kind.POSITION: "mm or m"}  # what moves along, and of no turn


@dataclass(frozen=True)
class Unit:
    """A unit, or those that it may be, and in words why."""

    name: str  # empty: the user has to say
    why: str
    candidates: tuple[str, ...] = ()


def guess_kind(values: Floats, drive: Floats) -> Kind:
    """Speed or position: a speed forgets what was (v' = −v/τ + …), a position keeps it. Both of shape (K,)."""
    return Kind.SPEED if _count_time_constants(values, drive) > FORGETS else Kind.POSITION


def is_kind_sure(values: Floats, drive: Floats) -> bool:
    """Whether it is clear which of both they are: a short run of a speed forgets little, a controlled position some.

    Under a proportional controller, whose output says the same as what it controls, neither tells what it forgets.
    """
    controlled = correlate(values, drive) < PROPORTIONAL
    return not controlled and not UNSURE[0] < _count_time_constants(values, drive) < UNSURE[1]


def _count_time_constants(values: Floats, drive: Floats) -> float:
    """How many time constants there are in a column, shape (K,), that forgets what was under a drive, shape (K,).

    Under a drive that is the same in all rows, as of a log of one step, those before the motor moves tell nothing: it
    was not there yet.
    """
    if np.ptp(drive) == 0.0 and (start := int(np.argmax(values != values[0]))):
        values, drive = values[start - 1 :], drive[start - 1 :]
    step = np.diff(values)
    columns = np.column_stack([values[:-1], drive[:-1], np.ones(len(step))])
    scale = np.max(np.abs(columns), axis=0)
    scale[scale == 0.0] = 1.0
    slope = np.linalg.lstsq(columns / scale, step, rcond=None)[0] / scale
    return -float(slope[0]) * len(step)


def guess_speed_unit(values: Floats, window: float, stamps: Floats | None = None) -> Unit:
    """The unit of speeds, shape (K,): the one in which their step is a whole share of a turn within the window [s].

    Times of the rows [s], shape (K,), whose lengths are their windows, say how well that is known.
    """
    asked = ASKED[Kind.SPEED]
    step = find_lattice(values) if len(values) > 20 and window > 0.0 else 0.0
    if step > 1.0 and abs(step * window - 1.0) < WHOLE:
        return Unit("", "", OF_COUNTS)  # 1 of it within the window: no angle in rad, and no digit of whole numbers
    if step <= 0.0 or _is_printed(values, step):
        return Unit("", "", asked)
    counts = {name: tau / (step * (UNITS[Kind.SPEED][name] or 1.0) * window) for name in asked}
    whole = [name for name, number in counts.items() if _is_whole(number)]
    if "rpm" in whole:
        whole = ["deg/s", "rpm"]  # six times as many a turn are whole too
    if len(whole) != 1:
        return Unit("", "", tuple(whole) or asked)
    number = round(counts[whole[0]])
    if stamps is not None and number * _measure_scatter(stamps) > WHOLE:
        return Unit("", "", asked)  # of a window that is known no better, a whole number is chance
    why = f"steps of {step:.4g} are {number} counts a turn in {whole[0]}, and no whole number in other units"
    return Unit(whole[0], f"{why}; otherwise: --unit")


def _measure_scatter(stamps: Floats) -> float:
    """Measure how far the mean length of rows may be from the usual one, relative to it; stamps [s], shape (K,).

    Of even rows it is known, and of others as well as a program's clock at best.
    """
    lengths = np.diff(stamps)
    usual = float(np.median(lengths))
    scatter = float(np.median(np.abs(lengths - usual))) / usual if usual > 0.0 else 0.0
    return max(scatter / sqrt(len(lengths)), CLOCK) if scatter > 0.0 else 0.0


def guess_position_unit(values: Floats) -> Unit:
    """The unit of positions, shape (K,): by where they wrap, or in which unit their step is a whole share of a turn."""
    for name in ("rad", "deg"):
        size = RANGES[name][0]
        jumps = np.abs(np.diff(values)) > 0.5 * size
        if REACHED * size < np.ptp(values) <= SLACK * size and jumps.any():
            return Unit(name, f"they wrap at {size:.4g}; otherwise: --unit")
    asked = ASKED[Kind.POSITION]
    lattice = find_position_lattice(values)
    if lattice is None or not np.any(values % 1.0):
        return Unit("", "", ("count", "deg") if lattice else asked)
    step, error = lattice.step, SURE * lattice.error / lattice.step
    turns = {"rad": (2.0 * pi, RELATIVE), "deg": (360.0, 0.0), "rev": (1.0, 0.0)}
    whole = [
        name
        for name, (turn, rounded) in turns.items()
        if _is_whole(turn / step, WHOLE_BY_POSITIONS, rounded + error) and not _is_printed(values, step)
    ]
    few = [
        name
        for name, (turn, rounded) in turns.items()
        if name not in whole and _is_whole(turn / step, WHOLE_BY_POSITIONS, rounded + error, FEWEST_MAGNETS)
    ]
    others = "no whole number"
    if few and whole:  # some magnets a turn of a motor, or that many times as many of its gear
        return Unit("", "", tuple(name for name in turns if name in {*whole, *few}))
    if len(whole) != 1:  # of steps so coarse that a turn has hardly any of them, no encoder is made
        fine = [name for name, (turn, _) in turns.items() if turn / step >= FEWEST_COUNTS]
        if len(fine) != 1 or few:
            return Unit("", "", tuple(whole) or asked)
        whole, others = fine, f"fewer than {FEWEST_COUNTS}"
    number = turns[whole[0]][0] / step
    why = f"steps of {step:.4g} are {number:.5g} counts a turn in {whole[0]}, and {others} in other units"
    return Unit(whole[0], f"{why}; otherwise: --unit")


def is_encoders_angle(values: Floats) -> bool:
    """Whether the steps of values, shape (K,), are a whole share of 2π: an encoder's in rad, and no voltages."""
    lattice = find_position_lattice(values)
    if lattice is None or round(tau / lattice.step) > MOST_TOLD or _is_printed(values, lattice.step):
        return False
    return _is_whole(tau / lattice.step, WHOLE_BY_POSITIONS, RELATIVE + SURE * lattice.error / lattice.step)


def _is_whole(number: float, near: float = WHOLE, relative: float = RELATIVE, fewest: int = FEWEST_COUNTS) -> bool:
    return fewest <= number <= MOST_COUNTS and abs(number - round(number)) < near + relative * number


def _is_printed(values: Floats, step: float) -> bool:
    """Whether a step is that of the last digit that was printed, or of every second or fifth of them."""
    places = [float(np.log10(step / digit)) for digit in (1.0, 2.0, 5.0)]
    return bool(
        any(abs(place - round(place)) < 1e-3 for place in places)
        and np.all(np.abs(values / step - np.rint(values / step)) < 1e-3)
    )
