"""Pair a drive and a motion whose names tell nothing: by how often they change, and which of them follows the other."""

from collections.abc import Sequence

import numpy as np

from motor_identification.logs.columns.behaviour.following import follows
from motor_identification.logs.columns.behaviour.position import find_position
from motor_identification.logs.columns.heading import Heading
from motor_identification.logs.columns.motion.movement import is_encoders_angle
from motor_identification.logs.columns.motion.speed_beside import FEWEST_CHANGES
from motor_identification.logs.columns.notes import ask_drive, miss_drive, miss_motion
from motor_identification.logs.columns.roles.candidates import list_unnamed, stays
from motor_identification.logs.columns.said import Pair
from motor_identification.logs.columns.vocabulary import MOVES, Quantity
from motor_identification.logs.csv.table import Table


def pair_by_behaviour(table: Table, headings: Sequence[Heading], time: str | None) -> Pair:
    """Columns without telling names: a drive beside a motion, or beside a position and its speed."""
    unnamed = list_unnamed(table, headings)
    if pair := _pair_with_angle(table, unnamed):
        return pair
    changes = {name: np.count_nonzero(np.diff(table.numbers(name))) for name in unnamed}
    drive, *others = sorted(unnamed, key=lambda name: changes[name]) or [""]
    fewest = min((changes[name] for name in others), default=0)
    position = (find_position(table, others, time) if len(others) == 2 else others[0]) if len(others) in (1, 2) else ""
    if not position or fewest < max(2 * changes[drive] + 1, FEWEST_CHANGES):
        for one, other in ((drive, *others), (*others, drive)) if len(others) == 1 else ():
            if follows(table, other, one):
                return Pair("", one, other)
        still = [one.name for one in headings if one.quantity is None and not np.any(table.numbers(one.name))]
        if still and len(unnamed) == 1:
            raise miss_motion(table, still[0], unnamed[0])
        if len(unnamed) == 1 or (len(unnamed) == 2 and find_position(table, unnamed, time)):
            raise miss_drive(table)
        raise ask_drive(table, unnamed or table.names)
    if stays(table, drive) and any(
        one.quantity is Quantity.REFERENCE and not stays(table, one.name) for one in headings
    ):
        raise miss_drive(table)  # what stays makes nothing follow what changes
    return Pair("", drive, position)  # what drives changes in fewer rows, and to fewer values


def _pair_with_angle(table: Table, unnamed: Sequence[str]) -> Pair | None:
    """Of two columns, one whose steps are a whole share of 2π, an encoder's angle in rad, and the other that drives it.

    It changes in fewer rows than what a controller puts out does.
    """
    angles = [name for name in unnamed if is_encoders_angle(table.numbers(name))]
    if len(unnamed) != 2 or len(angles) != 1:
        return None
    drive = next(name for name in unnamed if name not in angles)
    return Pair("", drive, angles[0])


def pair_channels(table: Table, headings: Sequence[Heading]) -> Pair | None:
    """Of two voltages, as an oscilloscope records them, the drive and the tachogenerator's that follows it."""
    volts = [one.name for one in headings if one.quantity is Quantity.VOLTAGE]
    others = [one for one in headings if one.quantity in MOVES or one.quantity in (None, Quantity.DUTY)]
    if len(volts) != 2 or others:
        return None
    return next((Pair("", one, other) for one, other in (volts, volts[::-1]) if follows(table, other, one)), None)
