"""The options that say which motor an experiment drives and how hard, the same for every command that drives one."""

import argparse

from motor_ros.command import positive

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
    offline.add_argument("--sample-rate", type=positive, default=200.0, metavar="HZ", help="default 200")
    offline.add_argument("--edges-per-revolution", type=int, default=96, metavar="N", help="default 96")
    offline.add_argument("--edge-resolution", type=float, default=4e-6, metavar="S", help="timer tick, default 4e-6 s")
    offline.add_argument("--slot-irregularity", type=float, default=0.0, metavar="SHARE", help="of a slot, default 0")
    offline.add_argument("--seed", type=int, default=0, metavar="N", help="of disc and starting angle, default 0")


def passed_on(options: argparse.Namespace) -> list[str]:
    """The same options as words for another command that has them."""
    given = {name: getattr(options, name) for name in _NAMES}
    return [f"--{name.replace('_', '-')}={value}" for name, value in given.items() if value is not None]
