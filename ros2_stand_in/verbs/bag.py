"""`ros2 bag`: the workbench's own executables record and play, its library repairs; `info` reads the metadata."""

import argparse
import datetime
from pathlib import Path
from typing import Any

from motor_model import yaml_file
from motor_model.errors import MotorError
from ros2_stand_in.arguments import not_negative, positive
from ros2_stand_in.interfaces import packages
from ros2_stand_in.verbs.run import become

_PACKAGE = "motor_identification"
_SIZES = ("B", "KiB", "MiB", "GiB", "TiB")
_INDENT = " " * 19


def record_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 bag record` takes."""
    parser.add_argument("topics_positional", nargs="*", metavar="TOPIC", help="topics to record")
    parser.add_argument("--topics", nargs="+", default=[], metavar="TOPIC", help="topics to record")
    parser.add_argument("-o", "--output", help="bag to write (default: rosbag2_ and the time)")
    parser.add_argument("-a", "--all", "--all-topics", action="store_true", help="record all topics")
    parser.add_argument("-s", "--storage", choices=["mcap"], default="mcap", help="storage; here always mcap")


def record(args: argparse.Namespace) -> int:
    """Become the workbench's recorder."""
    topics = args.topics_positional + args.topics
    if not topics and not args.all:
        raise MotorError("Say what to record: topics, such as /motor/speed, or --all.")
    output = args.output or datetime.datetime.now().strftime("rosbag2_%Y_%m_%d-%H_%M_%S")
    become([str(packages.executable(_PACKAGE, "record")), output, *(["--all"] if args.all else topics)])


def play_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 bag play` takes."""
    parser.add_argument("bag_path", help="bag to play")
    parser.add_argument("-r", "--rate", type=positive, default=1.0, help="how fast, as a multiple of real time")
    parser.add_argument("-l", "--loop", action="store_true", help="start again at the end")
    parser.add_argument("--topics", nargs="+", default=[], metavar="TOPIC", help="play these topics only")
    parser.add_argument("--start-offset", type=not_negative, default=0.0, help="leave out so many seconds")
    parser.add_argument(
        "-m", "--remap", nargs="+", default=[], metavar="OLD:=NEW", help="publish topics under other names"
    )


def play(args: argparse.Namespace) -> int:
    """Become the workbench's player."""
    command = [str(packages.executable(_PACKAGE, "play")), args.bag_path, "--rate", str(args.rate)]
    command += ["--node-name", "rosbag2_player"]  # as the genuine one, which moves no motor
    optional = {"--topics": args.topics, "--remap": args.remap}
    optional["--start-offset"] = [str(args.start_offset)] if args.start_offset else []
    words = [word for option, values in optional.items() if values for word in (option, *values)]
    become([*command, *(["--loop"] if args.loop else []), *words])


def reindex_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 bag reindex` takes."""
    parser.add_argument("bag_path", type=Path, help="bag, which is a directory")
    parser.add_argument("-s", "--storage", choices=["mcap", "sqlite3"], help="storage (default: by the files' names)")


def reindex(args: argparse.Namespace) -> int:
    """Write the metadata.yaml that a crash left unwritten."""
    from motor_identification.bag import repair  # NumPy takes a while, which no other verb has to wait for

    if not args.bag_path.is_dir():
        raise MotorError("Must specify a bag directory")
    done = repair(args.bag_path)
    print(f"{args.bag_path}: metadata.yaml {'written' if done else 'needs no repair, or cannot have one'}.")
    return 0


def info_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 bag info` takes."""
    parser.add_argument("bag_path", type=Path, help="bag, which is a directory")
    parser.add_argument("-t", "--topic-name", action="store_true", help="print the names of the topics only")


def info(args: argparse.Namespace) -> int:
    """Print files, size, times, messages and topics of a bag."""
    metadata = _metadata(args.bag_path)
    try:
        topics = metadata["topics_with_message_count"]
        if args.topic_name:
            text = "\n".join(topic["topic_metadata"]["name"] for topic in topics)
        else:
            text = _summary(args.bag_path, metadata, [_topic_line(topic) for topic in topics])
    except (KeyError, TypeError, ValueError, AttributeError, OverflowError, OSError) as error:
        raise MotorError(f"{args.bag_path}/metadata.yaml is not as rosbag2 writes it ({error!r}).") from error
    print(text)
    return 0


def _metadata(bag: Path) -> dict[str, Any]:
    file = bag / "metadata.yaml"
    if not bag.exists():
        raise MotorError(f"Bag path '{bag}' does not exist!")
    if not file.is_file():
        raise MotorError(
            f"{bag} has no metadata.yaml: it is not a bag, or was cut off; then `ros2 bag reindex {bag}` helps."
        )
    try:
        metadata: dict[str, Any] = yaml_file.read(file)["rosbag2_bagfile_information"]
        return metadata
    except (OSError, MotorError, KeyError, TypeError) as error:
        raise MotorError(f"{file} is not a bag's metadata; restore it, or record again.") from error


def _summary(bag: Path, metadata: dict[str, Any], topics: list[str]) -> str:
    start = metadata["starting_time"]["nanoseconds_since_epoch"]
    duration = metadata["duration"]["nanoseconds"]
    size = sum(path.stat().st_size for path in bag.rglob("*") if path.is_file())
    separator = f"\n{_INDENT}"
    rows = {
        "Files:": separator.join(metadata["relative_file_paths"]),
        "Bag size:": _size(size),
        "Storage id:": metadata["storage_identifier"],
        "ROS Distro:": metadata.get("ros_distro") or "unknown",
        "Duration:": f"{_seconds(duration)}s",
        "Start:": _instant(start),
        "End:": _instant(start + duration),
        "Messages:": metadata["message_count"],
        "Topic information:": separator.join(topics),
        "Service:": 0,
    }
    return "\n" + "\n".join(f"{name:<19}{value}" for name, value in rows.items()) + "\nService information: "


def _topic_line(topic: dict[str, Any]) -> str:
    about = topic["topic_metadata"]
    return (
        f"Topic: {about['name']} | Type: {about['type']} | Count: {topic['message_count']} | "
        f"Serialization Format: {about['serialization_format']}"
    )


def _size(size: float) -> str:
    index = 0
    while size >= 1024.0 and index < len(_SIZES) - 1:
        size, index = size / 1024.0, index + 1
    return f"{size:.{1 if index else 0}f} {_SIZES[index]}"


def _seconds(nanoseconds: int) -> str:
    return f"{nanoseconds // 10**9}.{nanoseconds % 10**9:09d}"


def _instant(nanoseconds: int) -> str:
    local = datetime.datetime.fromtimestamp(nanoseconds // 10**9)
    return f"{local:%b %e %Y %H:%M:%S}.{nanoseconds % 10**9:09d} ({_seconds(nanoseconds)})"
