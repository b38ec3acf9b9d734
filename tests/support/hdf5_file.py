"""Writes small HDF5 files as MATLAB 7.3 does: groups of one symbol node, arrays in one piece or in deflated chunks."""

import zlib
from dataclasses import dataclass, field
from itertools import product
from struct import pack
from typing import TypeAlias

import numpy as np

USER_BLOCK = 512
NOTHING = 2**64 - 1


@dataclass
class Stored:
    """An array, in the order of HDF5, and what is said of it; `refers` are paths instead of numbers."""

    values: np.ndarray
    about: dict[str, str | int] = field(default_factory=dict)
    chunk: tuple[int, ...] | None = None
    shuffled: bool = False
    refers: tuple[str, ...] = ()


Tree: TypeAlias = "dict[str, Tree | Stored]"


def matrix(values: object, **about: str | int) -> Stored:
    """A MATLAB matrix of doubles, whose rows and columns HDF5 exchanges."""
    rows = np.atleast_2d(np.asarray(values, dtype=float))
    return Stored(rows.T if rows.shape[0] > 1 else rows, {"MATLAB_class": "double", **about})


def text(value: str) -> Stored:
    """A MATLAB text."""
    return Stored(np.array([[ord(one)] for one in value], np.uint16), {"MATLAB_class": "char", "MATLAB_int_decode": 2})


def hdf5(tree: Tree, user_block: bytes = b"MATLAB 7.3 MAT-file") -> bytes:
    """The bytes of a file; addresses count from behind the user block."""
    return user_block.ljust(USER_BLOCK, b" ") + _Writer().write(tree)


class _Writer:
    def __init__(self) -> None:
        self.data = bytearray(96)
        self.places: dict[str, int] = {}
        self.references: list[tuple[int, str]] = []

    def write(self, tree: Tree) -> bytes:
        root = self._group(tree, "")
        for place, path in self.references:
            self.data[place : place + 8] = pack("<Q", self.places[path])
        head = b"\x89HDF\r\n\x1a\n" + bytes([0, 0, 0, 0, 0, 8, 8, 0]) + pack("<HHI", 4, 16, 0)
        head += pack("<QQQQ", USER_BLOCK, NOTHING, len(self.data), NOTHING) + pack("<QQI4x16x", 0, root, 0)
        self.data[:96] = head
        return bytes(self.data)

    def _put(self, piece: bytes) -> int:
        self.data += bytes(-len(self.data) % 8)
        place = len(self.data)
        self.data += piece
        return place

    def _object(self, messages: list[tuple[int, bytes]], path: str) -> int:
        block = b"".join(
            pack("<HHB3x", kind, len(body) + -len(body) % 8, 0) + body + bytes(-len(body) % 8)
            for kind, body in messages
        )
        half = 0 if len(messages) < 3 else 1  # a second block, as where attributes came later
        if half:
            first = pack("<HHB3x", messages[0][0], len(messages[0][1]) + -len(messages[0][1]) % 8, 0) + messages[0][1]
            first += bytes(-len(first) % 8)
            rest = self._put(block[len(first) :])
            block = first + pack("<HHB3x", 16, 16, 0) + pack("<QQ", rest, len(block) - len(first))
        place = self._put(pack("<BxHII4x", 1, len(messages) + half, 1, len(block)) + block)
        self.places[path] = place
        return place

    def _group(self, tree: Tree, path: str) -> int:
        names, entries, offset = b"\0" * 8, b"", 8
        for name, inner in sorted(tree.items()):
            where = f"{path}/{name}" if path else name
            place = self._group(inner, where) if isinstance(inner, dict) else self._array(inner, where)
            entries += pack("<QQI4x16x", offset, place, 0)
            written = name.encode() + b"\0"
            names += written + bytes(-len(written) % 8)
            offset = len(names)
        heap_data = self._put(names)
        heap = self._put(b"HEAP" + pack("<B3xQQQ", 0, len(names), NOTHING, heap_data))
        node = self._put(b"SNOD" + pack("<BxH", 1, len(tree)) + entries)
        branch = self._put(b"TREE" + pack("<BBHQQ", 0, 0, 1, NOTHING, NOTHING) + pack("<QQQ", 0, node, offset))
        return self._object([(17, pack("<QQ", branch, heap))], path)

    def _array(self, array: Stored, path: str) -> int:
        values = np.ascontiguousarray(array.values)
        shape = values.shape
        kind = _kind(values.dtype, bool(array.refers))
        space = pack("<BBB5x", 1, len(shape), 0) + pack(f"<{len(shape)}Q", *shape)
        messages = [(1, space), (3, kind)]
        if array.chunk is None:
            place = self._put(values.tobytes())
            self.references += [(place + 8 * k, to) for k, to in enumerate(array.refers)]
            messages.append((8, pack("<BBQQ", 3, 1, place, values.nbytes)))
        else:
            messages += self._chunks(values, array.chunk, array.shuffled)
        messages += [(12, _attribute(name, value)) for name, value in array.about.items()]
        return self._object(messages, path)

    def _chunks(self, values: np.ndarray, chunk: tuple[int, ...], shuffled: bool) -> list[tuple[int, bytes]]:
        keys, width = b"", values.dtype.itemsize
        corners = list(product(*(range(0, size, step) for size, step in zip(values.shape, chunk, strict=True))))
        for corner in corners:
            part = np.zeros(chunk, values.dtype)
            inside = values[tuple(slice(begin, begin + step) for begin, step in zip(corner, chunk, strict=True))]
            part[tuple(slice(0, size) for size in inside.shape)] = inside
            raw = part.tobytes()
            if shuffled:
                raw = np.frombuffer(raw, np.uint8).reshape(-1, width).T.tobytes()
            packed = zlib.compress(raw)
            keys += pack("<II", len(packed), 0) + pack(f"<{len(chunk) + 1}Q", *corner, 0)
            keys += pack("<Q", self._put(packed))
        keys += pack("<II", 0, 0) + pack(f"<{len(chunk) + 1}Q", *values.shape, 0)
        tree = self._put(b"TREE" + pack("<BBHQQ", 1, 0, len(corners), NOTHING, NOTHING) + keys)
        layout = pack("<BBBQ", 3, 2, len(chunk) + 1, tree) + pack(f"<{len(chunk) + 1}I", *chunk, width)
        steps = ([(2, width)] if shuffled else []) + [(1, 6)]
        filters = pack("<BB6x", 1, len(steps)) + b"".join(pack("<HHHHI4x", one, 0, 0, 1, value) for one, value in steps)
        return [(8, layout), (11, filters)]


def _kind(kind: np.dtype, refers: bool) -> bytes:
    size = kind.itemsize
    if refers:
        return pack("<B3sI", 0x17, bytes(3), 8)
    if kind.kind == "f":
        return pack("<B3sI", 0x11, bytes([0x20, 8 * size - 1, 0]), size) + bytes(12)
    return pack("<B3sI", 0x10, bytes([8 if kind.kind == "i" else 0, 0, 0]), size) + pack("<HH", 0, 8 * size)


def _attribute(name: str, value: str | int) -> bytes:
    written = name.encode() + b"\0"
    if isinstance(value, str):
        data, kind = value.encode(), pack("<B3sI", 0x13, bytes(3), len(value))
    else:
        data, kind = pack("<i", value), pack("<B3sI", 0x10, bytes([8, 0, 0]), 4) + pack("<HH", 0, 32)
    space = pack("<BBB5x", 1, 0, 0)
    padded = [piece + bytes(-len(piece) % 8) for piece in (written, kind, space)]
    return pack("<BxHHH", 1, len(written), len(kind), len(space)) + b"".join(padded) + data
