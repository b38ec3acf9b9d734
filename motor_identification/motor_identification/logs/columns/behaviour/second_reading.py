"""Read headings again by what stands beside them and how their numbers behave: `v`, `current`, `pulse`, `input`."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.behaviour.position import find_position
from motor_identification.logs.columns.drive import drives, is_supply
from motor_identification.logs.columns.heading import Heading
from motor_identification.logs.columns.vocabulary import INPUTS, MOVES, OUTPUTS, SIDES, WORDS, Quantity, words_of
from motor_identification.logs.csv.table import Table

Floats = NDArray[np.float64]

FEWEST_OWN = 10  # changes of a velocity while its drive stays, from which on it is no voltage; and of any motion
# Of a velocity's variance, what its drive does not make at once, by friction and inertia. Measured: 0.04 to 0.24 of
# carts under a sine of 0.5 Hz; a supply that sags by a fifth leaves 0.002 of a measured voltage.
OWN_WAY = 0.02
MOST_LATE = 2  # rows that a measured voltage is behind what was commanded
MOST_LEVELS = 3  # of a pulse that drives
NORMED = words_of("norm normed normalized normalised scaled")  # of an end of a system: `output_norm`


def references_beside(headings: list[Heading]) -> list[Heading]:
    """`xr` beside `x`, where there is no `xl`, is what `x` should be: a reference in control's letters."""
    motions = {one.words[0] for one in headings if one.words and one.quantity in (None, *MOVES)}
    return [replace(one, quantity=Quantity.REFERENCE) if _is_reference(one, motions) else one for one in headings]


def _is_reference(heading: Heading, motions: set[str]) -> bool:
    """Whether a name is one word, that of a motion beside it and an r."""
    if heading.quantity is not None or len(heading.words) != 1:
        return False
    (word,) = heading.words
    bare = word[:-1] if word.endswith("r") else word[1:]
    return "r" in (word[0], word[-1]) and bare in motions and not {f"{bare}l", f"l{bare}"} & motions


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

    A voltage that was measured changes as the duty does. Beside a drive that never stays, it goes its own way. What
    changes in a few rows, as the number of a part, and the velocity's own acceleration could not be the motion. Beside
    a position it is the velocity if it is its derivative.
    """
    called = [one for one in headings if one.quantity is Quantity.VOLTAGE and not one.unit and "v" in one.words]
    others = [one for one in headings if drives(one) and one not in called]
    if not called or not others:
        return headings
    if _any_moves(headings):
        own = [one for one in called if _has_position(table, one, headings)]
        return [replace(one, quantity=Quantity.SPEED) if one in own else one for one in headings]
    if any(one.quantity is None and _could_move(table, one.name, called) for one in headings):
        return headings
    if any(is_supply(table.numbers(one.name), table.numbers(others[0].name)) for one in called):
        return headings
    drives_it = [table.numbers(one.name) for one in others]
    if not all(_moves_alone(table.numbers(one.name), drives_it) for one in called):
        return headings
    return [replace(one, quantity=Quantity.SPEED) if one in called else one for one in headings]


def _moves_alone(values: Floats, others: Sequence[Floats]) -> bool:
    """Whether a column (K,) changes while its drives stay, or goes its own way where they hardly do."""
    stays = np.all([np.diff(other) == 0.0 for other in others], axis=0)
    if np.count_nonzero(stays) >= FEWEST_OWN:
        return bool(np.count_nonzero(np.diff(values)[stays]) >= FEWEST_OWN)
    return all(_own_way(values, other) > OWN_WAY for other in others)


def _own_way(values: Floats, drive: Floats) -> float:
    """The share of a column's variance (K,) that is no multiple of its drive some rows before, and no white noise."""
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # a column of anything
        shares = []
        for late in range(MOST_LATE + 1):
            moved, by = values[late:] - np.mean(values[late:]), drive[: len(drive) - late]
            by = by - np.mean(by)
            left = moved - by * float(by @ moved) / float(by @ by)
            shares.append(float(left[1:] @ left[:-1]) / float(moved @ moved))
    return min(shares)


def _has_position(table: Table, called: Heading, headings: Sequence[Heading]) -> bool:
    """Whether a column that is called `v` is the derivative of a position beside it."""
    angles = [one.name for one in headings if one.quantity in (Quantity.POSITION, Quantity.COUNT)]
    return any(find_position(table, (angle, called.name), None) == angle for angle in angles)


def _could_move(table: Table, name: str, called: Sequence[Heading]) -> bool:
    """Whether a column without a telling name may be the motion, beside some that are called `v`."""
    if np.count_nonzero(np.diff(table.numbers(name))) < FEWEST_OWN:
        return False
    return all(find_position(table, (one.name, name), None) != one.name for one in called)


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


def ends_of_a_loop(headings: list[Heading]) -> list[Heading]:
    """Input and output side by side: of a controller where a set point stands there too, else of the motor.

    An output beside what drives, where nothing else moves, is the motor's; so is one where nothing else could move.
    """
    places = {_place(one) for one in headings} - {None}
    drive_it = [one for one in headings if drives(one) and _place(one) is None]
    beside = {one.quantity for one in headings if _place(one) is None}
    if INPUTS in places and OUTPUTS in places:
        moves = INPUTS if any(one.quantity is Quantity.REFERENCE for one in headings) else OUTPUTS
    elif (
        OUTPUTS in places
        and drive_it
        and not any(one.quantity in MOVES for one in headings)
        or OUTPUTS in places
        and beside <= {Quantity.TIME, Quantity.REFERENCE, Quantity.OTHER}
    ):
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
    words = [word for word in heading.words if word not in SIDES and word not in NORMED and word != "r"]
    return next((place for place in (INPUTS, OUTPUTS) if len(words) == 1 and words[0] in place), None)
