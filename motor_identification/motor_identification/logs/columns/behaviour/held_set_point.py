"""Tell a log of a controller, whose set point of the motion stays while the voltage changes, from a static curve."""

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.heading import Heading, read_heading
from motor_identification.logs.columns.roles.candidates import is_numeric
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.columns.vocabulary import MOVES, UNITS, WORDS, Quantity
from motor_identification.logs.csv.table import Table

Floats = NDArray[np.float64]

STAYS = 0.5  # of the rows that a controller's set point changes in at most
# Of the set point's size, half of the motion's is at least, or twice: a limit, or another thing's, is of any size.
FOLLOWS = 0.5
# Of its range, that a speed is off the straight line over the voltage at most where every row has settled: friction and
# a dead zone bend it by less. Measured: 0.47 and 0.79 of a controller's log; 0.005 where all of its rows have settled.
OFF_CURVE = 0.15
_OF_OTHERS = WORDS[Quantity.VOLTAGE] | WORDS[Quantity.CURRENT] | WORDS[Quantity.DUTY]


def holds_a_set_point(table: Table, pair: Pair, said: Said) -> bool:
    """Decide whether a set point of a motor's motion stays from row to row, the motion follows it, and is no curve.

    A load that is held, a supply's voltage and a limit are no set points of the motion; and rows that all have settled
    are steady states, whoever gave the voltage.
    """
    motion = table.numbers(pair.motion)
    if _is_curve(table.numbers(pair.voltage), motion):
        return False
    moves = read_heading(pair.motion)
    kind = Quantity(said.kind.value) if said.kind else moves.quantity
    for name in table.names:
        target = read_heading(name)
        if target.quantity is not Quantity.REFERENCE or not is_numeric(table, name) or not _is_of(target, kind):
            continue
        values, size = table.numbers(name), _compare(target, said.unit or moves.unit)
        if size and np.any(values) and share_of_changes(values) < STAYS and _follows(values, motion, size):
            return True
    return False


def share_of_changes(values: Floats) -> float:
    """Count the rows whose value, shape (K,), is another than in the row before, as a share."""
    return float(np.mean(values[1:] != values[:-1]))


def _is_curve(drive: Floats, motion: Floats) -> bool:
    """Whether a motion (K,) lies on a straight line over what drives it (K,)."""
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # a damaged cell may be any number
        about = drive - np.mean(drive)
        line = np.mean(motion) + about * (about @ (motion - np.mean(motion))) / (about @ about)
        return bool(np.max(np.abs(motion - line), initial=0.0) <= OFF_CURVE * np.ptp(motion))


def _is_of(target: Heading, kind: Quantity | None) -> bool:
    """Whether a set point's name says no other quantity than the motion's."""
    if target.unit:
        return UNITS[target.unit][0] is kind or (kind is None and UNITS[target.unit][0] in MOVES)
    words = set(target.words)
    others = [WORDS[one] for one in MOVES if kind in MOVES and one is not kind]
    return not words & _OF_OTHERS and (kind is None or bool(words & WORDS[kind]) or not words & set().union(*others))


def _compare(target: Heading, unit: str) -> float:
    """How many of the motion's units a set point's one is; 1 where one is not known, 0 where they do not compare."""
    if not target.unit or not unit or target.unit == unit:
        return 1.0
    of_target, of_motion = (UNITS[one][1] if one in UNITS else None for one in (target.unit, unit))
    return of_target / of_motion if of_target and of_motion else 0.0


def _follows(target: Floats, motion: Floats, size: float) -> bool:
    """Whether a motion (K,) mostly is about as large as its set point (K,) of a size, and goes its way."""
    told = target != 0.0
    with np.errstate(over="ignore", invalid="ignore"):  # a damaged cell may be any number
        return bool(FOLLOWS <= np.median(motion[told] / target[told] / size) <= 1.0 / FOLLOWS)
