"""Signals in objects of MATLAB: iddata, tables, timeseries, the output and the data sets of Simulink.

Objects of newer classes are kept apart from the variables: a table of classes, objects and their properties, whose
values are the cells behind it; a variable, or a property that holds another object, has its number.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from struct import error as StructError
from struct import unpack_from
from typing import Any

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.formats.mat_elements import (
    CELL,
    CLASS,
    MATRIX,
    NUMERIC,
    OPAQUE,
    STRUCT,
    BrokenFileError,
    Tally,
    Value,
    list_matrices,
    read_kind,
    read_matrix,
    read_numbers,
    split_elements,
)

IDDATA = CLASS + "iddata"
REFERENCE = 0xDD000000  # the first number of a reference to objects
BESIDE = 2  # cells before those of the properties
SHOWN = 8  # names of what is left out
IN_CELL = 1  # a property whose value is in a cell; of other kinds are names and truth values
# What leads from an object to its signals: the properties of the classes that hold them.
INNER = {
    "SimulationOutput": ("Data",),
    "Dataset": ("any", "Storage_", "Storage"),
    "RamDatasetStorage": ("any", "Elements_", "Elements"),
    "Signal": ("Values",),
    "State": ("Values",),
}
HOLDERS = frozenset(["Storage", "Elements"])  # fields that name no signal
DEEPEST = 12
Floats = NDArray[np.float64]


def spread_iddata(variables: Mapping[str, Value]) -> tuple[dict[str, Value], tuple[str, ...]]:
    """Put the columns of the longest iddata in its place: times, inputs, outputs; and say which others are left out.

    One that was cut from vectors of the file with its columns' names, as long or longer, is left out beside them.
    """
    sets = {name: _columns(one[IDDATA]) for name, one in variables.items() if isinstance(one, dict) and IDDATA in one}
    sizes = {name: max((len(one) for one in columns.values()), default=0) for name, columns in sets.items()}
    longest = max(sizes, key=lambda name: sizes[name], default="")
    rest = {name: one for name, one in variables.items() if name not in sets}
    columns = sets.get(longest, {})
    if any(isinstance(own := rest.get(name), np.ndarray) and own.size >= len(one) for name, one in columns.items()):
        return rest, (f"Left out, beside the vectors that they were cut from: {', '.join([*sets][:SHOWN])}.",)
    others = [name for name in sets if name != longest]
    notes = (f"Left out, as another iddata is longer: {', '.join(others[:SHOWN])}.",) if others else ()
    return {**rest, **columns}, notes


def _columns(fields: Value) -> dict[str, Floats]:
    """The columns of an iddata of one experiment, each of shape (K, 1), by names with units."""
    if not isinstance(fields, dict):
        return {}
    found: dict[str, Floats] = {}
    for side, usual in (("Input", "u"), ("Output", "y")):
        values = fields.get(f"{side}Data")
        if not isinstance(values, np.ndarray):
            continue
        names, units = (_lines(fields.get(f"{side}{what}")) for what in ("Name", "Unit"))
        for k in range(values.shape[1]):
            own = names[k] if k < len(names) else f"{usual}{k + 1}"
            name = usual if own == f"{usual}1" and values.shape[1] == 1 else own
            behind = f" ({units[k]})" if k < len(units) and units[k] else ""
            found[name + behind] = np.asarray(values[:, k : k + 1], dtype=np.float64)
    period, begin = (fields.get(name) for name in ("Ts", "Tstart"))
    if found and isinstance(period, np.ndarray) and period.size == 1:
        first = float(begin.ravel()[0]) if isinstance(begin, np.ndarray) and begin.size == 1 else 0.0
        count = len(next(iter(found.values())))
        unit = _lines(fields.get("TimeUnit")) or [""]
        name = f"time ({unit[0]})" if unit[0] not in ("", "seconds") else "time (s)"
        found[name] = first + float(period.ravel()[0]) * np.arange(count, dtype=np.float64)[:, None]
    return found


def _lines(text: Value | None) -> list[str]:
    return text.split("\n") if isinstance(text, str) else []


def read_objects(data: bytes) -> dict[str, Value]:
    """Read the signals in a file's objects of newer classes: matrices (K, 1 + n) with the times before the values.

    A table's columns have their own names, of several tables `table.column`.

    Raises:
        BrokenFileError: they cannot be.
    """
    tally, matrices = list_matrices(data)
    roots: dict[str, memoryview] = {}
    store: memoryview | None = None
    try:
        for one in matrices:
            parts = [part.data for part in split_elements(one, 0, tally.order)]
            kind = read_kind(one, tally)
            if kind == OPAQUE and bytes(parts[2]) == b"MCOS":
                roots[bytes(parts[1]).decode("latin-1")] = parts[4]
            elif kind in NUMERIC and not bytes(parts[2]):
                store = parts[3]
        if store is None:
            return {}
        objects = _Objects(store, tally)
        for name, reference in roots.items():
            objects.look_into(reference, name, 0)
    except (IndexError, KeyError, ValueError, StructError, UnicodeDecodeError) as error:
        raise BrokenFileError("its objects cannot be") from error
    return {**objects.found, **_name_columns(objects.tables)}


def _name_columns(tables: Mapping[str, Mapping[str, Value]]) -> dict[str, Value]:
    several = len(tables) > 1
    return {
        f"{table}.{name}" if several else name: values
        for table, columns in tables.items()
        for name, values in columns.items()
    }


class _Objects:
    """The objects of a file, and the signals that were found in them."""

    def __init__(self, store: memoryview, tally: Tally) -> None:
        self.found: dict[str, Value] = {}
        self.tables: dict[str, dict[str, Value]] = {}
        self._tally, self._seen = tally, set[int]()
        top = next(split_elements(store, 8, tally.order))  # behind a header of its own
        wrapper = self._fields(top.data)["MCOS"]
        self._cells = list(self._list_cells([one.data for one in split_elements(wrapper, 0, tally.order)][4]))
        numbers = read_matrix(self._cells[0], tally, 1)[1]
        if not isinstance(numbers, np.ndarray):
            raise ValueError
        self._table = numbers.astype(np.uint8).tobytes()
        begins = unpack_from(tally.order + "8I", self._table, 8)
        texts = self._table[40 : begins[0]].split(b"\0")
        self._names = ["", *(text.decode("latin-1") for text in texts)]
        self._classes = self._rows(begins[0], begins[1], 4)
        self._objects = self._rows(begins[2], begins[3], 6)
        self._properties = [list(self._list_properties(begins[k], begins[k + 1])) for k in (1, 3)]

    def look_into(self, matrix: memoryview, name: str, depth: int) -> None:
        """Take the signals in a value: in structs, in cells, behind references."""
        kind = read_kind(matrix, self._tally)
        if depth > DEEPEST:
            return
        if kind == OPAQUE:
            self.look_into([one.data for one in split_elements(matrix, 0, self._tally.order)][4], name, depth + 1)
        elif kind == STRUCT:
            for field, value in self._fields(matrix).items():
                self.look_into(value, name if field in HOLDERS else field, depth + 1)
        elif kind == CELL:
            for value in self._list_cells(matrix):
                self.look_into(value, name, depth + 1)
        elif kind in NUMERIC:
            self._take(self._numbers(matrix), name, depth)

    def _take(self, value: NDArray[Any] | None, name: str, depth: int) -> None:
        """Take numbers, or look into the objects that they refer to."""
        if value is None:
            return
        numbers = value.ravel()
        if value.dtype.kind == "u" and numbers[0] == REFERENCE:
            for number in numbers[2 + int(numbers[1]) : -1]:
                self._look_into_object(int(number), name, depth + 1)
        elif value.ndim == 2 and value.size > 1:
            self.found.setdefault(name, value)

    def _look_into_object(self, number: int, name: str, depth: int) -> None:
        if number in self._seen:
            return
        self._seen.add(number)
        kind, values = self._object(number)
        own = self._text(values.get("Name")) or name
        if kind == "timeseries":
            self._take_series(values, own)
        if kind == "table":
            self._take_table(values, name)
        for inner in INNER.get(kind, ()):
            if inner in values:
                self.look_into(values[inner], own if kind in ("Signal", "State") else name, depth)

    def _take_series(self, values: Mapping[str, memoryview], name: str) -> None:
        """Put times and data of a timeseries side by side."""
        data = self._numbers(values.get("Data_", values.get("Data")))
        times = self._numbers(values.get("Time_", values.get("Time")))
        if times is None or times.size < 2:
            times = self._times(values.get("TimeInfo"))
        if data is None or times is None or times.size < 2 or times.size not in data.shape:
            return
        rows = np.moveaxis(data.astype(np.float64), data.shape.index(times.size), 0).reshape(times.size, -1)
        self.found.setdefault(name or "data", np.column_stack([times.ravel(), rows]))

    def _take_table(self, values: Mapping[str, memoryview], name: str) -> None:
        """Take the columns of a table that hold numbers, by their names."""
        names, columns = values.get("varnames"), values.get("data")
        if names is None or columns is None:
            return
        pairs = zip(map(self._text, self._list_cells(names)), self._list_cells(columns), strict=False)
        read = {word: self._numbers(one) for word, one in pairs if read_kind(one, self._tally) in NUMERIC}
        self.tables[name] = {word: one for word, one in read.items() if one is not None and one.ndim == 2}

    def _times(self, reference: memoryview | None) -> Floats | None:
        """The times that the information of a timeseries tells: listed, or by their begin and step."""
        numbers = self._numbers(reference)
        if numbers is None or numbers.ravel()[0] != REFERENCE:
            return None
        place = 2 + int(numbers.ravel()[1])
        _, values = self._object(int(numbers.ravel()[place]))
        listed, begin, step, count = (
            self._numbers(values.get(name)) for name in ("Time_", "Start_", "Increment_", "Length")
        )
        if listed is not None and listed.size > 1:
            return np.asarray(listed, dtype=np.float64)
        if begin is None or step is None or count is None or not 0 < count.ravel()[0] <= 2**26:
            return None
        return np.asarray(begin.ravel()[0] + step.ravel()[0] * np.arange(int(count.ravel()[0])), dtype=np.float64)

    def _object(self, number: int) -> tuple[str, dict[str, memoryview]]:
        """The class of an object, and its properties that have values, by name."""
        row = self._objects[number]
        values = {}
        for properties, which in zip(self._properties, row[3:5], strict=True):
            for name, kind, cell in properties[which] if which else ():
                if kind == IN_CELL:
                    values[self._names[name]] = self._cells[cell + BESIDE]
        return self._names[self._classes[row[0]][1]], values

    def _numbers(self, matrix: memoryview | None) -> NDArray[Any] | None:
        """Numbers in as many dimensions as they have; None where there are none."""
        value = None if matrix is None else read_numbers(matrix, self._tally)
        return value if value is not None and value.size else None

    def _text(self, matrix: memoryview | None) -> str:
        value = None if matrix is None else read_matrix(matrix, self._tally, 1)[1]
        return value.strip() if isinstance(value, str) else ""

    def _fields(self, matrix: memoryview) -> dict[str, memoryview]:
        """The fields of a struct, as they are."""
        _, _, _, sizes, names, *values = (one.data for one in split_elements(matrix, 0, self._tally.order))
        length = unpack_from(self._tally.order + "i", sizes)[0]
        texts = [bytes(names[k : k + length]).split(b"\0")[0] for k in range(0, len(names), length)]
        return dict(zip((text.decode("latin-1") for text in texts), values, strict=False))

    def _list_cells(self, matrix: memoryview) -> Iterator[memoryview]:
        yield from (one.data for one in split_elements(matrix, 0, self._tally.order) if one.type == MATRIX)

    def _rows(self, begin: int, end: int, width: int) -> list[tuple[int, ...]]:
        numbers = unpack_from(f"{self._tally.order}{(end - begin) // 4}I", self._table, begin)
        return [numbers[k : k + width] for k in range(0, len(numbers) - width + 1, width)]

    def _list_properties(self, begin: int, end: int) -> Iterator[list[tuple[int, ...]]]:
        """Properties of each object: name, kind, value; every list begins at a multiple of 8 bytes."""
        yield []  # objects are counted from 1
        numbers = unpack_from(f"{self._tally.order}{(end - begin) // 4}I", self._table, begin)
        place = 2
        while place < len(numbers):
            count = numbers[place]
            stop = place + 1 + 3 * count
            yield [numbers[k : k + 3] for k in range(place + 1, min(stop, len(numbers) - 2), 3)]
            place = stop + stop % 2
