"""Samples as serialised messages, a column at a time: one message at a time costs a long log minutes.

CDR puts a number at a multiple of its size, counted from behind the 4-byte encapsulation header; with one motor's name,
all messages of a type have one layout.
"""

from collections.abc import Sequence
from dataclasses import fields

import numpy as np
from numpy.typing import NDArray

from motor_model.sample import Sample

_ENCAPSULATION = b"\0\1\0\0"  # plain CDR, little endian
_FRAME_ID = 16  # behind encapsulation, stamp and the length of the frame_id


def speed_messages(samples: Sequence[Sample], stamps: NDArray[np.int64], name: str) -> list[bytes]:
    """Serialise samples as `motor_msgs/msg/MotorSpeed`; stamps [ns] of shape (K,)."""
    columns = [
        (field.name, "<i8" if field.type is int else "<f8", [getattr(sample, field.name) for sample in samples])
        for field in fields(Sample)
    ]
    return _messages(columns, stamps, name)


def voltage_messages(samples: Sequence[Sample], stamps: NDArray[np.int64], name: str) -> list[bytes]:
    """Serialise the voltages of samples as `motor_msgs/msg/MotorVoltage`; stamps [ns] of shape (K,)."""
    return _messages([("voltage", "<f8", [sample.voltage for sample in samples])], stamps, name)


def _messages(columns: Sequence[tuple[str, str, Sequence[float]]], stamps: NDArray[np.int64], name: str) -> list[bytes]:
    text = name.encode() + b"\0"
    begin = _FRAME_ID + len(text)
    begin += -(begin - len(_ENCAPSULATION)) % 8
    names = ["head", "sec", "nanosec", "length", "frame_id", *(column for column, _, _ in columns)]
    formats = ["S4", "<i4", "<u4", "<u4", f"S{len(text)}", *(kind for _, kind, _ in columns)]
    offsets = [0, 4, 8, 12, _FRAME_ID, *(begin + 8 * k for k in range(len(columns)))]
    size = begin + 8 * len(columns)
    rows = np.zeros(len(stamps), np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": size}))
    rows["head"], rows["length"], rows["frame_id"] = _ENCAPSULATION, len(text), text
    rows["sec"], rows["nanosec"] = stamps // 10**9, stamps % 10**9
    for column, _, values in columns:
        rows[column] = values
    data = rows.tobytes()
    return [data[k : k + size] for k in range(0, len(data), size)]
