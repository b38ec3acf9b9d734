"""What a plant reports: one sample, and what has to be known to read it; plain values without ROS."""

from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from math import nan

from motor_model.errors import MotorError
from motor_model.gearing.gear import LEAST, MOST, edge_angle, exact_gear


class Measurement(str, Enum):
    """What a recording's numbers are exact about."""

    EDGES = "edges"  # every edge has a time stamp
    COUNTS = "counts"  # a count is read at each sample: the angle is known to one slot, at that instant
    SPEED = "speed"  # a mean speed over a window is all there is


@dataclass(frozen=True, slots=True)
class Sample:
    """One encoder sample: the fields of `motor_msgs/msg/MotorSpeed` without the header."""

    sample_time: int  # [ns] on the plant's own monotonic clock
    speed: float  # [rad/s] signed
    voltage: float  # [V] latched at this sample, held until the next
    edge_count: int = 0  # edges of one polarity since power-up
    edge_time: int = 0  # [ns] latest edge; 0 before the first
    edge_period: float = 0.0  # [s] between the latest two edges; 0 before the second
    supply_voltage: float = nan  # [V] NaN if unmeasured
    current: float = nan  # [A] NaN if unmeasured


# [s] by which a current is older than its sample, by its source: the simulated board reads it at the sample, our board
# in the middle of a PWM pulse before it (motor_board/firmware/board/sense.h). Of others nobody knows.
CURRENT_LAG = {"simulation": 0.0, "hardware": 2.8e-4}


@dataclass(frozen=True, slots=True)
class Info:
    """How to read a plant's samples: the fields of `motor_msgs/msg/MotorInfo` without the header."""

    name: str = "motor"
    source: str = "simulation"  # hardware | simulation | import
    measurement: Measurement = Measurement.EDGES
    edges_per_revolution: int = 96  # counted in a turn of the encoder's shaft
    single_channel: bool = True
    edge_resolution: float = 4e-6  # [s] tick of the timer that stamps edges
    sample_period: float = 0.005  # [s]
    speed_window: float = 0.0  # [s] what a speed-only source averages over
    speed_lag: float = 0.0  # [s] how old the middle of that window is at the stamp
    max_voltage: float = 12.0  # [V] at most that the motor gets
    decay: str = "unknown"  # brake | coast | unknown
    supply_voltage: float = 0.0  # [V] at full duty; 0: max_voltage
    quadrature: int = 1  # counts in a period of one channel: 1 (one polarity), 2, 4; 0 is 1
    gear_ratio: float = 0.0  # encoder turns per turn of the output, which speeds and angles are of; 0: none
    voltage_assumed: bool = False  # of an imported log: nobody said that a voltage holds from its sample on
    rows_said: bool = False  # of an imported log: somebody said by which length of a row its speeds were divided
    speed_said: bool = False  # of an imported log: somebody said over which window its speeds are means, or how old

    @property
    def gear(self) -> Fraction:
        """Encoder turns per output turn, exactly."""
        return exact_gear(self.gear_ratio)

    @property
    def edge_angle(self) -> float:
        """[rad] by which the output turns from one count to the next."""
        return edge_angle(self.edges_per_revolution, self.gear)

    @property
    def full_voltage(self) -> float:
        """[V] at full duty: what a bridge that coasts and a supply that sags are judged by."""
        return self.supply_voltage or self.max_voltage

    @property
    def current_lag(self) -> float:
        """[s] by which a current is older than its sample; NaN: unknown."""
        return CURRENT_LAG.get(self.source, nan)


# What a plant can be: low and high of each number of Info, in its unit.
RANGES = {
    "edges_per_revolution": (0.0, 1e7),  # 0: a speed sensor
    "edge_resolution": (0.0, 1.0),
    "sample_period": (1e-6, 100.0),
    "speed_window": (0.0, 1000.0),
    "speed_lag": (-1000.0, 1000.0),
    "max_voltage": (0.0, 1e5),
    "supply_voltage": (0.0, 1e5),
    "quadrature": (0.0, 4.0),
    "gear_ratio": (0.0, float(MOST)),
}


def check_info(info: Info) -> None:
    """Refuse numbers that no plant has: whoever computes with them would take for ever, or all memory.

    Raises:
        MotorError: one is out of its range.
    """
    for name, (low, high) in RANGES.items():
        value = getattr(info, name)
        if not low <= value <= high:
            raise MotorError(f"motor/info says {name} {value:g}: it must be from {low:g} to {high:g}.")
    if 0.0 < info.gear_ratio < LEAST:
        raise MotorError(
            f"motor/info says gear_ratio {info.gear_ratio:g}: it must be 0 (none), or {float(LEAST):g} and more."
        )
