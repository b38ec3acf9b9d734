"""Decodes serialised `MotorSpeed` messages by the ten thousand, and single `MotorInfo` messages.

CDR puts a number at a multiple of its size, counted from behind the 4-byte encapsulation header. In `MotorSpeed` only
the header's frame_id has a variable length, so all messages with equally long frame_ids have one layout, and NumPy
reads them in one go: one message at a time would cost an hour's recording (720,000 messages) most of a minute.
"""

import struct
from collections.abc import Mapping, Sequence
from dataclasses import fields
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from motor_identification.bag.interface_grammar import Field, NotOfGrammar, parse
from motor_model.errors import MotorError
from motor_model.printable import escape
from motor_model.sample import Info, Measurement, Sample, check_info

SPEED_TYPE = "motor_msgs/msg/MotorSpeed"
INFO_TYPE = "motor_msgs/msg/MotorInfo"

_ENCAPSULATION = 4  # [bytes]
_FRAME_ID = 16  # where its characters begin: behind encapsulation, stamp and length
# Types of one size, by names that ROS and NumPy share.
_PRIMITIVES: dict[str, "np.dtype[Any]"] = {
    "bool": np.dtype(np.bool_),
    **dict.fromkeys(("byte", "char"), np.dtype(np.uint8)),
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
        """Decode messages; shape (K,), dtype ROW, in the order given, without those that are garbled.

        Raises:
            Undecodable: all of them are shorter than their type, or not plain CDR.
        """
        rows = _default_rows(len(messages))
        readable = np.ones(len(messages), dtype=np.bool_)
        refusal = None
        for (length, encapsulation, count), where in _alike(messages).items():
            try:
                layout = self._layout(length, *_head(encapsulation, count))
            except Undecodable as error:
                readable[where], refusal = False, error
                continue
            data = np.frombuffer(b"".join([messages[k] for k in where]), dtype=layout)
            for name in set(layout.names or ()) & set(ROW.names or ()):
                rows[name][where] = data[name]
            seconds: NDArray[np.int64] = data["sec"].astype(np.int64)
            rest: NDArray[np.int64] = data["nanosec"].astype(np.int64)
            rows["stamp"][where] = seconds * 1_000_000_000 + rest
        if refusal is not None and not readable.any():
            raise refusal
        return rows[readable]

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
    """Decode the plain value of a serialised `MotorInfo`; fields that its definition lacks keep their defaults.

    Raises:
        Undecodable: the message or its definition cannot be understood.
    """
    try:
        values = _values(message, parse(definition, INFO_TYPE))
        known = {field.name: values[field.name] for field in fields(Info) if field.name in values}
        named = {key: escape(value) for key, value in known.items() if isinstance(value, str)}
        info = Info(**{**known, **named, "measurement": Measurement(known["measurement"])})
        check_info(info)
        return info
    except (NotOfGrammar, KeyError, ValueError, TypeError, struct.error, MotorError) as error:
        raise Undecodable(f"a message of {INFO_TYPE} cannot be decoded ({error})") from error


def _values(message: bytes, types: Mapping[str, Sequence[Field]]) -> dict[str, Any]:
    """The texts and numbers of a message behind its header, up to the first field that is neither."""
    endian, count = _head(message[:2], message[12:16])
    position = _FRAME_ID + count
    values: dict[str, Any] = {}
    for field in types[INFO_TYPE][1:]:
        if field.count != 1 or not (field.type_name == "string" or field.type_name in _PRIMITIVES):
            break
        size = 4 if field.type_name == "string" else _PRIMITIVES[field.type_name].itemsize
        position += -(position - _ENCAPSULATION) % size
        if position >= len(message):
            break  # of an earlier version, which had fewer fields
        if field.type_name == "string":
            (length,) = struct.unpack_from(f"{endian}I", message, position)
            position += 4
            if position + length > len(message):
                raise ValueError("a text ends behind its end")
            text = message[position : position + length].removesuffix(b"\0")
            values[field.name] = text.decode(errors="backslashreplace")  # a name is shown, whatever it is
            position += length
        else:
            kind = _PRIMITIVES[field.type_name].newbyteorder(endian)
            if position + size > len(message):
                raise ValueError("it is too short")
            values[field.name] = np.frombuffer(message, kind, 1, position)[0].item()
            position += size
    return values


def _alike(messages: Sequence[bytes]) -> dict[tuple[int, bytes, bytes], list[int]]:
    """Positions of messages that share a layout, by length, encapsulation and length of the frame_id."""
    groups: dict[tuple[int, bytes, bytes], list[int]] = {}
    for k, message in enumerate(messages):
        groups.setdefault((len(message), message[:2], message[12:16]), []).append(k)
    return groups


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
        described = parse(definition, SPEED_TYPE)[SPEED_TYPE]
    except NotOfGrammar as error:
        raise Undecodable(f"its definition of {SPEED_TYPE} cannot be understood ({error})") from error
    if not described or (described[0].type_name, described[0].count) != ("std_msgs/msg/Header", 1):
        raise Undecodable(f"its {SPEED_TYPE} does not begin with a header")
    found = []
    for field in described[1:]:
        primitive = _PRIMITIVES.get(field.type_name) if field.count == 1 else None
        if primitive is None:
            break
        found.append((field.name, primitive))
    return found
