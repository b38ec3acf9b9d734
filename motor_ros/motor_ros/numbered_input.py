"""Subscribe to a topic with the numbers that the middleware gives a publisher's messages, which tell senders apart."""

import time
from collections import deque
from collections.abc import Callable
from typing import Any, Generic, NamedTuple, TypeVar

from rclpy.node import Node
from rclpy.qos import QoSProfile

from motor_ros.clocks.hold_ups import HELD_UP, HoldUps
from motor_ros.graph.acquaintances import Verdict
from motor_ros.graph.commanders import Commanders
from motor_ros.graph.publishers import publishers_of

MessageType = TypeVar("MessageType")
NOT_COUNTED = 2**63  # numbers from here on: the middleware does not count (rmw says 2^64 - 1)
MOST_HELD = 400  # messages that wait for their sender to be known: those of 2 s at 200 Hz
NOBODY = (
    "A message on {} is not obeyed: its publisher's node was not known when it came, or has turned out to play a "
    "recording. Send it again if it was yours."
)


class Arrival(NamedTuple):
    """What is known of a message beside what it says."""

    number: int | None  # how many its publisher has sent; None: nobody counts
    waited: int  # [ns] to be taken
    at: int  # [ns] when it was taken, on a clock that is never set
    sent: int  # [ns] when it was sent, on that clock: by the sender's own, which may be off, and not long ago


Counts = Callable[[Any, Arrival], bool]


def never(message: Any, arrival: Arrival) -> bool:
    """No message counts before its sender is known."""
    return False


class NumberedInput(Generic[MessageType]):
    """Hands each message on with how it came, once those who may have sent it are known.

    They are polled: the EventsExecutor of rclpy 7.1 fails for callbacks that want to know more than the message. They
    are taken before each sample, which is when they act; no storm of messages keeps a sample waiting, for no more are
    taken at once than are kept.
    """

    def __init__(
        self,
        node: Node,
        kind: type[MessageType],
        topic: str,
        profile: QoSProfile,
        take: Callable[[MessageType, Arrival], None],
        rings: Callable[[], None] | None = None,
        hold_ups: HoldUps | None = None,
        commanders: Commanders | None = None,
        counts: Counts = never,
    ) -> None:
        """`hold_ups`: after one, messages are as old as their sender says; it may be on a computer of another time.

        `rings` is called when a message may have come: where they act at once, and not with the next sample.
        `commanders`: they have to be known first, but for a message that `counts` whoever has sent it: a stop, or the
        next one of who is known. It ends what others have sent and what waits.
        """
        self._node, self._hold_ups, self._commanders, self._counts = node, hold_ups, commanders, counts
        self._held: deque[tuple[MessageType, Arrival]] = deque(maxlen=MOST_HELD)
        self._kind, self._take, self._most = kind, take, profile.depth
        self._subscription = node.create_subscription(kind, topic, self._on_message, profile)
        node._subscriptions.remove(self._subscription)  # so that no executor takes what is to be polled
        if rings is not None:  # made later, so that it hears of a message later
            node.create_subscription(kind, topic, lambda _: rings(), profile, raw=True)

    def poll(self) -> None:
        """Take what has come, and hand on what has waited."""
        for _ in range(self._most):
            if not (taken := self._subscription.handle.take_message(self._kind, False)):
                break
            self._on_message(*taken)
        self._hand_on()

    def _on_message(self, message: MessageType, about: dict[str, Any]) -> None:
        number = about["publication_sequence_number"]
        counted = number is not None and 0 < number < NOT_COUNTED
        doubt = self._hold_ups is not None and self._hold_ups.in_doubt()
        now, at = time.time_ns(), time.monotonic_ns()
        sent = at - min(_wait_of(about, now, True), round(HELD_UP * 1e9))
        arrival = Arrival(number if counted else None, _wait_of(about, now, doubt), at, sent)
        if self._commanders is None or self._counts(message, arrival):
            self.forget()
            self._take(message, arrival)
        else:
            self._held.append((message, arrival))
            self._hand_on()

    def _hand_on(self) -> None:
        """Hand on what has waited for long enough."""
        while self._held and self._commanders is not None:
            verdict = self._commanders.judge(self._held[0][1].at)
            if verdict is Verdict.WAITS:
                return
            message, arrival = self._held.popleft()
            if verdict is Verdict.OBEYED:
                self._take(message, arrival)
            else:
                self._node.get_logger().warning(NOBODY.format(self._subscription.topic_name), throttle_duration_sec=1.0)

    def forget(self) -> None:
        """Hand nothing on of what waits: it is over."""
        self._held.clear()

    def senders(self, node: Node) -> str:
        """The nodes that can send, in words."""
        return ", ".join(publishers_of(node, self._subscription.topic_name))


def _wait_of(about: dict[str, Any], now: int, doubt: bool) -> int:
    """How long a message has waited [ns], by the clock that stamped it and may be set; 0 where nobody stamps.

    A process that has not stood still lets none wait for as long as that takes to be noticed. While it does nothing is
    received: in doubt a message is as old as it is by when it was sent.
    """
    received, sent = (max(now - (about[f"{kind}_timestamp"] or now), 0) for kind in ("received", "source"))
    return max(received, sent) if doubt else min(received, round(HELD_UP * 1e9))
