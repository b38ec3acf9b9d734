"""Read the headers of HDF5 objects: their messages, the links of a group, attributes."""

from collections.abc import Iterator
from struct import unpack_from

import numpy as np

from motor_identification.logs.formats.hdf5.bounded_file import DEEPEST, BoundedFile
from motor_identification.logs.formats.hdf5.datatype import Type, read_type
from motor_identification.logs.formats.mat_elements import BrokenFileError

_CONTINUED = 16  # a message


def list_messages(file: BoundedFile, address: int) -> Iterator[tuple[int, memoryview]]:
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


def list_links(file: BoundedFile, tree: int, heap: int, depth: int) -> Iterator[tuple[str, int]]:
    """Names and addresses in a group: a tree of symbol nodes, and a heap of names."""
    file.enter()
    if bytes(file.bytes(tree, 4)) != b"TREE" or depth > DEEPEST:
        raise BrokenFileError("a group has no table")
    level, used = file.read("BH", tree + 5)
    names = file.read("Q", heap + 24)[0]
    for k in range(used):
        child = file.read("Q", tree + 24 + 16 * k + 8)[0]
        if level:
            yield from list_links(file, child, heap, depth + 1)
            continue
        if bytes(file.bytes(child, 4)) != b"SNOD":
            raise BrokenFileError("a group has no table")
        for entry in range(file.read("H", child + 6)[0]):
            file.enter()
            offset, address = file.read("QQ", child + 8 + 40 * entry)
            yield _name(file, names + offset), address


def _name(file: BoundedFile, address: int) -> str:
    begin = file.base + address
    if not 0 <= begin < len(file.data):
        raise BrokenFileError("a name is beyond its end")
    return bytes(file.data[begin : begin + 256]).split(b"\0")[0].decode("utf-8", "replace")


def read_attribute(body: memoryview) -> tuple[str, str] | None:
    """Name and value of an attribute that is a text or one whole number."""
    if len(body) < 8:
        return None
    version, names, types, spaces = unpack_from("<BxHHH", body)
    place = 9 if version == 3 else 8
    widths = [size + (-size % 8 if version == 1 else 0) for size in (names, types, spaces)]
    if len(body) < place + sum(widths):
        return None
    name = bytes(body[place : place + names]).split(b"\0")[0].decode("utf-8", "replace")
    kind = read_type(body[place + widths[0] : place + widths[0] + types]) if types >= 8 else Type(-1, 0, "")
    value = bytes(body[place + sum(widths) :])[: kind.size]
    if kind.kind == 3:
        return name, value.split(b"\0")[0].decode("utf-8", "replace")
    if kind.kind == 0 and len(value) == kind.size and kind.numbers:
        return name, str(int(np.frombuffer(value, kind.numbers)[0]))
    return None
