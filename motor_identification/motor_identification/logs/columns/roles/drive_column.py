"""Find the column that drives a motor, and the supply's beside it."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.drive import is_supply, sags
from motor_identification.logs.columns.heading import Heading, read_heading
from motor_identification.logs.columns.notes import ask_column, ask_drive, miss_drive
from motor_identification.logs.columns.roles.candidates import is_numeric, list_unnamed
from motor_identification.logs.columns.said import Pair
from motor_identification.logs.columns.vocabulary import Quantity
from motor_identification.logs.csv.table import Table

Floats = NDArray[np.float64]

STEADY = 0.7  # of its largest value: a battery stays above
BOTH_WAYS = 0.2  # of the largest speed, which a motor has the other way
# Of the largest speed, in so many rows on end, and so many times as many as are between two rows of a motor that runs,
# by the mean: one that stands again. Of slow counts every other row has none.
STANDS, FEWEST_STANDING, TIMES_AS_LONG = 0.01, 10, 10.0
FEWEST_CHANGES = 10  # of a battery's voltage, which sags; what changes in fewer rows is set


def find_drive_column(table: Table, headings: Sequence[Heading], side: str, others: tuple[str, ...]) -> str:
    """Find the column that drives a motor on a side; where there are others, one without a telling name may do.

    Raises:
        RecordingError: none does, or several may.
    """
    duties = [one.name for one in headings if one.quantity is Quantity.DUTY]
    for quantity in (Quantity.VOLTAGE, Quantity.DUTY):
        found = [one.name for one in headings if one.quantity is quantity]
        own = [one.name for one in headings if one.quantity is quantity and one.side == side and side]
        found = own or found
        if quantity is Quantity.VOLTAGE:
            found = [name for name in found if _may_drive(table, name, duties)]
        if len(found) > 1:  # what is 0 all the time drives nothing beside another
            found = [name for name in found if np.any(table.numbers(name))] or found
        if len(found) > 1:
            raise ask_column(table, quantity.value, "--voltage", found)
        if found:
            return found[0]
    swinging = [one.name for one in headings if one.quantity is Quantity.SUPPLY and _swings(table.numbers(one.name))]
    if len(swinging) == 1:
        return swinging[0]  # Vin, which is no supply then
    unnamed = [one.name for one in headings if one.quantity is None and np.ptp(table.numbers(one.name)) > 0.0]
    if len(unnamed) == 1 and others:
        return unnamed[0]
    candidates = list_unnamed(table, headings)
    if not candidates:
        raise miss_drive(table)
    raise ask_drive(table, candidates)


def _may_drive(table: Table, name: str, duties: Sequence[str]) -> bool:
    """Whether a voltage may be the motor's, beside duties: no supply's, and of no meter that is not plugged in."""
    if not duties:
        return not _is_battery(table, name)
    volts = table.numbers(name)
    idle = not np.any(volts) and any(np.any(table.numbers(duty)) for duty in duties)
    return not idle and not _is_supply(table, name, duties[0])


def _is_supply(table: Table, name: str, duty: str) -> bool:
    """Whether a voltage beside a duty is the supply's: it stays where that passes 0, or falls where the motor runs."""
    volts, share = table.numbers(name), table.numbers(duty)
    if is_supply(volts, share):
        return True
    beside = [read_heading(one) for one in table.names if is_numeric(table, one)]
    speeds = [table.numbers(one.name) for one in beside if one.quantity is Quantity.SPEED]
    return any(sags(volts, share, speed) for speed in speeds)


def _is_battery(table: Table, name: str) -> bool:
    """Whether a voltage is a battery's: it stays, of one sign, once it is there, while a motor turns both ways.

    Or while a motor that ran stands again.
    """
    volts = table.numbers(name)
    there = volts[volts != 0.0]
    beside = [read_heading(one) for one in table.names if is_numeric(table, one)]
    speeds = [table.numbers(one.name) for one in beside if one.quantity is Quantity.SPEED]
    both = any(np.min(speed) < -BOTH_WAYS * np.max(speed) < 0.0 for speed in speeds)
    turned = any({"dir", "direction"} & set(one.words) for one in beside)  # by a pin of its own
    steady = len(there) > 0 and np.min(there) > STEADY * np.max(there) > 0.0
    told = any(one.quantity is Quantity.REFERENCE and len(np.unique(table.numbers(one.name))) > 1 for one in beside)
    begin = int(np.argmax(volts != 0.0))
    if steady and np.all(volts[begin:] != 0.0) and any(_stands_again(speed[begin:]) for speed in speeds):
        return True
    if not both or turned or not steady:
        return False
    return told or bool(np.count_nonzero(np.diff(volts)) > FEWEST_CHANGES)  # few may be those of a drive


def _stands_again(speed: Floats) -> bool:
    """Whether a motor comes to a standstill after it ran; speeds, shape (K,), in any unit."""
    size = np.abs(speed)
    top = float(np.max(size, initial=0.0))
    runs = size > 0.5 * top
    ran = int(np.argmax(runs)) if np.count_nonzero(runs) >= FEWEST_STANDING else len(size)  # a few rows are garbage
    moves = np.flatnonzero(size[ran:] > STANDS * top)
    steps = np.diff(np.append(moves, len(size) - ran))
    return len(steps) > 0 and np.max(steps) > max(FEWEST_STANDING, TIMES_AS_LONG * float(np.median(steps)))


def _swings(values: Floats) -> bool:
    """Whether voltages, shape (K,), come to 0 or change their sign, as no supply's do."""
    return bool(np.min(values) <= 0.0 < np.max(np.abs(values)))


def find_supply_column(table: Table, headings: Sequence[Heading], pairs: Sequence[Pair]) -> str | None:
    """Find the column of the supply's voltage among those that neither drive nor move."""
    taken = {pair.voltage for pair in pairs} | {pair.motion for pair in pairs}
    free = [one for one in headings if one.name not in taken]
    named = [one.name for one in free if one.quantity is Quantity.SUPPLY]
    duty = pairs[0].voltage
    volts = [one.name for one in free if one.quantity is Quantity.VOLTAGE and _is_supply(table, one.name, duty)]
    return next(iter(named + volts), None)
