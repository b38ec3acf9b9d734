"""A robot of two motors (simulated, real or emulated): a plant and a controller a wheel, and the differential drive."""

from launch import LaunchDescription

from motor_bringup.actions import described
from motor_bringup.diff_drive import ARGUMENTS, session


def generate_launch_description() -> LaunchDescription:
    """`ros2 launch motor_bringup diff_drive.launch.py`; `--show-args` lists what it can be told."""
    return described(ARGUMENTS, session)
