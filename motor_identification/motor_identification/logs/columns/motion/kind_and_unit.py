"""Read what kind of motion a column has, and in which unit: as it is said, as its name says, as its numbers behave."""

import re
from dataclasses import replace
from shlex import quote

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.behaviour.following import is_speed_by_drive
from motor_identification.logs.columns.heading import Heading, is_in_volts, is_of_joint_states, read_heading
from motor_identification.logs.columns.motion.movement import (
    ASKED,
    OF_COUNTS,
    SLIDES,
    Unit,
    guess_kind,
    guess_position_unit,
    guess_speed_unit,
    is_encoders_angle,
    is_kind_sure,
)
from motor_identification.logs.columns.motion.speed_beside import tell_position_unit, tell_speed_unit
from motor_identification.logs.columns.notes import Notes
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.columns.vocabulary import MOVES, UNIT_BY_SPELLING, Quantity
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import LENGTHS, UNITS, Kind

Floats = NDArray[np.float64]

WHOLE_DEGREES = 360  # counts a turn, which are degrees as well
WHOLE_UNITS = (WHOLE_DEGREES, 60)  # counts a turn, one of which in a second is 1 deg/s, or 1 rpm
ELECTRICAL = "of electrical turns: speeds are those of the shaft times its pole pairs"
_KINDS = {Quantity.SPEED: Kind.SPEED, Quantity.POSITION: Kind.POSITION, Quantity.COUNT: Kind.COUNT}
_ORDER = (Kind.SPEED, Kind.COUNT, Kind.POSITION)  # `count` is a count before it is a position


def find_speed_with_unit(table: Table, pair: Pair, said: Said, period: float, stamps: Floats | None) -> str:
    """Name the one speed of a known unit beside a position whose unit nothing tells; else empty.

    Of whole numbers, which may be counts, the unit is worth a question.
    """
    heading = read_heading(pair.motion)
    if heading.quantity is not Quantity.POSITION or said.kind or said.unit:
        return ""
    if not np.any(table.numbers(pair.motion) % 1.0):
        return ""
    speed = _find_speed_beside(table, pair, Kind.POSITION, said)
    known = bool(speed) and UNITS[Kind.SPEED].get(read_heading(speed).unit) is not None
    known = known and bool(np.any(table.numbers(speed)))  # else the position is all that moves
    return speed if known and not _unit(table, heading, Kind.POSITION, said, period, stamps).name else ""


def read_motion(
    table: Table, pair: Pair, said: Said, period: float, stamps: Floats | None, notes: Notes
) -> tuple[Kind, Unit]:
    """Read the kind and the unit of a column of motion; what nothing tells is asked for."""
    heading, values = read_heading(pair.motion), table.numbers(pair.motion)
    kind = said.kind or _kind_of(heading)
    if kind is Kind.COUNT and said.kind is None and np.any(values % 1.0):
        kind = None  # nobody counts in fractions: an encoder's angle, or its voltage
    if said.unit and not said.kind and (kind is None or said.unit not in UNITS[kind]):
        kind = next(one for one in _ORDER if said.unit in UNITS[one])
    sure = kind is not None or not period or is_kind_sure(values, table.numbers(pair.voltage))
    if not sure and _is_called_v(heading):
        kind, sure = Kind.SPEED, True
    if kind is None:
        kind = guess_kind(values, table.numbers(pair.voltage)) if period else _guess_untimed_kind(values)
    if _is_speed_called_angle(heading, said) and is_speed_by_drive(values, table.numbers(pair.voltage)):
        why = f"assumed: {pair.motion} is a unit alone, and a speed that follows {pair.voltage}"
        return Kind.SPEED, Unit(f"{heading.unit}/s", f"{why}; otherwise: --position {quote(pair.motion)}")
    unit = _unit(table, heading, kind, said, period, stamps)
    if unit.name == "count" and kind is Kind.POSITION and said.kind is None:
        kind = Kind.COUNT
    other = ASKED[Kind.POSITION if kind is Kind.SPEED else Kind.SPEED]
    asked = unit if sure else replace(unit, candidates=(*unit.candidates, *other))
    _ask_about(pair.motion, values, kind, asked, said, notes, _find_speed_beside(table, pair, kind, said))
    return kind, unit


def _is_called_v(heading: Heading) -> bool:
    """Whether a motion is called `vRot`: a velocity, where its numbers tell no kind; `V` and `volts` are a sensor's."""
    return heading.quantity is Quantity.VOLTAGE and not heading.unit and bool(re.match(r"\s*v[A-Z]", heading.name))


def _find_speed_beside(table: Table, pair: Pair, kind: Kind, said: Said) -> str:
    """Name the one speed that a log has beside its position, which a unit of speeds would choose; else empty."""
    if kind is Kind.SPEED or said.motion or said.motors:
        return ""
    side = read_heading(pair.motion).side
    headings = [heading for heading in map(read_heading, table.names) if heading.side == side]
    speeds = [heading.name for heading in headings if heading.quantity is Quantity.SPEED]
    return speeds[0] if len(speeds) == 1 else ""


def _guess_untimed_kind(values: Floats) -> Kind:
    """Rows without times are steady states, of speeds, unless their steps, shape (K,), are an encoder's in rad."""
    return Kind.POSITION if is_encoders_angle(values) else Kind.SPEED


def _is_speed_called_angle(heading: Heading, said: Said) -> bool:
    """Whether a column that is called `rad` or `deg` and nothing else may hold a speed, as far as the user said."""
    alone = UNIT_BY_SPELLING.get(heading.name.strip().lower()) in ("rad", "deg")
    return alone and said.kind is None and said.unit is None


def _unit(table: Table, heading: Heading, kind: Kind, said: Said, period: float, stamps: Floats | None) -> Unit:
    if said.unit:
        return Unit(said.unit, f"1 V of it is taken for 1 {said.unit}" if is_in_volts(heading) else "")
    if kind is Kind.COUNT:
        return Unit("count", "")
    if heading.unit and _kind_of(heading) is kind:
        return Unit(heading.unit, ELECTRICAL if "erpm" in heading.name.lower() else "")
    if is_of_joint_states(heading):
        return Unit(ASKED[kind][0], "as ROS's joint states have them; otherwise: --unit")
    if is_in_volts(heading):
        return Unit("", "", ASKED[kind])  # its steps are those of an analogue-to-digital converter
    values = table.numbers(heading.name)
    window, rows = said.speed_window or period, None if said.speed_window else stamps
    guessed = guess_speed_unit(values, window, rows) if kind is Kind.SPEED else guess_position_unit(values)
    if not guessed.name and "count" in guessed.candidates and said.edges_per_revolution not in (None, WHOLE_DEGREES):
        return Unit("count", "as the counts of a turn are said; otherwise: --unit")
    if not guessed.name and guessed.candidates == OF_COUNTS and said.edges_per_revolution not in (None, *WHOLE_UNITS):
        return Unit("count/s", "as the counts of a turn are said; otherwise: --unit")
    if not guessed.name and stamps is not None:
        tell = tell_speed_unit if kind is Kind.SPEED else tell_position_unit
        guessed = tell(table, heading, stamps) or guessed
    return guessed


def _ask_about(
    column: str, values: Floats, kind: Kind, unit: Unit, said: Said, notes: Notes, speed_beside: str
) -> None:
    if not unit.name and is_in_volts(read_heading(column)):
        sensor, taken = ("tachogenerator", "rad/s") if kind is Kind.SPEED else ("potentiometer", "rad")
        of_which = f"of a {sensor}, say --unit {taken}, and 1 V of it is taken for 1 {taken}"
        notes.questions.append((column, f"is a voltage: {of_which}; of an encoder's pulses, log their count instead"))
    elif not unit.name:
        options = f"{', '.join(unit.candidates[:-1])} or {unit.candidates[-1]}"
        if set(ASKED[kind]) <= set(unit.candidates):
            options += f", or of a slide in {SLIDES[kind]}"
        counted = kind is Kind.SPEED and not np.any(values % 1.0) and "count/s" not in unit.candidates
        size = "" if said.edges_per_revolution else " and --edges-per-revolution N"
        counts = f", or --count {quote(column)}{size} where they are the counts of each row" if counted else ""
        speed = f", or one of {', '.join(ASKED[Kind.SPEED])} to read {speed_beside} instead" if speed_beside else ""
        sized = " (count with --edges-per-revolution N)" if size and "count" in unit.candidates else ""
        question = f"in {options}, which the numbers do not tell: say --unit{sized}{speed}{counts}"
        notes.questions.append((column, question))
    if unit.name in ("count", "count/s") and said.edges_per_revolution is None:
        question = f"in {unit.name}: say how many counts there are in a turn (--edges-per-revolution N)"
        notes.questions.append((column, question))
    if unit.name in LENGTHS and said.units_per_revolution is None and said.edges_per_revolution is not None:
        how_far = f"in {unit.name}: say how many {LENGTHS[unit.name][0]} a turn goes (--units-per-revolution U)"
        notes.questions.append((column, how_far))


def _kind_of(heading: Heading) -> Kind | None:
    return _KINDS[heading.quantity] if heading.quantity in MOVES else None
