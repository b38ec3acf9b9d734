"""Synthetic motor recordings: two thousand samples, each different from the next, in bags of any kind."""

from collections.abc import Callable
from math import sin
from pathlib import Path

import numpy as np
import pytest
from rclpy.serialization import serialize_message
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from motor_identification.bag import BagWriter, Qos, messages, read_recording, topics
from motor_identification.recording import Recording, recording_of
from motor_model.errors import RecordingError
from motor_model.sample import Info, Sample
from motor_ros.messages import info_message, speed_message, time_message

START = 1_760_000_000_123_456_789  # [ns] log time of the first sample
PERIOD = 5_000_000  # [ns]
COLUMNS = ("sample_time", "speed", "voltage", "edge_count", "edge_time", "edge_period", "supply_voltage", "current")
INFO = Info(name="wheel", max_voltage=9.0)
SPEED = "motor_msgs/msg/MotorSpeed"


def assert_is(recording: Recording, samples: list[Sample]) -> None:
    """Bit for bit, NaN included."""
    expected = recording_of(samples, INFO, "")
    assert len(recording) == len(samples)
    for name in COLUMNS:
        column = getattr(recording, name)
        assert column.dtype == getattr(expected, name).dtype
        assert np.array_equal(column, getattr(expected, name), equal_nan=column.dtype == np.float64), name


def rewritten(bag: Path, to: Path, plugin: StoragePlugin, compression: CompressionMode = CompressionMode.NONE) -> Path:
    """The same bag as another tool writes it."""
    writer = Writer(to, version=9, storage_plugin=plugin)
    if compression is not CompressionMode.NONE:
        writer.set_compression(compression, CompressionFormat.ZSTD)
    with writer:
        connections = {}
        for topic in topics(bag):
            store = get_typestore(Stores.EMPTY)
            store.register(get_types_from_msg(topic.definition, topic.type_name))
            connections[topic.name] = writer.add_connection(topic.name, topic.type_name, typestore=store)
        for name, _, log_time, data in messages(bag):
            writer.write(connections[name], log_time, data)
    return to


def sample(k: int) -> Sample:
    """The k-th sample of the synthetic motor; every field depends on k."""
    return Sample(
        sample_time=k * PERIOD + 7,
        speed=100.0 * sin(0.01 * k + 0.1),
        voltage=6.0 + 1e-3 * k,
        edge_count=3 * k,
        edge_time=k * PERIOD - 1000 - k,
        edge_period=1e-3 / (k + 1),
        supply_voltage=12.0 - 1e-4 * k,
        current=0.1 * k,
    )


SAMPLES = [sample(k) for k in range(2000)]  # 10 s


def write_bag(
    path: Path,
    samples: list[Sample],
    namespace: str = "",
    info: Info | None = INFO,
    frame: Callable[[int], str] = lambda k: "wheel",
    chunk: int = 0,
) -> Path:
    """A bag of these samples, 5 ms of log time apart; `chunk` is the number of samples in one, 0 as it comes."""
    with BagWriter(path) as writer:
        if info is not None:
            latched = (Qos(durability="transient_local", depth=1),)
            channel = writer.topic(f"{namespace}/motor/info", "motor_msgs/msg/MotorInfo", latched)
            writer.write(channel, START, serialize_message(info_message(info, time_message(START))))
        channel = writer.topic(f"{namespace}/motor/speed", "motor_msgs/msg/MotorSpeed", (Qos(depth=100),))
        for k, one in enumerate(samples):
            stamp = time_message(START + k * PERIOD)
            writer.write(channel, START + k * PERIOD, serialize_message(speed_message(one, stamp, frame(k))))
            if chunk and k % chunk == chunk - 1:
                writer.flush()
    return path


def fill(writer: BagWriter) -> int:
    """Write samples, flushing now and then as a recorder does; returns how many had been flushed at the refusal."""
    channel, flushed = writer.topic("/motor/speed", SPEED), 0
    for k, one in enumerate(SAMPLES):
        data = serialize_message(speed_message(one, time_message(START + k * PERIOD), "wheel"))
        writer.write(channel, START + k * PERIOD, data)
        if k % 100 == 99:
            writer.flush()
            flushed = k + 1
    return flushed


def refusal(uri: Path, namespace: str = "") -> str:
    with pytest.raises(RecordingError) as caught:
        read_recording(uri, namespace)
    sentence = str(caught.value)
    assert str(uri) in sentence and "\n" not in sentence and sentence.endswith(".")
    return sentence
