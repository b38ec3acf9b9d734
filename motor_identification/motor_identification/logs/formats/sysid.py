"""SysId's own JSON log (WPILib), and frc-characterization's before it: four tests of a mechanism or a drivetrain."""

import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.csv.dialect import read_text
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import LENGTHS
from motor_model.errors import RecordingError

TESTS = ("slow-forward", "slow-backward", "fast-forward", "fast-backward")
_UNITS = {"Meters": "m", "Feet": "ft", "Inches": "in", "Radians": "rad", "Rotations": "rev", "Degrees": "deg"}
_DRIVETRAIN = ("left voltage", "right voltage", "left position", "right position", "left velocity", "right velocity")
_SINGLE = ("voltage", "position", "velocity")


def read_sysid(path: Path) -> tuple[Table, float | None]:
    """A log's tests one after the other, told apart by the column `test`, and how far a turn goes.

    Positions stand in the log's unit, velocities in that per second; where that is a length, the log says how
    far a turn goes.
    frc-characterization has battery and share of the voltage behind the time, and two sides of any mechanism.

    Raises:
        RecordingError: it is no such log.
    """
    log = _load(path)
    before = not log.get("sysid")  # frc-characterization, whose first logs say no unit
    unit = _UNITS.get(str(log.get("units")), "")
    if not unit and not (before and log.get("units") is None):
        raise RecordingError(
            f"{path}: its units, {str(log.get('units'))[:40]}, are none that SysId has: export it again."
        )
    tests = {name: _rows(path, name, log[name]) for name in TESTS if log.get(name)}
    if not tests:
        raise RecordingError(f"{path} has none of SysId's tests ({', '.join(TESTS)}): export it again.")
    width = {rows.shape[1] for rows in tests.values()}
    known = {9, 10} if before else {4, 9}
    if len(width) > 1 or not width <= known:
        tool = "frc-characterization" if before else "SysId"
        raise RecordingError(
            f"{path}: its rows have {sorted(width)} numbers, where {tool} writes {min(known)} or {max(known)}: export "
            "it again."
        )
    sides = width == {9} if not before else log.get("test", "Drivetrain") == "Drivetrain"
    names = _DRIVETRAIN if sides else _SINGLE
    if before:
        tests = {name: _as_sysid_writes(rows, sides) for name, rows in tests.items()}
    rows = np.concatenate(list(tests.values()))
    speed_unit = {"rev": "rev/s"}.get(unit, f"{unit}/s") if unit else ""
    units = {"voltage": " [V]", "position": unit and f" [{unit}]", "velocity": speed_unit and f" [{speed_unit}]"}
    cells: dict[str, Any] = {
        "test": np.repeat(list(tests), [len(one) for one in tests.values()]),
        "time [s]": rows[:, 0],
    }
    for k, name in enumerate(names, start=1):
        cells[f"{name}{units[name.split()[-1]]}"] = rows[:, k]
    tool = "frc-characterization's" if before else "SysId"
    note = f"{tool} log of {str(log.get('test', 'a mechanism'))[:40]}: {', '.join(tests)}."
    table = Table(path, np.arange(1, len(rows) + 1), cells, notes=(note,))
    return table, _turn(path, log, unit)


def _as_sysid_writes(rows: NDArray[np.float64], sides: bool) -> NDArray[np.float64]:
    """Rows of frc-characterization as SysId's: time, voltages, positions, velocities, of two sides or of the left one.

    Its analyser gave the voltages the sign of the motion, since not every robot logged one; so does this, test by test.
    """
    kept = np.column_stack([rows[:, 0], rows[:, 3:9] if sides else rows[:, 3:9:2]])
    for k in range(1, 3 if sides else 2):
        volts, speed = kept[:, k], kept[:, k + (4 if sides else 2)]
        kept[:, k] = -volts if volts @ speed < 0.0 else volts
    return kept


def is_sysid(head: str) -> bool:
    """Whether a JSON document, or one that begins so, is such a log."""
    return any(f'"{name}"' in head for name in ("sysid", *TESTS))


def _load(path: Path) -> dict[str, Any]:
    text, _ = read_text(path)
    try:
        log = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise RecordingError(f"{path} is no complete JSON: export it again.") from error
    if not isinstance(log, dict) or not (log.get("sysid") or any(isinstance(log.get(test), list) for test in TESTS)):
        raise RecordingError(f"{path} is JSON, and no log of SysId: export it as CSV.")
    return log


def _rows(path: Path, name: str, rows: object) -> NDArray[np.float64]:
    try:
        array = np.array(rows, dtype=np.float64)
    except (ValueError, TypeError, OverflowError) as error:
        raise RecordingError(
            f"{path}: the rows of {name} are no numbers, or not equally many: export it again."
        ) from error
    if array.ndim != 2 or not np.all(np.isfinite(array)):
        raise RecordingError(f"{path}: the rows of {name} are no numbers, or not equally many: export it again.")
    return array


def _turn(path: Path, log: dict[str, Any], unit: str) -> float | None:
    """How far a turn goes, where the unit is a length."""
    if unit not in LENGTHS:
        return None
    turn = log.get("unitsPerRotation")
    if not isinstance(turn, int | float) or isinstance(turn, bool) or not 0.0 < turn < 1e6:
        return None  # asked for
    return float(turn)
