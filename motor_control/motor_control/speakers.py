"""Know who publishes motor/speed: by name for sentences, and whether a silence has ended with another publisher.

And know who plays a recording with `ros2 bag play`: nothing that it asks for is obeyed.

And know when somebody who may ask for a motion was last seen to be there for the first time: who has been sending since
before the controller is heard soon after that.

A driver that is started again quickly goes on with the board's own clock and counts, so that its samples look as if one
driver had been held up for a moment. What was asked for before is then answered again, from 0 V on, and the stop that
the driver before had latched were over without anybody's word.
"""

from dataclasses import replace

from rclpy.node import Node

from motor_control.controller.controller import State, meet_other_plant
from motor_control.controller.state import RESTARTED, introduce, meet_players
from motor_ros.topics import NAMED_WITHIN, players_of, publisher_ids, publishers_of

TOPIC = "motor/speed"
DEMANDS = "motor/reference", "motor/position_reference", "motor/joint_command"


class Speakers:
    """The publishers of samples, as the controller's node knows them."""

    def __init__(self, node: Node) -> None:
        self._node, self._count, self._demanders = node, 0, -1
        self._named = 0.0  # [s] when all who may ask for a motion have names
        self._ids: frozenset[tuple[int, ...]] = frozenset()  # when samples last began

    def name(self, state: State) -> State:
        """Note their names, where their number has changed."""
        if (count := self._node.count_publishers(TOPIC)) == self._count:
            return state
        self._count = count
        return replace(state, speakers=f"({', '.join(publishers_of(self._node, TOPIC))})")

    def introduce(self, state: State, now: float) -> State:
        """Note that there are more who may ask for a motion; at first, that nobody has been seen for long."""
        before, self._demanders = self._demanders, sum(map(self._node.count_publishers, DEMANDS))
        if self._demanders == before:
            return state
        self._named = now + NAMED_WITHIN
        return self.look_for_players(introduce(state, now) if self._demanders > before else state, now)

    def look_for_players(self, state: State, now: float) -> State:
        """Look for those who play recordings; a publisher's node may be named a little later than the publisher."""
        return meet_players(state, players_of(self._node, *DEMANDS)) if now <= self._named else state

    def meet(self, state: State) -> State:
        """Forget what was asked for where samples begin again and a publisher is there that was not before."""
        before, self._ids = self._ids, publisher_ids(self._node, TOPIC)
        return meet_other_plant(state, RESTARTED) if before and self._ids - before else state
