"""A duty without a sign, and beside it the pin that says which way: which of its two values is forward."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.names.words import split_words
from motor_identification.logs.columns.notes import Notes
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.columns.vocabulary import DIRECTIONS, words_of
from motor_identification.logs.csv.table import Table

Floats = NDArray[np.float64]

NONE = "-"  # instead of a column's name: there is none

FORWARD = words_of("1 1.0 +1 f fw fwd forward forwards cw high true vor vorwärts adelante avant")
BACKWARD = words_of("0 0.0 -1 -1.0 r rev reverse b bw back backward backwards ccw low false zurück atras arrière")
TWO_WAYS = frozenset(
    [("fwd", "rev"), ("forward", "reverse"), ("forward", "backward"), ("fwd", "bwd"), ("rpwm", "lpwm"), ("cw", "ccw")]
)
TOGETHER = 0.01  # of the rows
BOTH_WAYS = 0.05  # of the largest speed, that a motor has the other way
STANDS = words_of("stop stopped brake coast idle halt none off n neutral")
NEITHER = STANDS | words_of("0 0.0")  # 0 is one beside 1 and -1


@dataclass(frozen=True)
class Direction:
    """The values of a column, as they stand there, that mean backward; `sure` is false where they were guessed."""

    column: str
    backward: tuple[str, ...]
    why: str


def guess_direction(table: Table, pair: Pair, said: Said, is_speed: bool, notes: Notes) -> Direction | None:
    """Which way a drive without a sign goes, where a column says it."""
    if said.direction == NONE:
        return None
    column = said.direction or find_direction_column(table, pair.voltage, read_heading(pair.motion).side)
    if column is None:
        return None
    table.column(column)
    motion = table.numbers(pair.motion)
    speed = motion if is_speed else np.diff(motion, prepend=motion[:1])
    direction = read_direction(table, column, table.numbers(pair.voltage), speed)
    if direction is None:
        question = (
            f"says which way {pair.voltage} goes, and {pair.motion} does not turn with it: log motion with a sign, or "
            f"say --direction {NONE} if it is none"
        )
        notes.questions.append((column, question))
        return None
    notes.findings.append(f"Direction: {pair.voltage} goes {direction.why} (otherwise: --direction {NONE}).")
    return direction


def find_direction_column(table: Table, drive: str, side: str) -> str | None:
    """The column that tells the sign of a drive that is never negative; None where there is none."""
    if np.any(table.numbers(drive) < 0.0):
        return None
    named = [read_heading(name) for name in table.names if name != drive]
    told = [one for one in named if DIRECTIONS & set(one.words) and len(_values(table, one.name)) in (2, 3)]
    own = [one for one in told if one.side == side] or [one for one in told if not one.side]
    return own[0].name if len(own) == 1 else None


def read_direction(table: Table, column: str, drive: Floats, speed: Floats) -> Direction | None:
    """Which values mean backward; None where a value means nothing, or the motion never turns with it.

    Args:
        table: the log.
        column: that of the direction.
        drive: without a sign, shape (K,).
        speed: signed, in any unit, shape (K,).
    """
    values = _values(table, column)
    ways = [one for one in values if one.lower() not in (NEITHER if len(values) == 3 else STANDS)]
    ways = [one for one in ways if np.any(drive[is_backward(table, column, [one])])] or ways  # 0 may be "off"
    backward = [one for one in ways if one.lower() in BACKWARD]
    known = all(one.lower() in FORWARD | BACKWARD | NEITHER for one in values)
    if len(ways) == 1 and known:
        against = bool(backward) and float(np.sum(drive * speed)) < 0.0
        return Direction(column, tuple(ways) if against else (), f"one way, where {column} is {ways[0]}")
    if len(backward) != 1 or not known or not (np.any(speed < 0.0) and np.any(speed > 0.0)):
        return None
    sign = np.where(is_backward(table, column, backward), -1.0, 1.0)
    if float(np.sum(sign * drive * speed)) >= 0.0:
        return Direction(column, tuple(backward), f"backward where {column} is {backward[0]}")
    other = tuple(one for one in values if one not in backward and one.lower() in FORWARD)
    return Direction(column, other, f"backward where {column} is {' or '.join(other)}, as the motion turns with it")


def is_backward(table: Table, column: str, backward: Sequence[str]) -> NDArray[np.bool_]:
    """In which rows the direction is one of these values, shape (K,)."""
    return np.isin(np.asarray(table.column(column)).astype(np.str_), list(backward))


def _values(table: Table, column: str) -> list[str]:
    """The different values of a column, as they stand there; at most four of them."""
    found: list[str] = []
    for value in np.unique(np.asarray(table.column(column)))[:4]:
        found.append(value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value))
    return found


def join_two_ways(table: Table, voltage: str | None) -> Table:
    """Make one drive of two that are never on together, one for each way: `pwm_fwd`, `pwm_rev`; `RPWM`, `LPWM`.

    Args:
        table: the log.
        voltage: the column that a user said it is; then nothing is joined.
    """
    words = {name: split_words(name) for name in table.names}  # those of its unit too: pwm_rev is in no turns
    for one, other in permutations(table.names, 2):
        if voltage is None and _are_two_ways(words[one], words[other]) and _take_turns(table, one, other):
            cells = {name: cell for name, cell in table.cells.items() if name not in (one, other)}
            joined = table.numbers(one) - table.numbers(other)
            note = f"Voltage: {one} less {other}, as they are never on together (otherwise: --voltage)."
            return replace(table, cells={**cells, f"{one} - {other} (duty)": joined}, notes=(*table.notes, note))
    return table


def _are_two_ways(one: tuple[str, ...], other: tuple[str, ...]) -> bool:
    """Whether names are alike but for a word, which says forward in the first and backward in the other."""
    differ = [(a, b) for a, b in zip(one, other, strict=False) if a != b]
    return len(one) == len(other) and len(differ) == 1 and differ[0] in TWO_WAYS


def _take_turns(table: Table, one: str, other: str) -> bool:
    if not (bool(table.readable(one).all()) and bool(table.readable(other).all())):
        return False
    first, second = table.numbers(one), table.numbers(other)
    never_below = bool(np.min(first) >= 0.0 and np.min(second) >= 0.0)
    return never_below and bool(np.any(first) and np.any(second)) and float(np.mean(first * second != 0.0)) < TOGETHER


def turns_back(speed: Floats) -> bool:
    """Whether a motor goes both ways, by its speed (K,) in any unit."""
    forth, back = float(np.max(speed)), -float(np.min(speed))
    return min(forth, back) > BOTH_WAYS * max(forth, back)
