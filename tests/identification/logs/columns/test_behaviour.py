"""What columns and runs are by how their numbers behave."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.behaviour import can_have_stood, find_position, named_motors
from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.csv.table import Table

TIME = np.arange(300) * 0.01
SPEED = 20.0 * (1.0 - np.exp(-np.mod(TIME, 1.5) / 0.2)) * np.where(TIME < 1.5, 1.0, -0.6)


def test_a_position_among_a_position_and_its_speed() -> None:
    late = np.cumsum(np.where(np.arange(300) % 9 == 0, 0.04, 0.007))  # rows as a busy computer writes them
    angle = np.floor(np.cumsum(SPEED * np.diff(late, append=late[-1] + 0.01)) * 5.0)
    columns = {"t": late, "a": np.round(SPEED), "b": angle, "u": np.sign(SPEED)}
    table = Table(Path("log.csv"), np.arange(300), columns)
    assert find_position(table, ["a", "b"], "t") == "b" and find_position(table, ["b", "a"], "t") == "b"
    assert find_position(table, ["a", "u"], "t") == ""


@pytest.mark.parametrize(("units", "told"), [(1.0, True), (1.04, True), (1.1, False), (np.pi / 180.0, False)])
def test_a_position_of_a_steady_motor_by_its_speed_in_the_same_units(units: float, told: bool) -> None:
    """One that has its speed at once, but for the encoder's noise: all its ways are alike."""
    speed = 140.0 + 3.0 * np.random.default_rng(4).normal(size=300)
    columns = {"t": TIME, "a": np.round(speed), "b": np.floor(140.0 * units * TIME), "u": np.full(300, 20.0)}
    table = Table(Path("log.csv"), np.arange(300), columns)
    assert find_position(table, ["a", "b"], "t") == ("b" if told else "")
    assert find_position(table, ["b", "u"], "t") == ""


@pytest.mark.parametrize(
    ("begin", "voltage", "stood"),
    [
        (0.0, 5.0, True),
        (4.0, 5.0, True),  # within the first row
        (-19.0, 5.0, False),  # it still turned the other way
        (-4.0, 5.0, True),  # noise
        (-9.0, 5.0, False),
        (40.0, 5.0, False),  # it came from a higher voltage
        (0.0, -5.0, True),
    ],
)
def test_a_motor_that_stood(begin: float, voltage: float, stood: bool) -> None:
    way = np.sign(voltage)
    speed = way * 20.0 + (way * begin - way * 20.0) * np.exp(-TIME / 0.2)
    assert can_have_stood(speed, voltage) == stood
    assert can_have_stood(speed[:5], voltage)  # too short to tell


def test_a_run_at_no_voltage() -> None:
    assert can_have_stood(np.zeros(50), 0.0) and not can_have_stood(20.0 * np.exp(-TIME / 0.2), 0.0)


def named(*names: str) -> tuple[dict[str, str], tuple[str, ...]]:
    """The columns with a motor's label, and those left out."""
    headings, left = named_motors([read_heading(name) for name in names])
    return {one.name: one.side for one in headings if one.side}, left


def test_motors_by_the_names_that_drive_and_motion_share() -> None:
    labels, left = named("t", "shooter_volts", "shooter_rpm", "intake_volts", "intake_rpm", "hood_angle")
    assert labels == {
        "shooter_volts": "shooter",
        "shooter_rpm": "shooter",
        "intake_volts": "intake",
        "intake_rpm": "intake",
    }
    assert left == ("hood_angle",)
    corners = [
        f"{end}{side}{what}" for end in ("front", "rear") for side in ("Left", "Right") for what in ("Pwm", "Ticks")
    ]
    assert set(named(*corners)[0].values()) == {"front_left", "front_right", "rear_left", "rear_right"}


def test_modules_of_a_swerve_drive() -> None:
    parts = ("DriveAppliedVolts", "DrivePositionRad", "DriveVelocityRadPerSec", "TurnAppliedVolts", "TurnPositionRad")
    names = [f"/Drive/Module{k}/{part}" for k in (0, 1) for part in (*parts, "TurnAbsolutePositionRad")]
    labels, left = named(*names)
    assert set(labels.values()) == {"0_drive", "0_turn", "1_drive", "1_turn"}
    assert left == tuple(name for name in names if "Absolute" in name)


def test_the_only_motor_with_a_drive_beside_what_it_moves() -> None:
    labels, left = named("motor_voltage", "motor_speed", "load_speed")
    assert labels == {"motor_voltage": "motor", "motor_speed": "motor"} and left == ("load_speed",)


@pytest.mark.parametrize(
    "names",
    [
        ("pwm", "speed", "filtered_speed"),
        ("u", "speed_a", "speed_b"),
        ("left_pwm", "right_pwm", "left_speed", "right_speed"),  # sides do
        ("pwm", "voltage", "position", "speed"),
        ("a_volts", "b_volts", "speed"),
    ],
)
def test_names_that_tell_no_motors_apart(names: tuple[str, ...]) -> None:
    headings = [read_heading(name) for name in names]
    assert named_motors(headings) == (headings, ())
