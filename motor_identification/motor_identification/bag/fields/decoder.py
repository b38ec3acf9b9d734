"""Decodes messages of any type, by the definition in the bag, the installed one, or that of ROS 2 Jazzy."""

import struct
from collections.abc import Callable
from functools import lru_cache
from typing import Any

from rosbags.serde import SerdeError
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.base import TypesysError

from motor_identification.bag.definition import installed
from motor_identification.bag.interface_grammar import NotOfGrammar, parse
from motor_identification.bag.topic import Topic
from motor_model.errors import RecordingError

Decode = Callable[[bytes], Any]

_MOST_TYPES = 200  # whose decoders are kept
_BROKEN = (SerdeError, TypesysError, KeyError, ValueError, IndexError, OverflowError, struct.error, AssertionError)


class Garbled(Exception):
    """Bytes that are not the message that their topic says they are."""


def make_decoder(topic: Topic) -> Decode:
    """Make what decodes the messages of a topic; it raises Garbled where they are none.

    Raises:
        RecordingError: there is no definition of its type, or it cannot be understood.
    """
    return _decoder(topic.type_name, topic.definition)


@lru_cache(_MOST_TYPES)
def _decoder(type_name: str, definition: str) -> Decode:
    text = definition or installed(type_name).text
    store = get_typestore(Stores.EMPTY if text else Stores.ROS2_JAZZY)
    try:
        if text:
            parse(text, type_name)  # the library makes code of it
            store.register(get_types_from_msg(text, type_name))
    except (NotOfGrammar, TypesysError, KeyError, ValueError, SyntaxError, RecursionError) as error:
        raise RecordingError(f"The bag's definition of {type_name} cannot be understood ({error}).") from error
    if type_name not in store.fielddefs:
        raise RecordingError(
            f"The bag has no definition of {type_name or 'a message without a type'}, and it is not installed: record "
            "it as MCAP, which embeds definitions, or source the package that has it."
        )

    def decode(data: bytes) -> Any:
        try:
            return store.deserialize_cdr(data, type_name)
        except _BROKEN as error:
            raise Garbled(type_name) from error

    return decode
