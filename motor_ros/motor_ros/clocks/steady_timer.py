"""A timer that goes by a clock that nobody sets."""

from collections.abc import Callable

from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.timer import Timer

STEADY = Clock(clock_type=ClockType.STEADY_TIME)


def steady_timer(node: Node, period: float, callback: Callable[[], None]) -> Timer:
    """Call back every `period` [s], whatever ROS time does: it may be simulated, or set."""
    return node.create_timer(period, callback, clock=STEADY)
