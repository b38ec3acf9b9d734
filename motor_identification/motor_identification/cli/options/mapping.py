"""The options of the commands that read bags of any robot, and the source that they make."""

import argparse
from dataclasses import replace
from typing import TYPE_CHECKING

from motor_model.errors import RecordingError

if TYPE_CHECKING:
    from motor_identification.bag import Source
    from motor_identification.mapping import MappedReader, Mapping

FIELD = "TOPIC:FIELD"
KINDS = ("speed", "position", "count")


def add_mapping_options(parser: argparse.ArgumentParser) -> None:
    """Add `--mapping` and what replaces it on the command line."""
    group = parser.add_argument_group(
        "bags of another robot",
        "FIELD is a path into the messages, such as /joint_states:velocity[left_wheel] or /left/command:data; behind "
        "it may stand @UNIT and *FACTOR, such as /wheel:speed@rpm or /left/command:data*0.047 (volts). `inspect BAG` "
        "lists what there is.",
    )
    group.add_argument("--mapping", metavar="FILE", help="where voltage and motion stand (YAML)")
    motion = group.add_mutually_exclusive_group()
    for kind, unit in zip(KINDS, ("rad/s", "rad", "counts"), strict=True):
        motion.add_argument(f"--{kind}-from", metavar=FIELD, help=f"the motion is a {kind} [{unit}]")
    group.add_argument("--voltage-from", metavar=FIELD, help="the voltage that drives it [V]")
    group.add_argument("--current-from", metavar=FIELD, help="the motor's current [A]")
    group.add_argument("--counts-per-turn", type=int, metavar="N", help="of the motion, for --count-from")


def make_source(options: argparse.Namespace) -> "Source":
    """Make the source that the options describe.

    Raises:
        RecordingError: a mapping cannot be read, or is not complete.
    """
    from motor_identification.bag import Source, Window

    window = Window(options.start, options.stop)
    return Source(tuple(options.bags), options.topic_namespace, window, _reader(options))


def _reader(options: argparse.Namespace) -> "MappedReader | None":
    from motor_identification.mapping import MappedReader, load_mapping

    given = [name for name in ("voltage", "current", *KINDS) if getattr(options, f"{name}_from") is not None]
    if options.mapping is None and not given:
        return None
    mapping = load_mapping(options.mapping) if options.mapping is not None else None
    return MappedReader(_completed(mapping, options))


def _completed(mapping: "Mapping | None", options: argparse.Namespace) -> "Mapping":
    """A mapping with what the command line says instead."""
    from motor_identification.logs.count_size import MOST_EDGES
    from motor_identification.logs.form import Kind
    from motor_identification.mapping import Mapping, parse_origin

    kind = next((Kind(name) for name in KINDS if getattr(options, f"{name}_from")), None)
    motion = parse_origin(getattr(options, f"{kind.value}_from"), kind) if kind else None
    voltage = parse_origin(options.voltage_from) if options.voltage_from else None
    current = parse_origin(options.current_from) if options.current_from else None
    edges = options.counts_per_turn
    if edges is not None and not 1 <= edges <= MOST_EDGES:
        raise RecordingError(f"--counts-per-turn takes a whole number from 1 to {MOST_EDGES}.")
    if mapping is None:
        if motion is None or voltage is None or kind is None:
            raise RecordingError(
                "A bag of another robot needs --voltage-from and one of --speed-from, --position-from, --count-from "
                "(or --mapping FILE)."
            )
        return Mapping(voltage, motion, kind, current, edges_per_revolution=edges)
    if motion is not None and kind is not None:
        mapping = replace(mapping, motion=motion, kind=kind)
    return replace(
        mapping,
        voltage=voltage or mapping.voltage,
        current=current or mapping.current,
        edges_per_revolution=edges or mapping.edges_per_revolution,
    )
