"""List who publishes a topic, who hears one, and who calls a service, as the middleware tells it."""

from collections.abc import Callable
from typing import NamedTuple

from rclpy.node import Node, NodeNameNonExistentError
from rclpy.qos import ReliabilityPolicy
from rclpy.topic_endpoint_info import TopicEndpointInfo

UNKNOWN = "_NODE_NAME_UNKNOWN_"  # the middleware tells of a publisher before it tells of its node
NAMELESS = "a node that is not known by its name yet"  # to a user

Id = tuple[int, ...]


class Publisher(NamedTuple):
    """One publisher of a topic, or one who hears it; or one client of a service."""

    id: Id  # what the middleware knows it by: who is started again is another one
    node: str  # with its namespace; "" while it is not known


def list_publishers(node: Node, topic: str) -> list[Publisher]:
    """List the publishers of a topic."""
    return list(map(_one, node.get_publishers_info_by_topic(topic)))


def list_unreliable(node: Node, topic: str) -> list[Publisher]:
    """List the publishers of a topic that no reliable subscription hears: those that publish best effort."""
    if not count_publishers(node, topic):
        return []
    found = node.get_publishers_info_by_topic(topic)
    return [_one(one) for one in found if one.qos_profile.reliability is ReliabilityPolicy.BEST_EFFORT]


def list_subscribers(node: Node, topic: str) -> list[Publisher]:
    """List who hears a topic."""
    return list(map(_one, node.get_subscriptions_info_by_topic(topic)))


def list_clients(node: Node, service: str) -> list[Publisher]:
    """List the clients of a service by its full name: to the middleware, they publish its requests."""
    if not node.count_clients(service):
        return []
    found = node.get_publishers_info_by_topic(f"rq{service}Request", no_mangle=True)
    return list(map(_one, found)) or _list_calling_nodes(node, service)


def _list_calling_nodes(node: Node, service: str) -> list[Publisher]:
    """List the nodes that have clients, where the middleware does not tell of each (its topics have other names).

    Of several nodes of one name it answers for one: where more clients are there than were found, one is nameless.
    """
    nodes = [full_name(space, name) for name, space in node.get_node_names_and_namespaces()]
    names = {one for one in nodes if one}
    asked = ((one, ask_of_node(node.get_client_names_and_types_by_node, one)) for one in sorted(names))
    calling = [one for one, found in asked if any(name == service for name, _ in found)]
    hidden = len(nodes) > len(names) and node.count_clients(service) > len(calling)
    return [Publisher(tuple(one.encode()), one) for one in calling + [""] * hidden]


def count_publishers(node: Node, topic: str) -> int:
    """Count the publishers of a topic that may have been renamed, which rclpy's own counting does not ask."""
    return int(node.count_publishers(node.resolve_topic_name(topic)))


def published_topics(node: Node, kind: str) -> list[str]:
    """List the topics of a type (`package/msg/Name`) that somebody publishes, in alphabetical order."""
    found = node.get_topic_names_and_types()
    return sorted(name for name, kinds in found if kind in kinds and node.count_publishers(name))


def topics_of_node(node: Node, name: str, kind: str) -> list[str]:
    """List the topics of a type that the node of that full name publishes, in alphabetical order."""
    found = ask_of_node(node.get_publisher_names_and_types_by_node, name)
    return sorted(topic for topic, kinds in found if kind in kinds)


def ask_of_node(ask: Callable[[str, str], list[tuple[str, list[str]]]], name: str) -> list[tuple[str, list[str]]]:
    """Ask what the node of a full name has, such as publishers: names and types; nothing of one that has ended."""
    namespace, _, own = name.rpartition("/")
    try:
        return ask(own, namespace or "/")
    except NodeNameNonExistentError:
        return []


def kind_of(message: type) -> str:
    """Return a message's type as the middleware names it, `package/msg/Name`."""
    return f"{message.__module__.split('.')[0]}/msg/{message.__name__}"


def publishers_of(node: Node, topic: str) -> list[str]:
    """Name the nodes that publish a topic, in alphabetical order; one with two publishers stands there twice.

    `NAMELESS` comes last.
    """
    return sorted(one.node or NAMELESS for one in list_publishers(node, topic))


def publisher_ids(node: Node, topic: str) -> frozenset[Id]:
    """List the publishers of a topic by what the middleware knows them by."""
    return frozenset(one.id for one in list_publishers(node, topic))


def _one(found: TopicEndpointInfo) -> Publisher:
    return Publisher(tuple(found.endpoint_gid), full_name(found.node_namespace, found.node_name))


def full_name(namespace: str, name: str) -> str:
    """Join a node's namespace and name; "" where the middleware does not know it yet."""
    return "" if name == UNKNOWN else f"{namespace.rstrip('/')}/{name}"
