"""Read the bytes of an HDF5 array: in its header, in one piece, or in chunks that are shuffled and deflated."""

import zlib
from collections.abc import Iterator
from math import prod
from struct import unpack_from

import numpy as np

from motor_identification.logs.formats.hdf5.bounded_file import DEEPEST, BoundedFile
from motor_identification.logs.formats.hdf5.datatype import Type
from motor_identification.logs.formats.mat_elements import MOST_BYTES, BrokenFileError

_NONE = 2**64 - 1  # an address of nothing
_DEFLATE, _SHUFFLE = 1, 2


def read_contents(
    file: BoundedFile, layout: memoryview, filters: memoryview | None, kind: Type, shape: tuple[int, ...]
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


def _chunks(file: BoundedFile, tree: int, rank: int, depth: int) -> Iterator[tuple[tuple[int, ...], memoryview]]:
    """Where each chunk begins, and what is stored of it."""
    file.enter()
    if bytes(file.bytes(tree, 4)) != b"TREE" or depth > DEEPEST:
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


def _unpacked(file: BoundedFile, packed: memoryview, steps: list[int], size: int, width: int) -> bytes:
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
