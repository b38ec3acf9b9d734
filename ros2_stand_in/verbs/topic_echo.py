"""`ros2 topic echo`: prints what comes on a topic."""

import argparse
import time
from typing import Any

from rclpy.qos import DurabilityPolicy, QoSProfile

from motor_model.errors import MotorError
from ros2_stand_in.arguments import count, positive
from ros2_stand_in.graph import discovery, qos
from ros2_stand_in.graph.session import Session, session
from ros2_stand_in.interfaces import rendering
from ros2_stand_in.verbs.topic import message_type

_PRESET = "sensor_data"
_LOOK_EVERY = 0.2  # [s] for publishers that have come


def echo_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 topic echo` takes."""
    parser.add_argument("topic_name", help="name of the topic")
    parser.add_argument("message_type", nargs="?", help="its type, such as std_msgs/msg/Float64; found out without one")
    parser.add_argument("--once", action="store_true", help="end after the first message")
    parser.add_argument("--timeout", type=positive, metavar="N", default=float("inf"), help="end after N seconds")
    parser.add_argument("--field", help="print one field only; 'pose.position' is a field of a field")
    parser.add_argument("--csv", action="store_true", help="print each message in one line, values between commas")
    parser.add_argument("--flow-style", action="store_true", help="print arrays and messages in one line")
    parser.add_argument("-f", "--full-length", action="store_true", help="do not cut long arrays and texts")
    parser.add_argument("-l", "--truncate-length", type=count, default=rendering.DEFAULT_LENGTH, metavar="N",
                        help="cut arrays and texts after N elements (default: %(default)s)")  # fmt: skip
    qos.qos_arguments(parser, _PRESET)
    discovery.discovery_arguments(parser)


def echo(args: argparse.Namespace) -> int:
    """Print messages until Ctrl-C, or the first one only."""
    name = discovery.full_name(args.topic_name)
    with session() as ros:
        discovery.settle(ros, args.spin_time, lambda: ros.node.count_publishers(name))
        listener = _Listener(ros, name, message_type(ros, name, args.message_type), args)
        ros.spin(listener.done, args.timeout)
    return 0


class _Listener:
    """A subscription that fits the publishers, those too that are found later."""

    def __init__(self, ros: Session, name: str, kind: Any, args: argparse.Namespace) -> None:
        self._node, self._name, self._kind, self._args = ros.node, name, kind, args
        self._fixed = qos.asked_for(args)
        self._received = 0
        self._look_at = 0.0  # [s] of the monotonic clock
        self._profile = self._fitting()
        self._subscription = self._subscribe()

    def done(self) -> bool:
        """Whether everything that was asked for is printed."""
        if time.monotonic() >= self._look_at:
            self._refit()
        return bool(self._args.once and self._received)

    def _refit(self) -> None:
        self._look_at = time.monotonic() + _LOOK_EVERY
        profile = self._fitting()
        # To ask for the past again would print it twice; to ask for less never does.
        past_again = self._received and profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
        if profile != self._profile and not past_again:
            self._node.destroy_subscription(self._subscription)
            self._profile = profile
            self._subscription = self._subscribe()

    def _fitting(self) -> QoSProfile:
        return self._fixed or qos.fitting(self._node.get_publishers_info_by_topic(self._name), _PRESET)

    def _subscribe(self) -> Any:
        return self._node.create_subscription(self._kind, self._name, self._on_message, self._profile)

    def _on_message(self, message: Any) -> None:
        if not (self._args.once and self._received):
            print(_text(message, self._args))
        self._received += 1


def _text(message: Any, args: argparse.Namespace) -> str:
    longest = None if args.full_length else args.truncate_length
    value = _field(message, args.field)
    if not rendering.is_message(value):
        return f"{value}\n---"
    if args.csv:
        return rendering.to_csv(value, longest)
    return rendering.to_yaml(value, longest, args.flow_style) + "---"


def _field(message: Any, path: str | None) -> Any:
    value = message
    for name in path.split(".") if path else ():
        fields = value.get_fields_and_field_types() if rendering.is_message(value) else {}
        if name not in fields:
            have = f"there is: {', '.join(fields)}" if fields else "that is not a message"
            raise MotorError(f"Invalid field '{path}': there is no '{name}'; {have}.")
        value = getattr(value, name)
    return value
