"""The form of one motor in a table: how its drive becomes volts, what its motion is, when its runs begin."""

import re
from dataclasses import dataclass, replace
from math import tau

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.behaviour.codes import find_codes
from motor_identification.logs.columns.behaviour.following import is_speed_by_drive
from motor_identification.logs.columns.behaviour.standing_start import begins_at_rest
from motor_identification.logs.columns.behaviour.swings import goes_to_and_fro
from motor_identification.logs.columns.cautions import (
    caution_beyond_full,
    caution_no_means,
    caution_running_without_drive,
    caution_set_point,
)
from motor_identification.logs.columns.direction import guess_direction
from motor_identification.logs.columns.drive import supply_scale
from motor_identification.logs.columns.heading import Heading, is_in_volts, is_of_joint_states, read_heading
from motor_identification.logs.columns.increments import count_anew
from motor_identification.logs.columns.motor_drive import read_drive
from motor_identification.logs.columns.movement import (
    ASKED,
    SLIDES,
    Unit,
    guess_kind,
    guess_position_unit,
    guess_speed_unit,
    is_encoders_angle,
    is_kind_sure,
)
from motor_identification.logs.columns.notes import Notes
from motor_identification.logs.columns.roles.roles import Roles
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.columns.speed_beside import (
    Counted,
    find_counted_position,
    find_summed_counts,
    tell_position_unit,
    tell_speed_unit,
)
from motor_identification.logs.columns.turn_counts import say_turn_counts
from motor_identification.logs.columns.vocabulary import MOVES, UNIT_BY_SPELLING, Quantity
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import LENGTHS, UNITS, CsvForm, Kind, time_unit_size
from motor_identification.logs.rows.drive.constant_voltage import CONSTANT

Floats = NDArray[np.float64]

STEPS_BETWEEN = 0.8  # of the rows that a steady curve's voltage changes in
WHOLE_DEGREES = 360  # counts a turn, which are degrees as well
ELECTRICAL = "of electrical turns: speeds are those of the shaft times its pole pairs"
_KINDS = {Quantity.SPEED: Kind.SPEED, Quantity.POSITION: Kind.POSITION, Quantity.COUNT: Kind.COUNT}
_ORDER = (Kind.SPEED, Kind.COUNT, Kind.POSITION)  # `count` is a count before it is a position


@dataclass(frozen=True)
class Rows:
    """When the rows of a table were."""

    time: str | None  # column; None where rows are steady states
    unit: str  # of the times
    period: float  # [s]

    def stamps(self, table: Table) -> Floats | None:
        """Read the times [s] of a table's rows, shape (K,); None where they are steady states."""
        if self.time is None:
            return None
        return np.asarray(table.nanoseconds(self.time, time_unit_size(self.unit)) * 1e-9, dtype=np.float64)


def make_form(table: Table, pair: Pair, roles: Roles, said: Said, rows: Rows, notes: Notes) -> CsvForm:
    """The form of one motor; what is guessed and what is missing goes to the notes."""
    whose = f" of {pair.label}" if pair.label else ""
    stamps = rows.stamps(table)
    taken = frozenset(name for name in (rows.time, roles.supply, roles.current, said.split) if name)
    counted = _find_counted(table, pair, taken, said, stamps)
    said = replace(said, kind=Kind.COUNT) if counted and counted.whole else said
    beside_it = f", of which {counted.speed} is the speed (otherwise: --speed {counted.speed})" if counted else ""
    pair = replace(pair, motion=counted.column) if counted else pair
    said = say_turn_counts(table, pair, stamps, said, notes)
    if not counted and (speed := _find_speed_with_unit(table, pair, said, rows.period if rows.time else 0.0, stamps)):
        beside_it = f", as nothing tells the unit of {pair.motion} (otherwise: --position {pair.motion} --unit U)"
        pair = replace(pair, motion=speed)
    drive, scale, supply = read_drive(table, pair, roles, said, notes)
    driven = bool(pair.label or np.any(table.numbers(pair.voltage)))  # of several motors, one may not be
    codes = () if said.full_duty or not drive.full else find_codes(table.numbers(pair.voltage))
    caution_beyond_full(table, pair, None if codes else drive.full, notes)
    volts = supply_scale(read_heading(supply), table.numbers(supply)) if supply else (1.0, "")
    beside = f", times {supply} in {volts[1]}" if supply else ""
    notes.findings.append(f"Voltage{whose}: {pair.voltage} {drive.why}{beside}.")
    kind, unit = _motion(table, pair, said, rows.period if rows.time else 0.0, stamps, notes)
    if unit.name in LENGTHS and said.units_per_revolution is None and said.edges_per_revolution is None:
        length = LENGTHS[unit.name][0]
        far = f"1 {length} is taken for 1 rad, and V·s/rad are V·s/{length}; otherwise: --units-per-revolution"
        unit, said = (
            replace(unit, why="; ".join(filter(None, (unit.why, far)))),
            replace(said, units_per_revolution=tau),
        )
    if said.constant_voltage is None:
        caution_set_point(table, pair, kind, notes)
    if kind is Kind.SPEED and said.constant_voltage is None:
        caution_running_without_drive(table, pair, notes)
        caution_no_means(table, pair, notes)
    why = f" ({unit.why})" if unit.why else ""
    notes.findings.append(f"Motion{whose}: {pair.motion}, a {kind.value} in {unit.name or '?'}{why}{beside_it}.")
    if rows.time is None and not said.steady:
        _ask_for_times(table, pair, kind, notes)
    increments = kind is Kind.COUNT and count_anew(table, pair, said, notes)
    direction = guess_direction(table, pair, said, increments or kind is Kind.SPEED, notes)
    milliamperes = roles.current is not None and read_heading(roles.current).unit == "mA"
    same = (
        "edges_per_revolution",
        "gear",
        "count_quantum",
        "units_per_revolution",
        "wrap",
        "speed_window",
        "speed_lag",
    )
    return CsvForm(
        time=rows.time,
        voltage=pair.voltage,
        motion=pair.motion,
        kind=kind,
        unit=unit.name or ASKED.get(kind, ("count",))[0],
        voltage_scale=scale,
        split=said.split,
        rest_until=_rest(table, stamps, pair, kind, said, notes),
        voltage_before=said.voltage_before,
        even_clock=said.even_clock,
        nominal_period=said.nominal_period,
        name=said.name if said.name != "motor" or not pair.label else pair.label,
        max_voltage=said.max_voltage or (said.supply_voltage if drive.full and driven else None),
        time_unit=rows.unit,
        supply=supply,
        supply_scale=volts[0],
        current=roles.current,
        current_scale=1e-3 if milliamperes else 1.0,
        label=pair.label,
        direction=direction.column if direction else None,
        backward=direction.backward if direction else (),
        codes=codes,
        increments=increments,
        **{name: getattr(said, name) for name in same},
    )


def _find_counted(table: Table, pair: Pair, taken: frozenset[str], said: Said, stamps: Floats | None) -> Counted | None:
    """Find what was counted, of which the column of motion is the speed; None where the user said what it is."""
    if (said.motion, said.unit, said.motors) != (None, None, ()):
        return None
    summed = find_summed_counts(table, pair, taken)
    return summed or (None if stamps is None else find_counted_position(table, pair, taken, stamps))


def _find_speed_with_unit(table: Table, pair: Pair, said: Said, period: float, stamps: Floats | None) -> str:
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


def _motion(
    table: Table, pair: Pair, said: Said, period: float, stamps: Floats | None, notes: Notes
) -> tuple[Kind, Unit]:
    """Kind and unit of the column of motion."""
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
        return Kind.SPEED, Unit(f"{heading.unit}/s", f"{why}; otherwise: --position {pair.motion}")
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
    if not guessed.name and stamps is not None:
        tell = tell_speed_unit if kind is Kind.SPEED else tell_position_unit
        guessed = tell(table, heading, stamps) or guessed
    if not guessed.name and said.motion and said.kind:
        return Unit(next(iter(UNITS[kind])), "assumed; otherwise: --unit")
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
        counted = kind is Kind.SPEED and not np.any(values % 1.0)
        size = "" if said.edges_per_revolution else " and --edges-per-revolution N"
        counts = f", or --count {column}{size} where they are the counts of each row" if counted else ""
        speed = f", or one of {', '.join(ASKED[Kind.SPEED])} to read {speed_beside} instead" if speed_beside else ""
        question = f"in {options}, which the numbers do not tell: say --unit{speed}{counts}"
        notes.questions.append((column, question))
    if unit.name in ("count", "count/s") and said.edges_per_revolution is None:
        question = f"in {unit.name}: say how many counts there are in a turn (--edges-per-revolution N)"
        notes.questions.append((column, question))
    if unit.name in LENGTHS and said.units_per_revolution is None and said.edges_per_revolution is not None:
        how_far = f"in {unit.name}: say how many {LENGTHS[unit.name][0]} a turn goes (--units-per-revolution U)"
        notes.questions.append((column, how_far))


def _ask_for_times(table: Table, pair: Pair, kind: Kind, notes: Notes) -> None:
    """Ask, where rows without times are no steady states: these have speeds, and a voltage each."""
    times = "and no column is its times: say --time COL, or --sample-period S where the rows are S seconds apart"
    if kind is not Kind.SPEED:
        notes.questions.append((pair.motion, f"is a {kind.value}, {times}"))
    elif pair.voltage == CONSTANT:
        notes.questions.append((pair.motion, f"moves under one voltage, {times}; or --steady"))
    elif share_of_changes(table.numbers(pair.voltage)) < STEPS_BETWEEN:
        notes.questions.append((pair.voltage, f"stays from row to row, {times}; or --steady"))
    elif goes_to_and_fro(table.numbers(pair.voltage)):
        notes.questions.append((pair.voltage, f"goes to and fro, {times}; or --steady"))


def share_of_changes(values: Floats) -> float:
    """Count the rows whose value, shape (K,), is another than in the row before, as a share."""
    return float(np.mean(values[1:] != values[:-1]))


def _kind_of(heading: Heading) -> Kind | None:
    return _KINDS[heading.quantity] if heading.quantity in MOVES else None


def _rest(table: Table, stamps: Floats | None, pair: Pair, kind: Kind, said: Said, notes: Notes) -> float | None:
    """0, where every run's clock begins with its voltage, and the motor may have stood then."""
    if stamps is None or said.rest_until is not None:
        return said.rest_until
    if not begins_at_rest(stamps, table.numbers(pair.voltage), table.numbers(pair.motion), kind is Kind.SPEED):
        return None
    notes.findings.append(
        "Every run has one voltage, and its clock begins just before its first row: the voltage is taken to come upon "
        "a standing motor at 0 s (assumed; otherwise: --rest-until)."
    )
    return 0.0
