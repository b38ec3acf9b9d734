"""Read the pulses that a model's motor controller gets as shares of its supply: 1000 µs or 1500 µs are none."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.drive import are_pulses
from motor_identification.logs.columns.heading import Heading
from motor_identification.logs.columns.motion.direction import turns_back
from motor_identification.logs.columns.roles.candidates import list_readable
from motor_identification.logs.columns.said import Said
from motor_identification.logs.columns.vocabulary import MOVES, Quantity
from motor_identification.logs.csv.table import Table

Floats = NDArray[np.float64]

NEUTRALS = {1000.0: 1000.0, 1500.0: 500.0}  # [µs] a pulse of no voltage, and how far it is from there to full voltage
NEAR = 0.05  # of how far it is to full voltage: within it controllers give none
STANDS = 0.01  # of the largest speed
MOSTLY = 0.5  # of the rows in which it stands
SLOWER = 0.5  # of the mean speed elsewhere: a motor that runs out
READ = (
    "Pulses: {0} is read as a share of the supply from {1:g} µs, at which the motor stands, to {2:g} µs (assumed; "
    "otherwise: --full-duty, --voltage-scale)."
)


def read_pulses(table: Table, said: Said) -> Table:
    """Make shares, -1 to 1, of the pulses [µs] that drive a motor, where it stands at one of the usual neutral ones.

    A controller that goes one way has its neutral pulse at 1000 µs, one that goes both ways at 1500 µs; full voltage is
    at 2000 µs. Which it is the motion tells: at that pulse it stands, and it turns back only where pulses go below.

    Args:
        table: the log.
        said: what the user said; where that is how the drive becomes volts, nothing is changed.
    """
    if said.full_duty or said.voltage_scale or said.constant_voltage is not None or said.motors:
        return table
    headings = list_readable(table)
    pulses = [one.name for one in headings if are_pulses(one, table.numbers(one.name))]
    pulses = [name for name in pulses if len(np.unique(table.numbers(name))) > 1]
    if len(pulses) != 1 or said.voltage not in (None, pulses[0]):
        return table
    (name,) = pulses
    values = table.numbers(name)
    for speed in _speeds(table, headings, said):
        neutral = _find_neutral(values, speed)
        if neutral:
            full = NEUTRALS[neutral]
            least = -1.0 if neutral > full else 0.0
            shares = np.where(values == 0.0, 0.0, np.clip((values - neutral) / full, least, 1.0))
            note = READ.format(name, neutral, neutral + full)
            return replace(table, cells={**table.cells, name: shares}, notes=(*table.notes, note))
    return table


def _speeds(table: Table, headings: list[Heading], said: Said) -> list[Floats]:
    """Speeds, each of shape (K,), in any unit: of what was said first, then of what moves by its name."""
    moving = [one for one in headings if one.name == said.motion]
    moving += [one for one in headings if one.quantity in MOVES and one not in moving]
    moved = [(one.quantity is Quantity.SPEED, table.numbers(one.name)) for one in moving]
    return [
        values if is_speed else np.diff(values, prepend=values[:1])
        for is_speed, values in moved
        if np.ptp(values) > 0.0
    ]


def _find_neutral(pulses: Floats, speed: Floats) -> float:
    """[µs] the pulse at which a motor stands, of pulses [µs] and speeds, shape (K,); 0 where it cannot be told."""
    size = np.abs(speed)
    stands = size <= STANDS * float(np.max(size))
    both = turns_back(speed)
    for neutral, full in NEUTRALS.items():
        there = np.abs(pulses - neutral) <= NEAR * full
        idle = there | (pulses == 0.0)
        below = (pulses < neutral - NEAR * full) & ~idle
        if not np.any(stands & there) or idle.all() or np.mean(idle[stands]) < MOSTLY:
            continue
        slow = float(np.mean(size[there])) < SLOWER * float(np.mean(size[~idle]))
        turns_below = bool(np.any(below & ~stands))
        one_way = not below.any() and (not both or neutral > full)
        if slow and (one_way or (turns_below and neutral > full)):
            return neutral
    return 0.0
