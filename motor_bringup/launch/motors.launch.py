"""Two motors, left and right, each with its own board: plants (simulated, real or emulated) and speed controllers."""

from launch import LaunchDescription

from motor_bringup.actions import described
from motor_bringup.motors import ARGUMENTS, session


def generate_launch_description() -> LaunchDescription:
    """`ros2 launch motor_bringup motors.launch.py`; `--show-args` lists what it can be told."""
    return described(ARGUMENTS, session)
