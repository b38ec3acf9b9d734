"""Turn poses, velocities and decisions into messages."""

from math import cos, sin
from typing import Any

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import Quaternion, TransformStamped, TwistStamped
from nav_msgs.msg import Odometry

from motor_examples.diff_drive.drive import Decision
from motor_examples.diff_drive.kinematics import Twist
from motor_examples.diff_drive.odometry import Pose
from motor_examples.diff_drive.wheel import Wheel
from motor_ros.messages import diagnostic_message


def quaternion_of(heading: float) -> Quaternion:
    """Make the quaternion of a heading [rad]."""
    return Quaternion(z=sin(0.5 * heading), w=cos(0.5 * heading))


def twist_of(message: Any) -> Twist:
    """Read the velocity of a Twist or a TwistStamped."""
    told = message.twist if isinstance(message, TwistStamped) else message
    return Twist(told.linear.x, told.angular.z)


def odometry_message(pose: Pose, twist: Twist, stamp: Time, frames: tuple[str, str]) -> Odometry:
    """Make the message for `odom`; frames: the pose's, the robot's."""
    message = Odometry(child_frame_id=frames[1])
    message.header.stamp, message.header.frame_id = stamp, frames[0]
    message.pose.pose.position.x, message.pose.pose.position.y = pose.x, pose.y
    message.pose.pose.orientation = quaternion_of(pose.heading)
    message.twist.twist.linear.x, message.twist.twist.angular.z = twist
    return message


def transform_message(pose: Pose, stamp: Time, frames: tuple[str, str]) -> TransformStamped:
    """Make the transform from the pose's frame to the robot's."""
    message = TransformStamped(child_frame_id=frames[1])
    message.header.stamp, message.header.frame_id = stamp, frames[0]
    message.transform.translation.x, message.transform.translation.y = pose.x, pose.y
    message.transform.rotation = quaternion_of(pose.heading)
    return message


def diagnostics_message(
    decision: Decision, pose: Pose, wheels: tuple[Wheel, Wheel], name: str, stamp: Time
) -> DiagnosticArray:
    """Make one status: what the robot does and why, where it is, what each wheel's controller says."""
    values = {f"{wheel.name} wheel": wheel.state or "not heard" for wheel in wheels}
    values |= {f"{wheel.name} angle [rad]": f"{wheel.angle:.3f}" for wheel in wheels}
    values |= {"x [m]": f"{pose.x:.4f}", "y [m]": f"{pose.y:.4f}", "heading [rad]": f"{pose.heading:.4f}"}
    level = DiagnosticStatus.OK if decision.healthy else DiagnosticStatus.ERROR
    return diagnostic_message(name, level, decision.reason, values, stamp)
