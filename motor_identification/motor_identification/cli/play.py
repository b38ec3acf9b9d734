"""Publishes a bag's messages again, with their original spacing: `play BAG [--rate R] [--loop] [--topics …]`."""

import argparse
import sys
from typing import TYPE_CHECKING

from motor_ros.command.number_types import not_negative, positive
from motor_ros.command.parser import CommandParser
from motor_ros.command.shell import shell
from motor_ros.terminal import in_place

if TYPE_CHECKING:
    from motor_identification.bag import Contents
    from motor_identification.live.playback_schedule import Schedule

_EXAMPLE = """\
a recording beside a motor, by eye: let the motor (motor_sim with the model that identify found, or the real one) run
under the recorded voltages, give the recorded speed a name of its own, and draw both in one plot

  ros2 run motor_identification play bag --topics motor/voltage motor/speed --remap motor/speed:=recorded/motor/speed

and the recorded speed alone, from the tenth second on, as if the motor ran:

  ros2 run motor_identification play bag --start-offset 10
"""


def parser() -> argparse.ArgumentParser:
    """Make the command line's parser."""
    parser = CommandParser(
        "motor_identification",
        "play",
        "Publish the messages of a bag again, with their original spacing and QoS, as they were "
        "serialised; commands are stamped anew. A plant that listens to motor/voltage will move its motor; at the end "
        "it gets 0 V, and a controller a reference of 0.",
        _EXAMPLE,
    )
    parser.add_argument("bag", metavar="BAG", help="a rosbag2 directory or a .mcap or .db3 file")
    parser.add_argument("--rate", type=positive, default=1.0, metavar="R", help="times as fast (default: 1)")
    parser.add_argument("--loop", action="store_true", help="begin again at the end, until Ctrl-C")
    parser.add_argument(
        "--start-offset",
        type=not_negative,
        default=0.0,
        metavar="S",
        help="leave out the first S seconds; what was latched in them (such as motor/info) is published all the same",
    )
    parser.add_argument(
        "--topics",
        nargs="+",
        metavar="TOPIC",
        help="only these (default: all); motor/voltage is /bench/motor/voltage where the bag has only that",
    )
    parser.add_argument(
        "--remap", nargs="+", type=_renamed, default=[], metavar="OLD:=NEW", help="publish a topic under another name"
    )
    parser.add_argument(
        "--node-name", default="play", metavar="NAME", help="of this node; what rosbag2_player plays moves no motor"
    )
    return parser


def main(args: list[str] | None = None) -> int:
    """Entry point; returns the exit status."""
    options = parser().parse_args(args)
    return shell(lambda: _play(options))


def _renamed(text: str) -> tuple[str, str]:
    old, separator, new = text.partition(":=")
    if not (separator and old.strip("/") and new.strip("/")):
        raise argparse.ArgumentTypeError(f"'{text}' is not of the form OLD:=NEW, such as motor/speed:=recorded/speed")
    return old, new


def _play(options: argparse.Namespace) -> int:
    import rclpy

    from motor_identification.bag import absolute_name, named_topic
    from motor_identification.live.playback import Playback
    from motor_identification.live.playback_schedule import Schedule
    from motor_identification.live.publishers import Publishers
    from motor_ros.graph.open_sockets import refuse_open_sockets
    from motor_ros.run import Interrupt, start_ros

    interrupt = Interrupt()
    bag = _opened(options.bag, options.start_offset)
    there = [topic.name for topic in bag.topics if topic.message_count]
    chosen = [named_topic(name, there) for name in options.topics] if options.topics else None
    names = {named_topic(old, there): absolute_name("", new) for old, new in options.remap}
    schedule = Schedule(options.rate)
    start_ros([])
    try:
        node = rclpy.create_node(options.node_name, enable_rosout=False, start_parameter_services=False)
        refuse_open_sockets(node)
        publishers = Publishers(node, options.bag, bag, chosen, names)
        publishers.wait_for_subscribers(lambda: bool(interrupt))
        publishers.warn_of_others()
        print(f"Playing {publishers} from {options.bag}; Ctrl-C ends it.", flush=True)
        try:
            playback = Playback(options.bag, bag, publishers, schedule, options.start_offset)
            playback.run(lambda: bool(interrupt), options.loop)
        finally:
            publishers.close()
        node.destroy_node()
    finally:
        rclpy.try_shutdown()
    in_place("")
    if publishers.garbled:
        one = publishers.garbled == 1
        what = "message is not of its type and was" if one else "messages are not of their types and were"
        print(f"{publishers.garbled} {what} not played.", file=sys.stderr)
    print(_summary(options.bag, schedule))
    return 0


def _opened(uri: str, offset: float) -> "Contents":
    """What is in the bag; its metadata.yaml is written where a crash left it without."""
    from motor_identification.bag import contents, repair
    from motor_model.errors import RecordingError

    bag = contents(uri)
    if bag.cut:
        print(f"{uri} is cut off: {bag.message_count} messages, {bag.duration:.2f} s up to the cut.", file=sys.stderr)
    if bag.span and offset > bag.duration:
        raise RecordingError(f"{uri} is {bag.duration:.2f} s long: choose a --start-offset below that.")
    try:
        if repair(uri):
            print(f"{uri} had no metadata.yaml; it has been written from what is there.", file=sys.stderr)
    except RecordingError as error:  # it can be played all the same
        print(error, file=sys.stderr)
    return bag


def _summary(uri: str, schedule: "Schedule") -> str:
    if not schedule.played:
        return f"{uri}: nothing played"
    late = schedule.late_at_most(0.99) * 1e3
    messages = "message" if schedule.played == 1 else "messages"
    return f"{uri}: {schedule.played} {messages} played. Playback jitter: {late:.2f} ms (99 %)"


if __name__ == "__main__":
    sys.exit(main())
