"""Motors that are told apart."""

import numpy as np
import pytest
from log_columns import DRIVE, FOLLOWS, TIME, columns, table

from motor_identification.logs.columns.behaviour.motors import named_motors
from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.roles.roles import find_roles
from motor_identification.logs.columns.said import Pair, Said
from motor_model.errors import RecordingError


def test_motors_by_number_where_drives_and_motions_have_the_same() -> None:
    both = find_roles(table(t="t", pwm1="u", pwm2="r", enc1="y", enc2="y"), Said())
    assert both.pairs == (Pair("1", "pwm1", "enc1"), Pair("2", "pwm2", "enc2"))
    for cells in ({"pwm1": "u", "enc1": "y", "enc2": "y"}, {"pwm1": "u", "pwm3": "r", "enc1": "y", "enc2": "y"}):
        one = find_roles(table(t="t", **cells), Said())
        assert (one.pairs, one.left_out) == ((Pair("", "pwm1", "enc1"),), ("enc2",))


def test_numbered_motors_share_the_one_drive_where_each_follows_it() -> None:
    speeds = {f"Enc{k}": np.round(4.1 * FOLLOWS + 0.01 * k, 2) for k in (1, 2, 3)}
    roles = find_roles(columns(t=TIME, PWM=50.0 * DRIVE, **speeds), Said())
    assert roles.pairs == tuple(Pair(str(k), "PWM", f"Enc{k}") for k in (1, 2, 3))
    counts = {f"enc{k}": np.floor(90.0 * k + 7.3 * np.cumsum(FOLLOWS)) for k in (1, 2)}
    assert [pair.label for pair in find_roles(columns(t=TIME, pwm=50.0 * DRIVE, **counts), Said()).pairs] == ["1", "2"]


def test_a_pendulums_encoder_shares_no_drive() -> None:
    swings = np.floor(300.0 * np.sin(TIME * 31.0))
    with pytest.raises(RecordingError, match="For a motor of each: --motor 1:pwm,enc1"):
        find_roles(columns(t=TIME, pwm=50.0 * DRIVE, enc1=np.floor(7.3 * np.cumsum(FOLLOWS)), enc2=swings), Said())


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
