"""A table's forms, one a motor: as the user said, and guessed where not; every guess is said."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from motor_identification.logs.columns.behaviour.held_set_point import holds_a_set_point, share_of_changes
from motor_identification.logs.columns.behaviour.prompt_answer import answers_too_soon
from motor_identification.logs.columns.clock import (
    SLOWEST,
    SLOWEST_STEADY,
    can_be_longer,
    guess_time_unit,
    row_period,
    since_1970,
)
from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.motor_form import STEPS_BETWEEN, Rows, make_form
from motor_identification.logs.columns.notes import Notes
from motor_identification.logs.columns.roles.roles import Roles, find_roles
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.columns.vocabulary import Quantity
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import TIME_UNITS, CsvForm, Kind, time_unit_size
from motor_model.errors import RecordingError

_AT_A_RATE = re.compile(r"\d\s*k?hz\b", re.I)  # in the name of a column of times: 8 kHz
MOST_STAIRS = 100  # rows: a program that looks at a motor every millisecond logs more
SHORTEST = 1e-6  # [s] between rows: what a unit makes shorter is in another one


@dataclass(frozen=True)
class Guess:
    """One form a motor, and a line for each column: what it was taken for and why."""

    forms: tuple[CsvForm, ...]
    findings: tuple[str, ...]


def guess_forms(table: Table, said: Said) -> Guess:
    """Guess how to read a table.

    Raises:
        RecordingError: what cannot be guessed, all of it in one sentence with the options that say it.
    """
    roles, still = _without_still(table, find_roles(table, said), said)
    notes = Notes([], [])
    if roles.left_out:
        notes.findings.append(
            f"Left out, as no column drives them: {', '.join(roles.left_out)} (otherwise: --motor NAME:DRIVE,MOTION)."
        )
    notes.findings.extend(roles.findings)
    _check_drive(table, roles, said)
    rows = _rows(table, roles, said, notes)
    forms = [make_form(table, pair, roles, said, rows, notes) for pair in roles.pairs]
    if notes.questions:
        raise RecordingError(f"{table.path}: {_ask_once(notes.questions)}.")
    return Guess(tuple(forms), tuple(dict.fromkeys([*notes.findings, *still])))


def _without_still(table: Table, roles: Roles, said: Said) -> tuple[Roles, list[str]]:
    """Leave out motors that are not driven and never move, beside one that is: nothing is asked about them."""
    still = [pair for pair in roles.pairs if not _is_driven(table, pair) and not np.ptp(table.numbers(pair.motion)) > 0]
    if said.motors or not any(_is_driven(table, pair) for pair in roles.pairs):
        return roles, []
    left = [f"Left out: motor {pair.label}, which is not driven and hardly moves." for pair in still]
    return replace(roles, pairs=tuple(pair for pair in roles.pairs if pair not in still)), left


def _is_driven(table: Table, pair: Pair) -> bool:
    return bool(np.any(table.numbers(pair.voltage)))


def _check_drive(table: Table, roles: Roles, said: Said) -> None:
    """Refuse drives that are all 0 in every row, before their supply and the motions' units are asked for."""
    if said.max_voltage or not len(table) or any(_is_driven(table, pair) for pair in roles.pairs):
        return
    zero = " and ".join(dict.fromkeys(pair.voltage for pair in roles.pairs))
    drives = f"{zero} is" if len(roles.pairs) == 1 else f"{zero} are"
    raise RecordingError(f"{table.path}: {drives} 0 in every row: check --voltage, or give --max-voltage.")


def _rows(table: Table, roles: Roles, said: Said, notes: Notes) -> Rows:
    """When the rows were, and whether they are steady states."""
    if roles.time is None:
        if not said.steady:
            notes.findings.append(
                "No column of times: every row is taken for a steady state (otherwise: --time, or --sample-period)."
            )
        return Rows(None, "s", 0.0)
    unit, why = _time_unit(table, roles.time, said)
    if unit == "us" and why and not said.time_unit and _climbs_stairs(table, roles):
        unit, why = "ms", " (as few rows as a static curve has, a level each; otherwise: --time-unit)"
    if not said.time_unit and (longer := _find_longer_unit(table, roles, said, unit)):
        shown = f"{row_period(table.numbers(roles.time)) * TIME_UNITS[unit] * 1e-6:.4g} ms"
        why = f" (in {unit}, rows were {shown} apart, and no motor answers as soon; otherwise: --time-unit)"
        unit = longer
    if not said.time_unit and _AT_A_RATE.search(roles.time):
        notes.questions.append((roles.time, "counts by a rate: say how many seconds one is (--time-unit S)"))
    if said.sample_period:
        notes.findings.append(f"Time: rows are {said.sample_period * 1e3:.6g} ms apart, as said (--sample-period).")
    else:
        notes.findings.append(f"Time: {roles.time} in {unit}{why}.")
    stamps = table.nanoseconds(roles.time, time_unit_size(unit))
    period = row_period(np.asarray(stamps * 1e-9, dtype=np.float64))
    far_apart = period > SLOWEST and share_of_changes(table.numbers(roles.pairs[0].voltage)) > STEPS_BETWEEN
    controlled = far_apart and any(holds_a_set_point(table, pair, said) for pair in roles.pairs)
    if controlled:
        notes.findings.append(
            f"Caution: rows are {period:.3g} s apart, and a controller changes the voltage meanwhile: what it drove "
            "between them is not logged. Do not trust ka and delays; log faster."
        )
    if said.time or controlled or not far_apart:
        return Rows(roles.time, unit, period)
    notes.findings.append(
        f"Rows are {period:.3g} s apart and the voltage changes in each: every row is taken for a steady state "
        "(assumed; otherwise: --time)."
    )
    return Rows(None, unit, period)


def _time_unit(table: Table, column: str, said: Said) -> tuple[str, str]:
    if said.time_unit:
        known = said.time_unit in TIME_UNITS
        return said.time_unit, "" if known else " s a tick, as said"
    heading = read_heading(column)
    try:
        values = table.numbers(column)
    except RecordingError:  # times of day, or garbage, which is told with its line
        return heading.unit if heading.unit in TIME_UNITS else "s", ""
    if heading.unit in TIME_UNITS:
        if row_period(values) * TIME_UNITS[heading.unit] < SHORTEST * 1e9:  # as where a program divides by 10⁶
            unit, why = guess_time_unit(values)
            return unit, f" (whatever its name says: {why}; otherwise: --time-unit)"
        seconds = heading.unit == "ms" and since_1970(values) == "s" and bool(np.any(values % 1.0))
        return (
            ("s", " (whatever its name says: they count from 1970 in s; otherwise: --time-unit)")
            if seconds
            else (heading.unit, "")
        )
    unit, why = guess_time_unit(values)
    return unit, f" ({why}; otherwise: --time-unit)"


def _climbs_stairs(table: Table, roles: Roles) -> bool:
    """Whether a voltage goes the same step further in each of few rows, a second or so apart if they are in ms."""
    steps = np.diff(table.numbers(roles.pairs[0].voltage))
    if not 1 < len(steps) < MOST_STAIRS or row_period(table.numbers(roles.time or "")) > SLOWEST_STEADY:
        return False
    return bool(np.mean((steps == np.median(steps)) & (steps != 0.0)) > STEPS_BETWEEN)


def _find_longer_unit(table: Table, roles: Roles, said: Said, unit: str) -> str:
    """Find the next longer unit of times without one, where the motion answers too soon in this one; else empty."""
    units = sorted(TIME_UNITS, key=lambda one: TIME_UNITS[one])
    place = units.index(unit) + 1
    if read_heading(roles.time or "").unit in TIME_UNITS or place == len(units):
        return ""
    try:
        values = table.numbers(roles.time or "")
    except RecordingError:  # times of day
        return ""
    period = row_period(values) * 1e-9
    if not can_be_longer(values) or not 0.0 < period * TIME_UNITS[units[place]] < SLOWEST_STEADY * 1e-3:
        return ""
    for pair in roles.pairs:
        quantity = read_heading(pair.motion).quantity  # counts may be those of each row
        is_speed = said.kind is Kind.SPEED or quantity is Quantity.SPEED
        if not is_speed and (said.kind or quantity) not in (Kind.POSITION, Quantity.POSITION):
            continue
        drive, motion = table.numbers(pair.voltage), table.numbers(pair.motion)
        if answers_too_soon(drive, motion, is_speed, period * TIME_UNITS[unit]):
            return units[place]
    return ""


def _ask_once(questions: Sequence[tuple[str, str]]) -> str:
    """Each question once, with the columns that need it."""
    columns: dict[str, list[str]] = {}
    for column, question in questions:
        columns.setdefault(question, []).append(column)
    return "; ".join(f"{' and '.join(dict.fromkeys(names))} {question}" for question, names in columns.items())
