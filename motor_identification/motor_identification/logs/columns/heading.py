"""A column's name taken apart: its words, its unit, the quantity they tell, the side it belongs to."""

import re
from dataclasses import dataclass

from motor_identification.logs.columns.names.path import find_field
from motor_identification.logs.columns.names.quantity import is_speed_by_words, tell_quantity
from motor_identification.logs.columns.names.words import find_device, find_side, split_words
from motor_identification.logs.columns.vocabulary import (
    COUNTS_IN_BRACKETS,
    DIRECTIONS,
    INPUTS,
    MEASURED,
    MOVES,
    OF_OTHERS,
    OUTPUTS,
    SIDES,
    UNIT_BY_SPELLING,
    UNITS,
    WORDS,
    Quantity,
    words_of,
)
from motor_identification.logs.form import TIME_UNITS

_BRACKETS = re.compile(r"[\[({<]([^\])}>]*)[\])}>]")
_VOLTS_AT_THE_END = re.compile(r"[^\W_][\s_]V$")  # `left_v` is a velocity
_TELLING = frozenset().union(MEASURED, *(WORDS[kind] for kind in (*MOVES, Quantity.VOLTAGE, Quantity.DUTY)))
_INSIDE = words_of("rpm erpm upm krpm rad_s deg_s rad_sec deg_sec deg degrees")  # units that are no other word
# What a speed's unit may be where its name leaves the seconds out, `velocity_rad`; those that may be words, as in
# `speed_m` of a motor and `speed_rev` of the other way, are units in brackets only.
_NO_WORDS = words_of("rad deg cm mm")
_ANY_FIELD = words_of("data value values signal signals") | INPUTS | OUTPUTS  # of a struct that tells what they are
# What the name of a struct says of all its fields, such as `reference.speed`, whatever they are called.
_OF_WHOLE_STRUCTS = (None, Quantity.OTHER, Quantity.REFERENCE, Quantity.SUPPLY)
_A_SECOND = _NO_WORDS | words_of("in ft m rev")
_PER = {**dict.fromkeys(("s", "sec", "second"), "s"), **dict.fromkeys(("min", "minute"), "min")}


@dataclass(frozen=True)
class Heading:
    """What a name tells; `quantity` is None and `unit` empty where it tells nothing."""

    name: str
    words: tuple[str, ...]  # in lower case, without those of the unit
    quantity: Quantity | None
    unit: str  # a key of UNITS
    side: str  # left, right, a number, or empty


def read_heading(name: str) -> Heading:
    """Read a column's name: `leftSpeedRpm`, `Tiempo (s)`, `duty_pct`, `Battery [mV]`."""
    if name.strip() == "MV":  # a controller's manipulated variable, and no millivolts
        return Heading(name, ("mv",), Quantity.DUTY, "", "")
    unit, rest = _unit_in_brackets(name)
    in_brackets, words = bool(unit), split_words(rest)
    device = find_device(words)
    words = words[:-2] if device else words
    if not unit:
        behind = 1 if len(words) > 1 and (words[-1] in SIDES or words[-1] == "r") else 0  # rpm_left
        unit, before = _unit_at_the_end(words[: len(words) - behind])
        words = (*before, *words[len(words) - behind :])
    if unit in _A_SECOND and is_speed_by_words(words):
        unit = f"{unit}/s" if in_brackets or unit in _NO_WORDS else ""
    side = device or find_side(words)
    quantity = _tell_by_field(name, tell_quantity(words, unit))
    unit = unit or _unit_inside(words, quantity)
    if not unit and quantity in (None, Quantity.DUTY) and _has_unit_of_others(name):  # effort (N)
        quantity = Quantity.OTHER
    return Heading(name, words, quantity, unit, side)


def _tell_by_field(name: str, quantity: Quantity | None) -> Quantity | None:
    """The quantity of a struct's field, `speed_test.u`: by its own name, before that of the struct; else as it was."""
    field = read_heading(own) if (own := find_field(name)) else None
    if field is None or quantity in _OF_WHOLE_STRUCTS or not set(field.words) - _ANY_FIELD:
        return quantity
    if quantity is Quantity.TIME and not field.quantity:  # `d.samplingT1.th` is none; `time.s` and `stamp.nanosec` are
        return quantity if field.unit in TIME_UNITS or name.count(".") == 1 else None
    if (quantity, field.quantity) == (Quantity.VOLTAGE, Quantity.DUTY):  # `voltage.command`
        return quantity
    return field.quantity or quantity


def is_in_volts(heading: Heading) -> bool:
    """Whether a name says that its column is in volts, whatever else it says: `Tacho (V)`, `encoder_V`."""
    return heading.unit in ("V", "mV") or bool(_VOLTS_AT_THE_END.search(heading.name))


def is_direction(name: str) -> bool:
    """Whether a column's name says that it is the way in which a drive goes, `dir` or `reverse`."""
    return bool(DIRECTIONS & set(read_heading(name).words))


def is_of_joint_states(heading: Heading) -> bool:
    """Whether a name says that its column is of ROS's joint states, which are in radians."""
    return bool({"jointstate", "jointstates"} & set(heading.words)) or any(
        pair in (("joint", "states"), ("joint", "state"))
        for pair in zip(heading.words, heading.words[1:], strict=False)
    )


def words_besides(heading: Heading) -> tuple[str, ...]:
    """The words of a name that tell no quantity, but a machine's part: `front left` of `frontLeftVolts`."""
    telling = _TELLING | {"cycle"} if "duty" in heading.words else _TELLING
    return tuple(word for word in heading.words if word not in telling)


def _unit_in_brackets(name: str) -> tuple[str, str]:
    for match in _BRACKETS.finditer(name):
        spelt = match[1].strip().lower().replace(" ", "")
        unit = "count" if spelt in COUNTS_IN_BRACKETS else UNIT_BY_SPELLING.get(spelt, "")
        if unit:
            return unit, name.replace(match[0], " ")
    return "", _BRACKETS.sub(lambda match: " " if "/" in match[1] else f" {match[1]} ", name)  # furlongs/s: no seconds


def _has_unit_of_others(name: str) -> bool:
    return any(match[1].strip().lower().replace(" ", "") in OF_OTHERS for match in _BRACKETS.finditer(name))


def _unit_at_the_end(words: tuple[str, ...]) -> tuple[str, tuple[str, ...]]:
    """`speed rad s` is in rad/s, `pos deg` in degrees; a name that is only a unit keeps its word."""
    if len(words) > 2 and words[-2] == "per" and words[-1] in _PER:  # velocityRadPerSec, deg_per_s
        unit = UNIT_BY_SPELLING.get(f"{UNIT_BY_SPELLING.get(words[-3], '')}/{_PER[words[-1]]}", "")
        if unit:
            return unit, words[:-3] or words[:1]
    if words[-1:] == ("hz",) and any(word.isdigit() for word in words[-3:-1]):  # sampled at 8 kHz: no speed
        return "", words
    for length in (2, 1):
        unit = UNIT_BY_SPELLING.get("_".join(words[-length:]), "") if len(words) >= length else ""
        if unit and len(words) > length and words[-1] not in ("a", "v", "l", "r"):
            return unit, words[:-length]
        if unit and len(words) == length and unit not in ("A", "m", "s", "V"):
            return unit, words
    return "", words


def _unit_inside(words: tuple[str, ...], quantity: Quantity | None) -> str:
    """The unit of a motion with words behind it: `rpm_actual`, `RPM_Motor_DC`, `angle deg meas`; empty without one."""
    pairs = ("_".join(pair) for pair in zip(words, words[1:], strict=False))
    units = (UNIT_BY_SPELLING[one] for one in (*pairs, *words) if one in _INSIDE)
    return next((unit for unit in units if UNITS[unit][0] is quantity), "")
