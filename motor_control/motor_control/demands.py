"""Hear what is asked for, on three topics: nothing counts before who may have sent it is known, but for a stop.

A recording asks nobody, and its commands are of another day: not those of a node that plays one, nor a joint command
whose stamp is of another time. After this process stood still, what comes may be old as well.

When somebody who may ask for a motion was last seen to be there for the first time is noted, too: who has been sending
since before the controller is heard soon after that.
"""

import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64

from motor_control.controller import controller
from motor_control.controller.controller import Config, State
from motor_control.controller.reference.demand import Demand, Kind, Source
from motor_control.controller.state import EARLIER, introduce, meet_players
from motor_control.messages import joint_demand_of
from motor_ros import qos
from motor_ros.clocks.hold_ups import HELD_UP, STOOD_STILL, HoldUps
from motor_ros.graph.commanders import Commanders
from motor_ros.graph.publishers import publishers_of
from motor_ros.messages import stamp_age
from motor_ros.numbered_input import Arrival, Counts, NumberedInput, never

TOPICS = "motor/reference", "motor/position_reference", "motor/joint_command"
AT_ONCE = 1_000_000  # [ns] within which of two messages of two clock readings either may be the earlier
OLD = (
    "The stamp of motor/joint_command is {:.3g} s {}, as in a recording that is played: set both computers' clocks, or "
    "leave the stamp empty."
)

LEFT = (
    "Whoever sent references has ended, and the motor goes on at the last of them, {:.4g} rad/s: send 0, call "
    "motor/release, or set reference_timeout."
)


class Demands:
    """The topics on which a motion is asked for."""

    def __init__(self, node: Node, config: Config) -> None:
        self._node, self._config, self._state = node, config, State()
        self._resolved = [node.resolve_topic_name(topic) for topic in TOPICS]  # only so they are counted where renamed
        self._count, self._zeroed = -1, 0  # of those who may ask; when the latest 0 was sent [ns]
        self._commanders = Commanders(node, *TOPICS)
        self._hold_ups = HoldUps(node)
        refer, approach = partial(self._refer, Kind.SPEED), partial(self._refer, Kind.POSITION)
        self._inputs: tuple[NumberedInput[Any], ...] = (
            self._input(Float64, TOPICS[0], refer, lambda one, _: one.data == 0.0),
            self._input(Float64, TOPICS[1], approach),
            self._input(JointState, TOPICS[2], self._command_joint, lambda one, _: self._stops_joint(one)),
        )

    def poll(self, config: Config, state: State) -> State:
        """Take what has come."""
        self._config, self._state = config, self._introduce(state, time.monotonic())
        if self._commanders.players != state.players:
            self._state = meet_players(self._state, self._commanders.players)
        for one in self._inputs:
            one.poll()
        return self._state

    def look(self, state: State) -> State:
        """Note who publishes motor/joint_command, where they are several."""
        several = self._node.count_publishers(self._resolved[2]) > 1
        if several == bool(state.joint_senders):
            return state
        names = ", ".join(publishers_of(self._node, TOPICS[2]))
        return replace(state, joint_senders=f"({names})" if several else "")

    def left(self, config: Config, state: State) -> str:
        """Say that the motor goes on at the last of a stream of references, whose sender is gone; "" if it does not.

        A single reference is meant to hold when the command that sent it has ended; one of a joystick is not.
        """
        demand = state.demand
        if demand is None or demand.source is not Source.REFERENCE or demand.kind is not Kind.SPEED:
            return ""
        holds = demand.value != 0.0 and config.reference_timeout == 0.0 and state.references.streams
        there = sum(map(self._node.count_publishers, self._resolved[:2]))
        return LEFT.format(demand.value) if holds and not there else ""

    def _input(
        self, kind: type, topic: str, take: Callable[[Any, Arrival], None], counts: Counts = never
    ) -> NumberedInput[Any]:
        what = self._node, kind, topic, qos.COMMANDS, take
        return NumberedInput(*what, hold_ups=self._hold_ups, commanders=self._commanders, counts=counts)

    def _introduce(self, state: State, now: float) -> State:
        """Note that there are more who may ask for a motion; at first, that nobody has been seen for long."""
        before, self._count = self._count, sum(map(self._node.count_publishers, self._resolved))
        return introduce(state, now) if self._count > before else state

    def _refer(self, kind: Kind, message: Float64, arrival: Arrival) -> None:
        at, asks = arrival.at * 1e-9, kind is Kind.POSITION or message.data != 0.0
        late = STOOD_STILL if self._hold_ups.bars(arrival.waited) else EARLIER if self._is_over(arrival) else ""
        if asks and late:
            self._state = controller.doubt(self._state, late, at, kind, arrival.number)
        else:
            self._state = controller.refer(self._state, message.data, at, kind, arrival.number)
        if not asks:
            self._zeroed = max(self._zeroed, arrival.sent)
            for one in self._inputs:  # a 0 ends what waits on the other topics, too
                one.forget()

    def _is_over(self, arrival: Arrival) -> bool:
        """Whether the motor was stopped, released or sent a 0 after a message was sent that comes after that."""
        return arrival.sent < max(self._state.halted * 1e9, self._zeroed - AT_ONCE)

    def _stops_joint(self, message: JointState) -> bool:
        demand = joint_demand_of(message, self._config)
        return isinstance(demand, str) or (demand is not None and demand.value == 0.0)

    def _command_joint(self, message: JointState, arrival: Arrival) -> None:
        demand = joint_demand_of(message, self._config)
        if isinstance(demand, Demand) and demand.value != 0.0:
            age = stamp_age(message.header.stamp, self._node.get_clock().now().nanoseconds)
            if abs(age) > max(HELD_UP, self._config.joint_timeout):
                demand = OLD.format(abs(age), "old" if age > 0.0 else "ahead")
            elif self._hold_ups.bars(arrival.waited):
                demand = STOOD_STILL
            elif self._is_over(arrival):
                demand = EARLIER
        if demand is not None:
            at = arrival.at * 1e-9
            self._state = controller.command_joint(self._config, self._state, demand, at, arrival.number)
