"""Tell the quantity of a column by the words of its name and by its unit."""

from motor_identification.logs.columns.vocabulary import (
    DURATIONS,
    INPUTS,
    MOVES,
    OUTPUTS,
    SHARES,
    SIDES,
    UNITS,
    VOLTAGE_WORDS,
    WORDS,
    Quantity,
    words_of,
)

# What drives, in volts or not, by words that say neither; and words that say a share of the supply whatever is beside
# them, which power in watts and a controller's effort do not.
_ANY_DRIVE = INPUTS | words_of("u applied sine sinewave chirp ramp stair stairs staircase prbs aprbs sweep excitation")
_DUTIES = SHARES - words_of("power effort esforço esforco esfuerzo")
_ORDERS = frozenset(["command", "cmd", "commanded"])  # of a speed or a position: what it should be
_PULSES = frozenset(["esc", "servo", "signal", "pwm", "throttle", "pulse", "width", "command", "cmd", "output"])
_LASTING = frozenset(["pwm", "throttle"])  # in µs: how long its pulses are, and no time
_TESTS = frozenset(["test", "trial"])  # whose numbers are no times, however evenly they go on
_NUMBERS = frozenset(["no", "nr", "num", "number"])
_ROWS = frozenset(["sample", "samples", "row", "rows"])
_LOOPS = frozenset(["loop", "cycle", "sampling", "control", "step"])
_SENSORS = frozenset(["encoder", "enc", "qei"])
AXES = frozenset(["yaw", "pitch", "roll"])
_JOINT_FIELDS = frozenset(["position", "velocity", "effort"])
_OF_AXES = _JOINT_FIELDS | SHARES | VOLTAGE_WORDS  # what a machine's axis has, and no angle of a body in the air


def tell_quantity(words: tuple[str, ...], unit: str) -> Quantity | None:
    """The quantity that a name's words and its unit tell, a key of UNITS or empty; None where they tell none."""
    told = [
        kind
        for kind, known in WORDS.items()
        if known & set(words) and not (kind is Quantity.REFERENCE and _is_side(words))
    ]
    if _is_joint(words) or are_counts_per_row(words):
        told = [kind for kind in told if kind is not Quantity.OTHER]
    if _is_duty_whatever_its_unit(words, unit, told):
        return Quantity.DUTY
    by_unit = UNITS[unit][0] if unit else None
    if (Quantity.OTHER in told and "rate" not in words) or _numbers_tests(words):
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
        volts = WORDS[Quantity.VOLTAGE] & set(words) - _ANY_DRIVE
        return Quantity.DUTY if _DUTIES & set(words) and not volts else Quantity.VOLTAGE  # `inputDutyCycle`, `u_pwm`
    return _quantity_of_an_output(words, told) or (told[0] if told else None)


def _numbers_tests(words: tuple[str, ...]) -> bool:
    """Whether a column numbers tests, `Test #`, `trial_no`."""
    return bool(_TESTS & set(words)) and set(words) <= _TESTS | _NUMBERS


def may_number_rows(words: tuple[str, ...]) -> bool:
    """Whether a name may be that of the rows' numbers: `Sample`, `sample_no`."""
    return bool(_ROWS & set(words)) and set(words) <= _ROWS | _NUMBERS


def may_be_duration(words: tuple[str, ...]) -> bool:
    """Whether a name may be that of how long a row or a loop took, or what it waits: `dt`, `Ts`, `sample_period`."""
    return bool(DURATIONS & set(words)) and set(words) <= DURATIONS | _ROWS | _LOOPS | WORDS[Quantity.TIME]


def are_counts_per_row(words: tuple[str, ...]) -> bool:
    """Whether a name is that of the counts of each row: `ticks_per_sample`, `counts_per_loop`."""
    return bool(
        words[-2:-1] == ("per",)
        and words[-1] in _ROWS | _LOOPS | {"period", "interval"}
        and WORDS[Quantity.COUNT] & set(words[:-2])
    )


def is_speed_by_words(words: tuple[str, ...]) -> bool:
    """Whether the words of a name tell a speed, whatever its unit: `omega`, `Winkelgeschwindigkeit`, `theta_dot`."""
    if _is_dotted(words) or (words and words[-1] in WORDS[Quantity.SPEED]):
        return True
    others = WORDS[Quantity.POSITION] | WORDS[Quantity.COUNT] - _SENSORS
    return bool(WORDS[Quantity.SPEED] & set(words)) and not others & set(words)


def _is_speed_after_all(words: tuple[str, ...], told: list[Quantity]) -> bool:
    """Whether another word than the first tells a speed: `theta_dot`, and `velocity_encoder`, which measures it."""
    if told[:2] == [Quantity.COUNT, Quantity.SPEED]:
        return not WORDS[Quantity.COUNT] & set(words) - _SENSORS
    return told[:1] == [Quantity.POSITION] and _is_dotted(words)


def _is_dotted(words: tuple[str, ...]) -> bool:
    """Whether a name ends in a dot, but for the motor it is of: `theta_dot`, `phi_dot1`, `theta_dot_left`."""
    kept = [word for word in words if not word.isdigit() and word not in SIDES]
    return kept[-1:] == ["dot"]


def _quantity_of_an_output(words: tuple[str, ...], told: list[Quantity]) -> Quantity | None:
    """`output speed` is the speed that comes out, `speed output` what a controller of speeds puts out; else None."""
    if told[:1] != [Quantity.DUTY] or WORDS[Quantity.DUTY] & set(words) - OUTPUTS:
        return None
    return next((kind for kind in told if kind in MOVES and words[-1] in WORDS[kind]), None)


def _is_duty_whatever_its_unit(words: tuple[str, ...], unit: str, told: list[Quantity]) -> bool:
    """Whether a name is one of a duty: `pwm_rev`, that of the other way; `PWM [ticks]`, `Commande [pt]`, of a timer.

    So are `ESC signal (µs)` and `Servo 3 (µs)`, of a test stand, and `pwm_us`.
    """
    if is_pulse(words, unit) or (unit == "us" and _LASTING & set(words) and set(words) <= _PULSES):
        return True
    if unit == "rev":
        return Quantity.DUTY in told
    return unit == "count" and told == [Quantity.DUTY] and not (_ORDERS | OUTPUTS) & set(words)


def is_pulse(words: tuple[str, ...], unit: str) -> bool:
    """Whether a name is that of the pulses which a controller of a model's motor or a servo gets, not of a measurement.

    What a servo gets is told by its unit: `servo` alone may be its angle.
    """
    named = "esc" in words or ("servo" in words and unit == "us")
    return named and all(word in _PULSES or word.isdigit() for word in words)


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
    if by_unit is Quantity.POSITION and told == [Quantity.TIME]:  # `time_m`, a model's beside `time_r`, is no length
        return Quantity.TIME
    return by_unit
