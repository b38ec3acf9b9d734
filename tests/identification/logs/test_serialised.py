"""Messages made a column at a time are those that ROS makes one at a time (but for its padding, which is anything)."""

from math import nan

import numpy as np
import pytest
from rclpy.serialization import deserialize_message, serialize_message

from motor_identification.logs.serialised import speed_messages, voltage_messages
from motor_model.sample import Sample
from motor_msgs.msg import MotorSpeed, MotorVoltage
from motor_ros.messages import speed_message, time_message, voltage_message

SAMPLES = [
    Sample(sample_time=7, speed=-2.5, voltage=11.0, edge_count=-3, supply_voltage=12.5, current=nan),
    Sample(sample_time=2**62, speed=1e-9, voltage=-0.5, edge_count=2**40, edge_time=5, edge_period=0.25),
]
STAMPS = np.array([1_760_000_000_123_456_789, 5], np.int64)


def read(data: bytes) -> MotorSpeed:
    return deserialize_message(data, MotorSpeed)


@pytest.mark.parametrize("name", ["", "m", "motor", "the left wheel", "räder"])
def test_alike(name: str) -> None:
    for sample, stamp, speed, voltage in zip(
        SAMPLES, STAMPS, speed_messages(SAMPLES, STAMPS, name), voltage_messages(SAMPLES, STAMPS, name), strict=True
    ):
        whole = serialize_message(speed_message(sample, time_message(int(stamp)), name))
        assert len(speed) == len(whole) and repr(read(speed)) == repr(read(whole))
        single = serialize_message(voltage_message(sample.voltage, time_message(int(stamp)), name))
        assert len(voltage) == len(single)
        assert deserialize_message(voltage, MotorVoltage) == deserialize_message(single, MotorVoltage)
        assert deserialize_message(speed, MotorSpeed).edge_count == sample.edge_count
        assert deserialize_message(voltage, MotorVoltage).voltage == sample.voltage
