"""Rows of several motors under the same columns, told apart by one that names them: `motor` with M1, M1, M2, M2."""

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.names.words import split_words
from motor_identification.logs.columns.said import Said
from motor_identification.logs.columns.vocabulary import SIDES
from motor_identification.logs.csv.table import Table

MOST_MOTORS = 16
FEWEST_ROWS = 10  # of a motor: fewer are rows of something else
_NAMING = frozenset(["motor", "motors", "wheel", "joint", "roda", "rueda", "rad", "roue", "ruota"])
_BESIDE = frozenset(["id", "name", "no", "nr", "number", "num", "side"])
_PLACES = frozenset([*SIDES, "front", "rear", "back", "fl", "fr", "rl", "rr", "bl", "br"])


def separate_motors(table: Table, said: Said) -> dict[str, Table]:
    """Separate the rows of motors that a column names, by name; one table under no name where there is no such column.

    Columns that were said are taken as they are; but rows that are split by a motor's name are those of motors, too.
    """
    if said.motors:
        return {"": table}
    used = {said.time, said.voltage, said.motion, said.supply, said.direction}
    for column in table.names:
        words = set(split_words(column))
        if column in used or not words & _NAMING or words - _NAMING - _BESIDE:
            continue
        names = np.array([table.text(column, row).strip() for row in range(len(table))])
        motors, counts = np.unique(names, return_counts=True)
        named = all(map(_is_name, motors)) or (column == said.split and _are_numbered(motors))
        if 2 <= len(motors) <= MOST_MOTORS and counts.min() >= FEWEST_ROWS and named:
            note = f"{column} names {len(motors)} motors: {', '.join(motors)}, a bag each at least."
            return {str(motor): table.rows(names == motor, note) for motor in motors}
    return {"": table}


def _is_name(text: str) -> bool:
    """Whether a cell is a motor's name, `M1`, `left`, `FL`, and no number of its drive and no state of it."""
    words = split_words(text)
    return bool(words) and not words[0].isdigit() and (words[-1].isdigit() or any(word in _PLACES for word in words))


def _are_numbered(motors: NDArray[np.str_]) -> bool:
    """Whether motors, shape (K,), are called 1, 2, 3, or 0, 1, 2."""
    return any({*motors} == {str(first + k) for k in range(len(motors))} for first in (0, 1))
