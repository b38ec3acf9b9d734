"""Tell a program's parameters, whose names read as those of a motor, from what a motor does: `KF_W` and `KF_V`."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from motor_identification.logs.columns.drive import drives
from motor_identification.logs.columns.heading import Heading, words_besides
from motor_identification.logs.columns.vocabulary import MOVES, Quantity
from motor_identification.logs.csv.table import Table

# Of a parameter, which somebody sets now and then; what drives a motor, or is measured of it, changes more often.
MOST_CHANGES = 3
FEWEST_CHANGES = 10  # of the motion beside it, where a motor moves


def leave_out_parameters(table: Table, headings: Sequence[Heading]) -> list[Heading]:
    """Read parameters as such: speeds that stay at a number other than 0 while another motion goes on.

    And what drives or moves under the same name, but where a motion goes on with a drive of that name that changes: a
    filter's estimate has its parameters' name, which stay. A motor that stands has a speed of 0.
    """
    changes = {one.name: _count_changes(table, one.name) for one in headings if one.quantity in MOVES}
    set_once = [
        one
        for one in headings
        if one.quantity is Quantity.SPEED and changes[one.name] <= MOST_CHANGES and np.all(table.numbers(one.name))
    ]
    driven = [one for one in headings if drives(one) and _count_changes(table, one.name) > MOST_CHANGES]
    motors = {words_besides(one) for one in driven}
    motors &= {words_besides(one) for one in headings if changes.get(one.name, 0) >= FEWEST_CHANGES}
    set_once = [one for one in set_once if words_besides(one) not in motors - {()}]  # an axis that went on evenly
    names = {words_besides(one) for one in set_once} - {()}
    others = [one for one in headings if one not in set_once and words_besides(one) not in names]
    if not any(changes.get(one.name, 0) >= FEWEST_CHANGES for one in others):
        return list(headings)  # the motion that goes on is that of the same name
    return [
        replace(one, quantity=Quantity.OTHER)
        if one in set_once or (words_besides(one) in names and (drives(one) or one.quantity in MOVES))
        else one
        for one in headings
    ]


def _count_changes(table: Table, name: str) -> int:
    values = table.numbers(name)
    return int(np.count_nonzero(values[1:] != values[:-1]))
