"""Columns of one experiment among those of several, where each is a struct with fields of the same names."""

from collections.abc import Sequence

from motor_identification.logs.columns.drive import drives
from motor_identification.logs.columns.heading import Heading, read_heading
from motor_identification.logs.columns.names.path import find_struct
from motor_identification.logs.columns.vocabulary import MOVES, Quantity


def keep_struct(headings: Sequence[Heading], name: str) -> list[Heading]:
    """Leave out the drives and motions of other structs, where the one of a column has what that one lacks.

    A struct of a signal alone, `motor.voltage` beside `encoder.angle`, has none: then all are kept.
    """
    struct, is_motion = find_struct(name), read_heading(name).quantity in MOVES
    own = [one for one in headings if struct and find_struct(one.name) == struct]
    if not any(drives(one) if is_motion else one.quantity in (None, *MOVES) for one in own):
        return list(headings)
    return [one for one in headings if one in own or not _may_be_meant(one)]


def times_of_struct(names: Sequence[str], name: str) -> list[str]:
    """Those columns of times that are of the same struct as a column; all of them, where none is."""
    struct = find_struct(name)
    return [one for one in names if struct and find_struct(one) == struct] or list(names)


def _may_be_meant(heading: Heading) -> bool:
    return heading.quantity in (None, *MOVES) or drives(heading) or heading.quantity is Quantity.SUPPLY
