"""Subscribe to motor/voltage with the numbers that the middleware gives a publisher's messages."""

import time
from collections.abc import Callable
from typing import Any

from rclpy.node import Node

from motor_msgs.msg import MotorVoltage
from motor_ros import qos
from motor_ros.topics import publishers_of

Take = Callable[[float, str, int | None, int], None]
NOT_COUNTED = 2**63  # numbers from here on: the middleware does not count (rmw says 2^64 - 1)


class VoltageInput:
    """Hands each message on as voltage [V], frame_id, number, and how long it has waited to be taken [ns].

    Told by the executor, or `polled`: the EventsExecutor of rclpy 7.1 fails for callbacks that want to know more than
    the message. What is polled is taken before each sample, which is when it acts.
    """

    def __init__(self, node: Node, take: Take, polled: bool) -> None:
        self._take, self._polled = take, polled
        self._subscription = node.create_subscription(MotorVoltage, "motor/voltage", self._on_message, qos.COMMANDS)
        if polled:
            node._subscriptions.remove(self._subscription)  # so that no executor takes what is to be polled

    def poll(self) -> None:
        """Take what has come, if nobody else does."""
        while self._polled and (taken := self._subscription.handle.take_message(MotorVoltage, False)):
            self._on_message(*taken)

    def _on_message(self, message: MotorVoltage, about: dict[str, Any]) -> None:
        number = about["publication_sequence_number"]
        counted = number is not None and 0 < number < NOT_COUNTED
        waited = _wait_of(about["received_timestamp"], time.time_ns())
        self._take(message.voltage, message.header.frame_id, number if counted else None, waited)

    def senders(self, node: Node) -> str:
        """The nodes that can send, in words."""
        return ", ".join(publishers_of(node, self._subscription.topic_name))


def _wait_of(received: int | None, now: int) -> int:
    """How long a message has waited [ns], by the clock that stamped it and may be set back; 0 where nobody stamps."""
    return max(now - received, 0) if received else 0
