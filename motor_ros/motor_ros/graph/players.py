"""Know the nodes that play recordings: what they send, and the services they call, nobody asks for today."""

from rclpy.node import Node

from motor_ros.graph.publishers import ask_of_node, full_name

# How `ros2 bag play` calls its node, and what it serves under whatever name. A recording that it plays asks nobody, and
# leaves a motor as it is at its end.
PLAYER = "rosbag2_player"
SERVED = "rosbag2_interfaces/srv/"
CALLED = (
    "{} would be called by what plays a recording ({}), which may have requests in it: call again when that has ended."
)


def find_servers(node: Node) -> set[str]:
    """Find the nodes that serve what a player serves, by their full names."""
    services = node.get_service_names_and_types()
    return {name.rpartition("/")[0] for name, kinds in services if any(SERVED in kind for kind in kinds)}


def find_players(node: Node) -> set[str]:
    """Find all nodes that play recordings, by their full names."""
    named = {full_name(space, name) for name, space in node.get_node_names_and_namespaces() if name == PLAYER}
    return named | find_servers(node)


def find_playing_caller(node: Node, service: str) -> str:
    """Say who plays a recording and may call a service of this node, as a sentence; "" if nobody does.

    `ros2 bag play --publish-service-requests` calls what was called when it was recorded.
    """
    resolved = node.resolve_service_name(service)
    callers = [one for one in sorted(find_players(node)) if _may_call(node, one, resolved)]
    return CALLED.format(resolved, ", ".join(callers)) if callers else ""


def _may_call(node: Node, player: str, service: str) -> bool:
    """Tell whether a node has a client of a service."""
    return any(service == one for one, _ in ask_of_node(node.get_client_names_and_types_by_node, player))
