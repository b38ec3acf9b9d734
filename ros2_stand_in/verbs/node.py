"""`ros2 node`: which nodes run, and what they offer."""

import argparse
import sys
from collections.abc import Callable

from rclpy.action import get_action_client_names_and_types_by_node, get_action_server_names_and_types_by_node
from rclpy.node import Node

from motor_model.errors import MotorError
from ros2_stand_in.graph import discovery
from ros2_stand_in.graph.session import session

NamesAndTypes = Callable[[Node, str, str], list[tuple[str, list[str]]]]
_PARTS: dict[str, NamesAndTypes] = {
    "Subscribers": Node.get_subscriber_names_and_types_by_node,
    "Publishers": Node.get_publisher_names_and_types_by_node,
    "Service Servers": Node.get_service_names_and_types_by_node,
    "Service Clients": Node.get_client_names_and_types_by_node,
    "Action Servers": get_action_server_names_and_types_by_node,
    "Action Clients": get_action_client_names_and_types_by_node,
}


def nodes_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 node list` takes."""
    parser.add_argument("-a", "--all", action="store_true", help="hidden nodes too")
    parser.add_argument("-c", "--count-nodes", action="store_true", help="print only how many there are")
    discovery.discovery_arguments(parser)


def nodes(args: argparse.Namespace) -> int:
    """Print all nodes."""
    with session() as ros:
        discovery.settle(ros, args.spin_time)
        found = discovery.node_names(ros.node, args.all)
    if args.count_nodes:
        print(len(found))
        return 0
    if len(set(found)) < len(found):
        print("WARNING: some nodes share a name, which confuses them and you; rename with __node:=.", file=sys.stderr)
    for name in found:
        print(name)
    return 0


def info_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 node info` takes."""
    parser.add_argument("node_name", help="name of the node")
    parser.add_argument("--include-hidden", action="store_true", help="what starts with an underscore too")
    discovery.discovery_arguments(parser)


def info(args: argparse.Namespace) -> int:
    """Print the topics, services and actions of a node."""
    full_name = discovery.full_name(args.node_name)
    with session() as ros:
        discovery.settle(ros, args.spin_time)
        count = discovery.node_names(ros.node, args.include_hidden).count(full_name)
        if count == 0:
            raise MotorError(f"Unable to find node '{full_name}'; 'ros2 node list' shows what runs.")
        if count > 1:
            print(f"{count} nodes share the name '{full_name}'; this is about one of them.", file=sys.stderr)
        print(full_name)
        namespace, _, name = full_name.rpartition("/")
        for title, ask in _PARTS.items():
            print(f"  {title}:")
            rows = discovery.visible(ask(ros.node, name, namespace or "/"), args.include_hidden)
            print("\n".join(f"    {row}: {', '.join(types)}" for row, types in rows))
    return 0
