"""Tabulate the drive's parameters, and make a configuration of them."""

from collections.abc import Mapping

from motor_examples.diff_drive.drive import Config
from motor_examples.diff_drive.kinematics import Geometry, Limits
from motor_ros.parameters import Row, Value
from motor_ros.program import Program

LIMITS = (
    Row("max_linear", 0.5, "largest velocity forwards; 0: any", "m/s", 0.0, 100.0),
    Row("max_angular", 3.0, "largest rate of turn; 0: any", "rad/s", 0.0, 100.0),
    Row("max_wheel", 0.0, "largest speed of a wheel, such as the slower motor's top speed; 0: any", "rad/s", 0.0, 1e4),
    Row("linear_acceleration", 1.0, "largest acceleration, and deceleration; 0: any", "m/s^2", 0.0, 1000.0),
    Row("angular_acceleration", 6.0, "the same of the rate of turn; 0: any", "rad/s^2", 0.0, 1000.0),
)
NUMBERS = (
    Row("wheel_radius", 0.033, "radius of the wheels", "m", 1e-4, 10.0),
    Row("wheel_separation", 0.16, "distance between the wheels' points of contact", "m", 1e-3, 100.0),
    Row("cmd_vel_timeout", 0.5, "age at which a velocity is dropped and the robot stops; 0: it holds", "s", 0.0, 60.0),
    Row("travel_gain", 2.0, "speed for what a wheel is behind its way; 0: it stays behind", "1/s", 0.0, 20.0),
    *LIMITS,
)
ROWS = (
    *NUMBERS,
    Row("left", "left", "namespace of the left wheel's motor", read_only=True),
    Row("right", "right", "namespace of the right wheel's motor", read_only=True),
    Row("left_reversed", False, "the left motor turns backwards where the robot goes forwards", read_only=True),
    Row("right_reversed", False, "the right motor turns backwards where the robot goes forwards", read_only=True),
    Row("stamped", False, "cmd_vel is a geometry_msgs/msg/TwistStamped", read_only=True),
    Row("rate", 50.0, "references and odometry per second", "Hz", 5.0, 200.0, read_only=True),
    Row("odom_frame", "odom", "frame in which the pose is", read_only=True),
    Row("base_frame", "base_link", "frame of the robot", read_only=True),
    Row("publish_tf", True, "send the transform from odom_frame to base_frame on /tf, too", read_only=True),
)
PROGRAM = Program(
    "motor_examples",
    "diff_drive",
    "Drives a robot with two wheels: cmd_vel in, motor/reference of a left and a right motor out, odometry back.\n"
    "Stale velocities stop it; where one wheel stops, the other one stops too. Ctrl-C lets go of both motors.",
    ROWS,
    "ros2 run motor_examples diff_drive --ros-args -p wheel_radius:=0.034 -p wheel_separation:=0.15",
    publishes=("left/motor/reference", "right/motor/reference", "odom", "/tf", "/diagnostics"),
    subscribes=(
        "cmd_vel",
        *(f"{side}/motor/{name}" for side in ("left", "right") for name in ("speed", "info", "control_state")),
    ),
    requests=("left/motor/release", "right/motor/release"),
)


def config_of(values: Mapping[str, Value]) -> Config:
    """Make the drive's configuration.

    Raises:
        MotorError: a value does not work.
    """
    geometry = Geometry(float(values["wheel_radius"]), float(values["wheel_separation"]))
    linear, angular, wheel, *accelerations = (float(values[row.name]) for row in LIMITS)
    return Config(
        geometry,
        Limits(linear, angular, wheel, *accelerations),
        float(values["cmd_vel_timeout"]),
        float(values["travel_gain"]),
    )
