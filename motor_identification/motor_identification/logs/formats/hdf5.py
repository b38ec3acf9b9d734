"""Read the arrays of an HDF5 file as MATLAB 7.3 writes it: groups of symbol tables, plain or chunked arrays, deflated.

What a file says of itself is checked before anything is read by it, as in `mat_elements`; what is of a newer kind, or
no number, text or reference, is left out. Names are those of the "HDF5 File Format Specification", version 2.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from math import prod
from struct import error as StructError
from struct import unpack_from
from typing import Any

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.formats.mat_elements import MOST_BYTES, MOST_ELEMENTS, BrokenFileError, TooLargeError

SIGNATURE = b"\x89HDF\r\n\x1a\n"
_PLACES = (0, 512, 1024, 2048)  # of the signature, behind what a program puts in front
_NONE = 2**64 - 1  # an address of nothing
_DEEPEST, _MOST_DIMENSIONS = 24, 8
_SPACE, _TYPE, _LAYOUT, _FILTERS, _ATTRIBUTE, _CONTINUED, _TABLE = 1, 3, 8, 11, 12, 16, 17
_DEFLATE, _SHUFFLE = 1, 2
_REFERENCE = 7  # class of a type


@dataclass(frozen=True)
class Array:
    """A dataset's numbers, in the order of its dimensions; of references, the addresses of what they mean."""

    values: NDArray[Any]
    attributes: dict[str, str]  # those that are texts, or whole numbers
    references: bool = False


@dataclass
class Hdf5:
    """All arrays of a file by their path, `group/array`; `paths` are those of the addresses of groups and arrays."""

    arrays: dict[str, Array] = field(default_factory=dict)
    paths: dict[int, str] = field(default_factory=dict)


@dataclass
class _File:
    data: memoryview
    base: int
    unpacked: int = 0
    objects: int = 0

    def read(self, layout: str, address: int) -> tuple[Any, ...]:
        """Numbers at an address."""
        try:
            if address < 0:
                raise BrokenFileError("an address cannot be")
            return unpack_from("<" + layout, self.data, self.base + address)
        except StructError as error:
            raise BrokenFileError("an address is beyond its end") from error

    def bytes(self, address: int, size: int) -> memoryview:
        """So many bytes at an address."""
        begin = self.base + address
        if address < 0 or size < 0 or begin + size > len(self.data):
            raise BrokenFileError("an address is beyond its end")
        return self.data[begin : begin + size]

    def grow(self, size: int) -> None:
        """Count what is unpacked."""
        self.unpacked += size
        if self.unpacked > MOST_BYTES:
            raise TooLargeError(f"more than {MOST_BYTES >> 20} MiB unpacked")

    def enter(self) -> None:
        """Count an object or a node."""
        self.objects += 1
        if self.objects > 5 * MOST_ELEMENTS:
            raise TooLargeError(f"more than {5 * MOST_ELEMENTS} objects")


@dataclass(frozen=True)
class _Type:
    kind: int  # class
    size: int
    numbers: str  # of numpy; empty where there is none


def read_hdf5(data: bytes) -> Hdf5:
    """Read all arrays of numbers, texts and references.

    Raises:
        BrokenFileError: an address, a size or a type cannot be.
        TooLargeError: it is unpacked more than 512 MiB, or has more than 100,000 objects.
    """
    try:
        return _read_file(data)
    except (StructError, IndexError, ValueError, OverflowError) as error:  # of a piece that is too short
        raise BrokenFileError("a size cannot be") from error


def _read_file(data: bytes) -> Hdf5:
    place = next((one for one in _PLACES if data[one : one + 8] == SIGNATURE), None)
    if place is None:
        raise BrokenFileError("it has no header")
    view = memoryview(data)
    head = _File(view, place)
    version, offsets, lengths = head.read("B4xBB", 8)
    if version > 1 or (offsets, lengths) != (8, 8):
        raise BrokenFileError("it is of a kind that is not known here")
    base = head.read("Q", 24 if version == 0 else 28)[0]
    root = head.read("Q", (56 if version == 0 else 60) + 8)[0]
    file = _File(view, base if base else 0)
    found = Hdf5()
    _read_object(file, root, "", found, 0)
    return found


def _read_object(file: _File, address: int, path: str, found: Hdf5, depth: int) -> None:
    """Read a group and all that is in it, or an array."""
    if depth > _DEEPEST:
        raise BrokenFileError("its groups are nested too deep")
    if address in found.paths:  # a second name of the same
        return
    file.enter()
    found.paths[address] = path
    messages = list(_messages(file, address))
    tables = [body for kind, body in messages if kind == _TABLE]
    if tables and len(tables[0]) >= 16:
        tree, heap = unpack_from("<QQ", tables[0])
        for name, child in _links(file, tree, heap, 0):
            _read_object(file, child, f"{path}/{name}" if path else name, found, depth + 1)
        return
    array = _read_array(file, messages)
    if array is not None:
        found.arrays[path] = array


def _messages(file: _File, address: int) -> Iterator[tuple[int, memoryview]]:
    """The messages of an object's header, in all of its blocks."""
    version, count, size = file.read("BxHxxxxI", address)
    if version != 1:
        return
    blocks = [(address + 16, size)]
    while blocks and count > 0:
        begin, size = blocks.pop(0)
        end = begin + size
        while begin + 8 <= end and count > 0:
            kind, length = file.read("HH", begin)
            body = file.bytes(begin + 8, length)
            count -= 1
            begin += 8 + length
            if kind == _CONTINUED and len(body) >= 16:
                place, more = unpack_from("<QQ", body)
                blocks.append((place, more))
            else:
                yield kind, body


def _links(file: _File, tree: int, heap: int, depth: int) -> Iterator[tuple[str, int]]:
    """Names and addresses in a group: a tree of symbol nodes, and a heap of names."""
    file.enter()
    if bytes(file.bytes(tree, 4)) != b"TREE" or depth > _DEEPEST:
        raise BrokenFileError("a group has no table")
    level, used = file.read("BH", tree + 5)
    names = file.read("Q", heap + 24)[0]
    for k in range(used):
        child = file.read("Q", tree + 24 + 16 * k + 8)[0]
        if level:
            yield from _links(file, child, heap, depth + 1)
            continue
        if bytes(file.bytes(child, 4)) != b"SNOD":
            raise BrokenFileError("a group has no table")
        for entry in range(file.read("H", child + 6)[0]):
            file.enter()
            offset, address = file.read("QQ", child + 8 + 40 * entry)
            yield _name(file, names + offset), address


def _name(file: _File, address: int) -> str:
    begin = file.base + address
    if not 0 <= begin < len(file.data):
        raise BrokenFileError("a name is beyond its end")
    return bytes(file.data[begin : begin + 256]).split(b"\0")[0].decode("utf-8", "replace")


def _read_array(file: _File, messages: list[tuple[int, memoryview]]) -> Array | None:
    """An array of numbers or references; None where it is something else."""
    bodies = dict(reversed(messages))  # the first of each kind
    if not {_SPACE, _TYPE, _LAYOUT} <= set(bodies):
        return None
    kind, shape = _type(bodies[_TYPE]), _shape(bodies[_SPACE])
    if not kind.numbers or shape is None or kind.size * prod(shape) > MOST_BYTES:
        return None
    raw = _contents(file, bodies[_LAYOUT], bodies.get(_FILTERS), kind, shape)
    if raw is None:
        return None
    attributes = dict(filter(None, (_attribute(body) for one, body in messages if one == _ATTRIBUTE)))
    return Array(np.frombuffer(raw, kind.numbers).reshape(shape), attributes, kind.kind == _REFERENCE)


def _type(body: memoryview) -> _Type:
    if len(body) < 8:
        raise BrokenFileError("a type cannot be")
    first, bits, size = unpack_from("<BB2xI", body)
    kind, order = first & 0x0F, ">" if bits & 1 else "<"
    if kind == 0 and size in (1, 2, 4, 8):
        return _Type(kind, size, f"{order}{'i' if bits & 8 else 'u'}{size}")
    if kind == 1 and size in (4, 8):
        return _Type(kind, size, f"{order}f{size}")
    if kind == _REFERENCE and size == 8:
        return _Type(kind, size, "<u8")
    return _Type(kind, size, f"S{size}" if kind == 3 and 0 < size <= 256 else "")


def _shape(body: memoryview) -> tuple[int, ...] | None:
    """The dimensions; None where there are none, or too many."""
    version, rank = body[0], body[1]
    begin = {1: 8, 2: 4}.get(version)
    if begin is None or rank > _MOST_DIMENSIONS or len(body) < begin + 8 * rank:
        return None
    shape = unpack_from(f"<{rank}Q", body, begin)
    return shape if prod(shape) * 1.0 <= MOST_BYTES else None


def _contents(
    file: _File, layout: memoryview, filters: memoryview | None, kind: _Type, shape: tuple[int, ...]
) -> bytes | None:
    """An array's bytes: in its header, in one piece, or in chunks."""
    size = kind.size * prod(shape)
    if len(layout) < 2 or layout[0] != 3:
        return None
    file.grow(size)
    if layout[1] == 0:
        held = bytes(layout[4 : 4 + size])
        return held if len(held) == size else None
    if layout[1] == 1:
        address = unpack_from("<Q", layout, 2)[0] if len(layout) >= 10 else _NONE
        return bytes(size) if address == _NONE else bytes(file.bytes(address, size))
    if layout[1] != 2 or len(layout) < 11 + 4 * (len(shape) + 1) or layout[2] != len(shape) + 1:
        return None
    tree = unpack_from("<Q", layout, 3)[0]
    chunk = unpack_from(f"<{len(shape)}I", layout, 11)
    steps = _filters(filters) if filters is not None else []
    if steps is None or 0 in chunk or prod(chunk) * kind.size > MOST_BYTES:
        return None
    whole = np.zeros(shape, f"V{kind.size}")
    for corner, packed in _chunks(file, tree, len(shape), 0) if tree != _NONE else ():
        raw = _unpacked(file, packed, steps, prod(chunk) * kind.size, kind.size)
        part = np.frombuffer(raw, f"V{kind.size}").reshape(chunk)
        if any(begin >= most for begin, most in zip(corner, shape, strict=True)):
            raise BrokenFileError("a chunk is beyond its array")
        ends = tuple(min(begin + step, most) for begin, step, most in zip(corner, chunk, shape, strict=True))
        inside = tuple(slice(begin, end) for begin, end in zip(corner, ends, strict=True))
        whole[inside] = part[tuple(slice(0, end - begin) for begin, end in zip(corner, ends, strict=True))]
    return whole.tobytes()


def _chunks(file: _File, tree: int, rank: int, depth: int) -> Iterator[tuple[tuple[int, ...], memoryview]]:
    """Where each chunk begins, and what is stored of it."""
    file.enter()
    if bytes(file.bytes(tree, 4)) != b"TREE" or depth > _DEEPEST:
        raise BrokenFileError("an array has no table of chunks")
    level, used = file.read("BH", tree + 5)
    step = 8 + 8 * (rank + 1) + 8
    for k in range(used):
        place = tree + 24 + step * k
        size = file.read("I", place)[0]
        corner = file.read(f"{rank}Q", place + 8)
        child = file.read("Q", place + step - 8)[0]
        if level:
            yield from _chunks(file, child, rank, depth + 1)
        else:
            file.enter()
            yield corner, file.bytes(child, size)


def _filters(body: memoryview) -> list[int] | None:
    """How chunks were packed, first to last; None where by something else than deflating and shuffling."""
    version, count = body[0], body[1]
    place, found = 8 if version == 1 else 2, []
    for _ in range(min(count, 8)):
        if place + 8 > len(body):
            return None
        kind, length, _, values = unpack_from("<HHHH", body, place)
        if kind not in (_DEFLATE, _SHUFFLE):
            return None
        found.append(kind)
        if version == 1:
            place += 8 + length + -length % 8 + 4 * values + 4 * (values % 2)
        else:
            place += 6 + 4 * unpack_from("<H", body, place + 4)[0]
    return found


def _unpacked(file: _File, packed: memoryview, steps: list[int], size: int, width: int) -> bytes:
    raw = bytes(packed)
    for step in reversed(steps):
        if step == _DEFLATE:
            try:
                raw = zlib.decompressobj().decompress(raw, size + 1)
            except zlib.error as error:
                raise BrokenFileError("a chunk cannot be unpacked") from error
        elif len(raw) == size:
            raw = np.frombuffer(raw, np.uint8).reshape(width, -1).T.tobytes()
    if len(raw) != size:
        raise BrokenFileError("a chunk has another size")
    file.grow(size)
    return raw


def _attribute(body: memoryview) -> tuple[str, str] | None:
    """Name and value of an attribute that is a text or one whole number."""
    if len(body) < 8:
        return None
    version, names, types, spaces = unpack_from("<BxHHH", body)
    place = 9 if version == 3 else 8
    widths = [size + (-size % 8 if version == 1 else 0) for size in (names, types, spaces)]
    if len(body) < place + sum(widths):
        return None
    name = bytes(body[place : place + names]).split(b"\0")[0].decode("utf-8", "replace")
    kind = _type(body[place + widths[0] : place + widths[0] + types]) if types >= 8 else _Type(-1, 0, "")
    value = bytes(body[place + sum(widths) :])[: kind.size]
    if kind.kind == 3:
        return name, value.split(b"\0")[0].decode("utf-8", "replace")
    if kind.kind == 0 and len(value) == kind.size and kind.numbers:
        return name, str(int(np.frombuffer(value, kind.numbers)[0]))
    return None
