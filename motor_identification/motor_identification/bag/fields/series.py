"""The values of fields over the time of a bag."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from motor_identification.bag.fields.decoder import Garbled, make_decoder
from motor_identification.bag.fields.path import FieldPath
from motor_identification.bag.fields.values import list_fields, read_header_stamp, read_value
from motor_identification.bag.storage import Bag
from motor_identification.bag.topic import Topic
from motor_model.errors import RecordingError

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Row = tuple[int, int, float]  # received, stamp, value


@dataclass(frozen=True)
class Series:
    """A field's values, arrays of shape (K,) in the order of the bag; messages without a number there are left out."""

    path: FieldPath
    received: Integers  # [ns] when the recorder had the message
    stamp: Integers  # [ns] of the message's header; `received` where it has none
    values: Floats
    has_header: bool
    garbled: int = 0  # messages on the topic that could not be decoded


@dataclass
class Sampled:
    """What is on a topic: how many messages, when they were received, and the first of them."""

    topic: Topic
    received: list[int] = field(default_factory=list)  # [ns]
    messages: list[Any] = field(default_factory=list)
    stamps: list[int] = field(default_factory=list)  # [ns] of the messages' headers, 0 without one
    trouble: str = ""  # why there is no message


def read_fields(uri: str | Path, paths: Sequence[FieldPath]) -> list[Series]:
    """Read fields of a bag's messages.

    Raises:
        RecordingError: no such bag, topic or field, or its messages cannot be understood.
    """
    bag = Bag(uri)
    return collect_fields(bag.messages({path.topic for path in paths}), paths, bag.uri, bag.topics)


def collect_fields(
    messages: Iterable[tuple[Topic, int, bytes]], paths: Sequence[FieldPath], name: str, topics: Iterable[str]
) -> list[Series]:
    """Collect fields of messages: topic, when it was received [ns], serialised; from a bag or just heard.

    name: what they are from; topics: which ones that has, asked for once all messages are read.

    Raises:
        RecordingError: no message on a topic, no such field, or the messages cannot be understood.
    """
    rows: dict[FieldPath, list[Row]] = {path: [] for path in paths}
    last: dict[str, Any] = {}
    garbled: dict[str, int] = {}
    for topic, received, data in messages:
        try:
            message = make_decoder(topic)(data)
        except Garbled:
            garbled[topic.name] = garbled.get(topic.name, 0) + 1
            continue
        last[topic.name], stamp = message, read_header_stamp(message)
        for path in rows:
            value = read_value(message, path.steps) if path.topic == topic.name else None
            if value is not None:
                rows[path].append((received, stamp, value))
    return [_series(name, topics, path, rows[path], last, garbled.get(path.topic, 0)) for path in paths]


def sample_topics(uri: str | Path, most: int) -> list[Sampled]:
    """Read the times of all messages of a bag, and decode up to `most` messages of every topic.

    Raises:
        RecordingError: no such bag.
    """
    sampled: dict[str, Sampled] = {}
    for topic, received, data in Bag(uri).messages(None):
        there = sampled.setdefault(topic.name, Sampled(topic))
        there.received.append(received)
        if len(there.messages) >= most or there.trouble:
            continue
        try:
            message = make_decoder(topic)(data)
        except RecordingError as error:
            there.trouble = str(error)
        except Garbled:
            continue
        else:
            there.messages.append(message)
            there.stamps.append(read_header_stamp(message))
    return sorted(sampled.values(), key=lambda one: one.topic.name)


def _series(
    name: str, topics: Iterable[str], path: FieldPath, rows: Sequence[Row], last: Mapping[str, Any], garbled: int
) -> Series:
    if not rows:
        raise RecordingError(
            f"{name} has no number at {path}: {_instead(topics, path, last.get(path.topic), garbled)}."
        )
    received, stamp = (np.array([row[k] for row in rows], np.int64) for k in (0, 1))
    values = np.array([value for _, _, value in rows], dtype=np.float64)
    has_header = bool(np.all(stamp > 0))
    return Series(path, received, stamp if has_header else received, values, has_header, garbled)


def _instead(topics: Iterable[str], path: FieldPath, message: Any, garbled: int) -> str:
    """What there is instead."""
    if garbled and message is None:
        return f"none of the {garbled} messages on {path.topic} can be decoded"
    if message is None:
        return f"it has the topics {', '.join(sorted(topics)[:12]) or '(none)'}"
    return f"{path.topic} has {', '.join(list_fields(message)[:12]) or 'no numbers'}"
