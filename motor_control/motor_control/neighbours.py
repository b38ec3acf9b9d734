"""Know who hears this node and who is heard: what is missing is said, and another motor's voltages are not sent.

A node in another namespace than its plant, or one of whose topics has been renamed, waits for ever and has nothing to
say for itself. One that hears the samples of one plant while its voltages go to another would drive that one, by what
this one does, until it is found out by what is not applied. One that is told by another plant what its samples mean
takes them for what they are not, and where both have the same disc nothing contradicts that.
"""

from rclpy.node import Node

from motor_msgs.msg import MotorInfo, MotorSpeed
from motor_ros.graph.publishers import (
    count_publishers,
    kind_of,
    list_publishers,
    list_subscribers,
    published_topics,
    topics_of_node,
)

SPEED, INFO, VOLTAGE = "motor/speed", "motor/info", "motor/voltage"

NO_PLANT = "Nobody publishes {}: start motor_sim or motor_driver in this namespace{}."
ELSEWHERE = "; there is a plant that publishes {}, whose namespace this node would need (-r __ns:=/NAMESPACE)"
NO_INFO = "Nobody publishes {}, which says what the samples on {} mean{}: see remappings and namespaces."
INFO_ELSEWHERE = ", but {} is"
NOBODY_HEARS = "Nobody hears {}, on which the voltages go: see remappings and namespaces of plant and controller."
ANOTHER_DRIVEN = (
    "{} would be driven on {} by what another plant does ({}), for its own samples are on {}: see remappings and "
    "namespaces. The motor gets 0 V until then."
)

ANOTHER_TELLS = (
    "What the samples on {} mean is said on {} by another plant, {}, whose own samples are on {}: see remappings and "
    "namespaces. The motor gets 0 V until then."
)


class Neighbours:
    """Whoever has to do with this node's topics."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._speed, self._info, self._voltage = map(node.resolve_topic_name, (SPEED, INFO, VOLTAGE))

    def missing(self) -> str:
        """Say who is missing; "" if nobody is."""
        if not count_publishers(self._node, SPEED):
            there = published_topics(self._node, kind_of(MotorSpeed))
            return NO_PLANT.format(self._speed, ELSEWHERE.format(" and ".join(there)) if there else "")
        if not count_publishers(self._node, INFO):
            there = published_topics(self._node, kind_of(MotorInfo))
            named = INFO_ELSEWHERE.format(" and ".join(there)) if there else ""
            return NO_INFO.format(self._info, self._speed, named)
        return "" if self._node.count_subscribers(self._voltage) else NOBODY_HEARS.format(self._voltage)

    def crossed(self) -> str:
        """Say which of this node's topics are another motor's, so that nothing is to be driven; "" if none is."""
        return self.another_driven() or self.another_tells()

    def another_driven(self) -> str:
        """Say which plant would be driven by another one's samples; "" if none would, or only beside the right one.

        A simulation may well follow the voltages of a motor.
        """
        heard = {one.node for one in list_publishers(self._node, SPEED)}
        node, own = self._find_plant(self.hearers(), heard)
        return ANOTHER_DRIVEN.format(node, self._voltage, ", ".join(sorted(heard)), own) if node else ""

    def another_tells(self) -> str:
        """Say which plant tells of itself where this node wants to hear of the one whose samples it hears."""
        heard, telling = ({one.node for one in list_publishers(self._node, topic)} for topic in (SPEED, INFO))
        node, own = self._find_plant(telling, heard)
        return ANOTHER_TELLS.format(self._speed, self._info, node, own) if node else ""

    def _find_plant(self, nodes: set[str], heard: set[str]) -> tuple[str, str]:
        """Find the one of the nodes that has samples of its own, and their topic, if none of them is heard."""
        if not heard or "" in heard | nodes or heard & nodes:  # nobody, who is not known yet, or who should be
            return "", ""
        plants = ((node, topics_of_node(self._node, node, kind_of(MotorSpeed))) for node in sorted(nodes))
        return next(((node, own[0]) for node, own in plants if own), ("", ""))

    def hearers(self) -> set[str]:
        """Name the nodes that hear the motor's voltages; "" among them: of one it is not known yet."""
        return {one.node for one in list_subscribers(self._node, VOLTAGE)}
