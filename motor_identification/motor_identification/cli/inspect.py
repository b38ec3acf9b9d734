"""Says what is in a bag, and writes a first mapping for `identify` and `diagnose`: `inspect BAG`."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from motor_ros.command.parser import CommandParser
from motor_ros.command.shell import shell
from motor_ros.output_files import add_force_option, check_outputs

if TYPE_CHECKING:
    from motor_identification.mapping.candidates import Candidate
    from motor_identification.mapping.inventory import TopicRow

EXAMPLES = """\
what moves in a bag that another robot recorded, and a mapping to correct by hand:
  ros2 run motor_identification inspect bag --output mapping.yaml
  ros2 run motor_identification identify bag --mapping mapping.yaml
"""
_SHOWN = 5  # pairs
_LONGEST = 400  # characters of what is wrong with a topic: it says at its end what to do
OURS_NEEDS_NONE = "{bag} was recorded from this workbench's topics: identify and diagnose read it without a mapping."


def main(args: list[str] | None = None) -> int:
    """Entry point; returns the exit status."""
    options = parser().parse_args(args)
    return shell(lambda: _inspect(options))


def parser() -> argparse.ArgumentParser:
    """Make the command line's parser."""
    made = CommandParser(
        "motor_identification",
        "inspect",
        "List the topics of a bag with their rates and the numbers that change in them, find which drives which, and "
        "write a first mapping.",
        EXAMPLES,
    )
    made.add_argument("bag", metavar="BAG", help="any bag: MCAP or sqlite3")
    made.add_argument("--output", type=Path, metavar="FILE", help="write the mapping here (YAML)")
    add_force_option(made)
    return made


def _inspect(options: argparse.Namespace) -> int:
    from motor_identification.bag.motor.cdr import SPEED_TYPE
    from motor_identification.mapping import mapping_text
    from motor_identification.mapping.candidates import find_candidates
    from motor_identification.mapping.inventory import take_inventory
    from motor_model.errors import RecordingError

    if options.output:
        check_outputs([options.output], options.force)
    topics = take_inventory(options.bag)
    said = [*_lines(topics)]
    pairs = find_candidates([field for topic in topics for field in topic.fields])
    try:  # the mapping first: who reads what is said may go at any line
        if not pairs:
            unread = ", ".join(topic.name for topic in topics if topic.trouble)
            cure = f"make {unread} readable first, as said above, or write" if unread else "write"
            raise RecordingError(
                f"{options.bag}: no number that can be read follows another as a motor's speed follows its voltage: "
                f"{cure} the mapping by hand."
            )
        said += ["", *_pairs(pairs)]
        if any(topic.type_name == SPEED_TYPE for topic in topics):
            said += ["", OURS_NEEDS_NONE.format(bag=options.bag)]
        said += ["", _write(options.output, mapping_text(pairs[0].mapping()))]
    finally:
        print(*said, sep="\n")
    return 0


def _write(output: "Path | None", text: str) -> str:
    """Write a mapping, or show what would be written; what is said of it."""
    from motor_model.errors import MotorError
    from motor_model.regular_file import say_refusal, write_text

    if output is None:
        return f"A first mapping (--output FILE writes it):\n{text.rstrip()}"
    try:
        write_text(output, text)
    except OSError as error:
        raise MotorError(f"cannot write {output} {say_refusal(error)}.") from error
    return f"mapping: {output} (check it, and let scale make volts of the command)"


def _lines(topics: "list[TopicRow]") -> list[str]:
    from motor_model.printable import escape

    lines = []
    for topic in topics:
        stamps = "stamped" if topic.stamped else f"no stamps, jitter {topic.jitter * 1e3:.3f} ms"
        rate = f"{topic.messages} messages, {topic.rate:.4g} Hz" if topic.messages != 1 else "1 message"
        about = f"{rate}, {stamps}"
        lines.append(f"{escape(topic.name)}  {escape(topic.type_name)}  ({escape(topic.trouble or about, _LONGEST)})")
        lines += [
            escape(f"  {field.path.field}  {field.values.min():.4g} to {field.values.max():.4g}")
            for field in topic.fields
        ]
    return lines


def _pairs(pairs: "list[Candidate]") -> list[str]:
    from motor_model.printable import escape

    return [
        escape(
            f"{pair.drive.path} drives {pair.motion.path}, a {pair.kind.value} "
            f"(it explains {100 * pair.share:.0f} % of the changes that its own past does not)"
        )
        for pair in pairs[:_SHOWN]
    ]
