"""Records topics as they are, inside any node: finds publishers, fits their QoS, writes serialised messages."""

import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from operator import itemgetter
from types import MappingProxyType
from typing import Protocol

from rclpy.callback_groups import CallbackGroup
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.subscription import Subscription

from motor_identification.bag import FLUSH_EVERY, Qos
from motor_identification.live.qos_profiles import DEPTH, offered, to_hear
from motor_model.errors import RecordingError
from motor_model.printable import escape
from motor_ros.clocks.steady_timer import steady_timer
from motor_ros.interface_types import NotInstalled, load_message

LOOK_EVERY = 0.2  # [s] how long a topic that appears later may go unheard
DRAIN_EVERY = 0.02  # [s] how long a message waits in DDS, which stamps it and has room for a thousand


class Sink(Protocol):
    """Where messages go, such as a bag."""

    counts: Counter[str]  # messages by topic

    def topic(self, name: str, type_name: str, qos: tuple[Qos, ...]) -> int:
        """Open a channel for a topic, or find the one there is."""

    def write(self, channel: int, log_time: int, data: bytes, publish_time: int | None = None) -> None:
        """Take a serialised message: when it was received and sent [ns]."""

    def flush(self) -> None:
        """Make sure that what was taken is kept."""


class _NotWaitedFor(CallbackGroup):
    """Subscriptions that do not wake the executor: to wake it for a message costs more than to take the message."""

    def can_execute(self, entity: object) -> bool:
        return False


def _not_called(data: bytes) -> None:
    """What a subscription wants to have, and nobody calls."""


class Recorder:
    """Hands every message on the topics to a bag, or another sink, until `close`; runs on the node's own executor.

    Topics need not exist yet. `topics` are absolute names; None is every topic that is not hidden. `expected` has the
    type and QoS of topics whose first message must not be missed, such as one that is published once by a program that
    ends: they are listened to before anybody publishes, as soon as somebody else does (a publisher that waits for one
    listener must not take the recorder for the controller). `counts` has the messages by topic, `notes` sentences about
    topics that cannot be recorded. When the bag can no longer be written, `refusal` says why and nothing more is
    recorded: whoever runs the node decides what to stop first.
    """

    def __init__(
        self,
        node: Node,
        writer: Sink,
        topics: Sequence[str] | None,
        expected: Mapping[str, tuple[str, QoSProfile]] = MappingProxyType({}),
    ) -> None:
        self.notes: list[str] = []
        self.refusal: RecordingError | None = None
        self._node = node
        self._writer = writer
        self._wanted = None if topics is None else frozenset(topics)
        self._subscriptions: dict[str, Subscription] = {}
        self._channels: dict[str, int] = {}  # of topics that somebody publishes or has published
        self._types: dict[str, str] = {}
        self._group = _NotWaitedFor()
        self._asked: dict[str, QoSProfile] = {}
        self._unusable: set[str] = set()
        rows = ((DRAIN_EVERY, self.drain), (LOOK_EVERY, self.look), (FLUSH_EVERY, self._flush))
        self._expected = dict(expected)
        self._timers = [steady_timer(node, period, callback) for period, callback in rows]
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
        for topic, (type_name, profile) in self._expected.items():
            if topic not in self._subscriptions and self._node.count_subscribers(topic):
                self._subscribe(topic, type_name, to_hear([profile]))
        for topic, types in self._node.get_topic_names_and_types():
            if self._is_wanted(topic) and topic not in self._unusable:
                publishers = self._node.get_publishers_info_by_topic(topic)
                if publishers:
                    self._hear(topic, types[0], [publisher.qos_profile for publisher in publishers])

    def drain(self) -> None:
        """Write what has arrived, in the order in which it did."""
        with self._noticing():
            for received, channel, sent, data in sorted(self._arrived(), key=itemgetter(0)):
                self._writer.write(channel, received, data, sent)

    def _arrived(self) -> Iterator[tuple[int, int, int, bytes]]:
        """When each message was received, its channel, when it was sent, and its data."""
        for topic, subscription in self._subscriptions.items():
            room = DEPTH  # at most: who sends faster than we take must not hold us up
            with subscription.handle:
                while room > 0 and (taken := subscription.handle.take_message(subscription.msg_type, True)):
                    data, info = taken
                    # When DDS received it: waiting in this process does not count. Some middleware does not say.
                    received = info.get("received_timestamp") or time.time_ns()
                    channel = self._channel(topic, [self._asked[topic]])
                    yield received, channel, info.get("source_timestamp") or received, data
                    room -= 1

    def close(self) -> None:
        """Write what has arrived and has not been taken yet, and stop."""
        for timer in self._timers:
            self._node.destroy_timer(timer)
        self.drain()
        for subscription in self._subscriptions.values():
            self._node.destroy_subscription(subscription)
        self._subscriptions.clear()

    def _is_wanted(self, topic: str) -> bool:
        if self._wanted is not None:
            return topic in self._wanted
        return not any(part.startswith("_") for part in topic.split("/"))  # hidden: actions and services use them

    def _hear(self, topic: str, type_name: str, publishers: list[QoSProfile]) -> None:
        known = self._types.get(topic) == type_name
        asked = self._asked.get(topic) if known else None
        fitting = to_hear(
            [*publishers, *([asked] if asked else [])]
        )  # never more than before: that would repeat latched
        if fitting != asked:
            self.drain()
            self._subscribe(topic, type_name, fitting)
        if topic in self._subscriptions:
            with self._noticing():
                self._channel(topic, publishers)

    def _subscribe(self, topic: str, type_name: str, profile: QoSProfile) -> None:
        try:
            message_class = load_message(type_name)
        except NotInstalled as error:
            self._unusable.add(topic)
            self.notes.append(f"{escape(topic)} is not recorded: {error}")
            return
        before = self._subscriptions.pop(topic, None)
        if before is not None:
            self._node.destroy_subscription(before)
        self._subscriptions[topic] = self._node.create_subscription(
            message_class, topic, _not_called, profile, raw=True, callback_group=self._group
        )
        self._asked[topic], self._types[topic] = profile, type_name

    def _channel(self, topic: str, publishers: list[QoSProfile]) -> int:
        """The topic's channel in the bag, opened for the first publishers that are known or heard."""
        if topic not in self._channels:
            self._channels[topic] = self._writer.topic(topic, self._types[topic], offered(*publishers))
        return self._channels[topic]

    def _flush(self) -> None:
        with self._noticing():
            self._writer.flush()

    @contextmanager
    def _noticing(self) -> Iterator[None]:
        try:
            yield
        except RecordingError as error:
            self.refusal = error
