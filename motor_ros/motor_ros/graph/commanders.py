"""Look for those who may command a motor on a node's topics: nobody is obeyed before he is known."""

import time

from rclpy.node import Node

from motor_ros.clocks.steady_timer import steady_timer
from motor_ros.graph.acquaintances import Acquaintances, Verdict
from motor_ros.graph.players import find_players_among
from motor_ros.graph.publishers import list_publishers

LOOK_EVERY = 0.05  # [s]
RECENT = 5_000_000  # [ns] a look that is older does not tell who has sent what comes now


class Commanders:
    """Those who publish some topics."""

    def __init__(self, node: Node, *topics: str) -> None:
        self._node, self._topics = node, topics
        self._resolved = [node.resolve_topic_name(topic) for topic in topics]
        self._acquaintances = Acquaintances()
        self._looked, self._count = 0, -1
        steady_timer(node, LOOK_EVERY, self._look)

    @property
    def players(self) -> str:
        """The nodes that play recordings of these topics; empty if none does."""
        return self._acquaintances.players

    def judge(self, at: int) -> Verdict:
        """Judge a message on one of the topics that came at `at` [ns]."""
        now = time.monotonic_ns()
        if now - self._looked > RECENT or sum(map(self._node.count_publishers, self._resolved)) != self._count:
            self._look()
        return self._acquaintances.judge(at, now)

    def _look(self) -> None:
        begun = time.monotonic_ns()
        there = [one for topic in self._topics for one in list_publishers(self._node, topic)]
        now = self._looked = time.monotonic_ns()
        self._count = len(there)
        met = self._acquaintances.look(there, set(), now)
        players = find_players_among(self._node, there) if met.watches(now) or self.players else set()
        self._acquaintances = self._acquaintances.look(there, players, now, begun)
