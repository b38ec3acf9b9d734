"""YAML as users type it, into messages."""

import math

import pytest
from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseWithCovariance
from sensor_msgs.msg import JointState
from shape_msgs.msg import SolidPrimitive
from std_msgs.msg import Bool, ByteMultiArray, Float32, Float64, Int8, String

from motor_msgs.msg import MotorSpeed
from motor_msgs.srv import Identify
from ros2_stand_in.interfaces.values import ValueRefused, fill, parse


def filled(message, text):
    fill(message, parse(text))
    return message


@pytest.mark.parametrize(
    ("text", "value"),
    [("{data: 100.0}", 100.0), ("data: -3", -3.0), ("{data: 1e-3}", 1e-3), ("{data: .inf}", math.inf), ("{}", 0.0)],
)
def test_numbers(text, value):
    assert filled(Float64(), text).data == value


def test_a_request_as_in_the_readme():
    request = filled(
        Identify.Request(), "{bag_uris: [a, b], effects: [coulomb_friction], start: 1, seed: 18446744073709551615}"
    )
    assert request == Identify.Request(bag_uris=["a", "b"], effects=["coulomb_friction"], start=1.0, seed=2**64 - 1)


def test_nested_messages_lists_of_them_and_fixed_arrays():
    array = filled(DiagnosticArray(), "{status: [{level: 2, name: a, values: [{key: k, value: 1}]}, {name: b}]}")
    assert [(each.level, each.name) for each in array.status] == [(b"\x02", "a"), (b"\x00", "b")]
    assert (array.status[0].values[0].key, array.status[0].values[0].value) == ("k", "1")
    pose = filled(PoseWithCovariance(), f"{{pose: {{position: {{x: 2}}}}, covariance: {list(range(36))}}}")
    assert pose.pose.position.x == 2.0
    assert pose.covariance.tolist() == list(range(36))
    joints = filled(JointState(), "{header: {stamp: {sec: 5}, frame_id: m}, name: [shaft], velocity: [1, 2.5]}")
    assert (joints.header.stamp.sec, joints.header.frame_id, list(joints.velocity)) == (5, "m", [1.0, 2.5])
    assert list(filled(ByteMultiArray(), "{data: [1, 255]}").data) == [b"\x01", b"\xff"]


def test_automatic_stamps_are_set_later():
    speed, header, now = MotorSpeed(), MotorSpeed(), Time(sec=7, nanosec=9)
    for stamp in fill(speed, parse("{header: auto, speed: 2}")) + fill(header, parse("{header: {stamp: now}}")):
        stamp(now)
    assert (speed.header.stamp, header.header.stamp, speed.speed) == (now, now, 2.0)
    assert fill(String(), parse("{data: auto}")) == []


@pytest.mark.parametrize(
    ("message", "text", "sentence"),
    [
        (Float64(), "{daat: 1}", "std_msgs/msg/Float64 has no field 'daat'; it has: data."),
        (Identify.Request(), "{effect: []}", "motor_msgs/srv/Identify_Request has no field 'effect'; it has: bag_uris"),
        (
            MotorSpeed(),
            "{header: {stamp: {s: 1}}}",
            "builtin_interfaces/msg/Time has no field 's'; it has: sec, nanosec.",
        ),
        (Float64(), "5", "'5' does not name fields; write"),
        (Float64(), "{data: ", "'{data: ' is not YAML (did not find"),
    ],
)
def test_what_names_no_field_is_a_sentence(message, text, sentence):
    with pytest.raises(ValueRefused) as refused:
        filled(message, text)
    assert str(refused.value).startswith(sentence)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("message", "text", "sentence"),
    [
        (Float64(), "{data: fast}", " takes a number, not 'fast'."),
        (Float64(), "{data: true}", " takes a number, not True."),
        (Float32(), "{data: 1.0e+39}", " takes a float32, and 1e+39 is too large for one."),
        (String(), "{data: [a]}", " takes a text, not ['a']."),
        (String(), "{data: }", " takes a text, not None."),
        (Bool(), "{data: 2}", " takes true or false, not 2."),
        (Identify.Request(), "{effects: a}", " takes a list, such as [a], not 'a'."),
        (Identify.Request(), "{effects: [a, [b]]}", ", value 1, takes a text, not ['b']."),
        (Identify.Request(), "{particles: -1}", " takes a whole number from 0 to 4294967295, not -1."),
        (Identify.Request(), "{particles: 1.5}", " takes a whole number from 0 to 4294967295, not 1.5."),
        (
            Identify.Request(),
            "{seed: 18446744073709551616}",
            f" takes a whole number from 0 to {2**64 - 1}, not {2**64}.",
        ),
        (Int8(), "{data: -129}", " takes a whole number from -128 to 127, not -129."),
        (Int8(), "{data: .nan}", " takes a whole number from -128 to 127, not nan."),
        (DiagnosticStatus(), "{level: 256}", " takes a whole number from 0 to 255, not 256."),
        (MotorSpeed(), "{header: 5}", " takes {field: value}, not 5."),
        (PoseWithCovariance(), "{covariance: [1]}", " takes 36 values, not 1."),
        (SolidPrimitive(), "{dimensions: [1, 2, 3, 4]}", " takes at most 3 values, not 4."),
    ],
)
def test_what_does_not_fit_its_field_is_a_sentence(message, text, sentence):
    untouched = str(message)
    with pytest.raises(ValueRefused) as refused:
        filled(message, text)
    package, kind = type(message).__module__.split(".")[:2]
    (field,) = parse(text)
    assert str(refused.value) == f"field '{field}' of {package}/{kind}/{type(message).__name__}{sentence}"
    assert str(message) == untouched
