"""What is in a bag: topics, rates, and the fields whose numbers change, with their values over time."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from motor_identification.bag.fields import FieldPath, Sampled, list_fields, parse_path, read_value, sample_topics
from motor_identification.logs.signals import Floats, Integers

DECODED = 3000  # messages of each topic: at 200 Hz a quarter of a minute
MOST_FIELDS = 40  # of one topic
LATEST = 2**63 - 1  # [ns] of a time of arrival; a file may say more


@dataclass(frozen=True)
class Field:
    """A number that changes; arrays of shape (K,)."""

    path: FieldPath
    time: Integers  # [ns] stamps, or arrivals
    values: Floats


@dataclass(frozen=True)
class TopicRow:
    """One topic."""

    name: str
    type_name: str
    messages: int
    rate: float  # [Hz] 0 for a single message
    jitter: float  # [s] of arrival
    stamped: bool
    fields: tuple[Field, ...]
    trouble: str


def take_inventory(uri: str | Path) -> list[TopicRow]:
    """List the topics of a bag with the fields that change.

    Raises:
        RecordingError: no such bag.
    """
    return [_row(sampled) for sampled in sample_topics(uri, DECODED)]


def _row(sampled: Sampled) -> TopicRow:
    instants = [min(at, LATEST) for at in sampled.received]
    steps = np.diff(np.array(instants, np.int64)) * 1e-9
    period = float(np.median(steps)) if len(steps) else 0.0
    stamped = bool(sampled.stamps) and all(stamp > 0 for stamp in sampled.stamps)
    received = instants[: len(sampled.messages)]
    time = np.array(sampled.stamps if stamped else received, np.int64)
    return TopicRow(
        name=sampled.topic.name,
        type_name=sampled.topic.type_name,
        messages=len(sampled.received),
        rate=1.0 / period if period > 0.0 else 0.0,
        jitter=float(np.std(steps)) if len(steps) else 0.0,
        stamped=stamped,
        fields=tuple(_fields(sampled, time)),
        trouble=sampled.trouble,
    )


def _fields(sampled: Sampled, time: Integers) -> list[Field]:
    if not sampled.messages:
        return []
    names = list_fields(sampled.messages[0])[: 5 * MOST_FIELDS]
    return _changing(sampled, names, time)[:MOST_FIELDS]


def _changing(sampled: Sampled, names: Sequence[str], time: Integers) -> list[Field]:
    found = []
    for name in names:
        path = parse_path(f"{sampled.topic.name}:{name}")
        rows = [(when, read_value(message, path.steps)) for when, message in zip(time, sampled.messages, strict=False)]
        known = [(when, value) for when, value in rows if value is not None]
        values = np.array([value for _, value in known], dtype=np.float64)
        if len(values) > 1 and np.ptp(values) > 0.0:
            found.append(Field(path, np.array([when for when, _ in known], np.int64), values))
    return found
