"""The options that say which motor an experiment drives and how hard, the same for every command that drives one."""

import argparse

from motor_ros.command.number_types import between, positive, whole_between

_NAMES = (
    "voltage", "speed", "topic_namespace", "model", "sample_rate", "edges_per_revolution", "edge_resolution",
    "slot_irregularity", "seed",
)  # fmt: skip


def add_plant_options(parser: argparse.ArgumentParser) -> None:
    """Add them to a command line."""
    parser.add_argument(
        "--voltage",
        type=positive,
        metavar="V",
        help="peak of the profile (default: the plant's max_voltage; many profiles go both ways)",
    )
    parser.add_argument(
        "--speed",
        type=positive,
        metavar="RAD_S",
        help="lower the peak as far as it takes to stay below this speed; a live motor is moved by a short slow ramp "
        "first, to find that voltage, and stopped should it run faster all the same",
    )
    parser.add_argument("--model", metavar="FILE", help="model file to simulate offline; '' is the paper's motor")
    live = parser.add_argument_group("live")
    live.add_argument("--topic-namespace", default="", metavar="NS", help="of the motor to drive")
    offline = parser.add_argument_group("offline, with --model")
    add = offline.add_argument
    add("--sample-rate", type=between(1, 20_000), default=200.0, metavar="HZ", help="default 200")
    add("--edges-per-revolution", type=whole_between(1, 100_000), default=96, metavar="N", help="default 96")
    add("--edge-resolution", type=between(0, 1e-3), default=4e-6, metavar="S", help="timer tick, default 4e-6 s")
    add("--slot-irregularity", type=between(0, 0.2), default=0.0, metavar="SHARE", help="of a slot, default 0")
    add("--seed", type=whole_between(0, 2**31 - 1), default=0, metavar="N", help="of disc and first angle, default 0")


def passed_on(options: argparse.Namespace) -> list[str]:
    """Return the same options as words for another command that has them."""
    given = {name: getattr(options, name) for name in _NAMES}
    return [f"--{name.replace('_', '-')}={value}" for name, value in given.items() if value is not None]
