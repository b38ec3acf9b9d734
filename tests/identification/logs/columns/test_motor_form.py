"""The form of one motor: drive, motion, rest."""

from math import tau
from pathlib import Path

import numpy as np
import pytest
from log_forms import ROWS, form

from motor_identification.logs.columns.behaviour.standing_start import FIRST_ROWS
from motor_identification.logs.columns.motor_form import Notes, make_form
from motor_identification.logs.columns.roles.roles import Roles
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.csv.table import Table


@pytest.mark.parametrize(
    ("said", "scale", "full"),
    [
        (Said(supply_voltage=12.0), 12.0 / 255.0, 12.0),
        (Said(supply_voltage=12.0, full_duty=200.0), 12.0 / 200.0, 12.0),
        (Said(voltage_scale=0.05), 0.05, None),
        (Said(supply_voltage=12.0, max_voltage=9.0), 12.0 / 255.0, 9.0),
    ],
)
def test_a_duty_becomes_volts(said: Said, scale: float, full: float | None) -> None:
    notes = Notes([], [])
    made = form(said, notes)
    assert (made.voltage_scale, made.max_voltage) == (pytest.approx(scale), full) and notes.questions == []


@pytest.mark.parametrize(("full", "told"), [(100.0, "100 rows"), (150.0, "50 rows"), (198.1, ""), (255.0, "")])
def test_duties_beyond_the_full_one_are_told(full: float, told: str) -> None:
    """A count too few, or 1000 for "let it coast": 12 V of supply do not become 47."""
    notes = Notes([], [])
    time, volts = 0.01 * np.arange(100), np.repeat([110.0, -200.0], 50)
    table = Table(Path("log.csv"), np.arange(100), {"t": time, "pwm": volts, "rpm": np.cumsum(volts)})
    pair, roles = Pair("", "pwm", "rpm"), Roles("t", (), None, None)
    make_form(table, pair, roles, Said(supply_voltage=12.0, full_duty=full), ROWS, notes)
    cautions = [line for line in notes.findings if line.startswith("Caution")]
    assert len(cautions) == bool(told)
    if told:
        assert f"pwm goes up to 200, beyond the full duty of {full:g}, in {told}" in cautions[0]


def test_a_supply_is_no_voltage_where_the_duty_is_0_in_every_row() -> None:
    table = Table(Path("log.csv"), np.arange(9), {"t": np.arange(9.0), "pwm": np.zeros(9), "rpm": np.arange(9.0)})
    pair, roles = Pair("", "pwm", "rpm"), Roles("t", (), None, None)
    for said, most in ((Said(supply_voltage=12.0), None), (Said(supply_voltage=12.0, max_voltage=9.0), 9.0)):
        assert make_form(table, pair, roles, said, ROWS, Notes([], [])).max_voltage == most


def test_a_duty_without_a_supply_is_asked_about_and_one_beside_a_battery_is_not() -> None:
    notes = Notes([], [])
    form(Said(), notes)
    assert notes.questions == [
        ("pwm", "as a duty of ±255 (otherwise --full-duty): say the voltage at full duty (--supply-voltage V)")
    ]
    notes = Notes([], [])
    made = form(Said(), notes, battery=np.full(100, 7400.0))
    assert notes.questions == [] and (made.supply, made.supply_scale) == ("battery", 1e-3)


@pytest.mark.parametrize(("unit", "said", "turn"), [("mm/s", None, tau), ("m/s", None, tau), ("m/s", 0.2, 0.2)])
def test_a_length_without_a_turn_is_one_radian(unit: str, said: float | None, turn: float) -> None:
    notes = Notes([], [])
    made = form(Said(units_per_revolution=said, supply_voltage=12.0), notes, f"speed [{unit}]")
    length = unit.removesuffix("/s")
    line = f"1 {length} is taken for 1 rad, and V·s/rad are V·s/{length}; otherwise: --units-per-revolution"
    assert made.units_per_revolution == turn and notes.questions == []
    assert (line in notes.findings[1]) == (said is None)
    reports = (
        f"Reports on it then say rad for {length}, rad/s for {length}/s, and count per turn what 6.283 {length} have."
    )
    assert (reports in notes.findings) == (said is None)


def test_milliamperes() -> None:
    assert form(Said(voltage_scale=1.0), Notes([], []), **{"i [mA]": np.ones(100)}).current_scale == 1e-3
    assert form(Said(voltage_scale=1.0), Notes([], []), **{"i [A]": np.ones(100)}).current_scale == 1.0
    assert FIRST_ROWS > 4.7  # the EV3's runs begin up to 24 ms late, in rows of 5.2 ms
