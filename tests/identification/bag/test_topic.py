"""Topics by the names that people use."""

import pytest

from motor_identification.bag.topic import absolute_name, named_topic
from motor_model.errors import RecordingError

ONE = ["/bench/motor/speed", "/bench/motor/voltage", "/diagnostics"]
TWO = [*ONE, "/left/motor/speed"]


@pytest.mark.parametrize(
    ("namespace", "name", "absolute"),
    [
        ("", "motor/speed", "/motor/speed"),
        ("left", "motor/speed", "/left/motor/speed"),
        ("/left/", "motor/speed", "/left/motor/speed"),
        ("left", "/diagnostics", "/diagnostics"),
    ],
)
def test_a_relative_name_is_in_its_namespace(namespace: str, name: str, absolute: str) -> None:
    assert absolute_name(namespace, name) == absolute


@pytest.mark.parametrize(
    ("name", "topics", "meant"),
    [
        ("motor/speed", ["/motor/speed", *TWO], "/motor/speed"),
        ("motor/speed", ONE, "/bench/motor/speed"),
        ("motor/voltage", TWO, "/bench/motor/voltage"),
        ("/motor/speed", ONE, "/motor/speed"),  # this one and no other
        ("speed", ["/motor/overspeed"], "/speed"),  # not the end of another word
    ],
)
def test_the_only_topic_that_can_be_meant_is_meant(name: str, topics: list[str], meant: str) -> None:
    assert named_topic(name, topics) == meant


def test_a_name_in_several_namespaces_is_asked_for() -> None:
    with pytest.raises(RecordingError, match="^motor/speed is /bench/motor/speed or /left/motor/speed in this bag"):
        named_topic("motor/speed", TWO)
