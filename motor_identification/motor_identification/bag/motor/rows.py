"""Reads the messages of one motor: all its samples as rows, and all that was said of it."""

import numpy as np

from motor_identification.bag.definition import installed
from motor_identification.bag.motor.cdr import (
    INFO_TYPE,
    ROW,
    SPEED_TYPE,
    Rows,
    SpeedDecoder,
    Undecodable,
    decode_info,
)
from motor_identification.bag.storage import Messages
from motor_identification.bag.topic import Topic, absolute_name
from motor_model.errors import RecordingError
from motor_model.sample import Info

_BATCH = 65_536  # messages decoded at a time: keeps memory at twice that of the arrays, however long the bag
_BEHIND_STAMP = 12  # bytes: encapsulation, seconds, nanoseconds
SPEED_TOPIC = "motor/speed"
INFO_TOPIC = "motor/info"


def read_motor_rows(bag: Messages, namespace: str) -> tuple[Rows, list[Info], str]:
    """Samples and infos of the motor in a namespace, and the name of its info's topic."""
    info_topic = absolute_name(namespace, INFO_TOPIC)
    try:
        return *_read(bag, absolute_name(namespace, SPEED_TOPIC), info_topic), info_topic
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
