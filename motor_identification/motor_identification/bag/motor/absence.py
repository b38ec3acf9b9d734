"""Says why a bag has no samples of a motor, and where in it there may be some."""

from collections.abc import Iterable

from motor_identification.bag.motor.rows import SPEED_TOPIC
from motor_identification.bag.storage import Messages
from motor_identification.bag.topic import Topic
from motor_model.errors import RecordingError


def explain_absence(bag: Messages, speed_topic: str) -> RecordingError:
    """Why there is no sample, and what to do."""
    if bag.damaged and speed_topic not in bag.topics:
        return RecordingError(f"{bag.uri} is damaged before the first sample on {speed_topic}: restore it from a copy.")
    if bag.cut and speed_topic not in bag.topics:
        return RecordingError(f"{bag.uri} is cut off before the first sample on {speed_topic}: record it again.")
    if not bag.topics:
        return RecordingError(f"{bag.uri} is an empty bag: record while a plant (motor_sim or motor_driver) runs.")
    if speed_topic in bag.topics:
        return RecordingError(f"{bag.uri} has no message on {speed_topic}: record while a plant publishes.")
    return RecordingError(f"{bag.uri} has no {speed_topic}: {_elsewhere(bag.topics.values())}")


def _namespaces(topics: Iterable[Topic]) -> list[str]:
    """The namespaces in a bag that have a motor, `/` for none."""
    suffix = f"/{SPEED_TOPIC}"
    return sorted(topic.name[: -len(suffix)] or "/" for topic in topics if topic.name.endswith(suffix))


def find_only_namespace(bag: Messages) -> str:
    """The namespace of the only motor in a bag that has been read; empty where there are several, or none."""
    there = _namespaces(bag.topics.values())
    return there[0] if len(there) == 1 else ""


def _elsewhere(topics: Iterable[Topic]) -> str:
    """Where else in the bag a motor may be."""
    others = _namespaces(topics)
    if others:
        choices = " or ".join(f"--topic-namespace {namespace}" for namespace in others)
        return f"it has that of another namespace: say {choices}."
    return f"it has {list_names(sorted(topic.name for topic in topics))}: record {SPEED_TOPIC} too."


def list_names(names: list[str]) -> str:
    """Name ten of them at most, and say how many more there are."""
    return ", ".join(names[:10]) + (f" and {len(names) - 10} more" if len(names) > 10 else "")
