"""Answer requests that might move a motor once it is known whose they are: a node is known after its clients."""

from collections.abc import Callable
from typing import Any

from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from rclpy.task import Future

from motor_ros.clocks.steady_timer import STEADY
from motor_ros.graph.players import may_call

# [s] until a request's node is known, others having at most 0.1: a player of recordings that called as soon as it could
# was nobody in 9 of 17 calls, and in none of 15 after 0.1 s.
KNOWN_AFTER = 0.2
UNKNOWN = "Nobody knows yet which node calls {}: call again."


def serve_known(
    node: Node,
    kind: type,
    name: str,
    asks: Callable[[Any], bool],
    answer: Callable[[Any, Any], Any],
    refuse: Callable[[Any, str], Any],
) -> None:
    """Serve requests, those that ask for a motion once all who may call are known, or not at all.

    Nothing else of the node waits meanwhile. Where no node is known that may call, it is refused.

    Args:
        node: that serves them.
        kind: of service.
        name: of it.
        asks: whether a request asks for what may move a motor.
        answer: fills in the response to a request.
        refuse: fills in the response that is a refusal, for a sentence.
    """
    waits = MutuallyExclusiveCallbackGroup()

    async def serve(request: object, response: object) -> object:
        clients, known = count_callers(node, name) if asks(request) else (0, 0)
        if clients > known:
            waited: Future = Future()
            timer = node.create_timer(KNOWN_AFTER, lambda: waited.set_result(None), callback_group=waits, clock=STEADY)
            await waited
            node.destroy_timer(timer)
            if count_callers(node, name)[1] == 0:  # a node may have several of one kind, of which one is told
                return refuse(response, UNKNOWN.format(node.resolve_service_name(name)))
        return answer(request, response)

    node.create_service(kind, name, serve, callback_group=MutuallyExclusiveCallbackGroup())


def count_callers(node: Node, service: str) -> tuple[int, int]:
    """Count the clients that a service has, and the nodes that are known to have some."""
    resolved = node.resolve_service_name(service)
    nodes = node.get_node_names_and_namespaces()
    return node.count_clients(resolved), sum(may_call(node, name, space, resolved) for name, space in nodes)
