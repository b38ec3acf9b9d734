"""Publishers for the topics of a bag: which, under which names, for whom, and what they leave behind."""

import sys
import time
from collections.abc import Callable, Mapping
from typing import Any

from rclpy.duration import Duration
from rclpy.exceptions import InvalidTopicNameException
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.serialization import deserialize_message

from motor_identification.bag import Contents, Topic
from motor_identification.live.motor_commands import Rest, find_rest, message_of_rest
from motor_identification.live.qos_profiles import to_play
from motor_model.errors import RecordingError
from motor_model.printable import escape
from motor_ros.interface_types import NotInstalled, load_message

RMWError = rclpy_implementation.RMWError
_SETTLED = 0.5  # [s] without a new subscriber until playing starts
_PATIENCE = 4.0  # [s] without any subscriber until it does: one that tells of itself every 3 s, as ROS 2 does, is found
_ARRIVAL = 2.0  # [s] for the last messages to arrive


class Publishers:
    """One for each topic that is wanted and whose type is installed.

    Args:
        node: that publishes.
        uri: of the bag.
        bag: what is in it.
        chosen: absolute names of topics; None is all.
        names: new absolute names by those in the bag.

    Raises:
        RecordingError: a topic that is chosen or renamed has no messages, or no type is installed.
    """

    def __init__(self, node: Node, uri: str, bag: Contents, chosen: list[str] | None, names: Mapping[str, str]) -> None:
        there = {topic.name: topic for topic in bag.topics if topic.message_count}
        _check(uri, there, [*(chosen or []), *names])
        self._node = node
        self._names = {name: names.get(name, name) for name in chosen or there}
        self.garbled = 0  # messages that were not sent, because they are not of their type
        self._rests: dict[str, Rest] = {}  # of the topics that command a motor
        self._last: dict[str, Any] = {}  # their latest messages
        self._by_topic: dict[str, Publisher] = {}  # by the name in the bag
        for name in self._names:
            self._open(there[name])
        if not self._by_topic:
            raise RecordingError(
                f"{uri} has no topic that can be played here: install the packages of its messages and source them."
            )

    def __contains__(self, topic: object) -> bool:
        return topic in self._by_topic

    def __str__(self) -> str:
        played = [(name, self._names[name]) for name in self._by_topic]
        return ", ".join(old if old == new else f"{old} as {new}" for old, new in played)

    @property
    def command(self) -> bool:
        """Whether a motor may be driven by what is played."""
        return bool(self._rests)

    def publish(self, topic: str, data: bytes) -> None:
        """Send a serialised message; one that is not of its type would end whoever hears it, and is not sent."""
        publisher = self._by_topic[topic]
        try:
            message = deserialize_message(data, publisher.msg_type)
        except RMWError:
            self.garbled += 1
            return
        if topic not in self._rests:
            publisher.publish(data)
            return
        if hasattr(message, "header"):  # a command of another day is not obeyed
            message.header.stamp = self._node.get_clock().now().to_msg()
        publisher.publish(message)
        self._last[topic] = message

    def wait_for_subscribers(self, interrupted: Callable[[], bool]) -> None:
        """Let those connect who listen already, so that they get the first message too; finding them takes a while."""
        started = changed = time.monotonic()
        before: list[int] = []
        while (now := time.monotonic()) - started < _PATIENCE and not interrupted():
            connected = [publisher.get_subscription_count() for publisher in self._by_topic.values()]
            known = [self._node.count_subscribers(self._names[name]) for name in self._by_topic]
            if connected != before:
                before, changed = connected, now
            if any(connected) and connected == known and now - changed >= _SETTLED:
                return
            time.sleep(0.02)

    def warn_of_others(self) -> None:
        """Say where somebody else publishes too: who listens cannot tell the two apart."""
        for topic in self._by_topic:
            name = self._names[topic]
            infos = self._node.get_publishers_info_by_topic(name)
            others = sorted({info.node_name for info in infos} - {self._node.get_name()})
            if others:
                print(
                    f"{', '.join(others)} publishes {name} too, and listeners cannot tell the two apart: leave it out "
                    f"with --topics, or give it another name, --remap {topic}:=/recorded{topic}.",
                    file=sys.stderr,
                )

    def close(self) -> None:
        """Leave no motor under a voltage or at a speed, and wait until the last messages have arrived."""
        for topic, last in self._last.items():
            if (message := message_of_rest(self._rests[topic], last)) is not None:
                self._by_topic[topic].publish(message)
        for publisher in self._by_topic.values():  # a publisher that goes takes what has not arrived with it
            publisher.wait_for_all_acked(Duration(seconds=_ARRIVAL))

    def _open(self, topic: Topic) -> None:
        name, profile = self._names[topic.name], to_play(topic.qos)
        try:
            message_class = load_message(topic.type_name)
            self._by_topic[topic.name] = self._node.create_publisher(message_class, name, profile)
            if rest := find_rest(topic.type_name, name):
                self._rests[topic.name] = rest
        except NotInstalled as error:
            print(f"{escape(topic.name)} is not played: {error}", file=sys.stderr)
        except InvalidTopicNameException:
            print(f"{escape(name)} is not played: nothing in ROS has such a name; --remap helps.", file=sys.stderr)


def _check(uri: str, there: Mapping[str, Topic], wanted: list[str]) -> None:
    if not there:
        raise RecordingError(f"{uri} has no messages: choose another bag.")
    unknown = [name for name in wanted if name not in there]
    if unknown:
        what = f"has no messages on {', '.join(unknown)}; it has {', '.join(sorted(there))}"
        raise RecordingError(f"{uri} {what}: choose another bag or other topics.")
