"""What commands a motor in a bag, and the message after which it rests."""

from typing import Any

import pytest
from geometry_msgs.msg import Twist, TwistStamped, Vector3
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64

from motor_identification.live.motor_commands import COMMANDS, find_rest, message_of_rest
from motor_msgs.msg import MotorVoltage

FLOAT, JOINTS, TWIST = "std_msgs/msg/Float64", "sensor_msgs/msg/JointState", "geometry_msgs/msg/Twist"


@pytest.mark.parametrize(
    ("type_name", "topic", "commands"),
    [
        ("motor_msgs/msg/MotorVoltage", "/left/wheel", True),
        (FLOAT, "/left/motor/reference", True),
        (FLOAT, "/motor/position_reference", True),
        (FLOAT, "/recorded/motor/reference_seen", False),
        (JOINTS, "/motor/joint_command", True),
        (JOINTS, "/joint_states", False),
        (TWIST, "/robot/cmd_vel", True),
        (TWIST, "/odom_twist", False),
        ("geometry_msgs/msg/TwistStamped", "/cmd_vel", True),
        ("motor_msgs/msg/MotorSpeed", "/motor/speed", False),
    ],
)
def test_what_commands_a_motor(type_name: str, topic: str, commands: bool) -> None:
    """A bag of joint commands was played on after a Ctrl-Z, and left the last one in force."""
    assert (find_rest(type_name, topic) is not None) is commands


def joints(velocity: float, effort: float) -> JointState:
    return JointState(name=["a", "b"], velocity=[velocity, 0.0], effort=[0.0, effort], position=[1.0, 2.0])


@pytest.mark.parametrize(
    ("type_name", "last", "rests"),
    [
        ("motor_msgs/msg/MotorVoltage", MotorVoltage(voltage=3.0), MotorVoltage()),
        ("motor_msgs/msg/MotorVoltage", MotorVoltage(), None),
        (FLOAT, Float64(data=-3.0), Float64()),
        (FLOAT, Float64(), None),
        (JOINTS, joints(3.0, 0.0), joints(0.0, 0.0)),
        (JOINTS, joints(0.0, 3.0), joints(0.0, 0.0)),
        (JOINTS, joints(0.0, 0.0), None),
        (TWIST, Twist(angular=Vector3(z=1.0)), Twist()),
        (TWIST, Twist(), None),
        ("geometry_msgs/msg/TwistStamped", TwistStamped(twist=Twist(linear=Vector3(x=1.0))), TwistStamped()),
    ],
)
def test_the_message_after_which_it_rests(type_name: str, last: Any, rests: Any) -> None:
    _, rest = COMMANDS[type_name][0]
    assert message_of_rest(rest, last) == rests


def test_an_angle_is_held() -> None:
    rest = find_rest(FLOAT, "/motor/position_reference")
    assert rest is not None and message_of_rest(rest, Float64(data=2.0)) is None
    assert message_of_rest(rest, Float64(data=float("nan"))) is None
