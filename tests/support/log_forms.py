"""The form of a made-up log of one motor, by what is said of it."""

from pathlib import Path

import numpy as np

from motor_identification.logs.columns.motor_form import Notes, Rows, make_form
from motor_identification.logs.columns.roles.roles import Roles
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import CsvForm

ROWS = Rows("t", "s", 0.01)


def form(said: Said, notes: Notes, motion: str = "speed [rpm]", drive: str = "pwm", **extra: object) -> CsvForm:
    time = 0.01 * np.arange(1, 101)
    volts = np.repeat([100.0, -200.0], 50)
    table = Table(Path("log.csv"), np.arange(100), {"t": time, drive: volts, motion: 0.5 * np.cumsum(volts), **extra})  # type: ignore[arg-type]
    supply = next((name for name in extra if name == "battery"), None)
    current = next((name for name in extra if name.startswith("i")), None)
    return make_form(table, Pair("", drive, motion), Roles("t", (), supply, current), said, ROWS, notes)
