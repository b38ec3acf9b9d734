"""Records a motor's topics into a bag: `record BAG [TOPIC…]`."""

import argparse
import sys
import time
from typing import TYPE_CHECKING

from motor_ros.command.number_types import positive
from motor_ros.command.parser import CommandParser
from motor_ros.command.shell import shell
from motor_ros.output_files import add_force_option
from motor_ros.terminal import in_place
from motor_ros.topics import TOPICS

if TYPE_CHECKING:
    from collections.abc import Mapping

    from rclpy.qos import QoSProfile

    from motor_identification.bag import BagWriter
    from motor_identification.live.recorder import Recorder


def parser() -> CommandParser:
    """Make the command line's parser."""
    names = ", ".join(topic.name for topic in TOPICS)
    parser = CommandParser(
        "motor_identification",
        "record",
        f"Record topics into a bag until Ctrl-C, by default {names}. They may appear later; "
        "the bag is a rosbag2 directory with MCAP storage. What is older than half a second survives whatever happens "
        "to this program, and a bag that was cut off is read as it is.",
        "example:\n  ros2 run motor_identification record bag --duration 10",
    )
    parser.add_argument("bag", metavar="BAG", help="where the bag goes; must not exist")
    parser.add_argument("topics", metavar="TOPIC", nargs="*", help="relative names are in --topic-namespace")
    parser.add_argument("--mapping", metavar="FILE", help="the topics of another robot's motor, as `inspect` writes it")
    parser.add_argument("--all", action="store_true", help="every topic that there is or will be")
    parser.add_argument(
        "--topic-namespace", default="", metavar="NS", help="the namespace of the motor (default: none)"
    )
    parser.add_argument("--duration", type=positive, metavar="S", help="end after so many seconds")
    add_force_option(parser)
    return parser


def main(args: list[str] | None = None) -> int:
    """Entry point; returns the exit status."""
    options = parser().parse_args(args)
    if options.all and options.topics:
        parser().error("--all and TOPIC do not go together")
    if options.mapping is not None and (options.all or options.topics):
        parser().error("--mapping names the topics: it goes together neither with TOPIC nor with --all")
    return shell(lambda: _record(options))


def _record(options: argparse.Namespace) -> int:
    from motor_identification.bag import BagWriter, absolute_name
    from motor_ros.run import Interrupt

    known = {absolute_name(options.topic_namespace, topic.name): topic for topic in TOPICS}
    if options.mapping is not None:
        from motor_identification.mapping import load_mapping

        options.topics = list(load_mapping(options.mapping).topics)
    named = [absolute_name(options.topic_namespace, name) for name in options.topics]
    topics = None if options.all else named or list(known)
    expected = {name: (topic.type_name, topic.qos) for name, topic in known.items() if name in (topics or known)}
    interrupt = Interrupt()
    with BagWriter(options.bag, options.force) as writer:
        print(f"Recording {', '.join(topics or ['every topic'])} to {options.bag}; Ctrl-C ends it.", flush=True)
        try:
            notes = _listen(writer, topics, expected, interrupt, options.duration)
        finally:
            if writer.message_count == 0:
                writer.discard()
    in_place("")
    for note in notes:
        print(note, file=sys.stderr)
    if writer.message_count == 0:
        print(_nothing(topics), file=sys.stderr)
        return 1
    print(f"{options.bag}: {writer.message_count} messages, {writer.duration:.1f} s{_silent(writer, topics, options)}")
    return 0


def _listen(
    writer: "BagWriter",
    topics: list[str] | None,
    expected: "Mapping[str, tuple[str, QoSProfile]]",
    interrupt: object,
    duration: float | None,
) -> list[str]:
    """Record until the interrupt or for the duration [s]; returns notes about what could not be recorded."""
    import rclpy

    from motor_identification.live.recorder import Recorder
    from motor_ros.clocks.steady_timer import steady_timer
    from motor_ros.graph.open_sockets import refuse_open_sockets
    from motor_ros.run import spin, start_ros

    start_ros([])
    try:
        node = rclpy.create_node("record", enable_rosout=False, start_parameter_services=False)
        refuse_open_sockets(node)
        recorder = Recorder(node, writer, topics, expected)
        steady_timer(node, 1.0, lambda: in_place(_progress(writer, recorder)))
        deadline = time.monotonic() + (duration or float("inf"))
        spin(node, lambda: bool(interrupt or recorder.refusal) or time.monotonic() >= deadline)
        recorder.close()
        node.destroy_node()
        if recorder.refusal:
            raise recorder.refusal
        return recorder.notes
    finally:
        rclpy.try_shutdown()


def _progress(writer: "BagWriter", recorder: "Recorder") -> str:
    counts = ", ".join(f"{topic} {count}" for topic, count in sorted(writer.counts.items()))
    return f"{writer.duration:.0f} s: {counts}" if counts else f"waiting, {len(recorder.heard)} topics heard"


def _nothing(topics: list[str] | None) -> str:
    where = f"on {', '.join(topics)}" if topics else "on any topic"
    return (
        f"Nothing was recorded, and no bag made: no message came {where}; "
        "start a plant (ros2 run motor_sim motor_sim), and look at ROS_DOMAIN_ID and --topic-namespace."
    )


def _silent(writer: "BagWriter", topics: list[str] | None, options: argparse.Namespace) -> str:
    """What was asked for and did not come; of the default topics only the one that identification cannot do without."""
    expected = (topics or []) if options.topics else (topics or [])[:1]
    missing = [topic for topic in expected if not writer.counts[topic]]
    return f"; nothing came on {', '.join(missing)}" if missing else ""
