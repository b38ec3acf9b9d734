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
from motor_model.errors import RecordingError

Floats = NDArray[np.float64]

NEUTRALS = {1000.0: 1000.0, 1500.0: 500.0}  # [µs] a pulse of no voltage, and how far it is from there to full voltage
MIDDLE = 1500.0  # [µs]
FEWEST, ONE_WAY = 0.1, 0.75  # of the rows, that it is driven each way; and of those, in which it turns that way
NEAR = 0.05  # of how far it is to full voltage: within it controllers give none
STANDS = 0.01  # of the largest speed
MOSTLY = 0.5  # of the rows in which it stands
SLOWER = 0.5  # of the mean speed elsewhere: a motor that runs out
FULL_PULSE = 2000.0  # [µs]
FROM = "{0} is read as a share of the supply from {1:g}, at which there is no voltage, to {2:g}, as was said."
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
        said: what the user said; where that is how the drive becomes volts, nothing is changed. What is no voltage
            (`neutral`) may be said of any duties.

    Raises:
        RecordingError: nobody can tell which column the said neutral is of, or how far from there full voltage is.
    """
    if said.neutral is not None:
        return _read_from(said.neutral, table, said)
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
            return _share(table, name, neutral, NEUTRALS[neutral], READ)
    return table


def _turns_about(neutral: float, pulses: Floats, speed: Floats) -> bool:
    """Whether a motor turns one way by pulses [µs] above one and the other way by those below it, each (K,)."""
    far = NEAR * NEUTRALS[neutral]
    moves = np.abs(speed) > STANDS * float(np.max(np.abs(speed), initial=0.0))
    above, below = moves & (pulses > neutral + far), moves & (pulses < neutral - far) & (pulses > 0.0)
    if min(np.count_nonzero(above), np.count_nonzero(below)) < FEWEST * len(speed):
        return False
    ways = (float(np.mean(speed[above] > 0.0)), float(np.mean(speed[below] > 0.0)))
    return min(ways) < 1.0 - ONE_WAY and max(ways) > ONE_WAY


def _read_from(neutral: float, table: Table, said: Said) -> Table:
    """Make of duties, or pulses [µs], how far they are from what was said to be no voltage: shares, -1 to 1."""
    pulses = [one.name for one in list_readable(table) if are_pulses(one, table.numbers(one.name))]
    name = said.voltage or (pulses[0] if len(pulses) == 1 else "")
    if not name:
        raise RecordingError(f"--neutral {neutral:g} is of which column? Say it (--voltage COL).")
    full = said.full_duty or (FULL_PULSE - neutral if name in pulses else 0.0)
    if full <= 0.0:
        raise RecordingError(
            f"{name} shows {neutral:g} at 0 V: say how far from there full voltage is (--full-duty D)."
        )
    return _share(table, name, neutral, full, FROM, of_pulses=name in pulses)


def _share(table: Table, name: str, neutral: float, full: float, text: str, of_pulses: bool = True) -> Table:
    """Put shares of the supply in the place of a column, and say so; no pulse at all is none, whatever is neutral."""
    values, one_way = table.numbers(name), of_pulses and neutral <= full
    shares = np.clip((values - neutral) / full, 0.0 if one_way else -1.0, 1.0)
    shares[(values == 0.0) & of_pulses] = 0.0
    return replace(
        table, cells={**table.cells, name: shares}, notes=(*table.notes, text.format(name, neutral, neutral + full))
    )


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
    """[µs] the pulse at which a motor stands, of pulses [µs] and speeds, shape (K,); 0 where it cannot be told.

    Or about which it turns the one way and the other, though it hardly ever stands there.
    """
    if _turns_about(MIDDLE, pulses, speed):
        return MIDDLE
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
