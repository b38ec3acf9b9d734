"""YAML as typed on a command line → the fields of a message, checked before ROS sees them."""

import math
from collections.abc import Callable
from typing import Any

from rosidl_parser.definition import (
    AbstractNestedType,
    AbstractSequence,
    AbstractString,
    AbstractWString,
    Array,
    BasicType,
    BoundedSequence,
    NamespacedType,
)

from motor_model import yaml_file
from motor_model.errors import MotorError
from motor_model.printable import escape
from ros2_stand_in.interfaces import interface_type

Setter = Callable[[Any], None]  # takes a builtin_interfaces/msg/Time


class ValueRefused(MotorError):
    """A value that does not fit the field it is meant for."""


def parse(text: str) -> dict[str, Any]:
    """A mapping written in YAML; nothing at all is an empty one.

    Raises:
        ValueRefused: this is not YAML, or not a mapping.
    """
    try:
        values = yaml_file.parse(text)
    except yaml_file.NotYaml as error:
        raise ValueRefused(f"'{escape(text)}' {error}.") from error
    if values is None:
        return {}
    if not isinstance(values, dict):
        raise ValueRefused(f'\'{text}\' does not name fields; write "{{field: value}}", such as "{{data: 100.0}}".')
    return values


def fill(message: Any, values: dict[str, Any]) -> list[Setter]:
    """Set the fields of a message; what is not named keeps its default.

    A header given as `auto` and a time given as `now` are left to the caller: the setters returned take the time.

    Raises:
        ValueRefused: there is no such field, or the value is not of its type.
    """
    types = dict(zip(message.get_fields_and_field_types(), message.SLOT_TYPES, strict=True))
    stamps: list[Setter] = []
    for name, value in values.items():
        if name not in types:
            have = f"it has: {', '.join(types)}" if types else "it has none"
            raise ValueRefused(f"{_type_name(message)} has no field '{name}'; {have}.")
        where = f"field '{name}' of {_type_name(message)}"
        if _is_automatic(types[name], value):
            stamps.append(_stamp(message, name, value))
        else:
            setattr(message, name, _converted(types[name], value, where, stamps))
    return stamps


def _type_name(message: Any) -> str:
    package, kind = type(message).__module__.split(".")[:2]
    return f"{package}/{kind}/{type(message).__name__}"


_AUTOMATIC = {("std_msgs", "Header"): "auto", ("builtin_interfaces", "Time"): "now"}


def _is_automatic(kind: Any, value: Any) -> bool:
    return isinstance(kind, NamespacedType) and _AUTOMATIC.get((kind.namespaces[0], kind.name)) == value


def _stamp(message: Any, name: str, value: str) -> Setter:
    if value == "auto":
        return lambda now: setattr(getattr(message, name), "stamp", now)
    return lambda now: setattr(message, name, now)


def _converted(kind: Any, value: Any, where: str, stamps: list[Setter]) -> Any:
    if isinstance(kind, AbstractNestedType):
        return _list(kind, value, where, stamps)
    if isinstance(kind, NamespacedType):
        return _message(kind, value, where, stamps)
    if isinstance(kind, (AbstractString, AbstractWString)):
        return _text(value, where)
    if isinstance(kind, BasicType):
        return _BASIC[kind.typename](value, where)
    raise ValueRefused(f"{where} is of a kind ({kind}) that cannot be given on the command line.")


def _list(kind: Any, values: Any, where: str, stamps: list[Setter]) -> list[Any]:
    if not isinstance(values, list):
        raise ValueRefused(f"{where} takes a list, such as [{values}], not {values!r}.")
    if isinstance(kind, Array) and len(values) != kind.size:
        raise ValueRefused(f"{where} takes {kind.size} values, not {len(values)}.")
    if isinstance(kind, BoundedSequence) and len(values) > kind.maximum_size:
        raise ValueRefused(f"{where} takes at most {kind.maximum_size} values, not {len(values)}.")
    assert isinstance(kind, (Array, AbstractSequence))
    return [_converted(kind.value_type, value, f"{where}, value {i},", stamps) for i, value in enumerate(values)]


def _message(kind: NamespacedType, values: Any, where: str, stamps: list[Setter]) -> Any:
    if not isinstance(values, dict):
        raise ValueRefused(f"{where} takes {{field: value}}, not {values!r}.")
    inner = interface_type.load("/".join(kind.namespaced_name()), kind.namespaces[1])()
    stamps += fill(inner, values)
    return inner


def _text(value: Any, where: str) -> str:
    if isinstance(value, (list, dict)) or value is None:
        raise ValueRefused(f"{where} takes a text, not {value!r}.")
    return str(value)


def _boolean(value: Any, where: str) -> bool:
    if isinstance(value, bool) or value in (0, 1):
        return bool(value)
    raise ValueRefused(f"{where} takes true or false, not {value!r}.")


def _real(value: Any, where: str) -> float:
    try:
        if not isinstance(value, bool):
            return float(value)  # a text too: YAML reads 1e-3, without a point, as one
    except (TypeError, ValueError):
        pass
    raise ValueRefused(f"{where} takes a number, not {value!r}.")


def _single(value: Any, where: str) -> float:
    number = _real(value, where)
    if math.isfinite(number) and abs(number) > 3.402823466e38:
        raise ValueRefused(f"{where} takes a float32, and {value!r} is too large for one.")
    return number


def _whole(low: int, high: int) -> Callable[[Any, str], int]:
    def convert(value: Any, where: str) -> int:
        number = _real(value, where) if not isinstance(value, int) or isinstance(value, bool) else value
        if not low <= number <= high or number != int(number):
            raise ValueRefused(f"{where} takes a whole number from {low} to {high}, not {value!r}.")
        return int(number)

    return convert


def _octet(value: Any, where: str) -> bytes:
    return bytes([_whole(0, 255)(value, where)])


_BASIC: dict[str, Callable[[Any, str], Any]] = {
    "boolean": _boolean,
    "octet": _octet,
    "float": _single,
    "double": _real,
    **{f"int{bits}": _whole(-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": _whole(0, 2**bits - 1) for bits in (8, 16, 32, 64)},
}
