"""Who publishes a topic, in words: a node that the middleware does not know by name yet has none of its."""

from types import SimpleNamespace
from typing import cast

from rclpy.node import Node
from std_srvs.srv import Trigger
from workbench import Bench

from motor_ros.graph.publishers import NAMELESS, UNKNOWN, list_clients, list_publishers, publishers_of


def heard(*names: tuple[str, str]) -> Node:
    """A node that is told of publishers in such namespaces, of such names."""
    found = [
        SimpleNamespace(endpoint_gid=[number], node_namespace=space, node_name=name)
        for number, (space, name) in enumerate(names)
    ]
    return cast(Node, SimpleNamespace(get_publishers_info_by_topic=lambda topic: found))


def test_nodes_have_their_namespaces_and_who_is_not_named_yet_comes_last() -> None:
    node = heard(("/", UNKNOWN), ("/right", "motor_sim"), ("/", "motor_sim"))
    assert publishers_of(node, "motor/speed") == ["/motor_sim", "/right/motor_sim", NAMELESS]
    assert [one.node for one in list_publishers(node, "motor/speed")] == ["", "/right/motor_sim", "/motor_sim"]
    assert UNKNOWN not in NAMELESS and publishers_of(heard(), "motor/speed") == []


def test_every_client_of_a_service_is_listed_and_where_the_middleware_does_not_every_node(bench: Bench) -> None:
    """Nodes are told of a service once however many clients they have of it: of two, one may not be known yet."""
    clients = [bench.node.create_client(Trigger, "x") for _ in range(2)]
    bench.wait(lambda: [one.node for one in list_clients(bench.node, "/x")] == ["/bench"] * 2, "both")
    assert len({one.id for one in list_clients(bench.node, "/x")}) == 2 and list_clients(bench.node, "/y") == []
    bench.node.get_publishers_info_by_topic = lambda *_, **__: []  # type: ignore[method-assign]
    assert [one.node for one in list_clients(bench.node, "/x")] == ["/bench"] and len(clients) == 2
