"""Know the nodes that play recordings: what they send, and the services they call, nobody asks for today."""

from collections.abc import Iterable

from rclpy.node import Node

from motor_ros.graph.publishers import Publisher

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


def find_players_among(node: Node, there: Iterable[Publisher]) -> set[str]:
    """Find the nodes that play recordings among those that publish, or call, and all that serve as a player does."""
    return {one.node for one in there if one.node.rpartition("/")[2] == PLAYER} | find_servers(node)
