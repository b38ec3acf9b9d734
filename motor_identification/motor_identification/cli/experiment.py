"""`experiment`: drive a motor through a profile and record it, on the live plant or offline with a model."""

import argparse
import sys
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING

from motor_identification.cli.options.plant import add_plant_options
from motor_model.excitation import PROFILES, profile
from motor_model.parameters import paper_motor
from motor_ros.command.parser import CommandParser
from motor_ros.command.shell import shell
from motor_ros.output_files import add_force_option

if TYPE_CHECKING:
    from collections.abc import Iterator

    from motor_identification.bag import BagWriter
    from motor_identification.experiment import Plan
    from motor_model.parameters import Parameters
    from motor_model.sensing.board import BoardConfig


def parser() -> argparse.ArgumentParser:
    """Make the command line's parser."""
    rows = "\n".join(f"  {p.name:11}{p.duration:6.2f} s  {p.shows}" for p in PROFILES.values())
    parser = CommandParser(
        "motor_identification",
        "experiment",
        "Drive the motor through a voltage profile and record it into a bag. Without --model the live "
        "plant (motor_sim or motor_driver) is driven; with --model a simulated motor runs offline, at full speed. "
        "However a live experiment ends, the motor gets 0 V; a bag that is not complete is named "
        "BAG_incomplete. The bag says which profile it was, under custom_data in its metadata.yaml.",
        "examples:\n  ros2 run motor_identification experiment rich --output bag --voltage 6\n"
        f"  ros2 run motor_identification experiment step --model model.yaml --output bag\n\nprofiles:\n{rows}",
    )
    parser.add_argument("profile", choices=list(PROFILES), metavar="PROFILE", help="one of the profiles below")
    parser.add_argument("--output", required=True, metavar="BAG", help="the bag to write; must not exist")
    add_plant_options(parser)
    add_force_option(parser)
    return parser


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_identification experiment`."""
    options = parser().parse_args(args)
    return shell(lambda: _live(options) if options.model is None else _offline(options))


def _live(options: argparse.Namespace) -> int:
    from motor_identification.live.experiment_node import Driver
    from motor_identification.live.run_plan import drive
    from motor_ros.run import Interrupt, start_ros

    interrupt = Interrupt()
    start_ros()
    wanted = profile(options.profile)
    driver = Driver(wanted, options.voltage, options.speed, options.topic_namespace)
    return drive(driver, options.output, interrupt, options.force)


def _offline(options: argparse.Namespace) -> int:
    from motor_identification.bag import BagWriter
    from motor_identification.experiment import make_plan, slowed
    from motor_model.model_file import load
    from motor_model.sensing.board import BoardConfig

    model = load(options.model) if options.model else paper_motor()
    plan = make_plan(profile(options.profile), options.voltage, model.max_voltage, 1.0 / options.sample_rate)
    if options.speed is not None:
        plan = slowed(plan, model, options.speed)
    config = BoardConfig(
        name=model.name,
        sample_rate=options.sample_rate,
        edges_per_revolution=options.edges_per_revolution,
        edge_resolution=options.edge_resolution,
        slot_irregularity=options.slot_irregularity,
        seed=options.seed,
    )
    count = _write(BagWriter(options.output, options.force, part=False), plan, model, config)
    print(
        f"{options.output}: {count} samples, {plan.duration:.2f} s of '{plan.profile.name}' with '{model.name}', "
        f"peak {plan.voltage:g} V"
    )
    return 0


def _write(bag: "BagWriter", plan: "Plan", model: "Parameters", config: "BoardConfig") -> int:
    """Simulate into a bag with the topics, types and QoS of a live plant; returns the number of samples."""
    from rclpy.serialization import serialize_message
    from tqdm import tqdm

    from motor_identification.experiment import simulate_plan
    from motor_identification.live.qos_profiles import offered
    from motor_ros import qos
    from motor_ros.messages import info_message, speed_message, time_message, voltage_message

    begin, count = time.time_ns(), 0
    with _kept_if_whole(bag) as writer:
        writer.note("experiment", {**plan.words(), "motor": model.name, "source": "simulation"})
        info = writer.topic("/motor/info", "motor_msgs/msg/MotorInfo", offered(qos.INFO))
        speed = writer.topic("/motor/speed", "motor_msgs/msg/MotorSpeed", offered(qos.SPEED))
        voltage = writer.topic("/motor/voltage", "motor_msgs/msg/MotorVoltage", offered(qos.VOLTAGE))
        writer.write(info, begin, serialize_message(info_message(config.info(model), time_message(begin))))
        samples = simulate_plan(plan, model, config)
        for command, sample in tqdm(samples, total=len(plan.commands), delay=2.0, disable=None, unit=" samples"):
            now = begin + round(count * plan.sample_period * 1e9)
            stamp = time_message(now)
            writer.write(voltage, now, serialize_message(voltage_message(command, stamp, config.name)))
            writer.write(speed, now, serialize_message(speed_message(sample, stamp, config.name)))
            count += 1
    return count


@contextmanager
def _kept_if_whole(bag: "BagWriter") -> "Iterator[BagWriter]":
    """Close the bag, or take it away where it was not finished: simulated once more it is the same."""
    try:
        yield bag
    except BaseException:
        bag.discard()
        raise
    bag.close()


if __name__ == "__main__":
    sys.exit(main())
