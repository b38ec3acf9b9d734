"""Decodes serialised `MotorSpeed` messages by the ten thousand, and single `MotorInfo` messages.

CDR puts a number at a multiple of its size, counted from behind the 4-byte encapsulation header. In `MotorSpeed` only
the header's frame_id has a variable length, so all messages with equally long frame_ids have one layout, and NumPy
reads them in one go: one message at a time would cost an hour's recording (720,000 messages) most of a minute.
"""

import struct
from collections.abc import Sequence
from dataclasses import fields
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from rosbags.serde import SerdeError
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.base import TypesysError

from motor_model.sample import Info, Measurement, Sample

SPEED_TYPE = "motor_msgs/msg/MotorSpeed"
INFO_TYPE = "motor_msgs/msg/MotorInfo"

_ENCAPSULATION = 4  # [bytes]
_FRAME_ID = 16  # where its characters begin: behind encapsulation, stamp and length
# Types of one size, by names that ROS and NumPy share.
_PRIMITIVES: dict[object, "np.dtype[Any]"] = {
    "bool": np.dtype(np.bool_),
    **{f"{kind}{bits}": np.dtype(f"{kind}{bits}") for kind in ("int", "uint") for bits in (8, 16, 32, 64)},
    **{f"float{bits}": np.dtype(f"float{bits}") for bits in (32, 64)},
}
_REQUIRED = ("sample_time", "speed", "voltage")
# One row per message: all fields of Sample, and the header's stamp [ns].
ROW = np.dtype([(field.name, "i8" if field.type is int else "f8") for field in fields(Sample)] + [("stamp", "i8")])

Rows = NDArray[np.void]
Endian = Literal["<", ">"]

_ENDIAN: dict[bytes, Endian] = {b"\x00\x00": ">", b"\x00\x01": "<"}  # by the first two bytes of the encapsulation


class Undecodable(Exception):
    """Bytes that are not the message that their topic says they are."""


class SpeedDecoder:
    """Reads messages of one definition of `MotorSpeed`; fields that it has more are skipped, optional ones may lack.

    Raises:
        Undecodable: the definition cannot be understood or lacks a field that identification needs.
    """

    def __init__(self, definition: str) -> None:
        self._fields = _fixed_fields(definition)
        lacking = [name for name in _REQUIRED if name not in dict(self._fields)]
        if lacking:
            raise Undecodable(f"its {SPEED_TYPE} has no {', '.join(lacking)} in a place that can be read")

    def rows(self, messages: Sequence[bytes]) -> Rows:
        """Decode messages; shape (K,), dtype ROW, in the order given.

        Raises:
            Undecodable: a message is shorter than its type, or not plain CDR.
        """
        rows = _default_rows(len(messages))
        for (length, endian, frame_id_length), where in _alike(messages).items():
            layout = self._layout(length, endian, frame_id_length)
            data = np.frombuffer(b"".join([messages[k] for k in where]), dtype=layout)
            for name in set(layout.names or ()) & set(ROW.names or ()):
                rows[name][where] = data[name]
            rows["stamp"][where] = data["sec"].astype(np.int64) * 1_000_000_000 + data["nanosec"]
        return rows

    def _layout(self, length: int, endian: Endian, frame_id_length: int) -> "np.dtype[np.void]":
        """Where each field stands in a message of so many bytes."""
        names, formats, offsets = ["sec", "nanosec"], [f"{endian}i4", f"{endian}u4"], [4, 8]
        position = _FRAME_ID + frame_id_length
        for name, primitive in self._fields:
            position += -(position - _ENCAPSULATION) % primitive.itemsize
            names.append(name)
            formats.append(primitive.newbyteorder(endian).str)
            offsets.append(position)
            position += primitive.itemsize
        if position > length:
            raise Undecodable(f"a message of {length} bytes is too short for {SPEED_TYPE}")
        return np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": length})


def decode_info(message: bytes, definition: str) -> Info:
    """The plain value of a serialised `MotorInfo`; fields that its definition lacks keep their defaults.

    Raises:
        Undecodable: the message or its definition cannot be understood.
    """
    store = get_typestore(Stores.EMPTY)
    try:
        store.register(get_types_from_msg(definition, INFO_TYPE))
        content: Any = store.deserialize_cdr(message, INFO_TYPE)
        values = {field.name: getattr(content, field.name) for field in fields(Info) if hasattr(content, field.name)}
        return Info(**{**values, "measurement": Measurement(values["measurement"])})
    except (TypesysError, SerdeError, KeyError, ValueError, IndexError, struct.error) as error:
        raise Undecodable(f"a message of {INFO_TYPE} cannot be decoded ({error})") from error


def _alike(messages: Sequence[bytes]) -> dict[tuple[int, Endian, int], list[int]]:
    """Positions of messages that share a layout, by length, byte order and length of the frame_id."""
    groups: dict[tuple[int, bytes, bytes], list[int]] = {}
    for k, message in enumerate(messages):
        groups.setdefault((len(message), message[:2], message[12:16]), []).append(k)
    return {(length, *_head(kind, count)): where for (length, kind, count), where in groups.items()}


def _head(encapsulation: bytes, count: bytes) -> tuple[Endian, int]:
    endian = _ENDIAN.get(encapsulation)
    if endian is None or len(count) < 4:
        raise Undecodable(f"a message on the topic of {SPEED_TYPE} is not plain CDR")
    return endian, int(struct.unpack(f"{endian}I", count)[0])


def _default_rows(count: int) -> Rows:
    rows = np.zeros(count, ROW)
    rows["supply_voltage"] = rows["current"] = np.nan
    return rows


def _fixed_fields(definition: str) -> list[tuple[str, "np.dtype[Any]"]]:
    """Fields behind the header up to the first that has no fixed size, in their order."""
    try:
        (_, described) = get_types_from_msg(definition, SPEED_TYPE)[SPEED_TYPE]
    except (TypesysError, KeyError) as error:
        raise Undecodable(f"its definition of {SPEED_TYPE} cannot be understood ({error})") from error
    if not described or described[0][1][1] != "std_msgs/msg/Header":
        raise Undecodable(f"its {SPEED_TYPE} does not begin with a header")
    found = []
    for name, (_, kind) in described[1:]:
        primitive = _PRIMITIVES.get(kind[0]) if isinstance(kind, tuple) else None
        if primitive is None:
            break
        found.append((name, primitive))
    return found
