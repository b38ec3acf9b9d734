"""Publishes a bag's messages again, with their original spacing: `play BAG [--rate R] [--loop] [--topics …]`."""

import argparse
import sys
import time
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from motor_ros.command import CommandParser, in_place, not_negative, positive, shell

ANNOUNCED_GAP = 10.0  # [s] who sees nothing happen that long asks why
LONGEST_GAP = 30 * 86400.0  # [s] no bag of a motor pauses for a month; garbled log times lie centuries off

if TYPE_CHECKING:
    from motor_identification.bag import Contents
    from motor_identification.live.playback_schedule import Schedule
    from motor_identification.live.publishers import Publishers

_EXAMPLE = """\
a recording beside a motor, by eye: let the motor (motor_sim with the model that identify found, or the real one) run
under the recorded voltages, give the recorded speed a name of its own, and draw both in one plot

  play BAG --topics motor/voltage motor/speed --remap motor/speed:=recorded/motor/speed

and the recorded speed alone, from the tenth second on, as if the motor ran:  play BAG --start-offset 10
"""


def parser() -> argparse.ArgumentParser:
    """The command line."""
    parser = CommandParser(
        "motor_identification",
        "play",
        "Publish the messages of a bag again, with their original spacing and QoS, as they were "
        "serialised. A plant that listens to motor/voltage will move its motor; at the end it gets 0 V.",
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
    from motor_identification.live.playback_schedule import Schedule
    from motor_identification.live.publishers import Publishers
    from motor_ros.run import Interrupt, start_ros

    interrupt = Interrupt()
    bag = _opened(options.bag, options.start_offset)
    there = [topic.name for topic in bag.topics if topic.message_count]
    chosen = [named_topic(name, there) for name in options.topics] if options.topics else None
    names = {named_topic(old, there): absolute_name("", new) for old, new in options.remap}
    schedule = Schedule(options.rate)
    start_ros([])
    try:
        node = rclpy.create_node("play", enable_rosout=False, start_parameter_services=False)
        publishers = Publishers(node, options.bag, bag, chosen, names)
        publishers.wait_for_subscribers(lambda: bool(interrupt))
        publishers.warn_of_others()
        print(f"Playing {publishers} from {options.bag}; Ctrl-C ends it.", flush=True)
        try:
            _publish(options, bag, publishers, schedule, lambda: bool(interrupt))
        finally:
            publishers.close()
        node.destroy_node()
    finally:
        rclpy.try_shutdown()
    in_place("")
    if publishers.garbled:
        print(f"{publishers.garbled} messages are not of their types and were not played.", file=sys.stderr)
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


def _publish(
    options: argparse.Namespace,
    bag: "Contents",
    publishers: "Publishers",
    schedule: "Schedule",
    interrupted: Callable[[], bool],
) -> None:
    start = (bag.span.first if bag.span else 0) + round(options.start_offset * 1e9)
    for topic, data in _latched_before(start, options, bag, publishers):
        publishers.publish(topic, data)
    shown = time.monotonic()
    damage: set[str] = set()
    going = True
    while going:
        begun = False
        for topic, log_time, data in _from(start, options.bag, publishers, damage):
            if not begun:
                schedule.begin(log_time)
                begun = True
            _check_gap(options.bag, schedule.gap(log_time))
            if not schedule.wait(log_time, interrupted):
                return
            publishers.publish(topic, data)
            if time.monotonic() - shown >= 1.0:
                shown = time.monotonic()
                in_place(f"{schedule.elapsed(log_time):.0f} of {bag.duration:.0f} s, {schedule.played} messages")
        going = options.loop and begun


def _check_gap(uri: str, gap: float) -> None:
    """Announce a long pause [s], and refuse one that no recording has.

    Raises:
        RecordingError: a garbled log time, which would have us wait for ever.
    """
    from motor_model.errors import RecordingError

    if gap > LONGEST_GAP:
        days = gap / 86400.0
        raise RecordingError(f"{uri}: the next message is {days:.0f} days later, so its log time is damaged: end here.")
    if gap > ANNOUNCED_GAP:
        in_place("")
        print(f"{uri}: the next message comes {gap:.0f} s later.", file=sys.stderr)


def _from(start: int, uri: str, wanted: "Publishers", damage: set[str]) -> Iterator[tuple[str, int, bytes]]:
    """Topic, log time and data of the wanted messages from a log time on, in the order of time; damage is said once."""
    from motor_identification.bag import in_time_order, messages

    def tell(sentence: str) -> None:
        if sentence not in damage:
            in_place("")
            print(sentence, file=sys.stderr)
        damage.add(sentence)

    for topic, _, log_time, data in in_time_order(messages(uri, wanted, tell), uri):
        if log_time >= start:
            yield topic, log_time, data


def _latched_before(
    start: int, options: argparse.Namespace, bag: "Contents", wanted: "Publishers"
) -> Iterator[tuple[str, bytes]]:
    """The latest message before a log time on each topic whose publisher kept it for those who came later."""
    from motor_identification.bag import messages

    if options.start_offset == 0.0:
        return
    latched = {
        topic.name
        for topic in bag.topics
        if topic.name in wanted and any(profile.durability == "transient_local" for profile in topic.qos)
    }
    before = {topic: data for topic, _, log_time, data in messages(options.bag, latched) if log_time < start}
    yield from before.items()


def _summary(uri: str, schedule: "Schedule") -> str:
    if not schedule.played:
        return f"{uri}: nothing played"
    late = schedule.late_at_most(0.99) * 1e3
    return f"{uri}: {schedule.played} messages played. Playback jitter: {late:.2f} ms (99 %)"


if __name__ == "__main__":
    sys.exit(main())
