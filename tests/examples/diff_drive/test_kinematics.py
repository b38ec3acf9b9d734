"""Wheel speeds and velocities are each other's inverse; limits keep the path."""

from math import inf, nan

import pytest

from motor_examples.diff_drive.kinematics import (
    STILL,
    Geometry,
    Limits,
    Twist,
    approach_twist,
    body_twist,
    limit_twist,
    wheel_speeds,
)
from motor_model.errors import MotorError

ROBOT = Geometry(0.05, 0.2)


def test_known_motions() -> None:
    assert wheel_speeds(ROBOT, Twist(1.0, 0.0)) == pytest.approx((20.0, 20.0))
    assert wheel_speeds(ROBOT, Twist(0.0, 1.0)) == pytest.approx((-2.0, 2.0))  # to the left: the right wheel forwards
    assert body_twist(ROBOT, wheel_speeds(ROBOT, Twist(0.3, -1.7))) == pytest.approx((0.3, -1.7))


def test_limits_keep_the_curvature() -> None:
    for limits in (Limits(linear=0.1), Limits(angular=0.2), Limits(wheel=3.0)):
        slowed = limit_twist(ROBOT, limits, Twist(0.5, 1.0))
        assert slowed.linear / slowed.angular == pytest.approx(0.5) and 0.0 < slowed.linear < 0.5
    wheels = wheel_speeds(ROBOT, limit_twist(ROBOT, Limits(wheel=3.0), Twist(-0.5, 1.0)))
    assert wheels == pytest.approx((-3.0, -2.0))
    assert limit_twist(ROBOT, Limits(), Twist(9.0, -9.0)) == (9.0, -9.0)
    assert limit_twist(ROBOT, Limits(0.5, 1.0, 20.0), Twist(0.5, 0.0)) == (0.5, 0.0)


def test_a_velocity_is_approached_along_one_line() -> None:
    limits = Limits(linear_acceleration=1.0, angular_acceleration=2.0)
    assert approach_twist(limits, STILL, Twist(1.0, 1.0), 0.1) == pytest.approx((0.1, 0.1))
    assert approach_twist(limits, STILL, Twist(0.1, 4.0), 0.1) == pytest.approx((0.005, 0.2))
    assert approach_twist(limits, STILL, Twist(0.01, 0.01), 0.1) == (0.01, 0.01)
    assert approach_twist(limits, STILL, Twist(1.0, 1.0), 0.0) == STILL
    assert approach_twist(Limits(), STILL, Twist(1.0, 1.0), 0.0) == (1.0, 1.0)


@pytest.mark.parametrize("length", [0.0, -1.0, nan, inf])
def test_what_is_no_length_is_refused(length: float) -> None:
    with pytest.raises(MotorError, match="wheel_radius"):
        Geometry(length, 0.2)
    with pytest.raises(MotorError, match="wheel_separation"):
        Geometry(0.05, length)
