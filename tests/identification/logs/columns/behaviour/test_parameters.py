"""Parameters of a program are told from motions by their numbers."""

import numpy as np
import pytest
from log_columns import DRIVE, FOLLOWS, TIME, columns

from motor_identification.logs.columns.behaviour.parameters import MOST_CHANGES, leave_out_parameters
from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.roles.roles import find_roles
from motor_identification.logs.columns.said import Pair, Said
from motor_model.errors import RecordingError

ROWS = len(TIME)
SET_ONCE = np.where(np.arange(ROWS) < 120, 0.01, 1.97)


def left(**numbers: "np.ndarray[tuple[int], np.dtype[np.float64]]") -> list[str]:
    """The columns that still drive or move."""
    found = leave_out_parameters(columns(**numbers), [read_heading(name) for name in numbers])
    told = [read_heading(one.name).quantity is one.quantity for one in found]
    return [one.name for one, same in zip(found, told, strict=True) if same]


@pytest.mark.parametrize("noise", [np.full(ROWS, 0.01), SET_ONCE])
def test_a_kalman_filters_variances_are_no_motor(noise: "np.ndarray[tuple[int], np.dtype[np.float64]]") -> None:
    logged = columns(Time_s=TIME, Voltage_V=DRIVE, Raw_RPM=40.0 * FOLLOWS, KF_W=noise, KF_V=5.0 * noise)
    assert find_roles(logged, Said()).pairs == (Pair("", "Voltage_V", "Raw_RPM"),)
    assert find_roles(logged, Said(motion="KF_W", voltage="KF_V")).pairs == (Pair("", "KF_V", "KF_W"),)  # as said


def test_motors_are_no_parameters() -> None:
    stands = {"a_volts": np.full(ROWS, 2.0), "a_rpm": np.zeros(ROWS)}
    turns = {"b_volts": DRIVE, "b_rpm": 40.0 * FOLLOWS}
    assert left(**stands, **turns) == ["a_volts", "a_rpm", "b_volts", "b_rpm"]
    slow = np.repeat([1.0, 2.0, 3.0, 2.0, 1.0], ROWS // 5)  # of a sensor that tells a speed now and then
    assert left(a_volts=DRIVE, a_rpm=slow, **turns) == ["a_volts", "a_rpm", "b_volts", "b_rpm"]
    assert left(a_volts=DRIVE, a_rpm=SET_ONCE) == ["a_volts", "a_rpm"]  # nothing else moves
    assert left(a_volts=DRIVE, a_rpm=SET_ONCE, **turns) == ["b_volts", "b_rpm"]


def test_an_axis_whose_position_goes_on_is_no_parameter_however_even_its_speed() -> None:
    even = {"roll_effort": DRIVE, "roll_position": 7.0 * TIME, "roll_velocity": np.where(TIME < 1.0, -10.0, -15.0)}
    assert left(**even) == list(even)
    assert left(**{**even, "roll_position": np.full(ROWS, 2.0)}, b_rpm=FOLLOWS) == ["b_rpm"]
    assert left(roll_position=even["roll_position"], roll_velocity=even["roll_velocity"], b_rpm=FOLLOWS) == ["b_rpm"]


@pytest.mark.parametrize(("times", "motor"), [(MOST_CHANGES, False), (MOST_CHANGES + 1, True)])
def test_a_filters_estimate_beside_its_parameters_is_no_motor(times: int, motor: bool) -> None:
    """`KF_V` does not drive what the Kalman filter says of the motor, however often somebody sets it anew."""
    variance = 3.0 + np.minimum(np.arange(ROWS) // 20, times)
    axis = {"KF_W": np.full(ROWS, 0.3), "KF_V": variance, "KF_position [rad]": 7.0 * TIME}
    assert left(**axis, voltage=DRIVE, speed=FOLLOWS) == ([*axis] if motor else []) + ["voltage", "speed"]
    estimate = {"KF_W": np.full(ROWS, 0.3), "KF_V": np.full(ROWS, 3.0), "KF_speed [rad/s]": 39.0 * FOLLOWS}
    pairs = find_roles(
        columns(t=TIME, **estimate, **{"voltage [V]": DRIVE, "speed [rad/s]": 40.0 * FOLLOWS}), Said()
    ).pairs
    assert pairs == (Pair("", "voltage [V]", "speed [rad/s]"),)


def test_a_motion_of_the_same_name_is_no_other_one_that_goes_on() -> None:
    """A log of one axis without its drive: time, position and velocity were offered as the voltage."""
    axis = {"pitch_position": 7.0 * TIME, "pitch_velocity": np.full(ROWS, 7.0)}
    assert left(**axis) == list(axis)
    with pytest.raises(RecordingError, match="no column is the voltage or duty: t is a time, pitch_position is a pos"):
        find_roles(columns(t=TIME, **axis), Said())
