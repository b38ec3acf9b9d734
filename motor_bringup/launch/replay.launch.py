"""A recording beside its simulation: recorded voltages drive a simulated motor."""

from launch import LaunchDescription

from motor_bringup.actions import described
from motor_bringup.replay import ARGUMENTS, session


def generate_launch_description() -> LaunchDescription:
    """`ros2 launch motor_bringup replay.launch.py`; `--show-args` lists what it can be told."""
    return described(ARGUMENTS, session)
