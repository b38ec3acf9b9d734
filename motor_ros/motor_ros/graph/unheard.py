"""Find who publishes commands that cannot be heard: best effort, where a topic is heard reliably alone.

The middleware never matches such a publisher, and what it sends does not come, also not a 0 that is meant to stop the
motor. It tells the publisher's node alone, which does not always say so.
"""

from rclpy.node import Node

from motor_ros.graph.publishers import Id, list_unreliable

UNHEARD = (
    "What {} sends on {} is not heard, nor would a 0 be: it is published best effort, and commands are heard from "
    "reliable publishers alone; publish it with the default QoS (reliable)."
)


class Unheard:
    """Publishers of some topics that a node hears reliably."""

    def __init__(self, node: Node, *topics: str) -> None:
        self._node, self._topics = node, topics
        self._told: frozenset[Id] = frozenset()  # publishers that have been logged

    def look(self) -> str:
        """Say who is not heard; empty if nobody is. Each publisher is logged once."""
        there = {topic: [one for one in list_unreliable(self._node, topic) if one.node] for topic in self._topics}
        for topic, found in there.items():
            for one in found:
                if one.id not in self._told:
                    self._node.get_logger().warning(self._say(topic, one.node))
        self._told = frozenset(one.id for found in there.values() for one in found)
        return " ".join(self._say(topic, *{one.node for one in found}) for topic, found in there.items() if found)

    def _say(self, topic: str, *nodes: str) -> str:
        return UNHEARD.format(" and ".join(sorted(nodes)), self._node.resolve_topic_name(topic))
