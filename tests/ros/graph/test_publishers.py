"""Who publishes a topic, in words: a node that the middleware does not know by name yet has none of its."""

from contextlib import closing
from types import SimpleNamespace
from typing import cast

import pytest
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


def test_every_client_of_a_service_is_listed_and_where_the_middleware_does_not_every_node() -> None:
    """Nodes are told of a service once however many clients they have of it: of two, one may not be known yet.

    The bench has a namespace of its own: an earlier test's, of the same name, may be listed until it is forgotten.
    """
    with closing(Bench("/alone")) as bench:
        clients = [bench.node.create_client(Trigger, "x") for _ in range(2)]
        bench.wait(lambda: [one.node for one in list_clients(bench.node, "/alone/x")] == ["/alone/bench"] * 2, "both")
        assert len({one.id for one in list_clients(bench.node, "/alone/x")}) == 2
        assert list_clients(bench.node, "/alone/y") == []
        told_of_nodes_alone(bench)
        bench.wait(
            lambda: bench.node.get_node_names_and_namespaces().count(("bench", "/alone")) == 1, "one of its name"
        )
        assert [one.node for one in list_clients(bench.node, "/alone/x")] == ["/alone/bench"] and len(clients) == 2


@pytest.mark.parametrize("caller", [0, 1])
def test_of_two_nodes_of_one_name_none_calls_unseen(caller: int) -> None:
    """The middleware answers for one of them, whose client it may not be: that was not listed, or its name twice."""
    with closing(Bench("/twins")) as one, closing(Bench("/twins")) as other:
        client = (one, other)[caller].node.create_client(Trigger, "x")
        told_of_nodes_alone(one)
        one.wait(lambda: one.node.get_node_names_and_namespaces().count(("bench", "/twins")) == 2, "both")
        one.wait(lambda: len(list_clients(one.node, "/twins/x")) == 1, "its client")
        assert list_clients(one.node, "/twins/x")[0].node in ("", "/twins/bench") and client


def told_of_nodes_alone(bench: Bench) -> None:
    bench.node.get_publishers_info_by_topic = lambda *_, **__: []  # type: ignore[method-assign]
