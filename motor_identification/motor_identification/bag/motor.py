"""Reads one motor's recording out of any bag, and says in sentences what is wrong with a bag that has none."""

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import numpy as np

from motor_identification.bag.cdr import INFO_TYPE, ROW, SPEED_TYPE, Rows, SpeedDecoder, Undecodable, decode_info
from motor_identification.bag.definition import installed
from motor_identification.bag.storage import Bag, Messages, tell_damage
from motor_identification.bag.topic import Topic, absolute_name
from motor_identification.recording import Recording, check
from motor_model.errors import RecordingError
from motor_model.sample import Info

_BATCH = 65_536  # messages decoded at a time: keeps memory at twice that of the arrays, however long the bag
_BEHIND_STAMP = 12  # bytes: encapsulation, seconds, nanoseconds
_SPEED = "motor/speed"
_INFO = "motor/info"


def read_recording(uri: str | Path, topic_namespace: str = "", start: float = 0.0, stop: float = 0.0) -> Recording:
    """Read the samples on `motor/speed` with the latest `motor/info`, in the order of the log.

    Args:
        uri: a rosbag2 directory (MCAP or sqlite3, compressed or not, with or without metadata.yaml) or a storage file.
        topic_namespace: the namespace that the plant ran in, `/` for none; empty: none, or the only one in the bag that
            has a motor, which a note says then.
        start: [s] after the first sample; what lies outside of start and stop is not checked either.
        stop: [s] after the first sample; 0, 0 is all of it.

    Raises:
        RecordingError: no such bag, no bag, an empty one, one without this motor, one that identification cannot use.
    """
    return check(read_motor(Bag(uri), topic_namespace).between(start, stop))


def read_motor(bag: Messages, topic_namespace: str) -> Recording:
    """Read the same out of messages, wherever they are; not checked.

    Raises:
        RecordingError: none is of this motor, or they cannot be understood.
    """
    rows, infos, info_topic = _motor(bag, topic_namespace)
    notes: list[str] = []
    only = _only_namespace(bag)
    if len(rows) == 0 and not topic_namespace and only:
        rows, infos, info_topic = _motor(bag, only)
        notes = [f"{bag.uri} has one motor, in the namespace {only}: that one is used."]
    if len(rows) == 0:
        raise _nothing(bag, absolute_name(topic_namespace, _SPEED))
    kept, repeats = _without_repeats(rows, bag.uri)
    notes = [*repeats, *notes]
    if bag.cut:
        span = float(kept["sample_time"][-1] - kept["sample_time"][0]) * 1e-9
        notes = [f"{bag.uri} is cut off: {len(kept)} samples, {span:.2f} s up to the cut.", *notes]
    if damage := tell_damage(bag, bag.uri):
        notes.append(damage)
    if bag.garbled:
        notes.append(f"{bag.uri}: {bag.garbled} messages are garbled and were left out.")
    if bag.missing:
        notes.append(
            f"{bag.uri} lacks {_listed(bag.missing)}, which its metadata.yaml lists: those samples are missing."
        )
    info = _info(infos, kept, info_topic, bag.uri, notes)
    return _recording(bag.uri, info, kept, tuple(notes))


def _motor(bag: Messages, namespace: str) -> tuple[Rows, list[Info], str]:
    """Samples and infos of the motor in a namespace, and the name of its info's topic."""
    info_topic = absolute_name(namespace, _INFO)
    try:
        return *_read(bag, absolute_name(namespace, _SPEED), info_topic), info_topic
    except Undecodable as error:
        raise RecordingError(
            f"{bag.uri} cannot be read: {error}; record it again with this version of motor_msgs."
        ) from error


def _read(bag: Messages, speed_topic: str, info_topic: str) -> tuple[Rows, list[Info]]:
    """All samples, and all different infos in the order of their latest appearance."""
    batches: list[Rows] = []
    pending: list[bytes] = []
    infos: dict[Info, None] = {}  # in the order of their latest appearance; where only stamps differ, they are one
    seen: dict[bytes, Info] = {}
    decoder: SpeedDecoder | None = None
    for topic, _, data in bag.messages({speed_topic, info_topic}):
        if topic.name == info_topic:
            info = _known_info(data, _typed(topic, INFO_TYPE, bag.uri), seen)
            infos.pop(info, None)
            infos[info] = None
            continue
        if decoder is None:
            decoder = SpeedDecoder(_definition(_typed(topic, SPEED_TYPE, bag.uri)))
        pending.append(data)
        if len(pending) == _BATCH:
            batches.append(_decoded(decoder, pending, bag))
            pending = []
    if decoder is not None:
        batches.append(_decoded(decoder, pending, bag))
    return (np.concatenate(batches) if batches else np.zeros(0, ROW)), list(infos)


def _decoded(decoder: SpeedDecoder, pending: list[bytes], bag: Messages) -> Rows:
    rows = decoder.rows(pending)
    bag.garbled += len(pending) - len(rows)
    return rows


def _known_info(data: bytes, topic: Topic, seen: dict[bytes, Info]) -> Info:
    """The info in a message, decoded once for all that differ in nothing but their stamps."""
    rest = data[:4] + data[_BEHIND_STAMP:]
    if rest not in seen:
        seen[rest] = decode_info(data, _definition(topic))
    return seen[rest]


def _typed(topic: Topic, type_name: str, uri: str) -> Topic:
    if topic.type_name != type_name:
        raise RecordingError(
            f"{uri}: {topic.name} carries {topic.type_name or 'messages without a type'}, not {type_name}: "
            "record the topic of a plant (motor_sim or motor_driver)."
        )
    return topic


def _definition(topic: Topic) -> str:
    """The definition in the bag, which fits its messages whatever version of it is installed."""
    return topic.definition or installed(topic.type_name).text


def _nothing(bag: Messages, speed_topic: str) -> RecordingError:
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
    suffix = f"/{_SPEED}"
    return sorted(topic.name[: -len(suffix)] or "/" for topic in topics if topic.name.endswith(suffix))


def _only_namespace(bag: Messages) -> str:
    """The namespace of the only motor in a bag that has been read; empty where there are several, or none."""
    there = _namespaces(bag.topics.values())
    return there[0] if len(there) == 1 else ""


def _elsewhere(topics: Iterable[Topic]) -> str:
    """Where else in the bag a motor may be."""
    others = _namespaces(topics)
    if others:
        choices = " or ".join(f"--topic-namespace {namespace}" for namespace in others)
        return f"it has that of another namespace: say {choices}."
    return f"it has {_listed(sorted(topic.name for topic in topics))}: record {_SPEED} too."


def _listed(names: list[str]) -> str:
    """Name ten of them at most, and say how many more there are."""
    return ", ".join(names[:10]) + (f" and {len(names) - 10} more" if len(names) > 10 else "")


def _without_repeats(rows: Rows, uri: str) -> tuple[Rows, list[str]]:
    """Drop messages that are there twice; a clock that really steps back is left for `check` to tell."""
    time, stamp = rows["sample_time"], rows["stamp"]
    if np.all(np.diff(time) > 0):
        return rows, []
    order = np.lexsort((stamp, time))  # stable: of two alike, the first in the log stays
    alike = (np.diff(time[order]) == 0) & (np.diff(stamp[order]) == 0)
    keep = np.ones(len(rows), dtype=np.bool_)
    keep[order[1:][alike]] = False
    kept = rows[keep]
    kept = kept[np.concatenate(([True], np.diff(kept["sample_time"]) != 0))]
    dropped = len(rows) - len(kept)
    return kept, [f"{uri} has {dropped} samples more than once; the repeats were dropped."] if dropped else []


def _info(infos: list[Info], rows: Rows, info_topic: str, uri: str, notes: list[str]) -> Info:
    """The latest info, or defaults; adds to the notes what the user has to know about that."""
    if len(infos) > 1:
        notes.append(f"{uri}: {info_topic} changes during the recording; the latest is used for all of it.")
    if infos:
        return infos[-1]
    info = Info()
    if len(rows) > 1:
        info = replace(info, sample_period=float(np.median(np.diff(rows["sample_time"]))) * 1e-9)
    notes.append(
        f"{uri} has no {info_topic}; assumed: {info.edges_per_revolution} stamped edges per revolution on one channel, "
        f"{info.edge_resolution * 1e6:g} µs resolution, {info.max_voltage:g} V at full duty."
    )
    return info


def _recording(uri: str, info: Info, rows: Rows, notes: tuple[str, ...]) -> Recording:
    columns = {name: np.ascontiguousarray(rows[name]) for name in rows.dtype.names or () if name != "stamp"}
    return Recording(uri=uri, info=info, notes=notes, **columns)
