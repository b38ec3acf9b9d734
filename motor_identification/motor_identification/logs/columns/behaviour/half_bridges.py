"""Join what the two pins of a bridge get, where only the motion tells that each of them drives it one way."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.drive import drives
from motor_identification.logs.columns.heading import Heading, read_heading
from motor_identification.logs.columns.motion.direction import TOGETHER, turns_back
from motor_identification.logs.columns.roles.candidates import list_readable
from motor_identification.logs.columns.said import Said
from motor_identification.logs.columns.vocabulary import DIRECTIONS, MOVES, Quantity, words_of
from motor_identification.logs.csv.table import Table

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

FEWEST_ROWS = 10  # in which each pin is on
MOST_LATE = 3  # rows by which a motion follows its pins
FEW, MOST_PAIRS = 6, 20  # columns of which any two may be pins, else those of like names; pairs that are looked at
MOST_ROWS = 50_000  # in which pins and motion are compared, from the first on
SPANS = (1, 4, 16)  # rows whose means are looked at
SURE = 5.0  # standard errors of what a pin does to the motion
EXPLAINED = 0.2  # of what a motion's own speed before leaves open, that its pins explain
ALIKE = 0.2  # of what one pin does, that the other one does at least: the same motor goes the other way
# Times as fast where neither of them is on as where one is: no pins. Measured: 2.0 and more of the switches at the ends
# of a slide that goes to and fro, 1.2 and less of the pins of motors of 80 ms to 2 s in pulses of 30 to 120 ms.
RUNS_ON = 1.5
_ENABLES = words_of("ena enb en")  # of an L298N: the pin whose duty its inputs turn
JOINED = "Voltage: {0} less {1}, as the motion goes with each, as with the pins of a bridge (otherwise: --voltage)."
NAMED = "Voltage: {0} less {1}, as pins of a bridge that are never on together (otherwise: --voltage)."
TURNED = (
    "Direction: {0} goes forward where {1} is on and backward where {2} is, as the motion turns with them (otherwise: "
    "--direction -)."
)
_FORWARD_AND_BACK = ("l", "pwm"), ("r", "pwm")  # the pins of a BTS7960, and no sides of a machine


def join_half_bridge(table: Table, said: Said) -> Table:
    """Make one drive of two pins of which one drives a motor one way and the other one the other way.

    A bridge gives a motor the difference of what its halves get. So two columns are its halves where one of them is 0,
    or full, in every row, and the motion is pushed one way by one and the other way by the other: by what was, the
    speed of the next rows rises with one pin and falls with the other. Of pins of a bridge by name it is enough that
    they are never on together. Beside a duty without a sign such pins, of two levels, are its direction.

    Args:
        table: the log.
        said: what the user said; where he named the drive or its direction, nothing is joined.
    """
    if said.voltage or said.direction or said.constant_voltage is not None or said.motors:
        return table
    headings = list_readable(table)
    gaps = set(table.names) - {one.name for one in headings}
    if len({one.side for one in headings if one.quantity in MOVES}) > 1 or any(
        drives(read_heading(one)) for one in gaps
    ):
        return table  # several motors, or another drive
    able = [one for one in headings if one.quantity in (None, Quantity.VOLTAGE, Quantity.DUTY)]
    able = [one for one in able if not DIRECTIONS & set(one.words) and _may_be_pin(table, one.name)]
    pairs = [pair for pair in combinations(able, 2) if len(able) <= FEW or _are_alike(*pair)]
    for one, other in pairs[:MOST_PAIRS]:
        beside = [heading for heading in headings if heading not in (one, other)]
        if not _are_of_two_sides(one, other) and _are_halves(table.numbers(one.name), table.numbers(other.name)):
            joined = _join(table, one.name, other.name, beside, said)
            if joined is not None:
                return joined
    return table


def _are_alike(one: Heading, other: Heading) -> bool:
    """Whether names are the same but for one character: `IN1` and `IN2`."""
    apart = sum(a != b for a, b in zip(one.name, other.name, strict=False))
    return len(one.name) == len(other.name) and apart == 1


def _join(table: Table, one: str, other: str, beside: Sequence[Heading], said: Said) -> Table | None:
    """Join two pins, beside no drive or one that they turn; None where the motion does not go with them."""
    first, second = table.numbers(one), table.numbers(other)
    drive = _find_turned(table, beside, first, second, said)
    if drive is None:
        return None
    driven = np.ones(len(table), np.bool_) if not drive else table.numbers(drive) > 0.0
    on, off = driven & (first != second), driven & (first == second)
    speeds = [speed for speed in _speeds(table, beside, drive, said) if not _runs_on(speed, on, off)]
    if drive:
        size = table.numbers(drive) / max(float(np.max(first)), float(np.max(second)))
        first, second = size * first, size * second
    pins = not drive and _are_pins(one, other)
    sign = next(filter(None, (_sign(speed, first, second, pins) for speed in speeds)), 0)
    told = bool(sign)
    if not sign and pins and not np.any(first * second):
        sign = 1  # which way is forward is told later, by the motion
    if not sign:
        return None
    if sign < 0:
        one, other, first, second = other, one, second, first
    cells = {name: cell for name, cell in table.cells.items() if name not in (one, other)}
    unit = "V" if read_heading(one).unit == "V" else "duty"
    name = drive or f"{one} - {other} ({unit})"
    note = TURNED.format(drive, one, other) if drive else (JOINED if told else NAMED).format(one, other)
    return replace(table, cells={**cells, name: first - second}, notes=(*table.notes, note))


def _find_turned(table: Table, beside: Sequence[Heading], first: Floats, second: Floats, said: Said) -> str | None:
    """The duty without a sign that pins of two levels, shape (K,), turn; empty where nothing else drives.

    None where another column drives already.
    """
    names = [one.name for one in beside if drives(one) and np.any(table.numbers(one.name))]
    named = bool(said.motion) or any(one.quantity in MOVES for one in beside)
    names += [one.name for one in beside if named and one.name != said.motion and _ENABLES & set(one.words)]
    if not names:
        return ""
    turn = all(len(np.unique(pin)) == 2 for pin in (first, second))
    return names[0] if len(names) == 1 and turn and np.min(table.numbers(names[0])) >= 0.0 else None


def _may_be_pin(table: Table, name: str) -> bool:
    values = table.numbers(name)
    on = values > 0.0
    return bool(np.min(values) >= 0.0) and np.count_nonzero(on) >= FEWEST_ROWS


def _are_of_two_sides(one: Heading, other: Heading) -> bool:
    """Whether names are of two motors of a machine: `pwm_left` and `pwm_right`, `motor1` and `motor2`."""
    if {one.words, other.words} == set(_FORWARD_AND_BACK):
        return False
    return bool(one.side and other.side) and one.side != other.side


def _are_halves(first: Floats, second: Floats) -> bool:
    """Whether two pins, shape (K,), may be a bridge's: one is off in every row, or fully on, or both are alike."""
    full = max(float(np.max(first)), float(np.max(second)))
    apart = first != second
    off = apart & (np.minimum(first, second) > 0.0)
    low = apart & (np.maximum(first, second) < full)
    on = min(np.count_nonzero(first > second), np.count_nonzero(second > first))
    return on >= FEWEST_ROWS and min(float(np.mean(off)), float(np.mean(low))) < TOGETHER


def _are_pins(one: str, other: str) -> bool:
    """Whether names are those that the pins of a bridge have: `IN1` and `IN2`, `AIN1`, `pinA`, `IN_B`."""
    stems = {name.lower()[:-1].rstrip(" _") for name in (one, other)}
    ends = {name.lower()[-1:] for name in (one, other)}
    return len(stems) == 1 and stems.pop().endswith("in") and ends in ({"1", "2"}, {"a", "b"})


def _speeds(table: Table, beside: Sequence[Heading], drive: str, said: Said) -> list[Floats]:
    """Speeds, each of shape (K,), in any unit, of what may move: as it is, or by its steps."""
    moving = [one for one in beside if one.name == said.motion] or [one for one in beside if one.quantity in MOVES]
    moving = moving or [one for one in beside if one.quantity is None and one.name != drive][:FEW]
    found = [table.numbers(one.name) for one in moving if one.quantity is not Quantity.POSITION]
    steps = [table.numbers(one.name) for one in moving if one.quantity is not Quantity.SPEED]
    return [*found, *(np.diff(values, prepend=values[:1]) for values in steps)]


def _runs_on(speed: Floats, on: Bools, off: Bools) -> bool:
    """Whether a speed is not driven by pins, as it is larger where neither is on than where one is; of shape (K,)."""
    size = np.abs(speed)
    return bool(off.any() and on.any() and np.mean(size[off]) > RUNS_ON * np.mean(size[on]))


def _sign(speed: Floats, first: Floats, second: Floats, unsigned: bool) -> int:
    """1 where a speed goes forward with the first pin and backward with the second, -1 the other way; else 0.

    Means over a few rows tell it where one row is no more than a count, or than noise. All of shape (K,).

    Args:
        speed: the speed.
        first: what one pin gets.
        second: what the other one gets.
        unsigned: whether a speed without a sign, which rises with either, tells it too.
    """
    begin = int(np.argmax(first != second))
    rows = slice(begin, begin + MOST_ROWS)
    speed, first, second = speed[rows], first[rows], second[rows]
    both = turns_back(speed)
    if not both and not (unsigned and float(np.min(speed)) >= 0.0):
        return 0
    signs = {_sign_of_rows(*(_means(column, span) for column in (speed, first, second))) for span in SPANS} - {0}
    if len(signs) != 1:
        return 0
    (sign,) = signs
    return sign if both == (abs(sign) == 1) else 0


def _means(column: Floats, rows: int) -> Floats:
    count = len(column) // rows
    return np.asarray(np.mean(column[: count * rows].reshape(count, rows), axis=1))


def _sign_of_rows(speed: Floats, first: Floats, second: Floats) -> int:
    """1 or -1 as above, 2 where a speed rises with either pin; else 0.

    Of speed[k + late] = p speed[k + late - 1] + a first[k] + b second[k], by the delay that fits best; there is no
    constant: a motor without a voltage comes to stand. All of shape (K,).
    """
    best, sign = np.inf, 0
    for late in range(MOST_LATE + 1):
        count = len(speed) - late - 1
        if count < 2 * FEWEST_ROWS:
            return sign
        at = slice(1, 1 + count)
        known = np.column_stack([speed[late : late + count], first[at], second[at]])
        size = np.max(np.abs(known), axis=0)
        if not np.all((size > 0.0) & np.isfinite(size)):
            return 0
        known = known / size
        moved = speed[1 + late : 1 + late + count] / size[0]
        gains, _, rank, _ = np.linalg.lstsq(known, moved, rcond=None)
        left = float(np.mean((moved - known @ gains) ** 2))
        if rank < known.shape[1] or left >= best:
            continue
        best, errors = left, np.sqrt(left * np.diag(np.linalg.inv(known.T @ known)))
        forward, backward = (float(gain) for gain in gains[1:] / size[1:])
        alone = float(known[:, 0] @ moved / (known[:, 0] @ known[:, 0]))
        shown = left < (1.0 - EXPLAINED) * float(np.mean((moved - alone * known[:, 0]) ** 2))
        sure = shown and bool(np.all(np.abs(gains[1:]) > SURE * errors[1:]))
        alike = min(abs(forward), abs(backward)) > ALIKE * max(abs(forward), abs(backward))
        sign = _tell(forward, backward) if sure and alike else 0
    return sign


def _tell(forward: float, backward: float) -> int:
    if forward * backward < 0.0:
        return int(np.sign(forward))
    return 2 if forward > 0.0 else 0
