"""The drive of one motor: when numbers without a unit are volts, and when a duty of the supply that was said."""

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from motor_identification.logs.columns.motor_drive import read_drive
from motor_identification.logs.columns.notes import Notes
from motor_identification.logs.columns.roles.roles import Roles
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.csv.table import Table


def volts_per_unit(drive: str, values: NDArray[np.float64], said: Said) -> float:
    table = Table(Path("log.csv"), np.arange(100), {drive: values, "speed [rpm]": np.sin(np.arange(100.0))})
    return read_drive(table, Pair("", drive, "speed [rpm]"), Roles("t", (), None, None), said, Notes([], []))[1]


@pytest.mark.parametrize(("supply", "drive", "scale"), [(25.0, "setpoint", 25.0 / 255.0), (25.0, "setpoint [V]", 1.0)])
def test_more_than_the_supply_are_no_volts(supply: float, drive: str, scale: float) -> None:
    values = np.repeat([51.0, -51.0], 50)
    assert volts_per_unit(drive, values, Said(supply_voltage=supply)) == pytest.approx(scale)
    assert volts_per_unit(drive, values, Said(supply_voltage=51.0)) == 1.0


@pytest.mark.parametrize(
    ("supply", "drive", "largest", "scale"),
    [
        (9.0, "u", 0.9, 9.0),
        (9.0, "column 2", 1.0, 9.0),
        (9.0, "u", 1.1, 1.0),
        (9.0, "voltage", 0.9, 1.0),  # a name that says volts is believed
        (9.0, "u [V]", 0.9, 1.0),
        (None, "u", 0.9, 1.0),
        (0.9, "u", 0.9, 1.0),  # the supply of a motor as small
    ],
)
def test_shares_of_a_supply_that_was_said(supply: float | None, drive: str, largest: float, scale: float) -> None:
    """Who says a supply's voltage has a duty, whatever its column is called."""
    values = np.linspace(-largest, largest, 100)
    assert volts_per_unit(drive, values, Said(supply_voltage=supply)) == pytest.approx(scale)


@pytest.mark.parametrize(
    ("name", "last", "doubted"), [("column 2", 200.0, True), ("column 2", 0.0, False), ("pwm", 200.0, False)]
)
def test_what_stays_under_no_name_may_be_a_target(name: str, last: float, doubted: bool) -> None:
    """As programs print what a controller was told before what it measured."""
    values = np.append(np.full(99, 200.0), last)
    table = Table(Path("log.csv"), np.arange(100), {name: values, "speed [rpm]": np.sin(np.arange(100.0))})
    notes = Notes([], [])
    read_drive(table, Pair("", name, "speed [rpm]"), Roles("t", (), None, None), Said(), notes)
    ((_, question),) = notes.questions
    assert ("is 200 in every row; if no controller's target, but a duty of ±255 (otherwise" in question) == doubted
    assert question.endswith("say the voltage at full duty (--supply-voltage V)")


@pytest.mark.parametrize(("beside", "largest"), [(-30.0, "30"), (0.0, "15")])
def test_a_duty_of_round_numbers_below_100_is_asked_for_with_the_largest_of_all_motors(
    beside: float, largest: str
) -> None:
    """A log of four motors at "PWM" 15 was 0.88 V of a supply whose 15 % are 2.25 V, and only that supply was asked."""
    cells = {"pwm_1": np.resize([0.0, 15.0, -15.0], 120), "speed_1 [rpm]": np.ones(120), "pwm_2": np.full(120, beside)}
    table, notes, pair = (
        Table(Path("log.csv"), np.arange(120), cells),
        Notes([], []),
        Pair("", "pwm_1", "speed_1 [rpm]"),
    )
    roles = Roles("t", (pair, Pair("2", "pwm_2", "speed_1 [rpm]")), None, None)
    read_drive(table, pair, roles, Said(), notes)
    ((_, question),) = notes.questions
    assert question == (
        f"is a duty, {largest} of 100 or of 255: say what it is at full duty (--full-duty D) and the voltage there "
        "(--supply-voltage V)"
    )
    said = Said(supply_voltage=12.0, full_duty=100.0)
    assert read_drive(table, pair, roles, said, Notes([], []))[1] == pytest.approx(0.12)


@pytest.mark.parametrize(
    ("name", "values", "asked", "told"),
    [
        ("pwm", [0.0, 100.0], True, False),  # a step by per cent, or by 100 of 255
        ("pwm", [0.0, 50.0, 100.0], False, True),
        ("duty", [0.0, 100.0], False, True),
        ("pwm", [0.0, 33.3, 100.0], False, False),  # nobody writes fractions to a register
        ("duty [%]", [0.0, 100.0], False, False),
    ],
)
def test_a_duty_that_comes_to_100_may_be_of_255(name: str, values: list[float], asked: bool, told: bool) -> None:
    """Each voltage was 2.55 times too large in silence."""
    table = Table(Path("log.csv"), np.arange(120), {name: np.resize(values, 120), "speed [rpm]": np.ones(120)})
    notes, pair, roles = Notes([], []), Pair("", name, "speed [rpm]"), Roles("t", (), None, None)
    drive, scale, _ = read_drive(table, pair, roles, Said(supply_voltage=7.4), notes)
    assert bool(notes.questions) == asked and (asked or scale == pytest.approx(0.074))
    assert ("if full duty is 255, say --full-duty 255: voltages are 2.55" in drive.why) == (asked or told)
    if asked:
        assert "100 of 100 or of 255: say what it is at full duty (--full-duty D)" in notes.questions[0][1]
    said = read_drive(table, pair, roles, Said(supply_voltage=7.4, full_duty=255.0), Notes([], []))
    assert said[1] == pytest.approx(7.4 / 255.0)
