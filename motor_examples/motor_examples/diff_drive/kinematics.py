"""Turn velocities of a differential drive into wheel speeds and back, within limits that keep the curvature.

With wheel radius r and wheel separation b, for wheels that roll without slip (Siegwart et al., "Introduction to
Autonomous Mobile Robots", 2nd ed., 3.2):

    v = r (right + left)/2        w = r (right - left)/b
"""

from dataclasses import dataclass
from math import isfinite
from typing import NamedTuple

from motor_model.errors import MotorError


class Twist(NamedTuple):
    """Velocity of the robot's middle."""

    linear: float  # [m/s] forwards
    angular: float  # [rad/s] to the left


class Wheels(NamedTuple):
    """Speeds of the wheels, positive forwards."""

    left: float  # [rad/s]
    right: float  # [rad/s]


STILL = Twist(0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Geometry:
    """What the robot is like.

    Raises:
        MotorError: a length is not positive.
    """

    wheel_radius: float  # [m]
    wheel_separation: float  # [m] between the wheels' points of contact

    def __post_init__(self) -> None:
        for name, value in (("wheel_radius", self.wheel_radius), ("wheel_separation", self.wheel_separation)):
            if not (isfinite(value) and value > 0.0):
                raise MotorError(f"{name} = {value:g} does not work: give a length in metres above 0.")


@dataclass(frozen=True, slots=True)
class Limits:
    """What the robot may do; 0: no limit."""

    linear: float = 0.0  # [m/s]
    angular: float = 0.0  # [rad/s]
    wheel: float = 0.0  # [rad/s]
    linear_acceleration: float = 0.0  # [m/s²]
    angular_acceleration: float = 0.0  # [rad/s²]


def wheel_speeds(geometry: Geometry, twist: Twist) -> Wheels:
    """Compute the wheel speeds [rad/s] of a velocity."""
    half = 0.5 * geometry.wheel_separation * twist.angular
    return Wheels((twist.linear - half) / geometry.wheel_radius, (twist.linear + half) / geometry.wheel_radius)


def body_twist(geometry: Geometry, wheels: Wheels) -> Twist:
    """Compute the velocity of wheel speeds [rad/s]."""
    left, right = geometry.wheel_radius * wheels.left, geometry.wheel_radius * wheels.right
    return Twist(0.5 * (left + right), (right - left) / geometry.wheel_separation)


def limit_twist(geometry: Geometry, limits: Limits, twist: Twist) -> Twist:
    """Slow a velocity down until it is within all limits; its curvature stays, so the robot keeps to its path."""
    wheels = wheel_speeds(geometry, twist)
    fastest = max(abs(wheels.left), abs(wheels.right))
    share = _share((abs(twist.linear), limits.linear), (abs(twist.angular), limits.angular), (fastest, limits.wheel))
    return Twist(share * twist.linear, share * twist.angular)


def limit_wheels(limits: Limits, wheels: Wheels) -> Wheels:
    """Slow both wheels [rad/s] down by the same share, until neither is beyond its limit."""
    share = _share((max(abs(wheels.left), abs(wheels.right)), limits.wheel))
    return Wheels(share * wheels.left, share * wheels.right)


def approach_twist(limits: Limits, start: Twist, wanted: Twist, dt: float) -> Twist:
    """Move from one velocity towards another for dt [s], both parts by the same share of their way."""
    linear, angular = wanted.linear - start.linear, wanted.angular - start.angular
    share = _share((abs(linear), limits.linear_acceleration), (abs(angular), limits.angular_acceleration), dt=dt)
    return Twist(start.linear + share * linear, start.angular + share * angular)


def _share(*pairs: tuple[float, float], dt: float = 1.0) -> float:
    """Find the largest share, 1 at most, of values that keeps each within its limit times dt; a limit of 0 is none."""
    return min((limit * dt / value for value, limit in pairs if value > limit * dt and limit > 0.0), default=1.0)
