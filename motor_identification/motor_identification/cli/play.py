"""Publishes a bag's messages again, with their original spacing: `play BAG [--rate R] [--loop] [--topics …]`."""

import argparse
import sys
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from motor_identification.cli._shell import in_place, positive, shell

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.publisher import Publisher

    from motor_identification.bag import Contents

_SLICE = 0.1  # [s] how long a pause takes at most to notice Ctrl-C
_SETTLED, _PATIENCE = 0.5, 3.0  # [s] without a new subscriber, or without any, until playing starts
_LONE_ROUND = 1.0  # [s] a round of --loop with a single message


@dataclass
class _Schedule:
    """When each message is due: on one time line from the start, so that no error adds up."""

    rate: float
    started: float | None = None  # [s] on the monotonic clock, of this round
    first: int = 0  # [ns] log time
    played: int = 0
    late: deque[float] = field(default_factory=lambda: deque(maxlen=100_000))  # [s] of the latest messages

    def begin(self, first: int, round_length: float) -> None:
        """The first message of a round is here; the next round follows after `round_length` [s of log time]."""
        self.started = time.monotonic() if self.started is None else self.started + round_length / self.rate
        self.first = first

    def wait(self, log_time: int, interrupted: Callable[[], bool]) -> bool:
        """Sleep until the message is due, and count it; False where Ctrl-C came first."""
        due = (self.started or 0.0) + (log_time - self.first) * 1e-9 / self.rate
        while (left := due - time.monotonic()) > 0.0:
            if interrupted():
                return False
            time.sleep(min(left, _SLICE))
        if interrupted():
            return False
        self.late.append(time.monotonic() - due)
        self.played += 1
        return True


def main(args: list[str] | None = None) -> int:
    """Entry point; returns the exit status."""
    parser = argparse.ArgumentParser(
        prog="play",
        description="Publish the messages of a bag again, with their original spacing and QoS. A plant that listens to "
        "motor/voltage will move its motor.",
    )
    parser.add_argument("bag", metavar="BAG", help="a rosbag2 directory or a .mcap or .db3 file")
    parser.add_argument("--rate", type=positive, default=1.0, metavar="R", help="times as fast (default: 1)")
    parser.add_argument("--loop", action="store_true", help="begin again at the end, until Ctrl-C")
    parser.add_argument("--topics", nargs="+", metavar="TOPIC", help="only these (default: all)")
    options = parser.parse_args(args)
    return shell(lambda: _play(options))


def _play(options: argparse.Namespace) -> int:
    import rclpy

    from motor_identification.bag import contents
    from motor_ros.run import Interrupt, start_ros

    interrupt = Interrupt()
    bag = contents(options.bag)
    if bag.cut:
        cut = f"{options.bag} is cut off: {bag.message_count} messages, {bag.duration:.2f} s up to the cut."
        print(cut, file=sys.stderr)
    start_ros([])
    try:
        node = rclpy.create_node("play", enable_rosout=False, start_parameter_services=False)
        publishers = _publishers(node, options.bag, bag, options.topics)
        _wait_for_subscribers(node, publishers, lambda: bool(interrupt))
        print(f"Playing {', '.join(publishers)} from {options.bag}; Ctrl-C ends it.", flush=True)
        schedule = _Schedule(options.rate)
        _publish(options, bag, publishers, schedule, lambda: bool(interrupt))
        if not interrupt:
            _deliver(publishers)
        node.destroy_node()
    finally:
        rclpy.try_shutdown()
    in_place("")
    print(_summary(options.bag, schedule))
    return 0


def _publishers(node: "Node", uri: str, bag: "Contents", chosen: list[str] | None) -> "dict[str, Publisher]":
    """A publisher for each topic that is wanted, has messages, and whose type is installed."""
    from motor_identification.bag import absolute_name
    from motor_identification.cli._offered import to_play
    from motor_identification.cli._recorder import message_type
    from motor_model.errors import RecordingError

    there = {topic.name: topic for topic in bag.topics if topic.message_count}
    wanted = [absolute_name("", name) for name in chosen] if chosen else list(there)
    unknown = [name for name in wanted if name not in there]
    if unknown or not there:
        what = (
            f"has no messages on {', '.join(unknown)}; it has {', '.join(sorted(there))}"
            if there
            else "has no messages"
        )
        raise RecordingError(f"{uri} {what}: choose another bag{' or other --topics' if there else ''}.")
    publishers: dict[str, Any] = {}
    for name in wanted:
        message_class = message_type(there[name].type_name)
        if message_class is None:
            print(f"{name} is not played: its type {there[name].type_name} is not installed here.", file=sys.stderr)
        else:
            publishers[name] = node.create_publisher(message_class, name, to_play(there[name].qos))
    if not publishers:
        raise RecordingError(f"{uri} has no topic whose type is installed here: install its messages and source them.")
    return publishers


def _wait_for_subscribers(node: "Node", publishers: "dict[str, Publisher]", interrupted: Callable[[], bool]) -> None:
    """Let those connect who listen already, so that they get the first message too; finding them takes a while."""
    started = changed = time.monotonic()
    before: list[int] = []
    while (now := time.monotonic()) - started < _PATIENCE and not interrupted():
        connected = [publisher.get_subscription_count() for publisher in publishers.values()]
        known = [node.count_subscribers(name) for name in publishers]
        if connected != before:
            before, changed = connected, now
        if any(connected) and connected == known and now - changed >= _SETTLED:
            return
        time.sleep(0.02)


def _publish(
    options: argparse.Namespace,
    bag: "Contents",
    publishers: "dict[str, Publisher]",
    schedule: _Schedule,
    interrupted: Callable[[], bool],
) -> None:
    from motor_identification.bag import in_time_order, messages

    shown = time.monotonic()
    # A round ends one mean spacing behind its last message, so that the next one continues it.
    count = sum(topic.message_count for topic in bag.topics if topic.name in publishers)
    round_length = bag.duration * count / (count - 1) if count > 1 and bag.duration else _LONE_ROUND
    going = True
    while going:
        begun = False
        for topic, _, log_time, data in in_time_order(messages(options.bag, publishers), options.bag):
            if not begun:
                schedule.begin(log_time, round_length)
                begun = True
            if not schedule.wait(log_time, interrupted):
                return
            publishers[topic].publish(data)
            if time.monotonic() - shown >= 1.0:
                shown = time.monotonic()
                in_place(
                    f"{(log_time - schedule.first) * 1e-9:.0f} of {bag.duration:.0f} s, {schedule.played} messages"
                )
        going = options.loop and begun


def _deliver(publishers: "dict[str, Publisher]") -> None:
    """Wait until the last messages have arrived: a publisher that goes takes them with it."""
    from rclpy.duration import Duration

    for publisher in publishers.values():
        publisher.wait_for_all_acked(Duration(seconds=0.5))


def _summary(uri: str, schedule: _Schedule) -> str:
    late = sorted(schedule.late)
    if not late:
        return f"{uri}: nothing played"
    p99 = late[min(len(late) - 1, int(0.99 * len(late)))]
    return f"{uri}: {schedule.played} messages played, 99 % of them within {p99 * 1e3:.2f} ms of their time"
