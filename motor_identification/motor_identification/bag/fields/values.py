"""Numbers in a decoded message: the one at a path, and the paths of all."""

from collections.abc import Iterator, Sequence
from dataclasses import fields, is_dataclass
from math import isfinite
from typing import Any

import numpy as np

from motor_identification.bag.fields.path import Element

LONGEST_ARRAY = 64  # elements that are listed one by one: joints, and no images
DEEPEST = 6  # messages within messages
_OTHER = ("std_msgs/msg/Header", "builtin_interfaces/msg/Time", "builtin_interfaces/msg/Duration")


def read_value(message: Any, steps: Sequence[str | Element]) -> float | None:
    """Read the finite number at a path; None where this message has none there."""
    here = message
    owners: list[Any] = []
    for step in steps:
        if isinstance(step, str):
            owners.append(here)
            here = getattr(here, step, None) if is_dataclass(here) else None
            continue
        place = step.key if isinstance(step.key, int) else _place_of(step.key, here, owners)
        here = here[place] if place is not None and _is_array(here) and place < len(here) else None
    if not isinstance(here, bool | int | float | np.number):
        return None
    value = float(here)
    return value if isfinite(value) else None


def list_fields(message: Any) -> list[str]:
    """List the paths of all numbers in a message, without its header's; elements by their names where it has some."""
    return list(_walk(message, "", 0))


def read_header_stamp(message: Any) -> int:
    """[ns] of the message's header; 0 without one."""
    stamp = getattr(getattr(message, "header", None), "stamp", None)
    return 0 if stamp is None else int(stamp.sec) * 10**9 + int(stamp.nanosec)


def _walk(value: Any, path: str, depth: int) -> Iterator[str]:
    if is_dataclass(value) and depth < DEEPEST:
        for field in fields(value):
            inner = getattr(value, field.name)
            if field.name.startswith("__") or getattr(inner, "__msgtype__", "") in _OTHER:
                continue
            if _is_array(inner):
                yield from _walk_array(value, inner, f"{path}.{field.name}", depth)
            else:
                yield from _walk(inner, f"{path}.{field.name}", depth + 1)
    elif isinstance(value, bool | int | float | np.number):
        yield path.removeprefix(".")


def _walk_array(owner: Any, array: Any, path: str, depth: int) -> Iterator[str]:
    if not 0 < len(array) <= LONGEST_ARRAY:
        return
    names = next((names for names in _name_lists(owner) if len(names) == len(array)), [""] * len(array))
    for place, (element, name) in enumerate(zip(array, names, strict=True)):
        usable = name and not set(name) & set("[]") and not name.isdecimal()
        yield from _walk(element, f"{path}[{name if usable else place}]", depth + 1)


def _place_of(name: str, array: Any, owners: Sequence[Any]) -> int | None:
    """Where the element of a name stands: in a list of names as long as the array, in its message or those around."""
    if not _is_array(array):
        return None
    for owner in reversed(owners):
        for names in _name_lists(owner):
            if len(names) == len(array) and name in names:
                return names.index(name)
    return None


def _name_lists(message: Any) -> Iterator[list[str]]:
    """Lists of texts among a message's fields."""
    for field in fields(message) if is_dataclass(message) else ():
        value = getattr(message, field.name)
        if isinstance(value, list) and value and all(isinstance(one, str) for one in value):
            yield value


def _is_array(value: Any) -> bool:
    return isinstance(value, list | np.ndarray)
