"""Bags for benchmarks: what a simulated board reports under a list of commands, as `record` would have written it."""

from collections.abc import Iterable
from contextlib import ExitStack
from pathlib import Path

from rclpy.serialization import serialize_message

from motor_identification.bag import BagWriter
from motor_model.parameters import Parameters
from motor_model.sensing.board import BoardConfig, SimulatedBoard
from motor_ros.messages import info_message, speed_message, time_message

SPEED, INFO = "/motor/speed", "/motor/info"
BEGIN = 1_700_000_000_000_000_000  # [ns] since 1970
FLUSH = 100  # samples: half a second of recording


def write_bags(bags: dict[Path, int], commands: Iterable[float], motor: Parameters, config: BoardConfig) -> None:
    """One run under these commands [V], one for each sample, into bags that hold its first so many samples."""
    board = SimulatedBoard(motor, config)
    with ExitStack() as stack:
        open_bags = []
        for path, length in bags.items():
            writer = stack.enter_context(BagWriter(path))
            info = serialize_message(info_message(config.info(motor), time_message(BEGIN)))
            writer.write(writer.topic(INFO, "motor_msgs/msg/MotorInfo"), BEGIN, info)
            open_bags.append((length, writer, writer.topic(SPEED, "motor_msgs/msg/MotorSpeed")))
        for k, command in enumerate(commands):
            now = BEGIN + round(k * 1e9 / config.sample_rate)
            data = serialize_message(speed_message(board.sample(command), time_message(now), config.name))
            for length, writer, channel in open_bags:
                if k < length:
                    writer.write(channel, now, data)
                    if k % FLUSH == FLUSH - 1:
                        writer.flush()
