"""A topic in a bag: its name, its type, and how its publishers offered it."""

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any

from rosbags.interfaces import Qos as StoredQos
from rosbags.rosbag2.errors import ReaderError
from rosbags.rosbag2.metadata import parse_qos

from motor_model import yaml_file
from motor_model.errors import MotorError, RecordingError

# What rosbag2 writes for "no limit": the largest duration that fits 64 bits of nanoseconds.
_INFINITE = {"sec": 9223372036, "nsec": 854775807}


@dataclass(frozen=True, slots=True)
class Qos:
    """What a publisher offers, in the words of rosbag2; deadlines, lifespans and liveliness are not kept."""

    reliability: str = "reliable"  # reliable | best_effort | unknown
    durability: str = "volatile"  # volatile | transient_local | unknown
    history: str = "keep_last"  # keep_last | keep_all | unknown
    depth: int = 10

    def entry(self) -> dict[str, Any]:
        """The profile as version 9 of `metadata.yaml` lists it."""
        limits = {"deadline": _INFINITE, "lifespan": _INFINITE, "liveliness_lease_duration": _INFINITE}
        return {**asdict(self), **limits, "liveliness": "automatic", "avoid_ros_namespace_conventions": False}


@dataclass(frozen=True, slots=True)
class Topic:
    """One topic of a bag; `definition` is empty where the bag does not embed it."""

    name: str  # absolute, such as /motor/speed
    type_name: str  # such as motor_msgs/msg/MotorSpeed
    definition: str = ""  # ros2msg text with all nested types
    qos: tuple[Qos, ...] = ()
    message_count: int = 0
    type_hash: str = ""  # REP 2016


def absolute_name(namespace: str, name: str) -> str:
    """`motor/speed` in the namespace `left` (or `/left/`) is `/left/motor/speed`; a leading slash stays global."""
    parts = name.split("/") if name.startswith("/") else [*namespace.split("/"), *name.split("/")]
    return "/" + "/".join(part for part in parts if part)


def named_topic(name: str, topics: Iterable[str]) -> str:
    """Return the topic that a user means by a name: that one, or the only one that is it in some namespace.

    Raises:
        RecordingError: it is in several namespaces.
    """
    absolute, there = absolute_name("", name), sorted(topics)
    if absolute in there or name.startswith("/"):
        return absolute
    candidates = [topic for topic in there if topic.endswith(absolute)]
    if len(candidates) > 1:
        raise RecordingError(f"{name} is {' or '.join(candidates)} in this bag: say which.")
    return candidates[0] if candidates else absolute


def load_profiles(text: str) -> tuple[Qos, ...]:
    """Profiles from that text, in any version of rosbag2; none where it cannot be understood."""
    try:
        return from_stored(parse_qos(yaml_file.parse(text)))
    except (ReaderError, MotorError, KeyError, TypeError, ValueError, AttributeError):
        return ()


def from_stored(profiles: list[StoredQos]) -> tuple[Qos, ...]:
    """Profiles as `rosbags` gives them."""
    return tuple(
        Qos(
            reliability=profile.reliability.name.lower(),
            durability=profile.durability.name.lower(),
            history=profile.history.name.lower(),
            depth=profile.depth,
        )
        for profile in profiles
    )
