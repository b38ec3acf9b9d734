"""Counts that begin anew in every row: how many there were since the row before."""

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.motion.movement import guess_kind
from motor_identification.logs.columns.names.quantity import are_counts_per_row
from motor_identification.logs.columns.notes import Notes
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.columns.vocabulary import Quantity, words_of
from motor_identification.logs.correlation import correlate
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import Kind
from motor_identification.logs.rows.wraps import find_wrap

Floats = NDArray[np.float64]

# Of 600 simulated logs of each sort, 59 % of counts of one row and none of counts that go on follow the drive more than
# their steps do; of the others, 92 % and 0.5 % of 1,500 are explained so well as a speed that the user is asked.
FOLLOWS = 0.3  # correlation with the drive, from which on counts are those of one row
BESIDE = 0.9  # of it: what their steps' correlation with the drive stays below
EXPLAINED = 0.4  # of the steps' variance by a first-order motor: counts that forget may be those of one row
FEWEST_ROWS = 20  # that show it
AGAINST = 0.2  # correlation of a position's steps with the drive that holds it
IDLE, FEWEST_IDLE = 0.1, 5  # of the largest drive, below which nothing drives, and rows of it that tell something
HELD = 0.5  # of the largest count, where counts that go on may stand then
# Rows in which a position stays where a loop's dead band left it, and how many counts that is at least: so many of one
# row, each under one drive, are not the same in all of them, as no speed is a whole number of counts a row.
FEWEST_SAME, MANY_COUNTS = 20, 20.0
_PER_ROW = words_of("delta diff increment increments inc incremental")


def count_anew(table: Table, pair: Pair, said: Said, notes: Notes) -> bool:
    """Whether a column counts anew in every row; where that is open, the notes ask."""
    if said.increments is not None:
        return said.increments
    why, heading = "", read_heading(pair.motion)
    if (
        _is_per_row(heading.words, table.numbers(pair.motion), table.numbers(pair.voltage))
        or heading.quantity is Quantity.SPEED
    ):  # counts that are called a speed
        why = "by its name"
    elif find_wrap(table.numbers(pair.motion), "count", said.edges_per_revolution):
        return False  # where an angle begins again, and no speed does
    elif _follow_drive(table.numbers(pair.motion), table.numbers(pair.voltage), notes, pair.motion):
        why = "it follows the drive, as speeds do"
    if why:
        notes.findings.append(f"{pair.motion} counts anew in every row ({why}; otherwise: --no-increments): summed up.")
    return bool(why)


def _is_per_row(words: tuple[str, ...], values: Floats, drive: Floats) -> bool:
    """Whether a name says that counts are those of one row: `delta_counts`, `ticks_per_sample`, and `d_enc`.

    A single letter is believed where its numbers forget, as no counts do that go on.
    """
    if _PER_ROW & set(words) or are_counts_per_row(words):
        return True
    return words[:1] == ("d",) and guess_kind(values, drive) is Kind.SPEED


def _follow_drive(values: Floats, drive: Floats, notes: Notes, name: str) -> bool:
    """Whether counts, shape (K,), follow the drive, as those of one row do; those that go on only do by their steps."""
    if len(values) < FEWEST_ROWS or guess_kind(values, drive) is not Kind.SPEED:
        return False
    if _is_position_in_a_loop(values, drive):
        return False
    steps = np.diff(values)
    follows = correlation(values, drive)
    if follows > FOLLOWS and correlation(steps, drive[:-1]) < BESIDE * follows:
        return True
    if _explained(steps, values[:-1], drive[:-1]) > EXPLAINED:
        question = (
            "may count on, or anew in every row, which the numbers do not tell: say --no-increments or --increments"
        )
        notes.questions.append((name, question))
    return False


def _is_position_in_a_loop(values: Floats, drive: Floats) -> bool:
    """Whether counts, shape (K,), are held somewhere by a drive that falls as they rise, as by Kp (r - y).

    Counts of one row that fall as the drive rises are those of a motor with its sensor the other way round: they go
    back with it, and come to 0 where nothing drives. What was logged before anything drove tells nothing.
    """
    if _stays_in_dead_band(values, drive):
        return True
    if correlate(values, drive) >= 0.0:
        return False
    if correlate(np.diff(values), drive[:-1]) > AGAINST:
        return True
    idle = np.abs(values[np.abs(drive) <= IDLE * np.max(np.abs(drive))])
    return len(idle) >= FEWEST_IDLE and bool(np.median(idle) > HELD * np.max(np.abs(values)))


def _stays_in_dead_band(values: Floats, drive: Floats) -> bool:
    """Whether counts, shape (K,), come to stay at one number as a drive without a sign, or with one, falls to little.

    As under Kp |r - y|, with the sign on another wire: what is left of it does not overcome friction.
    """
    begin = int(np.argmax(drive != 0.0))
    values, drive = values[begin:], drive[begin:]
    changes = np.flatnonzero((np.diff(values) != 0.0) | (np.diff(drive) != 0.0))
    same = len(values) - 1 - (int(changes[-1]) if len(changes) else -1)
    if same < FEWEST_SAME or len(values) - same < 2 or abs(values[-1]) < MANY_COUNTS or drive[-1] == 0.0:
        return False
    return bool(abs(drive[-1]) < np.max(np.abs(drive))) and correlate(values, np.abs(drive)) < 0.0


def _explained(steps: Floats, *by: Floats) -> float:
    """The share of the steps' variance that columns of the same shape explain."""
    columns = np.column_stack([*(_scaled(one) for one in by), np.ones(len(steps))])
    steps = _scaled(steps)
    rest = steps - columns @ np.linalg.lstsq(columns, steps, rcond=None)[0]
    variance = float(np.var(steps))
    return 1.0 - float(np.var(rest)) / variance if variance > 0.0 else 0.0


def correlation(one: Floats, other: Floats) -> float:
    """The size of two columns' correlation coefficient; 0 where one of both is constant."""
    parts = [values - np.mean(values) for values in (_scaled(one), _scaled(other))]
    size = float(np.sqrt((parts[0] @ parts[0]) * (parts[1] @ parts[1])))
    return abs(float(parts[0] @ parts[1])) / size if size > 0.0 else 0.0


def _scaled(values: Floats) -> Floats:
    return np.asarray(values / max(float(np.max(np.abs(values))), 1e-300), dtype=np.float64)
