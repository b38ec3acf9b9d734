"""Know the nodes that play recordings: what they send, and the services they call, nobody asks for today."""

import re
from collections.abc import Iterable

from rclpy.node import Node

from motor_ros.graph.publishers import Publisher, ask_of_node

# How `ros2 bag play` and PlotJuggler's re-publisher of a loaded bag call their nodes, and what the former serves under
# whatever name. A recording that they play asks nobody, and leaves a motor as it is at its end, or at a cursor.
PLAYERS = "rosbag2_player", "plotjuggler"
# How programs call their nodes that publish what they read of a bag themselves: playback_node in ROS 2's own tutorial,
# bag_player, rosbag_replayer. The node of rqt, whose rqt_bag plays as well, is also one in which a person publishes.
OTHERS = re.compile(
    r"(^|_)(ros)?bag2?_?(re)?play(er|back)?(_|\d|$)|(^|_)(re)?play(er|back)?_?(ros)?bag2?(_|\d|$)|^playback_?node",
    re.IGNORECASE,
)
SERVED = "rosbag2_interfaces/srv/"
CALLED = (
    "{} would be called by what plays a recording ({}), which may have requests in it: call again when that has ended."
)


def find_players_among(node: Node, there: Iterable[Publisher]) -> set[str]:
    """Find the nodes that play recordings among those that publish, or call, by their full names."""
    names = {one.node for one in there if one.node}
    servers = _find_servers(node)  # by their services' names, of two nodes of one name, too
    return {one for one in names if is_player(one.rpartition("/")[2]) or one in servers or _serves(node, one)}


def is_player(name: str) -> bool:
    """Tell a node that plays recordings by its name, without namespace."""
    return name in PLAYERS or OTHERS.search(name) is not None


def _find_servers(node: Node) -> set[str]:
    return {name.rpartition("/")[0] for name, kinds in node.get_service_names_and_types() if _is_served(kinds)}


def _serves(node: Node, name: str) -> bool:
    """Tell whether a node serves what a player serves, whatever that has been renamed to."""
    return any(_is_served(kinds) for _, kinds in ask_of_node(node.get_service_names_and_types_by_node, name))


def _is_served(kinds: Iterable[str]) -> bool:
    return any(SERVED in kind for kind in kinds)
