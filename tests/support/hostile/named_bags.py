"""Bags for the hostile inputs that have a name: a motor's recording, and what somebody made of one."""

import struct
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import lz4.frame
import numpy as np
import zstandard
from numpy.typing import NDArray
from rclpy.serialization import deserialize_message, serialize_message
from std_msgs.msg import Float64

from hostile import mcap_mutation
from hostile.bags import base, stored
from motor_identification.bag import BagWriter
from motor_model.parameters import paper_motor
from motor_model.sample import Info, Sample
from motor_model.sensing.board import BoardConfig, SimulatedBoard
from motor_msgs.msg import MotorInfo, MotorVoltage
from motor_ros.messages import info_message, speed_message, time_message

START, PERIOD = 1_760_000_000_000_000_000, 5_000_000  # [ns]
BAG = "out/input"
MOTION = np.repeat([8.0, 3.0, -8.0, -3.0, 10.0, 0.0, 6.0, -6.0], 60)  # [V] a row of each for 0.3 s
SCHEMA, INDEX = 3, (7, 8, 11, 13, 14, 15)  # of records: definitions, and where and how much there is of others
SPEED, INFO, VOLTAGE = (f"motor_msgs/msg/Motor{name}" for name in ("Speed", "Info", "Voltage"))
Write = Callable[[Path], None]
BOARD = BoardConfig()
PACKED = {"zstd": zstandard.compress, "lz4": lz4.frame.compress}
GIGABYTE = 1 << 30


def move(volts: NDArray[np.float64], config: BoardConfig = BOARD) -> tuple[Info, list[Sample]]:
    """The samples of the paper's motor under these voltages."""
    motor = SimulatedBoard(paper_motor(), config)
    return config.info(paper_motor()), [motor.sample(float(volt)) for volt in volts]


def write(folder: Path, info: Info, samples: list[Sample], name: str = "motor") -> None:
    """Write samples as a bag that the user records."""
    with BagWriter(folder / BAG) as writer:
        said = serialize_message(info_message(info, time_message(START)))
        writer.write(writer.topic("/motor/info", INFO), START, said)
        channel = writer.topic("/motor/speed", SPEED)
        for k, sample in enumerate(samples):
            now = START + k * PERIOD
            writer.write(channel, now, serialize_message(speed_message(sample, time_message(now), name)))


def recording(name: str = "motor") -> Write:
    """A sound recording of a motor of that name."""
    return lambda folder: write(folder, *move(MOTION, BoardConfig(name)), name)


def long_standstill(folder: Path) -> None:
    """A minute at 0 V, then two seconds of motion: the pieces of the recording were without any."""
    write(folder, *_stand_and_move())


@cache
def _stand_and_move() -> tuple[Info, list[Sample]]:
    return move(np.concatenate([np.zeros(12_000), MOTION]))


@cache
def _gigabyte(kind: str) -> bytes:
    """A gigabyte, packed to a hundred kilobytes."""
    return bytes(PACKED[kind](bytes(GIGABYTE)))


def wired_backwards(folder: Path) -> None:
    """Both channels of the encoder are exchanged: the motor turns against its voltage."""
    info, samples = move(MOTION, BoardConfig(single_channel=False))
    write(folder, info, [replace(s, edge_count=-s.edge_count, speed=-s.speed) for s in samples])


def rewritten(data: bytes, change: Callable[[mcap_mutation.Records], mcap_mutation.Records]) -> bytes:
    """A bag's file with the records of every chunk changed, and the chunks left unpacked."""
    records = mcap_mutation.split(data)
    opened = [
        (opcode, _unpacked(mcap_mutation.join(change(mcap_mutation.split(mcap_mutation.opened(content))))))
        if opcode == mcap_mutation.CHUNK
        else (opcode, content)
        for opcode, content in records
        if opcode not in INDEX
    ]
    return mcap_mutation.MAGIC + mcap_mutation.join(opened) + mcap_mutation.MAGIC


def _unpacked(data: bytes) -> bytes:
    return struct.pack("<QQQII", START, START + 10**12, len(data), 0, 0) + struct.pack("<Q", len(data)) + data


def not_utf_8(folder: Path) -> None:
    """The recording of a motor whose name, in every message, is not UTF-8."""
    recording("mitor")(folder)
    (path,) = (folder / BAG).glob("*.mcap")
    path.write_bytes(
        rewritten(path.read_bytes(), lambda rows: [(code, row.replace(b"mitor", b"m\xfc\x9bor")) for code, row in rows])
    )


def flipped(which: int) -> Write:
    """A bag of several chunks, one bit of one of them flipped."""

    def make(folder: Path) -> None:
        records = mcap_mutation.split(base("chunks"))
        chunk = [k for k, (opcode, _) in enumerate(records) if opcode == mcap_mutation.CHUNK][which]
        content = bytearray(records[chunk][1])
        content[len(content) // 2] ^= 0x10
        records[chunk] = (mcap_mutation.CHUNK, bytes(content))
        put(folder, mcap_mutation.MAGIC + mcap_mutation.join(records) + mcap_mutation.MAGIC)

    return make


def put(folder: Path, data: bytes) -> None:
    (folder / BAG).mkdir()
    (folder / BAG / "input_0.mcap").write_bytes(data)


def bomb(kind: str) -> Write:
    """A chunk of a hundred kilobytes that unpacks to gigabytes, as its head says."""

    def make(folder: Path) -> None:
        packed = _gigabyte(kind)
        head = struct.pack("<QQQII", 1, 2, GIGABYTE, 0, len(kind)) + kind.encode() + struct.pack("<Q", len(packed))
        chunk = mcap_mutation.join([(mcap_mutation.CHUNK, head + packed)])
        put(folder, base("golden")[:-8].replace(mcap_mutation.MAGIC, mcap_mutation.MAGIC + chunk, 1))

    return make


def packed_file(folder: Path) -> None:
    """A file that is zstd and unpacks without an end."""
    (folder / "input.mcap.zstd").write_bytes(_gigabyte("zstd"))


def defined(line: bytes) -> Write:
    """The golden bag, a line put before every definition in it."""

    def changed(records: mcap_mutation.Records) -> mcap_mutation.Records:
        return [(code, _with_line(row, line) if code == SCHEMA else row) for code, row in records]

    return lambda folder: put(folder, rewritten(base("golden"), changed))


def _with_line(schema: bytes, line: bytes) -> bytes:
    at = 2
    for _ in range(2):  # its name, its encoding
        at += 4 + struct.unpack_from("<I", schema, at)[0]
    return schema[:at] + struct.pack("<I", len(schema) - at - 4 + len(line)) + line + schema[at + 4 :]


def info_says(times: int = 1, **values: object) -> Write:
    """The golden bag whose motor/info has other values, so many of it with another stamp each."""

    def make(folder: Path) -> None:
        with BagWriter(folder / BAG) as writer:
            for topic, kind, now, data in stored()[:251]:
                for k in range(times if topic == "/motor/info" else 1):
                    if topic == "/motor/info":
                        message = deserialize_message(data, MotorInfo)
                        for name, value in values.items():
                            setattr(message, name, value)
                        message.header.stamp = time_message(now + k)
                        data = serialize_message(message)
                    writer.write(writer.topic(topic, kind), now + k, data)

    return make


def to_play(*messages: tuple[str, str, int, bytes]) -> Write:
    """A bag of these messages: topic, type, log time, content."""

    def make(folder: Path) -> None:
        with BagWriter(folder / BAG) as writer:
            for topic, kind, time, data in messages:
                writer.write(writer.topic(topic, kind), time, data)

    return make


def voltage(volts: float) -> bytes:
    return bytes(serialize_message(MotorVoltage(voltage=volts)))


def number(value: float) -> bytes:
    return bytes(serialize_message(Float64(data=value)))
