"""What has to be asked of a table's columns."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.notes import (
    SHOWN,
    ask_column,
    ask_drive,
    ask_motion,
    lack_motion,
    miss_drive,
    miss_motion,
)
from motor_identification.logs.columns.vocabulary import Quantity
from motor_identification.logs.csv.table import Table
from motor_identification.logs.rows.row_times import ROW_TIMES

TABLE = Table(Path("log.csv"), np.arange(2, 5), {"w1": np.arange(3.0), "w2": np.ones(3), "enc": np.array([0.5, 1, 2])})


def test_twelve_names_are_shown_and_those_that_the_import_made_are_not() -> None:
    names = [f"c{k}" for k in range(SHOWN + 2)]
    assert str(ask_column(TABLE, "supply", "--supply", names)).endswith(
        "Say --supply and one of " + ", ".join(names[:SHOWN]) + " and 2 more."
    )
    assert str(ask_column(TABLE, "supply", "--supply", [ROW_TIMES, *names[:SHOWN]])).endswith(", c11.")


def test_names_with_spaces_are_quoted_in_the_options_that_a_user_copies() -> None:
    """A shell took `--motor 1:PWM (%),Wheel speed (rad/s)` apart."""
    headings = [read_heading(name) for name in ("PWM (%)", "w1", "w2")]
    asked = str(ask_motion(TABLE, headings, Quantity.SPEED, ["w1", "w2"]))
    assert asked.endswith("For a motor of each: --motor '1:PWM (%),w1' --motor '2:PWM (%),w2'")


def test_several_motions_on_one_drive_may_be_motors_of_their_own() -> None:
    headings = [read_heading(name) for name in ("pwm", "w1", "w2")]
    asked = str(ask_motion(TABLE, headings, Quantity.SPEED, ["w1", "w2"]))
    assert asked.endswith("Say --speed and one of w1, w2. For a motor of each: --motor 1:pwm,w1 --motor 2:pwm,w2")
    fractions = str(ask_motion(TABLE, headings[1:], Quantity.COUNT, ["enc", "w1"]))
    assert fractions.endswith("which column is the motion? Say --speed or --position and one of enc, w1.")


def test_a_log_of_one_step_has_an_option() -> None:
    asked = (ask_drive(TABLE, ["w1"]), miss_drive(TABLE), miss_motion(TABLE, "w2", "w1"))
    assert all("--constant-voltage V" in str(one) for one in asked)
    assert "w2 is 1 in every row: the motor never moves in it, or w1 is its motion" in str(asked[2])


def test_a_controllers_log_without_what_it_gave_is_no_log_of_one_step() -> None:
    """A speed that comes to its set point at 12 V all the time is no motor's."""
    asked = str(miss_drive(Table(Path("log.csv"), np.arange(3), {"t": np.arange(3), "setpoint_rpm": np.ones(3)})))
    assert "setpoint_rpm is what a controller was told" in asked and "--constant-voltage" not in asked


def test_what_cannot_move_is_not_asked_about() -> None:
    def asked(*names: str) -> str:
        return str(lack_motion(Table(Path("log.csv"), np.arange(2), {name: np.arange(2.0) for name in names}), "t"))

    assert asked("t", "target", "command").startswith(
        "log.csv: no column is the motion (target is a reference, command is a duty, t the time): log the motor's speed"
    )
    assert asked("t", "command", "load").endswith("Say --speed, --position or --count and one of load.")
    assert asked("t", "pwm", "volts").endswith("one of volts.")  # may be a tachogenerator's
    assert asked("t", "volts", "target").startswith("log.csv: no column is the motion (volts is a voltage")


@pytest.mark.parametrize(("rows", "motion"), [(11, False), (10, True)])
def test_the_numbers_of_rows_are_no_motion(rows: int, motion: bool) -> None:
    table = Table(
        Path("log.csv"), np.arange(rows), {"t": np.arange(rows) * 0.1, "i mA": np.ones(rows), "Nr": np.arange(rows)}
    )
    assert (str(lack_motion(table, "t")).endswith("and one of Nr.")) == motion
    assert ("no column is the motion" in str(lack_motion(table, "t"))) != motion


def test_a_set_point_beside_columns_that_may_drive_is_told() -> None:
    table = Table(Path("log.csv"), np.arange(2), {name: np.arange(2.0) for name in ("left_velocity_cmd", "x", "y")})
    assert str(ask_drive(table, ["x", "y"])).endswith(
        "one of x, y. left_velocity_cmd is what a controller was told: "
        "where what it gave to the motor is none of them, log that, too."
    )


def test_a_table_of_something_else_is_said_to_be_no_motors_log() -> None:
    """As of stocks and of the weather: which column is the voltage is no question there."""

    def asked(*names: str) -> str:
        table = Table(Path("log.csv"), np.arange(2), {name: np.arange(2.0) for name in names})
        return str(ask_drive(table, names[1:]))

    found = asked("date", "open", "high", "low", "close")
    assert found.startswith("log.csv: no motor's log by the names of its columns (open, high, low, close): none is")
    assert "no motor's log" in asked("Zeit", "Temperatur", "Solltemperatur", "Heizung")
    assert "which column is the voltage" in asked("t", "x", "w1", "enc_a") and "which" in asked("date", "open", "high")
    assert "which column" in asked("column 1", "column 2", "column 3", "column 4")
    assert "which column" in asked("CH1_Data_OutPut", "CH2_Data_OutPut", "CH3_Data_OutPut", "CH4_Data_OutPut")
    assert "which column" in asked("t", "alpha", "beta_x", "data.open.step1", "close")
    assert "which column" in asked("date", "open", "high", "low", "speed"), "one of a motor's"
    weather = Table(Path("w.csv"), np.arange(2), {name: np.ones(2) for name in ("tavg", "prcp", "pres")})
    assert "no motor's log" in str(miss_drive(weather))


def test_only_columns_that_may_drive_are_offered_and_the_motion_is_asked_for_at_once() -> None:
    def log(*names: str) -> Table:
        return Table(Path("log.csv"), np.arange(2), {name: np.arange(2.0) for name in names})

    assert "say which one of x is (--voltage COL)" in str(miss_drive(log("time [ms]", "speed [rpm]", "x")))
    none = str(miss_drive(log("time_ms", "speed_rpm")))
    assert "voltage or duty: time_ms is a time, speed_rpm is a speed. Log what drives the motor beside them" in none
    assert "which one" not in none and "--constant-voltage V" in none
    assert "one of angle_x, w." in str(lack_motion(log("t", "u", "angle_x", "erro pan", "speed error", "w"), "t"))
    assert "no column is the motion" in str(lack_motion(log("t", "u", "erro pan"), "t"))
    motion = "Say which is the motion, too: --speed, --position or --count COL."
    assert str(ask_drive(log("column 1", "column 2"), ["column 1", "column 2"])).endswith(motion)
    assert motion not in str(ask_drive(log("x", "y", "rpm"), ["x", "y"]))


@pytest.mark.parametrize(
    ("name", "offered"), [("ref", True), ("setpoint", True), ("setpoint_rpm", False), ("target speed", False)]
)
def test_a_set_point_of_a_motion_is_not_offered_as_the_voltage(name: str, offered: bool) -> None:
    asked = str(miss_drive(Table(Path("log.csv"), np.arange(3), {"t": np.arange(3), name: np.ones(3)})))
    assert asked.endswith(f"say --voltage {name}." if offered else "or say which column it is (--voltage COL).")
