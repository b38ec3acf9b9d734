"""Find the column of motion among those of one motor: the best by its name, and of several one that stands for all."""

from collections.abc import Sequence

import numpy as np

from motor_identification.logs.columns.behaviour.position import find_position
from motor_identification.logs.columns.drive import drives
from motor_identification.logs.columns.heading import Heading, read_heading
from motor_identification.logs.columns.motion.speed_beside import is_summed_up
from motor_identification.logs.columns.notes import ask_motion, lack_motion, miss_motion
from motor_identification.logs.columns.vocabulary import (
    BODIES,
    FILTERED,
    MEASURED,
    MOVES,
    RAW,
    UNITS,
    Quantity,
    words_of,
)
from motor_identification.logs.correlation import correlate
from motor_identification.logs.csv.table import Table
from motor_identification.logs.rows.drive.constant_voltage import CONSTANT

ANGLES = {(word,) for word in words_of("theta θ phi φ")}
SLIDES = {(word,) for word in words_of("x z s")}  # as a cart's place is called beside its pendulum's angle
SAME_MOTION = 0.9995  # correlation of a motion with itself in another unit, which is rounded
SIBLINGS, ALIKE = 2, 0.9  # letters of a name, and the correlation, of a signal and what a model makes of it
_BEST_FIRST = (Quantity.COUNT, Quantity.POSITION, Quantity.SPEED)  # what was counted is exact; a speed was computed


def find_motion_column(
    table: Table, headings: Sequence[Heading], side: str, time: str | None = None, unit: str | None = None
) -> str:
    """Name the column of motion; a unit that was said is one of its kind, if there is one."""
    headings = _without_bodies(headings)
    told = UNITS[unit][0] if unit in UNITS else None
    angles = [one.name for one in headings if one.quantity is Quantity.POSITION and one.words in ANGLES]
    for quantity in sorted(_BEST_FIRST, key=lambda one: one is not told):
        found = [one.name for one in headings if one.quantity is quantity and one.side == side]
        found = found or [one.name for one in headings if one.quantity is quantity]
        if len(found) > 1:  # what was made of another one comes later, and is smoother than the motor
            found = [name for name in found if not FILTERED & set(read_heading(name).words)] or found
            found = [name for name in found if RAW & set(read_heading(name).words)] or found
            found = [one for one in found if any(_sums_up(table, one, other) for other in found)] or found
            found = _in_one_unit(table, _each_once(table, found))
            with_unit = [name for name in found if read_heading(name).unit]
            found = with_unit if quantity is Quantity.SPEED and len(with_unit) == 1 else found
        found += _list_slides(table, headings) if len(found) == 1 and found[0] in angles else []
        found += _list_siblings(table, headings, found[0]) if len(found) == 1 else []
        if len(found) > 1:
            raise ask_motion(table, headings, quantity, found)
        if found:
            return found[0]
    unnamed = [one.name for one in headings if one.quantity is None and np.ptp(table.numbers(one.name)) > 0.0]
    measured = [one.name for one in headings if one.name in unnamed and MEASURED & set(one.words)]
    if not measured and {one.name for one in headings if drives(one)} == {"u"}:
        measured = [name for name in unnamed if name == "y"]  # a system's input and output, as textbooks call them
    if len(unnamed) == 1 or len(measured) == 1:
        return (measured or unnamed)[0]
    if len(unnamed) == 2 and (position := find_position(table, unnamed, time)):
        return position
    still = [one.name for one in headings if one.quantity is None and one.name != CONSTANT]
    if still and not unnamed:
        raise miss_motion(table, still[0])
    if len(unnamed) > 1:
        raise ask_motion(table, headings, None, unnamed)
    raise lack_motion(table, time)


def _list_siblings(table: Table, headings: Sequence[Heading], found: str) -> list[str]:
    """Columns that only their last letter tells from the one found, `wr` beside `wm`, and whose numbers are as its."""
    (word, *more) = read_heading(found).words or ("",)
    able = [one.name for one in headings if one.quantity is None and len(one.words) == 1 and not more]
    able = [name for name in able if len(word) == SIBLINGS and read_heading(name).words[0][:-1] == word[:-1]]
    values = table.numbers(found)
    return [name for name in able if name != found and correlate(values, table.numbers(name)) > ALIKE]


def _list_slides(table: Table, headings: Sequence[Heading]) -> list[str]:
    """The one column that a cart's place may be, beside an angle; none where several have such names, as a pose has."""
    slides = [one.name for one in headings if one.quantity is None and one.words in SLIDES]
    return slides if len(slides) == 1 and len(np.unique(np.diff(table.numbers(slides[0])))) > 2 else []


def _without_bodies(headings: Sequence[Heading]) -> list[Heading]:
    """Leave out the motions of what a motor moves, such as a pendulum, beside one that may be the motor's."""
    of_bodies = [one for one in headings if one.quantity in MOVES and BODIES & set(one.words)]
    others = [one for one in headings if one not in of_bodies]
    return others if any(one.quantity in MOVES for one in others) else list(headings)


def _sums_up(table: Table, name: str, other: str) -> bool:
    return name != other and is_summed_up(table.numbers(name), table.numbers(other))


def _each_once(table: Table, names: Sequence[str]) -> list[str]:
    """Leave out columns with the name and the numbers of one before, as where a program lists a signal twice."""
    kept: list[str] = []
    for name in names:
        alike = [one for one in kept if name.partition(" #")[0] == one]
        if not any(np.array_equal(table.numbers(name), table.numbers(one)) for one in alike):
            kept.append(name)
    return kept


def _in_one_unit(table: Table, names: Sequence[str]) -> list[str]:
    """Keep one of several columns that are the same in other units, `rpm` beside `rad/s`: one whose unit has a size."""
    units = {name: read_heading(name).unit for name in names}
    first, *others = sorted(names, key=lambda name: not units[name] or UNITS[units[name]][1] is None)
    values = table.numbers(first)
    for name in others:
        same = units[name] != units[first] and correlate(values, table.numbers(name)) > SAME_MOTION
        if not same or not units[first]:
            return list(names)
    return [first]
