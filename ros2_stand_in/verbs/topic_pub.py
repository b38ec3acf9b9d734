"""`ros2 topic pub`: publishes a message once, some times, or at a rate."""

import argparse
import itertools
import time
from typing import Any

from rclpy.duration import Duration
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile

from motor_model.errors import MotorError
from ros2_stand_in.arguments import count, positive
from ros2_stand_in.graph import discovery, qos
from ros2_stand_in.graph.session import Session, session
from ros2_stand_in.interfaces import interface_type, values

_LONGEST_MATCH = 1.0  # [s] between known and matched; one whose QoS does not fit never is
_LONGEST_DELIVERY = discovery.ANNOUNCEMENT_PERIOD + 1.0  # [s] a subscriber that started just now may not know us yet


def publish_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 topic pub` takes."""
    parser.add_argument("topic_name", help="name of the topic")
    parser.add_argument("message_type", help="type, such as std_msgs/msg/Float64")
    parser.add_argument("values", nargs="?", default="{}", help="fields in YAML, such as '{data: 100.0}'")
    parser.add_argument("-r", "--rate", type=positive, default=1.0, metavar="N", help="messages a second (default: 1)")
    how_many = parser.add_mutually_exclusive_group()
    how_many.add_argument("-1", "--once", action="store_true", help="publish one message, when someone subscribes")
    how_many.add_argument("-t", "--times", type=count, default=0, metavar="N", help="publish N messages")
    parser.add_argument("-w", "--wait-matching-subscriptions", type=count, metavar="N", dest="wait",
                        help="wait for N subscriptions (default: 1 with --once and --times, otherwise 0)")  # fmt: skip
    parser.add_argument("--max-wait-time-secs", type=positive, metavar="N", help="give up waiting after N seconds")
    parser.add_argument("--keep-alive", type=positive, default=0.1, metavar="N", help="stay N seconds after the last")
    parser.add_argument("-p", "--print", type=int, default=1, metavar="N", help="print every N-th message (default: 1)")
    parser.add_argument("-n", "--node-name", help="name of the publishing node")
    qos.qos_arguments(parser, "default")
    discovery.discovery_arguments(parser)


def publish(args: argparse.Namespace) -> int:
    """Publish and say so; with a number of messages, only return when they have arrived."""
    message = interface_type.load(args.message_type, "msg")()
    stamps = values.fill(message, values.parse(args.values))
    times = 1 if args.once else args.times
    name = discovery.full_name(args.topic_name)
    with session(discovery.full_name(args.node_name)[1:] if args.node_name else None) as ros:
        publisher = ros.node.create_publisher(type(message), name, _profile(args, times))
        wanted = args.wait if args.wait is not None else min(times, 1)
        _wait_for_subscriptions(ros, publisher, wanted, args.max_wait_time_secs or float("inf"))
        if times and args.wait is None:
            _wait_for_all_known(ros, publisher, name)
        print("publisher: beginning loop")
        _loop(ros, publisher, message, stamps, times, args)
        ros.pause(args.keep_alive)
    return 0


def _loop(
    ros: Session, publisher: Publisher, message: Any, stamps: list[values.Setter], times: int, args: argparse.Namespace
) -> None:
    heard = times > 0
    due = time.monotonic()
    for number in itertools.count(1):
        ros.pause(due - time.monotonic())
        now = ros.node.get_clock().now().to_msg()
        for stamp in stamps:
            stamp(now)
        publisher.publish(message)
        if args.print and number % args.print == 0:
            print(f"publishing #{number}: {message!r}\n")
        heard = heard and _wait_for_delivery(ros, publisher)
        due += 1.0 / args.rate
        if number == times:
            return


def _profile(args: argparse.Namespace, times: int) -> QoSProfile:
    profile = qos.profile(args)
    if times and args.qos_depth is None:
        profile.depth = 1  # with a full history Fast DDS asks for acknowledgement at once, otherwise every 3 s
    return profile


def _wait_for_subscriptions(ros: Session, publisher: Publisher, wanted: int, longest: float) -> None:
    end = time.monotonic() + longest
    while publisher.get_subscription_count() < wanted:
        print(f"Waiting for at least {wanted} matching subscription(s)...")
        left = min(1.0, end - time.monotonic())
        if left <= 0.0:
            have = publisher.get_subscription_count()
            raise MotorError(f"Nobody to publish to after {longest:g} s: {have} of {wanted} matching subscriptions.")
        ros.spin(lambda: publisher.get_subscription_count() >= wanted, left, look_every=0.02)


def _wait_for_all_known(ros: Session, publisher: Publisher, name: str) -> None:
    """With one message, whoever listens already shall get it, and not only who was found first."""
    discovery.settle(ros)
    ros.spin(lambda: publisher.get_subscription_count() >= ros.node.count_subscribers(name), _LONGEST_MATCH, 0.02)


def _wait_for_delivery(ros: Session, publisher: Publisher) -> bool:
    """Whether all reliable subscribers have acknowledged everything; for best-effort ones there is nothing to wait."""
    return ros.spin(lambda: publisher.wait_for_all_acked(Duration(nanoseconds=20_000_000)), _LONGEST_DELIVERY)
