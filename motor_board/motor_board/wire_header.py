"""Writes what follows from wire.yaml: firmware header and test vectors (`python -m motor_board.wire_header`)."""

import json
import random
from collections.abc import Iterator, Mapping
from pathlib import Path

from motor_board.places import share
from motor_board.wire_table import FrameRow, WireTable, load_table, seal

CTYPES = {"u8": "uint8_t", "i8": "int8_t", "u16": "uint16_t", "i16": "int16_t", "u32": "uint32_t", "i32": "int32_t"}
RANGES = {"u8": (0, 2**8 - 1), "u16": (0, 2**16 - 1), "i16": (-(2**15), 2**15 - 1), "u32": (0, 2**32 - 1)}

HEAD = """/* Generated from protocol/wire.yaml by `python -m motor_board.wire_header`; do not edit. */
#ifndef WIRE_H
#define WIRE_H

#include <stdint.h>
"""

PRIMITIVES = """
static inline uint8_t *wire_put_u8(uint8_t *at, uint8_t value) { *at = value; return at + 1; }
static inline uint8_t *wire_put_u16(uint8_t *at, uint16_t value)
{ return wire_put_u8(wire_put_u8(at, (uint8_t)value), (uint8_t)(value >> 8)); }
static inline uint8_t *wire_put_u32(uint8_t *at, uint32_t value)
{ return wire_put_u16(wire_put_u16(at, (uint16_t)value), (uint16_t)(value >> 16)); }
static inline uint8_t *wire_put_i16(uint8_t *at, int16_t value) { return wire_put_u16(at, (uint16_t)value); }

static inline uint8_t wire_get_u8(const uint8_t *at) { return at[0]; }
static inline uint16_t wire_get_u16(const uint8_t *at) { return (uint16_t)(at[0] | (uint16_t)((uint16_t)at[1] << 8)); }
static inline uint32_t wire_get_u32(const uint8_t *at)
{ return (uint32_t)wire_get_u16(at) | (uint32_t)wire_get_u16(at + 2) << 16; }
static inline int16_t wire_get_i16(const uint8_t *at) { return (int16_t)wire_get_u16(at); }
"""


def _constants(table: WireTable) -> Iterator[str]:
    yield f"#define WIRE_VERSION {table.version}u"
    yield f"#define WIRE_BAUD {table.baud}UL"
    yield f"#define WIRE_LONGEST_FRAME {table.longest_frame}u /* byte, the closing zero included */"
    for group, members in table.values.items():
        yield ""
        yield from (f"#define WIRE_{group.upper()}_{name.upper()} {number}u" for name, number in members.items())
    for group, members in table.bits.items():
        yield ""
        yield from (f"#define WIRE_{group.upper()}_{name.upper()} {1 << bit}u" for name, bit in members.items())


def _frame(row: FrameRow) -> Iterator[str]:
    name = row.name
    yield f"\n/* From the {row.sender}: {row.about}. */"
    yield f"#define WIRE_{name.upper()} 0x{row.type:02X}u"
    yield f"#define WIRE_{name.upper()}_SIZE {sum(field.size for field in row.fields)}u /* byte of body */"
    if row.extends:
        yield f"/* The body of {row.extends.name}, then:"
        yield from (f"   {CTYPES[field.type]} {field.name} {field.about}" for field in row.own)
        yield "*/"
        return
    if not row.fields:
        return
    yield f"struct wire_{name} {{"
    for field in row.fields:
        yield f"    {CTYPES[field.type]} {field.name};" + (f" /* {field.about} */" if field.about else "")
    yield "};"
    yield from _put(row) if row.sender == "board" else _get(row)


def _put(row: FrameRow) -> Iterator[str]:
    yield f"static inline uint8_t *wire_put_{row.name}(uint8_t *at, const struct wire_{row.name} *frame)"
    yield "{"
    yield from (f"    at = wire_put_{field.type}(at, frame->{field.name});" for field in row.fields)
    yield "    return at;"
    yield "}"


def _get(row: FrameRow) -> Iterator[str]:
    yield f"static inline void wire_get_{row.name}(const uint8_t *at, struct wire_{row.name} *frame)"
    yield "{"
    offset = 0
    for field in row.fields:
        yield f"    frame->{field.name} = wire_get_{field.type}(at + {offset});"
        offset += field.size
    yield "}"


def header(table: WireTable) -> str:
    """firmware/core/wire.h."""
    frames = [line for row in table.frames for line in _frame(row)]
    return "\n".join([HEAD, *_constants(table), PRIMITIVES.rstrip(), *frames, "", "#endif", ""])


def _example(table: WireTable, row: FrameRow, values: Mapping[str, int], seq: int) -> dict[str, object]:
    return {"frame": row.name, "seq": seq, "values": values, "wire": seal(table.data(row.name, seq, values)).hex()}


def vectors(table: WireTable) -> dict[str, object]:
    """protocol/vectors.json: frames with the bytes they make, and bytes that make no frame."""
    chance = random.Random(5)
    good = []
    for row in table.frames:
        for pick in (lambda low, high: 0, lambda low, high: low, lambda low, high: high, chance.randint):
            values = {field.name: pick(*RANGES[field.type]) for field in row.fields}
            good.append(_example(table, row, values, pick(*RANGES["u16"])))
    command = table.data("command", 7, {"duty": 100})
    whole = bytearray(seal(command))
    flipped = bytes([*whole[:5], whole[5] ^ 0x10, *whole[6:]])
    bad = {
        "one bit flipped": flipped,
        "one byte missing": bytes(whole[:5] + whole[6:]),
        "cut short by a zero": bytes(whole[:6]) + b"\0",
        "a type nobody knows": seal(command[:1] + b"\x7f" + command[2:]),
        "a byte too long": seal(command + b"\0"),
        "a byte too short": seal(command[:-1]),
        "a COBS code that points past the end": b"\x20" + bytes(whole[1:]),
        "longer than any frame": b"\x01" * (table.longest_frame + 20) + b"\0",
    }
    other = table.data("command", 7, {"duty": 100}, version=table.version + 1)
    return {
        "about": "generated from wire.yaml by `python -m motor_board.wire_header`; tests hold both sides to it",
        "good": good,
        "bad": [{"about": about, "wire": wire.hex()} for about, wire in bad.items()],
        "other_version": {"version": table.version + 1, "wire": seal(other).hex()},
    }


def files(root: Path | None = None) -> dict[Path, str]:
    """Return what follows from the table, by path."""
    root = root or share()
    table = load_table()
    return {
        root / "firmware" / "core" / "wire.h": header(table),
        root / "protocol" / "vectors.json": json.dumps(vectors(table), indent=1) + "\n",
    }


if __name__ == "__main__":
    for path, text in files().items():
        path.write_text(text, encoding="utf-8")
