"""What columns are by how their numbers behave, where their names tell nothing or two things."""

import os.path
from collections.abc import Sequence
from dataclasses import replace
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.clock import row_period
from motor_identification.logs.columns.drive import drives, is_supply
from motor_identification.logs.columns.heading import Heading, words_besides
from motor_identification.logs.columns.movement import guess_kind
from motor_identification.logs.columns.vocabulary import INPUTS, MOVES, OUTPUTS, SIDES, WORDS, Quantity
from motor_identification.logs.correlation import correlate
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import Kind

Floats = NDArray[np.float64]

INTEGRAL = 0.9  # correlation of a position's steps with its speed, both over some rows, as one row is coarse
SAME_UNITS, BESIDE_ITS_WAY = 0.05, 0.2  # of the way: a position in degrees beside its speed in degrees a second
PARTS, FEWEST_PARTS = 40, 5  # of a log, over which they are compared

ANSWERS, UNANSWERED = 0.6, 0.2  # share of what moves that a drive explains, and of a drive that what moves does
FEWEST_STEPS = 50  # of two columns that tell it
WITH_DRIVE = 0.8  # correlation of a motor's speed, or of its way, with what drives it and others
FEWEST_OWN = 10  # changes of a velocity while its drive stays, from which on it is no voltage
FIRST_ROWS = 6.0  # sample periods after 0, within which a run's clock began with its voltage
MOST_LEVELS = 3  # of a pulse that drives
FIRST_VALUES = 3  # of a run, that tell whether the motor turned already
AGAINST = 0.25  # of a run's largest speed, which noise may seem to turn against the voltage


def find_position(table: Table, names: Sequence[str], time: str | None) -> str:
    """The position among two columns of which one is the other's derivative; empty where that is not so.

    Without a column of times rows are taken for regular.
    """
    steps = np.ones(len(table)) if time is None else np.diff(table.numbers(time), append=np.nan)
    steps[~(steps >= 0.0)] = 0.0  # where time begins again
    changing = {name for name in names if np.any(table.numbers(name) != table.numbers(name)[0])}  # no drive that stays
    able = [(one, other) for one, other in permutations(names, 2) if other in changing]
    for agreement in (_agreement, _is_integral):  # the second where a steady motor's ways are all alike
        pairs = {pair: agreement(table, *pair, steps) for pair in able}
        best = max(pairs, key=lambda pair: pairs[pair], default=("", ""))
        if pairs.get(best, 0.0) > INTEGRAL:
            return best[0]
    return ""


def follows(table: Table, motion: str, drive: str) -> bool:
    """Whether one column moves as another drives it, by a first-order motor, and not the other way round."""
    moves, drives_it = table.numbers(motion), table.numbers(drive)
    if len(moves) < FEWEST_STEPS:
        return False
    return _explained(moves, drives_it) > ANSWERS and _explained(drives_it, moves) < UNANSWERED


def is_speed_by_drive(values: Floats, drive: Floats) -> bool:
    """Whether a motion goes with its drive and forgets what was, as no angle does. Both of shape (K,)."""
    return guess_kind(values, drive) is Kind.SPEED and correlate(values, drive) > WITH_DRIVE


def _explained(values: Floats, by: Floats) -> float:
    """The share of a column's steps that its values and another one's before and after each of them explain."""
    with np.errstate(over="ignore", invalid="ignore"):  # a column of anything
        steps = np.diff(values)
    size = float(np.max(np.abs(steps), initial=0.0))
    if not 0.0 < size < np.inf:
        return 0.0
    scaled = [column / max(float(np.max(np.abs(column))), 1e-300) for column in (values[:-1], by[:-1], by[1:])]
    known = np.column_stack([*scaled, np.ones(len(steps))])
    rest = steps / size - known @ np.linalg.lstsq(known, steps / size, rcond=None)[0]
    variance = float(np.var(steps / size))
    return 1.0 - float(np.var(rest)) / variance if variance > 0.0 else 0.0


def _agreement(table: Table, position: str, speed: str, steps: Floats) -> float:
    """Correlation of a column's way with another's integral, over parts of the log."""
    way, integral = _ways(table, position, speed, steps)
    return correlate(way, integral) if len(way) >= FEWEST_PARTS else 0.0


def _is_integral(table: Table, position: str, speed: str, steps: Floats) -> float:
    """1 where a column's way is another's integral itself, in the same units, over all parts of the log; else 0."""
    way, integral = _ways(table, position, speed, steps)
    whole, path = float(np.sum(np.abs(integral))), float(np.sum(np.abs(way)))
    if len(way) < FEWEST_PARTS or not 0.0 < whole < np.inf or not path < np.inf:
        return 0.0
    return float(abs(path / whole - 1.0) < SAME_UNITS and np.sum(np.abs(way - integral)) < BESIDE_ITS_WAY * whole)


def _ways(table: Table, position: str, speed: str, steps: Floats) -> tuple[Floats, Floats]:
    """A column's way and another's integral over parts of the log, each of shape (P,)."""
    with np.errstate(over="ignore", invalid="ignore"):  # a column of anything
        angle, travel = table.numbers(position), np.cumsum(table.numbers(speed) * steps)
        ends = np.unique(np.linspace(0, len(angle) - 1, min(PARTS, len(angle) // 3) + 1).astype(np.int64))
        return np.diff(angle[ends]), np.diff(travel[ends])


def present_values(headings: list[Heading]) -> list[Heading]:
    """`current` beside a target, where nothing else moves and no unit says ampere, is what is present: it moves."""
    if not any(one.quantity is Quantity.REFERENCE for one in headings) or _any_moves(headings):
        return headings
    return [replace(one, quantity=Quantity.POSITION) if _is_present(one) else one for one in headings]


def _any_moves(headings: Sequence[Heading]) -> bool:
    return any(one.quantity in MOVES for one in headings)


def _is_present(heading: Heading) -> bool:
    return heading.quantity is Quantity.CURRENT and not heading.unit and "current" in heading.words


def speeds_called_v(table: Table, headings: list[Heading]) -> list[Heading]:
    """`v` beside what drives, where nothing else moves or could, is the velocity: it changes where the drive stays.

    A voltage that was measured changes as the duty does.
    """
    called = [one for one in headings if one.quantity is Quantity.VOLTAGE and not one.unit and "v" in one.words]
    others = [one for one in headings if drives(one) and one not in called]
    unnamed = any(one.quantity is None and np.ptp(table.numbers(one.name)) > 0.0 for one in headings)
    if not called or not others or _any_moves(headings) or unnamed:
        return headings
    stays = np.all([np.diff(table.numbers(one.name)) == 0.0 for one in others], axis=0)
    alone = [np.count_nonzero(np.diff(table.numbers(one.name))[stays]) for one in called]
    if any(is_supply(table.numbers(one.name), table.numbers(others[0].name)) for one in called):
        return headings
    if min(alone) < FEWEST_OWN:
        return headings
    return [replace(one, quantity=Quantity.SPEED) if one in called else one for one in headings]


def pulses_that_drive(table: Table, headings: list[Heading]) -> list[Heading]:
    """`pulse` of a few levels, where nothing else drives and something else moves, is what drives, and no count."""
    if any(map(drives, headings)):
        return headings
    few = [
        one
        for one in headings
        if one.quantity is Quantity.COUNT
        and one.words in (("pulse",), ("pulses",))
        and 2 <= len(np.unique(table.numbers(one.name))) <= MOST_LEVELS
    ]
    if len(few) != 1 or not any(one.quantity in MOVES for one in headings if one not in few):
        return headings
    return [replace(one, quantity=Quantity.VOLTAGE) if one in few else one for one in headings]


def numbered_motors(headings: list[Heading]) -> list[Heading]:
    """Motors by number, where as many drives as motions have the same ones: `pwm1`, `pwm2`, `enc1`, `enc2`."""
    numbers = {
        one.name: one.words[-1] for one in headings if not one.side and one.words[-1:] and one.words[-1].isdigit()
    }
    moving = [numbers[one.name] for one in headings if one.quantity in MOVES and one.name in numbers]
    driving = [numbers[one.name] for one in headings if drives(one) and one.name in numbers]
    if len(moving) < 2 or sorted(moving) != sorted(driving) or len(set(moving)) != len(moving):
        return headings
    return [replace(one, side=numbers.get(one.name, one.side)) for one in headings]


def named_motors(headings: list[Heading]) -> tuple[list[Heading], tuple[str, ...]]:
    """Motors by the names that a drive and a motion share: `shooter_volts`, `shooter_rpm`, `/Drive/Module0/TurnVolts`.

    Only where columns could be those of several; what drives or moves besides is left out, and named.
    """
    own = [one for one in headings if drives(one) or one.quantity in MOVES]
    if not _several(own):
        return headings, ()
    motors: dict[tuple[str, ...], list[Heading]] = {}
    for one in own:
        motors.setdefault(words_besides(one), []).append(one)
    whole = {
        words: ones
        for words, ones in motors.items()
        if any(map(drives, ones)) and any(one.quantity in MOVES for one in ones) and not _several(ones)
    }
    if not whole or (len(whole) == 1 and () in whole):
        return headings, ()
    shared = len(os.path.commonprefix(list(whole))) if len(whole) > 1 else 0
    labels = {one.name: "_".join(words[shared:]) or "motor" for words, ones in whole.items() for one in ones}
    left = [one for one in own if one.name not in labels]
    kept = [replace(one, side=labels.get(one.name, one.side)) for one in headings if one not in left]
    return kept, tuple(one.name for one in left if one.quantity in MOVES)


def _several(headings: Sequence[Heading]) -> bool:
    """Whether there are two columns of one kind for the same side."""
    kinds = [(one.quantity, one.side) for one in headings]
    return len(set(kinds)) < len(kinds)


def share_one_drive(table: Table, headings: list[Heading]) -> list[Heading]:
    """Motors by number on the one drive, where each of them follows it: `pwm`, `enc1`, `enc2`, `enc3`.

    A pendulum's second encoder does not follow the drive, nor does a parameter of a controller.
    """
    driving = [one for one in headings if drives(one)]
    moving = [one for one in headings if one.quantity in MOVES]
    names = {(one.words[:-1], one.quantity, one.unit, one.side) for one in moving}
    numbers = [one.words[-1] for one in moving if one.words and one.words[-1].isdigit()]
    if (
        len(driving) != 1
        or driving[0].side
        or "".join(driving[0].words[-1:]).isdigit()
        or len(names) != 1
        or len(moving) < 2
        or len(set(numbers)) != len(moving)
    ):
        return headings
    drive, ones = driving[0].name, np.ones(len(table))
    for one in moving:
        speeds = one.quantity is Quantity.SPEED or bool(np.any(table.numbers(one.name) % 1.0))
        with_it = correlate(table.numbers(one.name), table.numbers(drive)) if speeds else 0.0
        if max(with_it, _agreement(table, one.name, drive, ones)) < WITH_DRIVE:
            return headings
    return [replace(one, side=one.words[-1]) if one in moving else one for one in headings]


def ends_of_a_loop(headings: list[Heading]) -> list[Heading]:
    """Input and output side by side: of a controller where a set point stands there too, else of the motor.

    An output beside what drives, where nothing else moves, is the motor's.
    """
    places = {_place(one) for one in headings} - {None}
    drive_it = [one for one in headings if drives(one) and _place(one) is None]
    if INPUTS in places and OUTPUTS in places:
        moves = INPUTS if any(one.quantity is Quantity.REFERENCE for one in headings) else OUTPUTS
    elif OUTPUTS in places and drive_it and not any(one.quantity in MOVES for one in headings):
        moves = OUTPUTS
    else:
        return headings
    sides = sum(_place(one) == moves for one in headings) > 1
    found = Quantity.POSITION if sides else None  # of which kind, its numbers tell
    return [replace(one, quantity=found) if _place(one) == moves else one for one in headings]


def commands_beside_control(table: Table, headings: list[Heading]) -> list[Heading]:
    """An input that nobody calls a voltage, beside a duty that changes, is what the controller is told: a set point."""
    duties = [table.numbers(one.name) for one in headings if one.quantity is Quantity.DUTY]
    if not any(np.any(duty != duty[0]) for duty in duties):
        return headings
    return [replace(one, quantity=Quantity.REFERENCE) if _is_bare_input(one) else one for one in headings]


def _is_bare_input(heading: Heading) -> bool:
    told = set(heading.words) & WORDS[Quantity.VOLTAGE]
    return heading.quantity is Quantity.VOLTAGE and not heading.unit and bool(told) and told <= INPUTS


def _place(heading: Heading) -> frozenset[str] | None:
    """Which end of a system a name is of, but for which motor it belongs to: `outputL`; None where of none."""
    words = [word for word in heading.words if word not in SIDES and word != "r"]
    return next((place for place in (INPUTS, OUTPUTS) if len(words) == 1 and words[0] in place), None)


def begins_at_rest(stamps: Floats, volts: Floats, values: Floats, is_speed: bool) -> bool:
    """Whether each of several runs has one voltage, its clock begins just before its first row, and it may have stood.

    Args:
        stamps: times of the rows [s], shape (K,); they go back where a run begins.
        volts: in any unit, shape (K,).
        values: speeds or positions, in any unit, shape (K,).
        is_speed: which of both they are.
    """
    begins = np.concatenate(([0], np.flatnonzero(np.diff(stamps) < 0.0) + 1, [len(stamps)]))
    if len(begins) < 3:
        return False
    period = row_period(stamps)
    runs = [slice(start, stop) for start, stop in zip(begins[:-1], begins[1:], strict=True) if stop - start > 1]
    even = all(np.all(volts[run] == volts[run.start]) for run in runs)
    if not even or not all(0.0 < stamps[run.start] < FIRST_ROWS * period for run in runs):
        return False
    speeds = [values[run] if is_speed else np.diff(values[run]) for run in runs]
    return all(can_have_stood(speed, float(volts[run.start])) for speed, run in zip(speeds, runs, strict=True))


def can_have_stood(speed: Floats, voltage: float) -> bool:
    """Whether a run's speeds, shape (K,), in any unit, can be those of a motor that stood when its voltage came.

    One that still turns against its voltage, or faster than it will in the end, did not.
    """
    if len(speed) < 2 * FIRST_VALUES:
        return True
    top, end = float(np.max(np.abs(speed))), float(np.mean(speed[-len(speed) // 4 :]))
    begin = float(np.median(speed[:FIRST_VALUES]))
    way = np.sign(voltage)
    return bool(begin * way >= -AGAINST * top and abs(begin) <= abs(end) + AGAINST * top)
