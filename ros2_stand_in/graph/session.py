"""A hidden node of our own, alive for as long as one verb runs."""

import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import rclpy
from rclpy.exceptions import NameValidationException
from rclpy.executors import SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node

from motor_model.errors import MotorError
from motor_ros.graph.open_sockets import refuse_open_sockets
from motor_ros.run import LOOK_FOR_SIGNALS_EVERY, Interrupt, start_ros

RCLError = rclpy_implementation.RCLError


class Session:
    """The node, and waiting for things in a way that Ctrl-C always ends."""

    def __init__(self, node: Node, interrupt: Interrupt) -> None:
        self.node = node
        self._interrupt = interrupt
        self._executor = SingleThreadedExecutor()
        self._executor.add_node(node)

    def spin(self, until: Callable[[], bool], seconds: float = float("inf"), look_every: float = 0.1) -> bool:
        """Run callbacks until the condition holds (true) or the time is over (false).

        Raises:
            KeyboardInterrupt: the user pressed Ctrl-C.
        """
        end = time.monotonic() + seconds
        while not until():
            left = end - time.monotonic()
            if self._interrupt:
                raise KeyboardInterrupt
            if left <= 0.0:
                return False
            self._executor.spin_once(timeout_sec=min(left, look_every, LOOK_FOR_SIGNALS_EVERY))
        return True

    def pause(self, seconds: float) -> None:
        """Let this time pass.

        Raises:
            KeyboardInterrupt: the user pressed Ctrl-C.
        """
        self.spin(lambda: False, seconds)

    def close(self) -> None:
        """Let go of the node: held by a suspended spin it would not say goodbye, and the next one would wait for it."""
        self._executor.shutdown(timeout_sec=0.5)

    def forgive_interrupt(self) -> None:
        """Wait on after a Ctrl-C, such as for a goal to be cancelled; the next one ends that too."""
        self._interrupt.forgive()


@contextmanager
def session(node_name: str | None = None) -> Iterator[Session]:
    """Start ROS and a node whose name hides it from lists; both end with the block.

    Raises:
        MotorError: ROS cannot start, such as for a ROS_DOMAIN_ID that is not a number, or a node name with a slash; or
            it is open to the network.
    """
    interrupt = Interrupt()
    try:
        start_ros([])
        node = rclpy.create_node(node_name or f"_ros2cli_{os.getpid()}", start_parameter_services=False)
    except (RCLError, NameValidationException) as error:
        raise MotorError(f"ROS does not start: {' '.join(str(error).split())}.") from error
    ros = Session(node, interrupt)
    try:
        refuse_open_sockets(node)
        yield ros
    finally:
        ros.close()
        node.destroy_node()
        rclpy.try_shutdown()
