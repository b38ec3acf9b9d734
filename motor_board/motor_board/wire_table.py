"""The wire's normative table as values, and frames packed straight from it: what both real codecs are held against."""

import struct
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from motor_board.places import share
from motor_model import yaml_file

LETTERS = {"u8": "B", "i8": "b", "u16": "H", "i16": "h", "u32": "I", "i32": "i"}


@dataclass(frozen=True)
class Field:
    """One number of a frame."""

    name: str
    type: str  # u8 … i32
    about: str = ""

    @property
    def size(self) -> int:
        """[byte]."""
        return struct.calcsize("<" + LETTERS[self.type])


@dataclass(frozen=True)
class FrameRow:
    """One kind of frame."""

    name: str
    type: int
    sender: str  # host | board
    about: str
    own: tuple[Field, ...]
    extends: "FrameRow | None" = None  # the kind whose fields come before its own

    @property
    def fields(self) -> tuple[Field, ...]:
        """Of the body."""
        return (*self.extends.fields, *self.own) if self.extends else self.own

    @property
    def layout(self) -> str:
        """Of the body, as the `struct` module writes it."""
        return "<" + "".join(LETTERS[field.type] for field in self.fields)


@dataclass(frozen=True)
class WireTable:
    """The whole table."""

    version: int
    baud: int
    longest_frame: int  # [byte]
    frames: tuple[FrameRow, ...]
    values: Mapping[str, Mapping[str, int]]
    bits: Mapping[str, Mapping[str, int]]

    def frame(self, name: str) -> FrameRow:
        """The row of that name."""
        return next(row for row in self.frames if row.name == name)

    def data(self, name: str, seq: int, values: Mapping[str, int], version: int | None = None) -> bytes:
        """Header and body of a frame."""
        row = self.frame(name)
        header = struct.pack("<BBH", self.version if version is None else version, row.type, seq)
        return header + struct.pack(row.layout, *(values[field.name] for field in row.fields))


def _field(row: Mapping[str, Any]) -> Field:
    unit = f"[{row['unit']}] " if "unit" in row else ""
    return Field(row["name"], row["type"], (unit + row.get("about", row.get("bits", row.get("values", "")))).strip())


def load_table(path: Path | None = None) -> WireTable:
    """Read wire.yaml."""
    raw = yaml_file.read(path or share() / "protocol" / "wire.yaml")
    rows: dict[str, FrameRow] = {}
    for name, row in raw["frames"].items():
        own, before = tuple(map(_field, row["fields"])), rows.get(row.get("extends", ""))
        rows[name] = FrameRow(name, row["type"], row["from"], row["about"], own, before)
    frames = tuple(rows.values())
    return WireTable(raw["version"], raw["baud"], raw["longest_frame"], frames, raw["values"], raw["bits"])


def seal(data: bytes) -> bytes:
    """Header and body as they go on the wire: CRC, COBS and the closing zero, bit by bit as their definitions say."""
    crc = 0xFFFFFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0xEDB88320 if crc & 1 else 0)
    crc ^= 0xFFFFFFFF
    rest, out = data + struct.pack("<I", crc) + b"\0", b""
    while rest:
        run = rest.index(0)
        out += bytes([run + 1]) + rest[:run]
        rest = rest[run + 1 :]
    return out + b"\0"
