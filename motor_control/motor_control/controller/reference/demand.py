"""What is asked of the motor: a speed, a voltage or an angle, and by whom."""

from enum import Enum
from typing import NamedTuple


class Kind(str, Enum):
    """What a demand's number is."""

    SPEED = "speed"  # [rad/s]
    VOLTAGE = "voltage"  # [V] as it is, within the limits
    POSITION = "position"  # [rad] of edges since the plant's start


class Source(str, Enum):
    """Which topic a demand comes by; one at a time drives."""

    REFERENCE = "motor/reference"  # and motor/position_reference: single messages that hold
    JOINT = "motor/joint_command"  # a stream


class Demand(NamedTuple):
    """What is asked for."""

    value: float
    kind: Kind = Kind.SPEED
    source: Source = Source.REFERENCE


UNITS = {Kind.SPEED: "rad/s", Kind.VOLTAGE: "V", Kind.POSITION: "rad"}
