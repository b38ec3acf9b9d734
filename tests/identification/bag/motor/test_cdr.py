"""The vectorised decoder against the real one, and against definitions of other versions."""

import struct
from dataclasses import fields, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from motor_bags import SAMPLES
from rclpy.serialization import deserialize_message, serialize_message

from motor_identification.bag.definition import installed
from motor_identification.bag.motor.cdr import ROW, SPEED_TYPE, SpeedDecoder, Undecodable, decode_info
from motor_model.sample import Info, Measurement, Sample
from motor_msgs.msg import MotorSpeed
from motor_ros.messages import info_message, speed_message, time_message

DEFINITION = installed(SPEED_TYPE).text
LONGS = st.integers(-(2**63), 2**63 - 1)
FLOATS = st.floats(allow_nan=True, allow_infinity=True)
ANY_SAMPLE = st.builds(Sample, LONGS, FLOATS, FLOATS, LONGS, LONGS, FLOATS, FLOATS, FLOATS)
ANY_NAME = st.text(st.characters(codec="utf-8", exclude_characters="\0"), max_size=40)


ANY_ROWS = st.lists(st.tuples(ANY_SAMPLE, ANY_NAME, st.integers(-(2**31) * 10**9, 2**62)), min_size=1, max_size=20)


@settings(max_examples=8)  # of ten samples each
@given(ANY_ROWS)
def test_it_says_what_rclpy_says(given: list[tuple[Sample, str, int]]) -> None:
    assert_said_as_by_rclpy(given)


@pytest.mark.slow
@settings(max_examples=100)
@given(ANY_ROWS)
def test_whatever_is_sent_it_says_what_rclpy_says(given: list[tuple[Sample, str, int]]) -> None:
    assert_said_as_by_rclpy(given)


def assert_said_as_by_rclpy(given: list[tuple[Sample, str, int]]) -> None:
    stored = [
        serialize_message(speed_message(sample, time_message(max(stamp, 0)), name)) for sample, name, stamp in given
    ]
    rows = SpeedDecoder(DEFINITION).rows(stored)
    assert rows.dtype == ROW and len(rows) == len(given)
    for row, data in zip(rows, stored, strict=True):
        message = deserialize_message(data, MotorSpeed)
        for field in fields(Sample):
            expected, got = getattr(message, field.name), row[field.name]
            assert struct.pack("<d" if field.type is float else "<q", got) == struct.pack(
                "<d" if field.type is float else "<q", expected
            )
        assert row["stamp"] == message.header.stamp.sec * 10**9 + message.header.stamp.nanosec


def encoded(names: list[str], values: dict[str, float], endian: str, padding: int = 0) -> bytes:
    """A message by hand: stamp 7.5 s, frame_id of 5 characters, then 8-byte fields."""
    head = struct.pack(f"{endian}iII6s6x", 7, 500_000_000, 6, b"wheel\0")
    kinds = {"sample_time": "q", "edge_count": "q", "edge_time": "q"}
    body = b"".join(struct.pack(endian + kinds.get(name, "d"), values[name]) for name in names)
    return (b"\0\1" if endian == "<" else b"\0\0") + b"\0\0" + head + body + bytes(padding)


VALUES = {field.name: getattr(SAMPLES[3], field.name) for field in fields(Sample)}
NAMES = list(VALUES)


@pytest.mark.parametrize("endian", ["<", ">"])
@pytest.mark.parametrize("padding", [0, 4])
def test_both_byte_orders_with_and_without_padding(endian: str, padding: int) -> None:
    (row,) = SpeedDecoder(DEFINITION).rows([encoded(NAMES, VALUES, endian, padding)])
    assert {name: row[name].item() for name in NAMES} == VALUES
    assert row["stamp"] == 7_500_000_000


def test_a_later_version_with_more_fields_is_read() -> None:
    later = DEFINITION.replace("float64 voltage", "float64 temperature\nfloat64 voltage")
    later = later.replace("float64 current", "float64 current\nstring[] remarks\nfloat64 torque")
    names = [*NAMES[:2], "temperature", *NAMES[2:]]
    (row,) = SpeedDecoder(later).rows([encoded(names, {**VALUES, "temperature": 55.0}, "<", 40)])
    assert {name: row[name].item() for name in NAMES} == VALUES


def test_an_earlier_version_without_optional_fields_is_read() -> None:
    text = DEFINITION.split("float64 supply_voltage")[0]
    rest = "=" * 80 + DEFINITION.split("=" * 80, 1)[1]
    (row,) = SpeedDecoder(text + rest).rows([encoded(NAMES[:-2], VALUES, "<")])
    assert {name: row[name].item() for name in NAMES[:-2]} == {name: VALUES[name] for name in NAMES[:-2]}
    assert np.isnan(row["supply_voltage"]) and np.isnan(row["current"])


@pytest.mark.parametrize(
    ("definition", "complaint"),
    [
        (DEFINITION.replace("float64 voltage", "float64 volts"), "has no voltage"),
        (DEFINITION.replace("std_msgs/Header header", "float64 header"), "does not begin with a header"),
        (DEFINITION.replace("float64 speed", "float64[ speed"), "cannot be understood"),
        ("", "does not begin with a header|cannot be understood"),
    ],
)
def test_a_definition_that_does_not_do(definition: str, complaint: str) -> None:
    with pytest.raises(Undecodable, match=complaint):
        SpeedDecoder(definition)


INFO_DEFINITION = installed("motor_msgs/msg/MotorInfo").text
INFO = Info("wheel", "hardware", Measurement.COUNTS, 2800, False, 1e-6, 0.001, 0.02, 0.01, 7.4, "coast")


def test_info_comes_back_in_all_its_fields() -> None:
    for info in (INFO, replace(INFO, source="import", voltage_assumed=True, rows_said=True, speed_said=True)):
        data = serialize_message(info_message(info, time_message(5)))
        assert decode_info(data, INFO_DEFINITION) == info


def test_a_name_that_is_not_utf_8_is_shown_by_its_bytes() -> None:
    """All else in the message is sound, and a plant written in C says what it likes."""
    message = info_message(replace(INFO, name="wheel"), time_message(5))
    data = serialize_message(message).replace(b"wheel\0", b"r\xe4d\x1b[\0")
    assert decode_info(data, INFO_DEFINITION) == replace(INFO, name=r"r\xe4d\x1b[")


def test_info_that_cannot_be_understood() -> None:
    message = info_message(INFO, time_message(5))
    message.measurement = "guesses"
    with pytest.raises(Undecodable, match="guesses"):
        decode_info(serialize_message(message), INFO_DEFINITION)
    data = serialize_message(info_message(INFO, time_message(5)))
    for size in (0, 3, 8, 30, len(data) - 5):
        with pytest.raises(Undecodable):
            decode_info(data[:size], INFO_DEFINITION)


def test_an_info_of_an_earlier_version_under_a_later_definition_keeps_the_defaults() -> None:
    later = INFO_DEFINITION.replace("string decay", "string decay\nfloat64 supply_of_the_future", 1)
    assert "supply_of_the_future" in later
    assert decode_info(serialize_message(info_message(INFO, time_message(5))), later) == INFO
