"""Definitions of message types, as bags embed them, read by ROS 2's grammar and nothing else.

A definition comes out of a bag, and libraries make code of it: what is not of the grammar, or stands for more than any
message has, is refused before anybody does.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from keyword import iskeyword

LARGEST = 1 << 20  # characters: the largest of the common interfaces has ten thousand
LONGEST_ARRAY = 4096  # elements of a fixed array of texts or messages, for each of which libraries write a line of code
MOST_VALUES = 100_000  # that one message may have without growing ones; a pose with its covariance has 43
DEEPEST = 30  # types in types
_UNFINISHED = -1
PRIMITIVES = frozenset(
    ["bool", "byte", "char", "string", "wstring", "float32", "float64", "time", "duration"]
    + [f"{kind}{bits}" for kind in ("int", "uint") for bits in (8, 16, 32, 64)]
)
_TEXTS = ("string", "wstring")
_TYPE = r"(?P<type>[A-Za-z]\w*(?:/msg)?(?:/[A-Za-z]\w*)?)(?P<text_bound><=\d{1,9})?"
_FIELD = re.compile(
    rf"{_TYPE}(?P<array>\[(?:<=)?\d{{0,9}}\])?\s+(?P<name>[A-Za-z]\w*)\s*(?P<rest>=.*|\s\S.*)?", re.ASCII
)
_OWNER = re.compile(r"(?:MSG|IDL):\s*(?P<name>\w+(?:/msg)?/\w+)", re.ASCII)
_SEPARATOR = re.compile(r"={3,}")


class NotOfGrammar(ValueError):
    """A definition that is none."""


@dataclass(frozen=True, slots=True)
class Field:
    """One field; `count` is 1, the number of a fixed array, or 0 for a growing one."""

    name: str
    type_name: str  # a primitive, or package/msg/Name
    count: int = 1


def parse(definition: str, type_name: str) -> Mapping[str, tuple[Field, ...]]:
    """Parse the fields of a type and of all types nested in it, by full names; constants and remarks are left out.

    Raises:
        NotOfGrammar: a line is no field, constant or remark, or a type is nested in itself, missing or too large.
    """
    if len(definition) > LARGEST:
        raise NotOfGrammar(f"it is longer than {LARGEST} characters")
    types: dict[str, list[Field]] = {type_name: []}
    owner = type_name
    for number, line in enumerate(definition.splitlines(), 1):
        text = line.split("#", 1)[0].strip()
        if match := _OWNER.fullmatch(text):
            owner = full_name(match["name"], type_name)
            types[owner] = []
        elif text and not _SEPARATOR.fullmatch(text) and (field := _field(text, owner, number)):
            types[owner].append(field)
    _count(type_name, types, {})
    return {name: tuple(fields) for name, fields in types.items()}


def full_name(name: str, owner: str) -> str:
    """`Header` or `std_msgs/Header` as package/msg/Name; a name without a package is of its owner's."""
    package, _, short = name.rpartition("/")
    return f"{(package or owner).split('/')[0]}/msg/{short}"


def _field(text: str, owner: str, number: int) -> Field | None:
    match = _FIELD.fullmatch(text)
    if match is None or iskeyword(match["name"]):
        raise NotOfGrammar(f"line {number} is no field")
    if (match["rest"] or "").startswith("="):
        return None  # a constant
    primitive = match["type"] in PRIMITIVES
    if match["text_bound"] and match["type"] not in _TEXTS:
        raise NotOfGrammar(f"line {number} is no field")
    digits = (match["array"] or "").strip("[]")
    count = 1 if match["array"] is None else int(digits) if digits.isdigit() else 0
    if count > LONGEST_ARRAY and (not primitive or match["type"] in _TEXTS):
        raise NotOfGrammar(f"line {number} has an array of {count}, and {LONGEST_ARRAY} is the most")
    return Field(match["name"], match["type"] if primitive else full_name(match["type"], owner), count)


def _count(name: str, types: Mapping[str, list[Field]], known: dict[str, int], depth: int = 0) -> int:
    """Values in a message of a type, each array of numbers counted as one; `known` has those of the types met."""
    if name not in types:
        raise NotOfGrammar(f"{name} is not defined")
    if known.setdefault(name, _UNFINISHED) != _UNFINISHED:
        return known[name]
    if depth > DEEPEST:
        raise NotOfGrammar(f"{name} is nested deeper than {DEEPEST}, or in itself")
    total = 1
    for field in types[name]:
        if field.type_name in PRIMITIVES:
            total += field.count if field.type_name in _TEXTS else 1
        else:
            total += max(field.count, 1) * _count(field.type_name, types, known, depth + 1)
        if total > MOST_VALUES:
            raise NotOfGrammar(f"a message of it has more than {MOST_VALUES} values")
    known[name] = total
    return total
