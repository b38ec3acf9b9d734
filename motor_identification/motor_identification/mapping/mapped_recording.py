"""A recording out of a bag of any robot, by a mapping."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from motor_identification.bag.fields import read_fields
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
    """The reader by a mapping file; None without a path.

    Raises:
        RecordingError: it is no mapping.
    """
    return MappedReader(load_mapping(path)) if path else None


def read_mapped(uri: str | Path, mapping: Mapping) -> Recording:
    """Read the motor that a mapping describes; the longest part, where gaps and resets make several.

    Raises:
        RecordingError: the bag, a topic or a field is not there, or the numbers are those of no motor.
    """
    log, notes = read_mapped_log(uri, mapping)
    run = max(log.runs, key=lambda one: one.duration)
    if len(log.runs) > 1:
        notes = (*notes, f"{uri} is in {len(log.runs)} parts: the longest is used, {run.duration:.4g} s.")
    return recording_of(run.samples, log.info, str(uri), notes)


def read_mapped_log(uri: str | Path, mapping: Mapping) -> tuple[Log, tuple[str, ...]]:
    """Read all parts of a bag, and what a user has to know of them.

    Raises:
        RecordingError: as above.
    """
    origins = [mapping.voltage, mapping.motion, *([mapping.current] if mapping.current else [])]
    voltage, motion, *current = read_fields(uri, [origin.path for origin in origins])
    rows = align(voltage, motion, current[0] if current else None)
    cells = {
        "time": rows.time,
        str(mapping.voltage): rows.voltage,
        str(mapping.motion): rows.motion * mapping.motion.scale,
    }
    measured = mapping.current is not None and bool(np.all(np.isfinite(rows.current)))
    if measured:
        cells[str(mapping.current)] = rows.current
    table = Table(Path(uri), np.arange(1, len(rows.time) + 1), cells)
    log = read_motor(table, _form(mapping, str(mapping.current) if measured else None))
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
