"""The drive of one motor in a table: how its column becomes volts, and by which supply."""

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.behaviour.codes import find_codes
from motor_identification.logs.columns.cautions import ROUNDED
from motor_identification.logs.columns.drive import Drive, are_pulses, duty_drive, voltage_drive
from motor_identification.logs.columns.heading import Heading, read_heading
from motor_identification.logs.columns.notes import Notes
from motor_identification.logs.columns.roles.roles import Roles
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.columns.vocabulary import VOLTAGE_WORDS, Quantity
from motor_identification.logs.csv.table import Table

Floats = NDArray[np.float64]


def read_drive(table: Table, pair: Pair, roles: Roles, said: Said, notes: Notes) -> tuple[Drive, float, str | None]:
    """Read how the driving column becomes volts: in words, per unit, by which supply."""
    heading, values = read_heading(pair.voltage), table.numbers(pair.voltage)
    if said.constant_voltage is not None:
        return Drive(1.0, f"is {said.constant_voltage:g} V in every row, as said"), 1.0, None
    if said.voltage_scale is not None:
        return Drive(said.voltage_scale, f"times {said.voltage_scale:g} V"), said.voltage_scale, None
    no_volts = _is_beyond(heading, values, said.supply_voltage) or _is_share(heading, values, said.supply_voltage)
    if said.full_duty or heading.quantity is Quantity.DUTY or no_volts:
        drive = duty_drive(heading, _duties(table, pair, roles), said.full_duty)
    else:
        drive = voltage_drive(heading, values)
    if drive.scale is not None:
        return drive, drive.scale, None
    full = drive.full or 1.0
    if drive.full is None:
        of_pulses = "say which it is (--neutral N), " if are_pulses(heading, values) else "say "
        what = f"{of_pulses}which column drives (--voltage COL), or what it is in volts (--voltage-scale V)"
        notes.questions.append((pair.voltage, f"{drive.why}: {what}"))
        return drive, 1.0, roles.supply
    if not drive.sure:
        beside = "" if said.supply_voltage or roles.supply else " and the voltage there (--supply-voltage V)"
        question = f"is a duty{drive.doubt}: say what it is at full duty (--full-duty D){beside}"
        notes.questions.append((pair.voltage, question))
        return drive, 1.0, roles.supply
    if said.supply_voltage:
        why = f"{drive.why}, times {said.supply_voltage:g} V"
        return Drive(None, why, full), said.supply_voltage / full, None
    if roles.supply:
        return drive, 1.0 / full, roles.supply
    why = drive.why.replace(" (assumed; otherwise:", " (otherwise")
    if heading.quantity is None and np.all(values == values[:1]):
        why = f"is {values[0]:g} in every row; if no controller's target, but {why.removeprefix('as ')}"
    notes.questions.append((pair.voltage, f"{why}: say the voltage at full duty (--supply-voltage V)"))
    return drive, 1.0, None


def _is_beyond(heading: Heading, values: Floats, supply: float | None) -> bool:
    """Whether values without a unit are more than the supply's voltage, which was said: then they are no volts."""
    largest = float(np.max(np.abs(values), initial=0.0))
    return supply is not None and not heading.unit and largest > supply * (1.0 + ROUNDED)


def _is_share(heading: Heading, values: Floats, supply: float | None) -> bool:
    """Whether values without a unit are shares of the supply's voltage, which was said: none is above 1."""
    largest = float(np.max(np.abs(values), initial=0.0))
    return (
        supply is not None and supply > 1.0 >= largest and not heading.unit and not set(heading.words) & VOLTAGE_WORDS
    )


def _duties(table: Table, pair: Pair, roles: Roles) -> Floats:
    """The duties of all motors of a table, any shape: what is full is the same for each, also for one that stands."""
    drives = {one.voltage for one in roles.pairs if read_heading(one.voltage).quantity is Quantity.DUTY}
    duties = [table.numbers(name) for name in sorted(drives | {pair.voltage})]
    return np.concatenate([one[~np.isin(one, find_codes(one))] for one in duties])
