"""Know who publishes motor/speed: by name for sentences, and whether a silence has ended with another publisher.

A driver that is started again quickly goes on with the board's own clock and counts, so that its samples look as if one
driver had been held up for a moment. What was asked for before is then answered again, from 0 V on, and the stop that
the driver before had latched were over without anybody's word.
"""

from dataclasses import replace

from rclpy.node import Node

from motor_control.controller.controller import State, meet_other_plant
from motor_control.controller.state import RESTARTED
from motor_ros.graph.publishers import NAMELESS, publisher_ids, publishers_of

TOPIC = "motor/speed"


class Speakers:
    """The publishers of samples, as the controller's node knows them."""

    def __init__(self, node: Node) -> None:
        self._node, self._count = node, 0
        self._resolved = node.resolve_topic_name(TOPIC)  # only so it is counted where it is renamed
        self._ids: frozenset[tuple[int, ...]] = frozenset()  # when samples last began

    def name(self, state: State) -> State:
        """Note their names, where their number has changed, or one had none yet."""
        count = self._node.count_publishers(self._resolved)
        if count == self._count and NAMELESS not in state.speakers:
            return state
        self._count = count
        return replace(state, speakers=f"({', '.join(publishers_of(self._node, TOPIC))})")

    def meet(self, state: State) -> State:
        """Forget what was asked for where samples begin again and a publisher is there that was not before."""
        before, self._ids = self._ids, publisher_ids(self._node, TOPIC)
        return meet_other_plant(state, RESTARTED) if before and self._ids - before else state
