"""Integrate a pose from what both wheels have turned, by the exact arc between two looks.

With the travels l and r [m] of the wheels, s = (l + r)/2 and a = (r - l)/b, the robot has moved along an arc of the
length s and the angle a, whose chord is s·sin(a/2)/(a/2) long and points to heading + a/2. No speed is integrated, so
no error of a speed adds up: what is left is that of the counts, half a slot a wheel, which does not grow.
"""

from math import cos, sin
from typing import NamedTuple

from motor_examples.diff_drive.kinematics import Geometry

NEARLY_STRAIGHT = 1e-4  # [rad] of an arc, below which sin(x)/x = 1 - x²/6 is exact to the last digit


class Pose(NamedTuple):
    """Where the robot is."""

    x: float = 0.0  # [m]
    y: float = 0.0  # [m]
    heading: float = 0.0  # [rad] not wrapped


def advance_pose(geometry: Geometry, pose: Pose, left: float, right: float) -> Pose:
    """Move a pose by what the wheels have turned [rad]."""
    left, right = geometry.wheel_radius * left, geometry.wheel_radius * right
    arc, angle = 0.5 * (left + right), (right - left) / geometry.wheel_separation
    half = 0.5 * angle
    chord = arc * (1.0 - half * half / 6.0 if abs(angle) < NEARLY_STRAIGHT else sin(half) / half)
    middle = pose.heading + half
    return Pose(pose.x + chord * cos(middle), pose.y + chord * sin(middle), pose.heading + angle)
