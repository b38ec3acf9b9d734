"""SysId's own JSON log (WPILib): four tests, of one mechanism or of the two sides of a drivetrain."""

import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.csv.dialect import read_text
from motor_identification.logs.csv.table import Table
from motor_model.errors import RecordingError

TESTS = ("slow-forward", "slow-backward", "fast-forward", "fast-backward")
_UNITS = {"Meters": "m", "Feet": "m", "Inches": "m", "Radians": "rad", "Rotations": "rev", "Degrees": "deg"}
_DRIVETRAIN = ("left voltage", "right voltage", "left position", "right position", "left velocity", "right velocity")
_SINGLE = ("voltage", "position", "velocity")


def read_sysid(path: Path) -> tuple[Table, float | None]:
    """A log's tests one after the other, told apart by the column `test`, and how far a turn goes.

    Positions stand in the log's unit, velocities in that per second; where that is a length, `m` stands for it and the
    units of a turn say how long.

    Raises:
        RecordingError: it is no such log.
    """
    log = _load(path)
    unit = _UNITS.get(str(log.get("units")), "")
    if not unit:
        raise RecordingError(
            f"{path}: its units, {str(log.get('units'))[:40]}, are none that SysId has: export it again."
        )
    tests = {name: _rows(path, name, log[name]) for name in TESTS if log.get(name)}
    if not tests:
        raise RecordingError(f"{path} has none of SysId's tests ({', '.join(TESTS)}): export it again.")
    width = {rows.shape[1] for rows in tests.values()}
    names = _DRIVETRAIN if width == {9} else _SINGLE
    if width not in ({9}, {4}):
        raise RecordingError(
            f"{path}: its rows have {sorted(width)} numbers, where SysId writes 4 or 9: export it again."
        )
    rows = np.concatenate(list(tests.values()))
    units = {"voltage": "V", "position": unit, "velocity": {"rev": "rev/s"}.get(unit, f"{unit}/s")}
    cells: dict[str, Any] = {
        "test": np.repeat(list(tests), [len(one) for one in tests.values()]),
        "time [s]": rows[:, 0],
    }
    for k, name in enumerate(names, start=1):
        cells[f"{name} [{units[name.split()[-1]]}]"] = rows[:, k]
    note = f"SysId log of {str(log.get('test', 'a mechanism'))[:40]}: {', '.join(tests)}."
    table = Table(path, np.arange(1, len(rows) + 1), cells, notes=(note,))
    return table, _turn(path, log, unit)


def _load(path: Path) -> dict[str, Any]:
    text, _ = read_text(path)
    try:
        log = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise RecordingError(f"{path} is no complete JSON: export it again.") from error
    if not isinstance(log, dict) or not log.get("sysid"):
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
    if unit != "m":
        return None
    turn = log.get("unitsPerRotation")
    if not isinstance(turn, int | float) or isinstance(turn, bool) or not 0.0 < turn < 1e6:
        return None  # asked for
    return float(turn)
