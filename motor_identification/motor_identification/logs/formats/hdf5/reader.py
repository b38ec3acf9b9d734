"""Read the arrays of an HDF5 file as MATLAB 7.3 writes it: groups of symbol tables, plain or chunked arrays, deflated.

What a file says of itself is checked before anything is read by it, as in `mat_elements`; what is of a newer kind, or
no number, text or reference, is left out. Names are those of the "HDF5 File Format Specification", version 2.
"""

from dataclasses import dataclass, field
from math import prod
from struct import error as StructError
from struct import unpack_from
from typing import Any

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.formats.hdf5.bounded_file import DEEPEST, BoundedFile
from motor_identification.logs.formats.hdf5.datatype import REFERENCE, read_shape, read_type
from motor_identification.logs.formats.hdf5.objects import list_links, list_messages, read_attribute
from motor_identification.logs.formats.hdf5.storage import read_contents
from motor_identification.logs.formats.mat_elements import MOST_BYTES, BrokenFileError

SIGNATURE = b"\x89HDF\r\n\x1a\n"
_PLACES = (0, 512, 1024, 2048)  # of the signature, behind what a program puts in front
_SPACE, _TYPE, _LAYOUT, _FILTERS, _ATTRIBUTE, _TABLE = 1, 3, 8, 11, 12, 17  # messages


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
    head = BoundedFile(view, place)
    version, offsets, lengths = head.read("B4xBB", 8)
    if version > 1 or (offsets, lengths) != (8, 8):
        raise BrokenFileError("it is of a kind that is not known here")
    base = head.read("Q", 24 if version == 0 else 28)[0]
    root = head.read("Q", (56 if version == 0 else 60) + 8)[0]
    file = BoundedFile(view, base if base else 0)
    found = Hdf5()
    _read_object(file, root, "", found, 0)
    return found


def _read_object(file: BoundedFile, address: int, path: str, found: Hdf5, depth: int) -> None:
    """Read a group and all that is in it, or an array."""
    if depth > DEEPEST:
        raise BrokenFileError("its groups are nested too deep")
    if address in found.paths:  # a second name of the same
        return
    file.enter()
    found.paths[address] = path
    messages = list(list_messages(file, address))
    tables = [body for kind, body in messages if kind == _TABLE]
    if tables and len(tables[0]) >= 16:
        tree, heap = unpack_from("<QQ", tables[0])
        for name, child in list_links(file, tree, heap, 0):
            _read_object(file, child, f"{path}/{name}" if path else name, found, depth + 1)
        return
    array = _read_array(file, messages)
    if array is not None:
        found.arrays[path] = array


def _read_array(file: BoundedFile, messages: list[tuple[int, memoryview]]) -> Array | None:
    """An array of numbers or references; None where it is something else."""
    bodies = dict(reversed(messages))  # the first of each kind
    if not {_SPACE, _TYPE, _LAYOUT} <= set(bodies):
        return None
    kind, shape = read_type(bodies[_TYPE]), read_shape(bodies[_SPACE])
    if not kind.numbers or shape is None or kind.size * prod(shape) > MOST_BYTES:
        return None
    raw = read_contents(file, bodies[_LAYOUT], bodies.get(_FILTERS), kind, shape)
    if raw is None:
        return None
    attributes = dict(filter(None, (read_attribute(body) for one, body in messages if one == _ATTRIBUTE)))
    return Array(np.frombuffer(raw, kind.numbers).reshape(shape), attributes, kind.kind == REFERENCE)
