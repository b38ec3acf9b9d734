"""From a motor to its model: a plant, an experiment, and the analysis of what it recorded."""

from launch import LaunchDescription

from motor_bringup.actions import described
from motor_bringup.identify import ARGUMENTS, session


def generate_launch_description() -> LaunchDescription:
    """`ros2 launch motor_bringup identify.launch.py`; `--show-args` lists what it can be told."""
    return described(ARGUMENTS, session)
