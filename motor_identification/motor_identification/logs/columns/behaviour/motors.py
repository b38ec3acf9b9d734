"""Tell the motors of a table apart: by number, by the names that a drive and a motion share, or on one drive."""

import os.path
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from motor_identification.logs.columns.behaviour.following import WITH_DRIVE
from motor_identification.logs.columns.behaviour.position import correlate_ways
from motor_identification.logs.columns.drive import drives
from motor_identification.logs.columns.heading import Heading, words_besides
from motor_identification.logs.columns.vocabulary import MOVES, Quantity
from motor_identification.logs.correlation import correlate
from motor_identification.logs.csv.table import Table


def numbered_motors(headings: list[Heading]) -> list[Heading]:
    """Motors by number, where as many drives as motions have the same ones: `pwm1`, `pwm2`, `enc1`, `enc2`."""
    numbers = {
        one.name: one.words[-1] for one in headings if not one.side and one.words[-1:] and one.words[-1].isdigit()
    }
    moving = [numbers[one.name] for one in headings if one.quantity in MOVES and one.name in numbers]
    driving = [numbers[one.name] for one in headings if drives(one) and one.name in numbers]
    if len(moving) < 2 or sorted(moving) != sorted(driving) or len(set(moving)) != len(moving):
        return headings
    return [replace(one, side=numbers.get(one.name, one.side)) for one in headings]


def named_motors(headings: list[Heading]) -> tuple[list[Heading], tuple[str, ...]]:
    """Motors by the names that a drive and a motion share: `shooter_volts`, `shooter_rpm`, `/Drive/Module0/TurnVolts`.

    Only where columns could be those of several; what drives or moves besides is left out, and named.
    """
    own = [one for one in headings if drives(one) or one.quantity in MOVES]
    if not _several(own):
        return headings, ()
    motors: dict[tuple[str, ...], list[Heading]] = {}
    for one in own:
        motors.setdefault(words_besides(one), []).append(one)
    whole = {
        words: ones
        for words, ones in motors.items()
        if any(map(drives, ones)) and any(one.quantity in MOVES for one in ones) and not _several(ones)
    }
    if not whole or (len(whole) == 1 and () in whole):
        return headings, ()
    shared = len(os.path.commonprefix(list(whole))) if len(whole) > 1 else 0
    labels = {one.name: "_".join(words[shared:]) or "motor" for words, ones in whole.items() for one in ones}
    left = [one for one in own if one.name not in labels]
    kept = [replace(one, side=labels.get(one.name, one.side)) for one in headings if one not in left]
    return kept, tuple(one.name for one in left if one.quantity in MOVES)


def _several(headings: Sequence[Heading]) -> bool:
    """Whether there are two columns of one kind for the same side."""
    kinds = [(one.quantity, one.side) for one in headings]
    return len(set(kinds)) < len(kinds)


def share_one_drive(table: Table, headings: list[Heading]) -> list[Heading]:
    """Motors by number on the one drive, where each of them follows it: `pwm`, `enc1`, `enc2`, `enc3`.

    A pendulum's second encoder does not follow the drive, nor does a parameter of a controller.
    """
    driving = [one for one in headings if drives(one)]
    moving = [one for one in headings if one.quantity in MOVES]
    names = {(one.words[:-1], one.quantity, one.unit, one.side) for one in moving}
    numbers = [one.words[-1] for one in moving if one.words and one.words[-1].isdigit()]
    if (
        len(driving) != 1
        or driving[0].side
        or "".join(driving[0].words[-1:]).isdigit()
        or len(names) != 1
        or len(moving) < 2
        or len(set(numbers)) != len(moving)
    ):
        return headings
    drive, ones = driving[0].name, np.ones(len(table))
    for one in moving:
        speeds = one.quantity is Quantity.SPEED or bool(np.any(table.numbers(one.name) % 1.0))
        with_it = correlate(table.numbers(one.name), table.numbers(drive)) if speeds else 0.0
        if max(with_it, correlate_ways(table, one.name, drive, ones)) < WITH_DRIVE:
            return headings
    return [replace(one, side=one.words[-1]) if one in moving else one for one in headings]
