"""Topics: their absolute names, and the QoS that was offered, in any version of rosbag2."""

from pathlib import Path

import pytest
from mcap.reader import make_reader
from motor_bags import START
from rosbags.highlevel import AnyReader

from motor_identification.bag import BagWriter, topics
from motor_identification.bag.metadata import profiles_text
from motor_identification.bag.topic import Qos, absolute_name, load_profiles, named_topic
from motor_model.errors import RecordingError

SPEED = "motor_msgs/msg/MotorSpeed"
ONE = ["/bench/motor/speed", "/bench/motor/voltage", "/diagnostics"]
TWO = [*ONE, "/left/motor/speed"]


def test_a_topic_without_qos_has_an_empty_list_of_them(tmp_path: Path) -> None:
    """As rosbag2 writes it."""
    with BagWriter(tmp_path / "bag") as writer:
        writer.write(writer.topic("/motor/speed", SPEED), START, b"\x00\x01\x00\x00")
    with next((tmp_path / "bag").glob("*.mcap")).open("rb") as stream:
        summary = make_reader(stream).get_summary()
    assert summary is not None
    assert [channel.metadata["offered_qos_profiles"] for channel in summary.channels.values()] == ["[]"]
    assert topics(tmp_path / "bag")[0].qos == ()
    with AnyReader([tmp_path / "bag"]) as reader:
        assert reader.message_count == 1


@pytest.mark.parametrize(
    ("namespace", "name", "absolute"),
    [
        ("", "motor/speed", "/motor/speed"),
        ("left", "motor/speed", "/left/motor/speed"),
        ("/left/", "motor/speed", "/left/motor/speed"),
        ("a/b", "motor/speed", "/a/b/motor/speed"),
        ("left", "/motor/speed", "/motor/speed"),
        ("", "/diagnostics", "/diagnostics"),
    ],
)
def test_names_are_made_absolute(namespace: str, name: str, absolute: str) -> None:
    assert absolute_name(namespace, name) == absolute


def test_profiles_are_read_in_the_words_of_any_version() -> None:
    """Numbers up to version 8 of rosbag2, words since."""
    latched = Qos("reliable", "transient_local", "keep_last", 1)
    assert load_profiles(profiles_text((latched, Qos(depth=100)))) == (latched, Qos(depth=100))
    limits = "{sec: 9223372036, nsec: 854775807}"
    old = (
        f"- {{history: 1, depth: 1, reliability: 1, durability: 1, deadline: {limits}, lifespan: {limits}, "
        f"liveliness: 1, liveliness_lease_duration: {limits}, avoid_ros_namespace_conventions: false}}"
    )
    assert load_profiles(old) == (latched,)


@pytest.mark.parametrize("text", ["", "[]", "- 7", "- {depth: 1}"])
def test_profiles_that_cannot_be_understood_are_none(text: str) -> None:
    assert load_profiles(text) == ()


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
