"""A log file as recordings: its format, its columns, its motors, and what was found on the way."""

from dataclasses import dataclass, replace
from pathlib import Path

from motor_identification.logs.columns.behaviour.half_bridges import join_half_bridge
from motor_identification.logs.columns.behaviour.pulses import read_pulses
from motor_identification.logs.columns.guess import guess_forms
from motor_identification.logs.columns.motion.direction import join_two_ways
from motor_identification.logs.columns.motion.edge_periods import read_edge_periods
from motor_identification.logs.columns.said import Said
from motor_identification.logs.csv.graph_export import name_plots
from motor_identification.logs.csv.mending import mend_table, take_off_units
from motor_identification.logs.csv.sparse import fill_gaps
from motor_identification.logs.csv.table import Table
from motor_identification.logs.excitation import describe_excitation, hardly_moves
from motor_identification.logs.formats.source import Source, read_source
from motor_identification.logs.log import Log, read_motor
from motor_identification.logs.motor_rows import separate_motors
from motor_identification.logs.rows.drive.constant_voltage import CONSTANT, give_voltage, wait_for_motion
from motor_identification.logs.rows.row_times import (
    ROW_TIMES,
    give_times,
    number_rows,
    space_evenly,
    sum_steps,
    take_periods_out,
    write_times_in_seconds,
)
from motor_model.errors import RecordingError


@dataclass(frozen=True)
class Motor:
    """One motor of a log; `label` is empty where it is the only one."""

    label: str
    log: Log


@dataclass(frozen=True)
class Imported:
    """The motors of a file; `findings` are lines for the user about all of it."""

    motors: tuple[Motor, ...]
    findings: tuple[str, ...]


def import_log(path: Path, said: Said) -> Imported:
    """Read a log file of any known format.

    Raises:
        RecordingError: it cannot be read, or what cannot be guessed has to be said: the sentence asks for it.
    """
    return import_source(read_source(path, said), said)


def import_source(source: Source, said: Said) -> Imported:
    """Read the motors out of a table.

    Raises:
        RecordingError: as above.
    """
    given = take_off_units(name_plots(source.table))
    said = said.with_names(given.names)
    motors: list[Motor] = []
    findings: list[str] = []
    for label, table in separate_motors(given, said).items():
        own = source.with_said(said)
        by_name = bool(label and own.split and table.text(own.split, 0).strip() == label)  # there is nothing to split
        found, about = _read_motors(table, replace(own, split=None) if by_name else own)
        motors += [replace(motor, label="_".join(filter(None, (label, motor.label)))) for motor in found]
        findings += about
    motors, still = _without_still(motors)
    if not any(motor.log.runs for motor in motors):
        raise RecordingError(f"{given.path} holds no recording: give a log with at least 2 samples.")
    about_file = f"{given.path}: a {source.format} with the columns {_listed(source.table.names)}."
    return Imported(tuple(motors), (about_file, *dict.fromkeys(findings), *still))


def _read_motors(given: Table, said: Said) -> tuple[list[Motor], list[str]]:
    """Read the motors whose columns stand side by side, and what was found about all of them."""
    if said.sample_period is None:
        timed = given if said.time_unit else write_times_in_seconds(given)
        untimed = said.time is None and not said.steady
        table = mend_table(space_evenly(sum_steps(take_periods_out(timed))) if untimed else timed)
    else:
        table = give_times(mend_table(number_rows(given)), said.sample_period)
        said = replace(said, time=ROW_TIMES, time_unit="ns")
    if said.constant_voltage is not None:
        table = give_voltage(table, said.constant_voltage)
        said = replace(said, voltage=CONSTANT)
    table, said = read_edge_periods(table, said)
    joined = table if said.motors else join_half_bridge(join_two_ways(table, said.voltage), said)
    filled = fill_gaps(read_pulses(joined, said))
    if said.neutral is not None:  # then they are shares
        said = replace(said, full_duty=1.0)
    guess = guess_forms(filled.table, said)
    motors = []
    for form in guess.forms:
        rows = filled.rows_of(form.time, form.motion, form.voltage, form.supply, form.direction)
        rows = wait_for_motion(rows, form)
        log = read_motor(replace(rows, notes=rows.notes[len(table.notes) :]), form)
        motors.append(Motor(form.label, replace(log, findings=(*log.findings, *describe_excitation(log)))))
    return motors, [*table.notes, *guess.findings]


def _without_still(motors: list[Motor]) -> tuple[list[Motor], list[str]]:
    """The motors but for those that were not driven and hardly move, beside one that does, and a finding for each."""
    still = [motor for motor in motors if motor.log.runs and hardly_moves(motor.log) and not _is_driven(motor)]
    if not still or len(still) == len(motors):
        return motors, []
    said = [f"Left out: motor {motor.label}, which is not driven and hardly moves." for motor in still]
    return [motor for motor in motors if motor not in still], said


def _is_driven(motor: Motor) -> bool:
    return any(sample.voltage != 0.0 for run in motor.log.runs for sample in run.samples)


def _listed(names: list[str]) -> str:
    shown = ", ".join(names[:12])
    return f"{shown} and {len(names) - 12} more" if len(names) > 12 else shown
