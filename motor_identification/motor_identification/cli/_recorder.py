"""Records topics as they are, inside any node: finds publishers, fits their QoS, writes serialised messages."""

import time
from collections import Counter
from collections.abc import Sequence
from functools import partial
from importlib import import_module
from typing import Any

from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.subscription import Subscription

from motor_identification.bag import FLUSH_EVERY, BagWriter
from motor_identification.cli._offered import offered, to_hear

LOOK_EVERY = 0.2  # [s] how long a topic that appears later may go unheard
_DRAIN_AT_MOST = 0.3  # [s]


class Recorder:
    """Writes every message on the topics to the bag from now until `close`; runs on the node's own executor.

    Topics need not exist yet. `topics` are absolute names; None is every topic that is not hidden. `counts` has the
    messages by topic, `notes` sentences about topics that cannot be recorded.
    """

    def __init__(self, node: Node, writer: BagWriter, topics: Sequence[str] | None) -> None:
        self.notes: list[str] = []
        self._node = node
        self._writer = writer
        self._wanted = None if topics is None else frozenset(topics)
        self._subscriptions: dict[str, Subscription] = {}
        self._asked: dict[str, QoSProfile] = {}
        self._unusable: set[str] = set()
        self._timers = [node.create_timer(LOOK_EVERY, self.look), node.create_timer(FLUSH_EVERY, writer.flush)]
        self.look()

    @property
    def counts(self) -> Counter[str]:
        """Messages by topic."""
        return self._writer.counts

    @property
    def heard(self) -> frozenset[str]:
        """The topics that are subscribed to."""
        return frozenset(self._subscriptions)

    def look(self) -> None:
        """Subscribe to topics that have appeared, and again to those whose new publishers offer less."""
        for topic, types in self._node.get_topic_names_and_types():
            if self._is_wanted(topic) and topic not in self._unusable:
                publishers = self._node.get_publishers_info_by_topic(topic)
                if publishers:
                    self._hear(topic, types[0], [publisher.qos_profile for publisher in publishers])

    def close(self) -> None:
        """Write what has arrived and has not been taken yet, and stop."""
        for timer in self._timers:
            self._node.destroy_timer(timer)
        deadline = time.monotonic() + _DRAIN_AT_MOST
        for subscription in self._subscriptions.values():
            with subscription.handle:
                while time.monotonic() < deadline and (
                    taken := subscription.handle.take_message(subscription.msg_type, True)
                ):
                    subscription.callback(*taken)
            self._node.destroy_subscription(subscription)
        self._subscriptions.clear()

    def _is_wanted(self, topic: str) -> bool:
        if self._wanted is not None:
            return topic in self._wanted
        return not any(part.startswith("_") for part in topic.split("/"))  # hidden: actions and services use them

    def _hear(self, topic: str, type_name: str, publishers: list[QoSProfile]) -> None:
        asked = self._asked.get(topic)
        fitting = to_hear(
            [*publishers, *([asked] if asked else [])]
        )  # never more than before: that would repeat latched
        if fitting == asked:
            return
        message_class = message_type(type_name)
        if message_class is None:
            self._unusable.add(topic)
            self.notes.append(f"{topic} is not recorded: its type {type_name} is not installed here.")
            return
        channel = self._writer.topic(topic, type_name, offered(*publishers))
        before = self._subscriptions.pop(topic, None)
        if before is not None:
            self._node.destroy_subscription(before)
        keep = partial(self._keep, channel)
        self._subscriptions[topic] = self._node.create_subscription(message_class, topic, keep, fitting, raw=True)
        self._asked[topic] = fitting

    def _keep(self, channel: int, data: bytes, info: dict[str, int]) -> None:
        # When DDS received it: queueing in this process does not count. Some middleware does not say.
        received = info.get("received_timestamp") or time.time_ns()
        self._writer.write(channel, received, data, info.get("source_timestamp") or received)


def message_type(type_name: str) -> Any:
    """The class of `package/msg/Name`; None where it is not installed."""
    package, kind, name = type_name.split("/") if type_name.count("/") == 2 else ("", "", "")
    try:
        return getattr(import_module(f"{package}.{kind}"), name, None)
    except (ImportError, ValueError, TypeError):
        return None
