"""Subscribe to a topic with the numbers that the middleware gives a publisher's messages, which tell senders apart."""

import time
from collections.abc import Callable
from typing import Any, Generic, TypeVar

from rclpy.node import Node
from rclpy.qos import QoSProfile

from motor_ros.clocks.hold_ups import HELD_UP, HoldUps
from motor_ros.topics import publishers_of

MessageType = TypeVar("MessageType")
NOT_COUNTED = 2**63  # numbers from here on: the middleware does not count (rmw says 2^64 - 1)


class NumberedInput(Generic[MessageType]):
    """Hands each message on with its number, None if nobody counts, and how long it has waited to be taken [ns].

    Told by the executor, or `polled`: the EventsExecutor of rclpy 7.1 fails for callbacks that want to know more than
    the message. What is polled is taken before each sample, which is when it acts; no storm of messages keeps a sample
    waiting, for no more are taken at once than are kept.
    """

    def __init__(
        self,
        node: Node,
        kind: type[MessageType],
        topic: str,
        profile: QoSProfile,
        take: Callable[[MessageType, int | None, int], None],
        polled: bool = True,
        hold_ups: HoldUps | None = None,
    ) -> None:
        """`hold_ups`: after one, messages are as old as their sender says; it may be on a computer of another time."""
        self._hold_ups = hold_ups
        self._kind, self._take, self._most = kind, take, profile.depth if polled else 0
        self._subscription = node.create_subscription(kind, topic, self._on_message, profile)
        if polled:
            node._subscriptions.remove(self._subscription)  # so that no executor takes what is to be polled

    def poll(self) -> None:
        """Take what has come, if nobody else does."""
        for _ in range(self._most):
            if not (taken := self._subscription.handle.take_message(self._kind, False)):
                return
            self._on_message(*taken)

    def _on_message(self, message: MessageType, about: dict[str, Any]) -> None:
        number = about["publication_sequence_number"]
        counted = number is not None and 0 < number < NOT_COUNTED
        doubt = self._hold_ups is not None and self._hold_ups.in_doubt()
        self._take(message, number if counted else None, _wait_of(about, time.time_ns(), doubt))

    def senders(self, node: Node) -> str:
        """The nodes that can send, in words."""
        return ", ".join(publishers_of(node, self._subscription.topic_name))


def _wait_of(about: dict[str, Any], now: int, doubt: bool) -> int:
    """How long a message has waited [ns], by the clock that stamped it and may be set; 0 where nobody stamps.

    A process that has not stood still lets none wait for as long as that takes to be noticed. While it does nothing is
    received: in doubt a message is as old as it is by when it was sent.
    """
    received, sent = (max(now - (about[f"{kind}_timestamp"] or now), 0) for kind in ("received", "source"))
    return max(received, sent) if doubt else min(received, round(HELD_UP * 1e9))
