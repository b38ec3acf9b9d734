"""The form of one motor in a table: how its drive becomes volts, what its motion is, when its runs begin."""

from dataclasses import dataclass, replace
from math import tau
from shlex import quote

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.behaviour.codes import find_codes
from motor_identification.logs.columns.behaviour.held_set_point import share_of_changes
from motor_identification.logs.columns.behaviour.standing_start import begins_at_rest
from motor_identification.logs.columns.behaviour.swings import goes_to_and_fro
from motor_identification.logs.columns.cautions import (
    caution_beyond_full,
    caution_no_means,
    caution_running_without_drive,
    caution_set_point,
)
from motor_identification.logs.columns.drive import supply_scale
from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.motion.direction import guess_direction
from motor_identification.logs.columns.motion.increments import count_anew
from motor_identification.logs.columns.motion.kind_and_unit import find_speed_with_unit, read_motion
from motor_identification.logs.columns.motion.movement import ASKED
from motor_identification.logs.columns.motion.speed_beside import Counted, find_counted_position, find_summed_counts
from motor_identification.logs.columns.motion.turn_counts import say_turn_counts
from motor_identification.logs.columns.motor_drive import read_drive
from motor_identification.logs.columns.notes import Notes
from motor_identification.logs.columns.roles.roles import Roles
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import LENGTHS, CsvForm, Kind, time_unit_size
from motor_identification.logs.rows.drive.constant_voltage import CONSTANT

Floats = NDArray[np.float64]

AS_SAID = (  # of the form, and nothing else tells it
    "edges_per_revolution",
    "gear",
    "count_quantum",
    "units_per_revolution",
    "wrap",
    "speed_window",
    "speed_lag",
    "voltage_before",
    "even_clock",
    "nominal_period",
)
STEPS_BETWEEN = 0.8  # of the rows that a steady curve's voltage changes in


@dataclass(frozen=True)
class Rows:
    """When the rows of a table were."""

    time: str | None  # column; None where rows are steady states
    unit: str  # of the times
    period: float  # [s]

    @property
    def spacing(self) -> float:
        """[s] between rows; 0 where they are steady states."""
        return self.period if self.time else 0.0

    def stamps(self, table: Table) -> Floats | None:
        """Read the times [s] of a table's rows, shape (K,); None where they are steady states."""
        if self.time is None:
            return None
        return np.asarray(table.nanoseconds(self.time, time_unit_size(self.unit)) * 1e-9, dtype=np.float64)


def make_form(table: Table, pair: Pair, roles: Roles, said: Said, rows: Rows, notes: Notes) -> CsvForm:
    """Make the form of one motor; what is guessed and what is missing goes to the notes."""
    stamps = rows.stamps(table)
    pair, said, instead = _choose_motion(table, pair, roles, said, rows, stamps)
    said = say_turn_counts(table, pair, stamps, said, notes)
    if not instead and (speed := find_speed_with_unit(table, pair, said, rows.spacing, stamps)):
        instead = f", as nothing tells the unit of {pair.motion} (otherwise: --position {quote(pair.motion)} --unit U)"
        pair = replace(pair, motion=speed)
    drive, scale, supply = read_drive(table, pair, roles, said, notes)
    driven = bool(pair.label or np.any(table.numbers(pair.voltage)))  # of several motors, one may not be
    codes = () if said.full_duty or not drive.full else find_codes(table.numbers(pair.voltage))
    caution_beyond_full(table, pair, None if codes else drive.full, notes)
    volts = supply_scale(read_heading(supply), table.numbers(supply)) if supply else (1.0, "")
    beside = f", times {supply} in {volts[1]}" if supply else ""
    notes.findings.append(f"Voltage{_whose(pair)}: {pair.voltage} {drive.why}{beside}.")
    kind, unit, said = _read_motion(table, pair, said, rows, stamps, instead, notes)
    increments = kind is Kind.COUNT and count_anew(table, pair, said, notes)
    direction = guess_direction(table, pair, said, increments or kind is Kind.SPEED, notes)
    milliamperes = roles.current is not None and read_heading(roles.current).unit == "mA"
    return CsvForm(
        time=rows.time,
        voltage=pair.voltage,
        motion=pair.motion,
        kind=kind,
        unit=unit,
        voltage_scale=scale,
        split=said.split,
        rest_until=_rest(table, stamps, pair, kind, said, notes),
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
        **{name: getattr(said, name) for name in AS_SAID},
    )


def _whose(pair: Pair) -> str:
    return f" of {pair.label}" if pair.label else ""


def _choose_motion(
    table: Table, pair: Pair, roles: Roles, said: Said, rows: Rows, stamps: Floats | None
) -> tuple[Pair, Said, str]:
    """Choose what was counted, where the column of motion is the speed of that; and say what it is instead of."""
    taken = frozenset(name for name in (rows.time, roles.supply, roles.current, said.split) if name)
    counted = _find_counted(table, pair, taken, said, stamps)
    if counted is None:
        return pair, said, ""
    said = replace(said, kind=Kind.COUNT) if counted.whole else said
    instead = f", of which {counted.speed} is the speed (otherwise: --speed {quote(counted.speed)})"
    return replace(pair, motion=counted.column), said, instead


def _read_motion(
    table: Table, pair: Pair, said: Said, rows: Rows, stamps: Floats | None, instead: str, notes: Notes
) -> tuple[Kind, str, Said]:
    """Read kind and unit of the column of motion, and how far a unit of a slide is taken to go; cautions and notes."""
    kind, unit = read_motion(table, pair, said, rows.spacing, stamps, notes)
    length = ""
    if unit.name in LENGTHS and said.units_per_revolution is None and said.edges_per_revolution is None:
        length = LENGTHS[unit.name][0]
        far = f"1 {length} is taken for 1 rad, and V·s/rad are V·s/{length}; otherwise: --units-per-revolution"
        unit = replace(unit, why="; ".join(filter(None, (unit.why, far))))
        said = replace(said, units_per_revolution=tau)
    if said.constant_voltage is None:
        caution_set_point(table, pair, kind, notes)
    if kind is Kind.SPEED and said.constant_voltage is None:
        caution_running_without_drive(table, pair, notes)
        caution_no_means(table, pair, notes)
    why = f" ({unit.why})" if unit.why else ""
    notes.findings.append(f"Motion{_whose(pair)}: {pair.motion}, a {kind.value} in {unit.name or '?'}{why}{instead}.")
    if length:
        notes.findings.append(
            f"Reports on it then say rad for {length}, rad/s for {length}/s, and count per turn what {tau:.4g} "
            f"{length} have."
        )
    if rows.time is None and not said.steady:
        _ask_for_times(table, pair, kind, notes)
    return kind, unit.name or ASKED.get(kind, ("count",))[0], said


def _find_counted(table: Table, pair: Pair, taken: frozenset[str], said: Said, stamps: Floats | None) -> Counted | None:
    """Find what was counted, of which the column of motion is the speed; None where the user said what it is."""
    if (said.motion, said.unit, said.motors) != (None, None, ()):
        return None
    summed = find_summed_counts(table, pair, taken)
    return summed or (None if stamps is None else find_counted_position(table, pair, taken, stamps))


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
