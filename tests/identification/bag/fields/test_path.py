"""Paths into messages."""

import pytest

from motor_identification.bag.fields.path import Element, parse_path
from motor_model.errors import RecordingError


@pytest.mark.parametrize(
    ("text", "topic", "steps"),
    [
        ("/joint_states:velocity[left_wheel]", "/joint_states", ("velocity", Element("left_wheel"))),
        ("left/command:data", "/left/command", ("data",)),
        ("/odom:twist.twist.linear.x", "/odom", ("twist", "twist", "linear", "x")),
        ("/a:data[0]", "/a", ("data", Element(0))),
        ("/a:wheels[1].v[arm/joint 2]", "/a", ("wheels", Element(1), "v", Element("arm/joint 2"))),
        ("/a:matrix[2][3]", "/a", ("matrix", Element(2), Element(3))),
    ],
)
def test_topics_attributes_and_elements(text: str, topic: str, steps: tuple[object, ...]) -> None:
    path = parse_path(text)
    assert (path.topic, path.steps) == (topic, steps)
    assert parse_path(str(path)) == path


WRONG = "|:|/a|/a:|:data|/a:[0]|/a:data[|/a:data[]|/a:data]0[|/a:a b|/a:a..b|/a:a.0|/a:dätä"


@pytest.mark.parametrize("text", ["", *WRONG.split("|"), "/a:" + "x" * 600])
def test_what_is_no_path(text: str) -> None:
    with pytest.raises(RecordingError, match="names no field of a message: write TOPIC:FIELD") as caught:
        parse_path(text)
    assert "\n" not in str(caught.value)
