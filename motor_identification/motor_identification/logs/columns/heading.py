"""A column's name taken apart: its words, its unit, the quantity they tell, the side it belongs to."""

import re
from dataclasses import dataclass

from motor_identification.logs.columns.vocabulary import (
    COUNTS_IN_BRACKETS,
    FILTERED,
    MEASURED,
    MOVES,
    OF_OTHERS,
    OUTPUTS,
    SHARES,
    SIDES,
    TAILS,
    UNIT_BY_SPELLING,
    UNITS,
    VOLTAGE_WORDS,
    WORDS,
    Quantity,
    words_of,
)

_BRACKETS = re.compile(r"[\[({<]([^\])}>]*)[\])}>]")
_PARTS = re.compile(r"[^\W\d_]+|\d+|%|°")
_CAMEL = re.compile(r"(?<=[^\W\d_A-ZÀ-Þ])(?=[A-ZÀ-Þ])|(?<=[A-Z])(?=[A-Z][a-z])")
_ORDERS = frozenset(["command", "cmd", "commanded"])  # of a speed or a position: what it should be
_PULSES = frozenset(["esc", "signal", "pwm", "throttle", "pulse", "width", "command", "cmd", "output"])
_MILLI = re.compile(r"(?<![^\W\d_])m([AVS])(?![^\W_])")  # units of one word, whatever their capitals
_VOLTS_AT_THE_END = re.compile(r"[^\W_][\s_]V$")  # `left_v` is a velocity
_SENSORS = frozenset(["encoder", "enc", "qei"])
AXES = frozenset(["yaw", "pitch", "roll"])
_JOINT_FIELDS = frozenset(["position", "velocity", "effort"])
_OF_AXES = _JOINT_FIELDS | SHARES | VOLTAGE_WORDS  # what a machine's axis has, and no angle of a body in the air
_TELLING = frozenset().union(MEASURED, *(WORDS[kind] for kind in (*MOVES, Quantity.VOLTAGE, Quantity.DUTY)))
_KNOWN = frozenset().union(*WORDS.values(), MEASURED, FILTERED)
_MOTIONS = frozenset(word for kind in MOVES for word in WORDS[kind] if len(word) > 2)
_WRITTEN_TOGETHER = re.compile(  # the longer ones first
    "|".join(sorted((word for word in _KNOWN if "\u2e80" < word[0] < "\ua4d0"), key=len, reverse=True))
)
_INSIDE = words_of("rpm erpm upm krpm rad_s deg_s rad_sec deg_sec deg degrees")  # units that are no other word
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
    words = split_words(rest)
    device = _device(words)
    words = words[:-2] if device else words
    if not unit:
        behind = 1 if len(words) > 1 and (words[-1] in SIDES or words[-1] == "r") else 0  # rpm_left
        unit, before = _unit_at_the_end(words[: len(words) - behind])
        words = (*before, *words[len(words) - behind :])
    side = device or _side(words)
    quantity = _quantity(words, unit)
    unit = unit or _unit_inside(words, quantity)
    if not unit and quantity in (None, Quantity.DUTY) and _has_unit_of_others(name):  # effort (N)
        quantity = Quantity.OTHER
    return Heading(name, words, quantity, unit, side)


def is_in_volts(heading: Heading) -> bool:
    """Whether a name says that its column is in volts, whatever else it says: `Tacho (V)`, `encoder_V`."""
    return heading.unit in ("V", "mV") or bool(_VOLTS_AT_THE_END.search(heading.name))


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


def split_words(text: str) -> tuple[str, ...]:
    """The words of a name, in lower case."""
    whole = _MILLI.sub(lambda match: f" m{match[1].lower()} ", text)
    apart = _CAMEL.sub(" ", whole.replace("ω", " ω ").replace("θ", " θ "))
    return tuple(part for word in _PARTS.findall(apart) for part in _taken_apart(word.lower()))


def _taken_apart(word: str) -> tuple[str, ...]:
    """The known words in one that are written together, as in Chinese and in German; else the word itself."""
    if word in _KNOWN:
        return (word,)
    if word[0] in "lr" and word[1:] in _MOTIONS:  # Lspeed beside Rspeed; RPWM and LPWM may be one motor's two ways
        return (word[0], word[1:])
    if found := tuple(_WRITTEN_TOGETHER.findall(word)):
        return found
    tail = next((one for one in TAILS if word.endswith(one)), "")
    return (word.removesuffix(tail), tail) if tail else (word,)


def _unit_at_the_end(words: tuple[str, ...]) -> tuple[str, tuple[str, ...]]:
    """`speed rad s` is in rad/s, `pos deg` in degrees; a name that is only a unit keeps its word."""
    if len(words) > 3 and words[-2] == "per" and words[-1] in _PER:  # velocityRadPerSec
        unit = UNIT_BY_SPELLING.get(f"{UNIT_BY_SPELLING.get(words[-3], '')}/{_PER[words[-1]]}", "")
        if unit:
            return unit, words[:-3]
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


def _side(words: tuple[str, ...]) -> str:
    for word in words:
        if word in SIDES:
            return SIDES[word]
    if "r" in words and len(words) > 1:
        return "right"
    numbers = [
        words[k + 1] for k in range(len(words) - 1) if words[k] in ("m", "motor", "wheel") and words[k + 1].isdigit()
    ]
    return numbers[0] if numbers else ""


def _device(words: tuple[str, ...]) -> str:
    """The number of a VESC, `DutyCycle_V1` beside `DutyCycle_V2`; empty where a `v` is the only word that is known."""
    numbered = len(words) > 2 and words[-2] == "v" and words[-1].isdigit()
    return words[-1] if numbered and any(len(word) > 1 and word in _KNOWN for word in words[:-2]) else ""


def _quantity(words: tuple[str, ...], unit: str) -> Quantity | None:
    told = [
        kind
        for kind, known in WORDS.items()
        if known & set(words) and not (kind is Quantity.REFERENCE and _is_side(words))
    ]
    if _is_joint(words):
        told.remove(Quantity.OTHER)
    if _is_duty_whatever_its_unit(words, unit, told):
        return Quantity.DUTY
    by_unit = UNITS[unit][0] if unit else None
    if Quantity.OTHER in told and "rate" not in words:
        return Quantity.OTHER
    if Quantity.REFERENCE in told:
        return Quantity.REFERENCE
    if Quantity.SUPPLY in told and by_unit in (None, Quantity.VOLTAGE):
        return Quantity.SUPPLY
    if by_unit is not None:
        return _moves_by_unit(by_unit, told, words)
    if MOVES & set(told) and (_ORDERS | {"commande"}) & set(words):
        return Quantity.REFERENCE
    if _is_speed_after_all(words, told):
        return Quantity.SPEED
    if Quantity.VOLTAGE in told and Quantity.DUTY in told:
        return Quantity.VOLTAGE
    return _quantity_of_an_output(words, told) or (told[0] if told else None)


def _is_speed_after_all(words: tuple[str, ...], told: list[Quantity]) -> bool:
    """Whether another word than the first tells a speed: `theta_dot`, and `velocity_encoder`, which measures it."""
    if told[:2] == [Quantity.COUNT, Quantity.SPEED]:
        return not WORDS[Quantity.COUNT] & set(words) - _SENSORS
    return told[:1] == [Quantity.POSITION] and words[-1] == "dot"


def _quantity_of_an_output(words: tuple[str, ...], told: list[Quantity]) -> Quantity | None:
    """`output speed` is the speed that comes out, `speed output` what a controller of speeds puts out; else None."""
    if told[:1] != [Quantity.DUTY] or WORDS[Quantity.DUTY] & set(words) - OUTPUTS:
        return None
    return next((kind for kind in told if kind in MOVES and words[-1] in WORDS[kind]), None)


def _is_duty_whatever_its_unit(words: tuple[str, ...], unit: str, told: list[Quantity]) -> bool:
    """Whether a name is one of a duty: `pwm_rev`, that of the other way; `PWM [ticks]`, `Commande [pt]`, of a timer.

    So is `ESC signal (µs)`, of a test stand.
    """
    if is_pulse_of_esc(words):
        return True
    if unit == "rev":
        return Quantity.DUTY in told
    return unit == "count" and told == [Quantity.DUTY] and not (_ORDERS | OUTPUTS) & set(words)


def is_pulse_of_esc(words: tuple[str, ...]) -> bool:
    """Whether a name is that of the pulses which a brushless motor's controller gets, not of what that measures."""
    return "esc" in words and all(word in _PULSES or word.isdigit() for word in words)


def _is_joint(words: tuple[str, ...]) -> bool:
    """Whether a name is one of a joint's fields, as ROS has them, or its drive: yaw, pitch and roll are joints then."""
    others = WORDS[Quantity.OTHER] & set(words)
    return bool(others) and others <= AXES and bool(_OF_AXES & set(words))


def _is_side(words: tuple[str, ...]) -> bool:
    """Whether the r in a name means the right one: `r speed`, not `r` alone."""
    return "r" in words and len(words) > 1 and not WORDS[Quantity.REFERENCE] & (set(words) - {"r"})


def _moves_by_unit(by_unit: Quantity, told: list[Quantity], words: tuple[str, ...]) -> Quantity:
    """The unit says what it is; of a speed or an angle, the words whether it is measured."""
    if by_unit in MOVES and _ORDERS & set(words):
        return Quantity.REFERENCE
    return by_unit
