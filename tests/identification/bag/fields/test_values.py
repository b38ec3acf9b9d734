"""Numbers in messages."""

from math import nan

import foreign_bags
import numpy as np
import pytest
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from motor_identification.bag.fields.path import parse_path
from motor_identification.bag.fields.values import list_fields, read_header_stamp, read_value

STORE = get_typestore(Stores.ROS2_JAZZY)
STORE.register(get_types_from_msg(foreign_bags.DRIVER_DEFINITION, foreign_bags.DRIVER))
JOINT = STORE.types["sensor_msgs/msg/JointState"]
STATE = JOINT(
    foreign_bags.stamp(STORE, 5_000_000_007),
    ["left", "right/a"],
    np.array([1.0, 2.0]),
    np.array([3.0, nan]),
    np.zeros(0),
)
WHEEL = STORE.types["example_control_msgs/msg/WheelState"]
DRIVER = STORE.types[foreign_bags.DRIVER](
    foreign_bags.stamp(STORE, 1), ["left", "right"], [WHEEL(1.0, 2.0, 3, 4.0), WHEEL(5.0, 6.0, 7, 8.0)]
)


def value(message: object, field: str) -> float | None:
    return read_value(message, parse_path(f"/a:{field}").steps)


@pytest.mark.parametrize(
    ("field", "expected"),
    [
        ("position[left]", 1.0),
        ("position[right/a]", 2.0),
        ("position[1]", 2.0),
        ("velocity[left]", 3.0),
        ("velocity[right/a]", None),  # NaN is no value
        ("effort[left]", None),  # nobody measured it
        ("position[2]", None),
        ("position[up]", None),
        ("position", None),
        ("name[0]", None),
        ("nothing", None),
        ("position[0].x", None),
        ("header.stamp.sec", 5.0),
    ],
)
def test_joint_states(field: str, expected: float | None) -> None:
    assert value(STATE, field) == expected


def test_messages_in_arrays_by_names_beside_them() -> None:
    assert value(DRIVER, "wheels[right].ticks") == 7.0 and value(DRIVER, "wheels[0].duty") == 1.0
    assert value(DRIVER, "wheels[up].ticks") is None


def test_all_numbers_of_a_message() -> None:
    assert list_fields(STATE) == ["position[left]", "position[right/a]", "velocity[left]", "velocity[right/a]"]
    fields = list_fields(DRIVER)
    assert fields[0] == "wheels[left].duty" and len(fields) == 8
    assert [value(DRIVER, field) for field in fields] == [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]
    image = STORE.types["std_msgs/msg/UInt8MultiArray"](
        STORE.types["std_msgs/msg/MultiArrayLayout"]([], 0), np.zeros(65)
    )
    assert list_fields(image) == ["layout.data_offset"]  # an array of more than 64 is no list of joints


def test_stamps_of_headers() -> None:
    assert read_header_stamp(STATE) == 5_000_000_007 and read_header_stamp(WHEEL(1.0, 2.0, 3, 4.0)) == 0
