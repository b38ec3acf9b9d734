"""One motor: a plant (simulated, real or emulated), its speed controller and, if wanted, a recorder."""

from launch import LaunchDescription

from motor_bringup.actions import described
from motor_bringup.motor import ARGUMENTS, session


def generate_launch_description() -> LaunchDescription:
    """`ros2 launch motor_bringup motor.launch.py`; `--show-args` lists what it can be told."""
    return described(ARGUMENTS, session)
