"""Notice that somebody else publishes a plant's samples: a second plant, or a recording that is played.

Whose voltages are on motor/voltage then? Those of a recording are of another day, and those that answer samples of
another plant are not meant for this one. A publisher that has died is listed for a while, so that only samples count:
they are heard while there is more than one publisher, and are another's where this plant has not sent them. But one
that comes while this plant runs has not died: it is another's before it has said anything. A recording may begin with
references or voltages, and only then have samples.

A sample is this plant's once for each time that it was sent. Its stamp alone is not enough: ROS time may stand still
(`use_sim_time` without a /clock), and then all samples of all plants have the same one.
"""

import struct
import time
from collections import deque

from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.subscription import Subscription

from motor_msgs.msg import MotorSpeed
from motor_ros import qos
from motor_ros.clocks.steady_timer import steady_timer
from motor_ros.graph.publishers import Id, publisher_ids, publishers_of

RCLError = rclpy_implementation.RCLError
LOOK_EVERY = 0.05  # [s] all that has come is looked at then: an executor would take as long for it as for the sampling
REMEMBERED = 4096  # samples of our own that were not heard yet: no busy computer hears one so late
SILENT = 500_000_000  # [ns] after another's latest sample, from which on it is gone

ANOTHER = (
    "Another node publishes {} too ({}), a second plant or a recording that is played: the motor gets 0 V until that "
    "has ended, and then until 0 V is sent, or motor/enable is called with data: true."
)

DENIED = (
    "This node may not subscribe to {}, and does not notice a second plant there: make keys of the present policy.xml "
    "(docs/security.md)."
)

STAMP = {0: struct.Struct(">iI"), 1: struct.Struct("<iI")}  # by the second byte: how the header's stamp is serialised
BEFORE = 4  # bytes before it

Stamp = tuple[int, int]  # of a sample, in ROS time: seconds, nanoseconds


def read_stamp(data: bytes) -> Stamp | None:
    """Read the stamp of a serialised sample; None of one that is too short to have any, which is not ours."""
    if len(data) < BEFORE + STAMP[0].size:
        return None
    seconds, nanoseconds = STAMP[data[1] & 1].unpack_from(data, BEFORE)
    return seconds, nanoseconds


class OtherPlant:
    """Listens to the topic of this plant's samples while somebody else is there to publish them."""

    def __init__(self, node: Node, publisher: Publisher) -> None:
        self._node, self._topic = node, publisher.topic_name
        self._ours: deque[Stamp] = deque(maxlen=REMEMBERED)  # sent since this plant listens, and not heard yet
        self._heard: int | None = None  # [ns] another's latest sample
        self._count = 0  # of publishers
        self._ids: frozenset[Id] = frozenset()  # at the first look ours, and what was there before
        self._unheard: frozenset[Id] = frozenset()  # those that came, and have said nothing yet
        self._subscription: Subscription | None = None
        self._may_listen = True
        steady_timer(node, LOOK_EVERY, self._look)

    def sent(self, message: MotorSpeed) -> None:
        """Take a sample of our own, before it is published."""
        if self._subscription is not None:
            self._ours.append((message.header.stamp.sec, message.header.stamp.nanosec))

    def speaks(self, now: int) -> bool:
        """Whether another plant's samples were heard just before `now` [ns], or are to be expected."""
        return bool(self._unheard) or (self._heard is not None and now - self._heard <= SILENT)

    def problem(self, now: int) -> str:
        """What is wrong at `now` [ns], as a sentence; empty if nothing is."""
        if not self.speaks(now):
            return ""
        return ANOTHER.format(self._topic, ", ".join(publishers_of(self._node, self._topic)))

    def _look(self) -> None:
        if (count := self._node.count_publishers(self._topic)) != self._count:
            self._count = count
            self._meet(publisher_ids(self._node, self._topic), time.monotonic_ns())
        several = count > 1
        if several and self._subscription is None and self._may_listen:
            self._listen()
        elif not several and self._subscription is not None:
            self._subscription.destroy()
            self._subscription = None
        while self._subscription and (taken := self._subscription.handle.take_message(MotorSpeed, True)):
            self._hear(taken[0])

    def _meet(self, ids: frozenset[Id], now: int) -> None:
        new = ids - self._ids if self._ids else frozenset()
        spoke, self._ids, self._unheard = self.speaks(now), ids, (self._unheard | new) & ids
        if new and not spoke:
            self._node.get_logger().error(self.problem(now))

    def _listen(self) -> None:
        self._ours.clear()
        try:
            self._subscription = self._node.create_subscription(
                MotorSpeed, self._topic, lambda message: None, qos.SPEED, raw=True
            )
            self._node._subscriptions.remove(self._subscription)  # so that no executor takes what is to be polled
        except RCLError:  # keys that were made before a plant was to listen
            self._may_listen = False
            self._node.get_logger().warning(DENIED.format(self._topic))

    def _hear(self, data: bytes) -> None:
        stamp = read_stamp(data)
        if stamp is not None and stamp in self._ours:
            self._ours.remove(stamp)
            return
        now = time.monotonic_ns()
        spoke, self._heard, self._unheard = self.speaks(now), now, frozenset()
        if not spoke:
            self._node.get_logger().error(self.problem(now))
