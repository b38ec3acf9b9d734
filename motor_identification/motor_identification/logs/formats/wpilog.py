"""WPILib's data log (WPILOG 1.0), as robots and SysId's routines write it: numbers by name, each with its own times.

The format is WPILib's "DataLog file format": the six letters, a version, an extra header; then records of an entry's
number, a payload's size and a time [us], each of as many bytes as it needs. Entry 0 says which others there are.
Numbers that come only when they change, or some microseconds after one another in one turn of a loop, are put into the
rows of the entry that came most often.
"""

import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path
from struct import calcsize, unpack_from
from typing import Any

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.said import Pair
from motor_identification.logs.csv.table import Table
from motor_model.errors import RecordingError

LETTERS, VERSION = b"WPILOG", 0x0100
NUMBERS = {"double": "<d", "float": "<f", "int64": "<q"}
STATE = "sysid-test-state"  # the text that SysId's routines log: which test runs
NO_TEST = "none"
TEST_NAMES = frozenset(f"{kind}-{way}" for kind in ("quasistatic", "dynamic") for way in ("forward", "reverse"))
MOTIONS = ("position", "velocity")  # of a routine's motor, the better one first
TOGETHER = 0.1  # of a row's time: what one turn of a loop logs comes within that
SELDOM = 0.05  # of the rows: what has fewer values need not have begun with the first row
MOST_NAMES, MOST_NUMBERS = 1000, 2**26
_UNITS = {"Volt": "V", "Ampere": "A", "Meter": "m", "Radian": "rad", "Rotation": "rev", "Degree": "deg"}


@dataclass
class Entry:
    """A named series."""

    name: str
    kind: str
    unit: str
    times: list[int] = field(default_factory=list)  # [us]
    values: list[Any] = field(default_factory=list)


@dataclass(frozen=True)
class RobotLog:
    """The numbers of a log as columns, and what SysId's routines say of them."""

    table: Table
    split: str | None  # the column of the tests
    motors: tuple[Pair, ...]  # that a routine logs by its own names, `voltage-MOTOR-MECHANISM` and so on


def read_wpilog(path: Path) -> RobotLog:
    """Read the numbers as columns, with `time [s]` and the tests of SysId as `test`.

    Where a routine names its motors, the rows are those in which it logs them, whatever else the robot writes.

    Raises:
        RecordingError: it is no such log, or has too few numbers in it, or too many.
    """
    data = path.read_bytes()
    entries, cut = _read_entries(path, data)
    numbers = [entry for entry in entries if entry.kind in NUMBERS and len(entry.times) >= 2]
    if len(numbers) < 2:
        raise RecordingError(f"{path} has no two series of numbers: log voltage and position or speed as doubles.")
    if len(numbers) > MOST_NAMES:
        raise RecordingError(f"{path} has {len(numbers)} series of numbers, and {MOST_NAMES} is the most: log fewer.")
    states = _states_of(entries)
    routine = _motors_of(numbers, states)
    rows = _rows_of_routine(routine, states) if routine else _rows_of(numbers)
    if len(rows) * len(numbers) > MOST_NUMBERS:
        raise RecordingError(f"{path} has {len(rows)} rows of {len(numbers)} numbers: export fewer of them as CSV.")
    tests = _tests_at(states, rows)
    chosen = tests != ""
    split = "test" if chosen.sum() >= 2 else None
    if split is None:
        chosen = np.ones(len(rows), np.bool_)
    cells: dict[str, Any] = {"test": tests[chosen]} if split else {}
    cells["time [s]"] = rows[chosen] * 1e-6
    names: dict[int, str] = {}
    for entry in numbers:
        names[id(entry)] = _free_name(entry, cells)
        cells[names[id(entry)]] = _at(entry, rows, np.nan)[chosen]
    _silence(cells, names, routine, states)
    first = next(iter(routine.values()), [max(numbers, key=lambda e: len(e.times))])[0]
    notes = [f"WPILOG of {len(numbers)} series; rows are those of {first.name}."]
    if split and len(states) > 1 and not routine:
        notes.append(f"Tests of {len(states)} mechanisms, named before each: choose the columns of one.")
    if routine:
        notes.append("Motors are those that SysId's routine names; other series are left out (otherwise: --motor).")
    notes += [f"{path} is damaged or cut off: what follows byte {cut} is not read."] if cut else []
    motors = tuple(
        Pair(label if len(routine) > 1 else "", names[id(voltage)], names[id(motion)])
        for label, (voltage, motion) in routine.items()
    )
    table = Table(path, np.arange(1, int(chosen.sum()) + 1), cells, notes=tuple(notes))
    return RobotLog(table, split, motors)


def _states_of(entries: list[Entry]) -> list[Entry]:
    """The series that say which test runs: by their name, or else one that says nothing but SysId's tests."""
    texts = [entry for entry in entries if entry.kind == "string" and entry.values]
    named = [entry for entry in texts if STATE in entry.name]
    told = [entry for entry in texts if TEST_NAMES & set(entry.values) and set(entry.values) <= {*TEST_NAMES, NO_TEST}]
    return named or told[:1]


def _motors_of(numbers: list[Entry], states: list[Entry]) -> dict[str, list[Entry]]:
    """Voltage and motion of each motor that routines log, by name, and by the mechanism where there are several.

    WPILib's SysIdRoutineLog calls them `voltage-MOTOR-MECHANISM`, where the state is `sysid-test-state-MECHANISM`.
    """
    series = {entry.name: entry for entry in numbers}
    found: dict[str, list[Entry]] = {}
    for state in states:
        mechanism = state.name.partition(STATE)[2]
        for name, voltage in series.items():
            if STATE not in state.name or not (name.startswith("voltage-") and name.endswith(mechanism)):
                continue
            motor = name.removeprefix("voltage-").removesuffix(mechanism)
            own = [series[one] for what in MOTIONS if (one := f"{what}-{motor}{mechanism}") in series]
            moving = [entry for entry in own if len(set(entry.values)) > 1] or own
            label = re.sub(r"[^\w.+]", "_", f"{motor}{mechanism}" if len(states) > 1 else motor)[:80]
            if moving and label not in found:
                found[label] = [voltage, moving[0]]
    return found


def _silence(
    cells: dict[str, Any], names: dict[int, str], routine: dict[str, list[Entry]], states: list[Entry]
) -> None:
    """Of several mechanisms, each says nothing in the tests of the others: its last values stand for none."""
    if len(states) < 2 or "test" not in cells:
        return
    for state in states:
        mechanism = state.name.partition(STATE)[2]
        others = ~np.char.startswith(cells["test"], mechanism.strip("-_ /")[:100] + " ")
        for entry in {id(one): one for ones in routine.values() for one in ones}.values():
            if entry.name.endswith(mechanism):
                cells[names[id(entry)]] = np.where(others, np.nan, cells[names[id(entry)]])


def _tests_at(states: list[Entry], rows: NDArray[np.float64]) -> NDArray[Any]:
    """Which test runs at each row, with its mechanism where there are several; empty where none does."""
    tests = np.zeros(len(rows), dtype="U201")
    for state in states:
        mechanism = state.name.partition(STATE)[2].strip("-_ /")[:100] if len(states) > 1 else ""
        for k, test in enumerate(_at(state, rows, "")):
            if test not in ("", NO_TEST) and not tests[k]:
                tests[k] = f"{mechanism} {test}".strip()
    return tests


def _free_name(entry: Entry, taken: Collection[str]) -> str:
    """A column for an entry that no other has: the table has a `test` of its own, and names may be of two kinds."""
    name = f"{entry.name} [{entry.unit}]" if entry.unit else entry.name
    return next(one for k in count(1) if (one := name if k == 1 else f"{name} ({k})") not in taken)


def _read_entries(path: Path, data: bytes) -> tuple[list[Entry], int]:
    """Every entry with its values, and the byte from which on nothing could be read; 0: there is none."""
    if len(data) < 12 or unpack_from("<H", data, 6)[0] >> 8 != VERSION >> 8:
        raise RecordingError(f"{path} is a WPILOG of another version than 1: export it as CSV.")
    started: dict[int, Entry] = {}
    found: dict[tuple[str, str], Entry] = {}  # by name and kind
    position = 12 + unpack_from("<I", data, 8)[0]
    if position > len(data):
        raise RecordingError(f"{path} is damaged: its header says that it is longer than the file; copy it again.")
    for number, time, payload, end in _records(data, position):
        position = end
        if number == 0:
            _start(payload, started, found)
        elif (entry := started.get(number)) is not None:
            _take(entry, time, payload)
    return list(found.values()), position if position < len(data) else 0


def _records(data: bytes, position: int) -> Iterator[tuple[int, int, bytes, int]]:
    """Entry, time [us], payload and end of each record up to the first that is cut off."""
    while position < len(data):
        sizes = data[position]
        parts, at = [], position + 1
        for length in ((sizes & 3) + 1, (sizes >> 2 & 3) + 1, (sizes >> 4 & 7) + 1):
            parts.append(int.from_bytes(data[at : at + length], "little"))
            at += length
        if sizes & 0x80 or at + parts[1] > len(data):
            return
        position = at + parts[1]
        yield parts[0], parts[2], data[at:position], position


def _start(payload: bytes, started: dict[int, Entry], found: dict[tuple[str, str], Entry]) -> None:
    """Take a control record: an entry starts, or ends; what else there is, is left out."""
    if len(payload) < 5:
        return
    number = unpack_from("<I", payload, 1)[0]
    if payload[0] == 1:
        started.pop(number, None)
    if payload[0] != 0:
        return
    texts, at = [], 5
    for _ in range(3):
        if at + 4 > len(payload):
            return
        size = unpack_from("<I", payload, at)[0]
        texts.append(payload[at + 4 : at + 4 + size].decode("utf-8", "replace"))
        at += 4 + size
    name, kind, metadata = texts
    if (name, kind) not in found and len(found) < 20 * MOST_NAMES:
        found[name, kind] = Entry(name, kind, _unit(metadata))
    if (name, kind) in found:
        started[number] = found[name, kind]


def _take(entry: Entry, time: int, payload: bytes) -> None:
    """Take a value; times that go back are another clock's, and are left out."""
    if entry.times and time < entry.times[-1] or time >= 1 << 53:
        return
    form = NUMBERS.get(entry.kind)
    if form is not None and len(payload) == calcsize(form):
        entry.values.append(float(unpack_from(form, payload)[0]))
    elif entry.kind == "string":
        entry.values.append(payload[:100].decode("utf-8", "replace"))
    else:
        return
    entry.times.append(time)


def _rows_of_routine(routine: dict[str, list[Entry]], states: list[Entry]) -> NDArray[np.float64]:
    """The times [us] of the rows: those of each mechanism's voltages, one of them where they come together."""
    mechanisms = [state.name.partition(STATE)[2] for state in states]
    voltages = [voltage for voltage, _ in routine.values()]
    first = [next((one for one in voltages if one.name.endswith(mechanism)), None) for mechanism in mechanisms]
    rows = [_rows_of([entry]) for entry in first if entry is not None]
    return np.asarray(np.unique(np.concatenate(rows)), dtype=np.float64)


def _rows_of(numbers: list[Entry]) -> NDArray[np.float64]:
    """The times [us] of the rows: those of the entry with most values, once all that come often have begun."""
    most = max(numbers, key=lambda entry: len(entry.times))
    rows = np.unique(np.array(most.times, np.float64))
    often = [entry.times[0] for entry in numbers if len(entry.times) >= SELDOM * len(most.times)]
    begun = rows[rows >= max(often) - _together(rows)]
    return begun if len(begun) >= 2 else rows


def _together(rows: NDArray[np.float64]) -> float:
    """[us] that a value may come after its row."""
    return TOGETHER * float(np.median(np.diff(rows))) if len(rows) > 1 else 0.0


def _at(entry: Entry, rows: NDArray[np.float64], none: Any) -> NDArray[Any]:
    """The entry's latest value at each row; `none` before the first."""
    values = np.array([none, *entry.values])
    return values[np.searchsorted(np.array(entry.times, np.float64), rows + _together(rows), side="right")]


def _unit(metadata: str) -> str:
    """The unit of metadata such as `Meter per Second`, as SysId's routines write it; else empty."""
    what, _, per = metadata.partition(" per ")
    unit = _UNITS.get(what, "")
    return unit if not per else f"{unit}/s" if unit and per == "Second" else ""
