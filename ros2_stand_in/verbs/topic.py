"""`ros2 topic list`, `info` and `type`: which topics there are, and who is on them."""

import argparse
import sys
from collections.abc import Callable, Sequence
from typing import Any

from rclpy.node import Node

from motor_model.errors import MotorError
from ros2_stand_in.graph import discovery
from ros2_stand_in.graph.session import Session, session
from ros2_stand_in.interfaces import interface_type


def topics_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 topic list` takes."""
    parser.add_argument("-t", "--show-types", action="store_true", help="print the types too")
    parser.add_argument("-c", "--count-topics", action="store_true", help="print only how many there are")
    parser.add_argument("-v", "--verbose", action="store_true", help="print who publishes and subscribes")
    parser.add_argument("--include-hidden-topics", action="store_true", help="topics whose name starts with _ too")
    discovery.discovery_arguments(parser)


def topics(args: argparse.Namespace) -> int:
    """Print all topics."""
    with session() as ros:
        discovery.settle(ros, args.spin_time)
        rows = discovery.visible(ros.node.get_topic_names_and_types(), args.include_hidden_topics)
        if args.verbose and not args.count_topics:
            _print_ends("Published topics:", "publisher", rows, ros.node.count_publishers)
            _print_ends("Subscribed topics:", "subscriber", rows, ros.node.count_subscribers)
        else:
            discovery.print_list(rows, args.show_types, args.count_topics)
    return 0


def _print_ends(title: str, end: str, rows: list[tuple[str, list[str]]], count_of: Callable[[str], int]) -> None:
    print(title)
    for name, types in rows:
        count = count_of(name)
        if count:
            print(f" * {name} [{', '.join(types)}] {count} {end}{'s' if count > 1 else ''}")
    print()


def info_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 topic info` takes."""
    parser.add_argument("topic_name", help="name of the topic")
    parser.add_argument("-v", "--verbose", action="store_true", help="print nodes, types and QoS of all ends")
    discovery.discovery_arguments(parser)


def info(args: argparse.Namespace) -> int:
    """Print the type of a topic and how many publish and subscribe."""
    name = discovery.full_name(args.topic_name)
    with session() as ros:
        discovery.settle(ros, args.spin_time)
        types = _types(ros.node, name)
        gap = "\n\n" if args.verbose else "\n"
        print(f"Type: {types[0] if len(types) == 1 else types}", end=gap)
        publishers = ros.node.get_publishers_info_by_topic(name)
        _print_info("Publisher count", publishers, args.verbose, gap)
        _print_info("Subscription count", ros.node.get_subscriptions_info_by_topic(name), args.verbose, gap)
    return 0


def _print_info(title: str, ends: Sequence[Any], verbose: bool, gap: str) -> None:
    print(f"{title}: {len(ends)}", end=gap)
    for end in ends if verbose else ():
        print(end, end=gap)


def type_of_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 topic type` takes."""
    parser.add_argument("topic_name", help="name of the topic")
    discovery.discovery_arguments(parser)


def type_of(args: argparse.Namespace) -> int:
    """Print the type of a topic."""
    name = discovery.full_name(args.topic_name)
    with session() as ros:
        discovery.settle(ros, args.spin_time, lambda: _found(ros.node, name))
        print(*_types(ros.node, name), sep="\n")
    return 0


def _found(node: Node, name: str) -> list[str]:
    types: list[str] = dict(node.get_topic_names_and_types()).get(name, [])
    return types


def _types(node: Node, name: str) -> list[str]:
    types = _found(node, name)
    if not types:
        raise MotorError(f"Unknown topic '{name}': nobody publishes or subscribes to it.")
    return types


def message_type(ros: Session, name: str, given: str | None) -> Any:
    """The class of a topic's messages; waits until the topic is there, unless the type is given.

    Raises:
        MotorError: there is no such type, or more than one on the topic.
    """
    if given is not None:
        return interface_type.load(given, "msg")
    if not _found(ros.node, name):
        print(f"WARNING: topic [{name}] does not appear to be published yet", file=sys.stderr)
        ros.spin(lambda: bool(_found(ros.node, name)))
    types = _found(ros.node, name)
    if len(types) > 1:
        raise MotorError(f"Topic '{name}' has more than one type ({', '.join(types)}): say which after its name.")
    return interface_type.load(types[0], "msg")
