"""List who publishes a topic, as the middleware tells it."""

from typing import NamedTuple

from rclpy.node import Node

UNKNOWN = "_NODE_NAME_UNKNOWN_"  # the middleware tells of a publisher before it tells of its node

Id = tuple[int, ...]


class Publisher(NamedTuple):
    """One publisher of a topic."""

    id: Id  # what the middleware knows it by: who is started again is another one
    node: str  # with its namespace; "" while it is not known


def list_publishers(node: Node, topic: str) -> list[Publisher]:
    """List the publishers of a topic."""
    found = node.get_publishers_info_by_topic(topic)
    return [Publisher(tuple(one.endpoint_gid), _name(one.node_namespace, one.node_name)) for one in found]


def publishers_of(node: Node, topic: str) -> list[str]:
    """Name the nodes that publish a topic, in alphabetical order; one with two publishers stands there twice."""
    return sorted(one.node or f"/{UNKNOWN}" for one in list_publishers(node, topic))


def publisher_ids(node: Node, topic: str) -> frozenset[Id]:
    """List the publishers of a topic by what the middleware knows them by."""
    return frozenset(one.id for one in list_publishers(node, topic))


def _name(namespace: str, name: str) -> str:
    return "" if name == UNKNOWN else f"{namespace.rstrip('/')}/{name}"
