"""A recording out of a bag of any robot, by a mapping."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from motor_identification.bag.fields import Series, read_fields
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.log import Log, read_motor
from motor_identification.mapping.alignment import align
from motor_identification.mapping.mapping import Mapping, load_mapping
from motor_identification.recording import Recording, recording_of

_DEFAULT_UNITS = {Kind.SPEED: "rad/s", Kind.POSITION: "rad", Kind.COUNT: "count"}  # REP 103


@dataclass(frozen=True)
class MappedReader:
    """Reads bags by a mapping: what a `Source` calls instead of looking for `motor/speed`."""

    mapping: Mapping

    def __call__(self, uri: str) -> Recording:
        """Read a bag.

        Raises:
            RecordingError: as `read_mapped`.
        """
        return read_mapped(uri, self.mapping)


def make_reader(path: str) -> MappedReader | None:
    """Make the reader by a mapping file; None without a path.

    Raises:
        RecordingError: it is no mapping.
    """
    return MappedReader(load_mapping(path)) if path else None


def read_mapped(uri: str | Path, mapping: Mapping) -> Recording:
    """Read the motor that a mapping describes; the longest part, where gaps and resets make several.

    Raises:
        RecordingError: the bag, a topic or a field is not there, or the numbers are those of no motor.
    """
    return take_longest(str(uri), *read_mapped_log(uri, mapping))


def take_longest(name: str, log: Log, notes: tuple[str, ...]) -> Recording:
    """Take the longest part of a log as a recording."""
    run = max(log.runs, key=lambda one: one.duration)
    if len(log.runs) > 1:
        notes = (*notes, f"{name} is in {len(log.runs)} parts: the longest is used, {run.duration:.4g} s.")
    return recording_of(run.samples, log.info, name, notes)


def read_mapped_log(uri: str | Path, mapping: Mapping) -> tuple[Log, tuple[str, ...]]:
    """Read all parts of a bag, and what a user has to know of them.

    Raises:
        RecordingError: as above.
    """
    return make_mapped_log(str(uri), read_fields(uri, mapping.paths), mapping)


def make_mapped_log(
    name: str, fields: Sequence[Series], mapping: Mapping, signs_as_they_are: bool = False
) -> tuple[Log, tuple[str, ...]]:
    """Make a log of the fields at a mapping's `paths`, and what a user has to know of them.

    A motion against its voltage is turned round, unless signs are to stay as they are: a motor that is watched may do
    so because something broke.

    Raises:
        RecordingError: they do not overlap, or the numbers are those of no motor.
    """
    voltage, motion, *current = fields
    rows = align(voltage, motion, current[0] if current else None)
    cells = {
        "time": rows.time,
        str(mapping.voltage): rows.voltage,
        str(mapping.motion): rows.motion * mapping.motion.scale,
    }
    measured = mapping.current is not None and bool(np.all(np.isfinite(rows.current)))
    if measured:
        cells[str(mapping.current)] = rows.current
    table = Table(Path(name), np.arange(1, len(rows.time) + 1), cells)
    form = _form(mapping, str(mapping.current) if measured else None)
    log = read_motor(table, replace(form, signs_as_they_are=signs_as_they_are))
    return log, (*rows.notes, *log.findings)


def _form(mapping: Mapping, current: str | None) -> CsvForm:
    return CsvForm(
        time="time",
        time_unit="ns",
        voltage=str(mapping.voltage),
        voltage_scale=mapping.voltage.scale,
        motion=str(mapping.motion),
        kind=mapping.kind,
        unit=mapping.motion.unit or _DEFAULT_UNITS[mapping.kind],
        edges_per_revolution=mapping.edges_per_revolution,
        units_per_revolution=mapping.units_per_revolution,
        speed_window=mapping.speed_window,
        speed_lag=mapping.speed_lag,
        max_voltage=mapping.max_voltage,
        voltage_before=mapping.voltage_before,
        current=current,
        current_scale=mapping.current.scale if mapping.current else 1.0,
        name=mapping.name,
    )
