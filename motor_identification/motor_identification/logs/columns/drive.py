"""Which column drives the motor, and how it becomes volts: voltages, duties of a supply, a battery beside them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.behaviour.stray_rows import find_stray_rows
from motor_identification.logs.columns.heading import Heading
from motor_identification.logs.columns.names.quantity import is_pulse
from motor_identification.logs.columns.vocabulary import SHARES, UNITS, VOLTAGE_WORDS, Quantity, words_of
from motor_identification.logs.correlation import correlate
from motor_identification.logs.csv.table import Table

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

# Levels of a drive that may be a set-point.
BANDS = 8  # of the drive's range, each a level
LEAST_ROWS = 0.03  # of all rows, in a band: a level that was held
LEAST_SIZE = 0.2  # of the largest number: a motor that stands is at 0 by any drive
SAME = 0.02  # of the largest number: within it a controlled speed is what it should be, at all levels. Measured: 0.01
LEAST_LEVELS = 2
USUAL, MOST = 0.99, 2.0  # quantile of a drive, and times that: beyond are cells that lost a point, 2515 for 251.5

# What a duty column shows at full duty: shares, per cent, and the registers of timers.
FULL_DUTIES = (1.0, 100.0, 255.0, 1000.0, 1023.0, 4095.0, 32767.0, 65535.0)
# Full duties where they are reached: of VEX and of motor controllers on a serial line, of Pololu's motor drivers,
# and of timers of 11 bits: half of 12 bits is 2048 or 2000 to whoever writes it.
FULL_WHERE_REACHED = (127.0, 400.0, 2047.0)
_PER_CENT = frozenset({"duty", "power", "throttle", "output", "effort", "control"})
HUNDRED = 100.0  # all that per cent go to, and what people write to a PWM of 8 bits
_CHOSEN = 5.0  # people's levels are multiples of: 15 of 100 or of 255
_OF_BOTH = ", {:g} of 100 or of 255"
_EFFORTS = words_of("effort esforço esforco esfuerzo")  # a share by its name alone: a control effort is a command
_CONTROLLERS = words_of("control controle contrôle controller")
_SHORTEST_PULSE = 400.0  # [µs] that any servo or ESC of usual pulses gets; 0 is none
_STRAY = 0.05  # of the rows with a pulse, whose numbers may be others: a mark of a lost signal
_PULSES = (1_000.0, 2_500.0)  # [µs] the longest of a log, of which none is a share of the supply
_SUPPLIES = (15.0, 18.0, 24.0, 36.0, 48.0)  # [V] where commands are cut off
_MOST_VOLTS = 12.0  # of a command that never is larger: a duty of so few per cent, or of 255, moves no motor
_CUT_OFF = 3  # rows at the largest command
_BITS_8 = 255.0  # of the register of most boards; a duty of so many at most is called a voltage by some
_OF_DUTY = " (of a duty, say --full-duty)"
_STEADY_SUPPLY = 0.5  # of its largest value: a supply stays above, a motor's voltage passes 0
MILLIVOLTS_FROM = 100.0  # such a supply is given in mV
_BITS = words_of("bit bits")
_TIMERS = words_of("8 9 10 11 12 13 14")  # of 16 bits a register may have a sign
_TIMED = words_of("pwm duty")
_STANDS = 0.01  # of the largest speed
_WITH = 0.5  # correlation of what rises, or falls, with a speed
_USUALLY = 0.9  # quantile: a converter's noise is above now and then
_EFFORT = "effort"  # of joint states
REACHED = 0.5  # of a register of 16 bits, below which a largest duty tells nothing of it: 5,299 is of 5,319 or of 6,000
FEWEST_MILLIVOLTS = 2000.0  # of what is called a voltage: fewer may be a duty of 255 or 1,023
LARGEST_VOLTS = 60.0  # whole numbers beyond are a duty
MOST_VOLTS = 1000.0  # and any numbers beyond these, of machines on a mains voltage, are no volts
_LARGEST_UNNAMED = 24.0  # and where no name says that they are volts


@dataclass(frozen=True)
class Drive:
    """How the driving column becomes volts, and in words why."""

    scale: float | None  # volts, or share of the supply, per unit; None: the supply has to be said
    why: str
    full: float | None = None  # a duty's value at full duty
    sure: bool = True  # whether that could be told from its values at all
    doubt: str = ""  # between what, where it could not


def voltage_drive(heading: Heading, values: Floats) -> Drive:
    """A column that holds volts, or whole numbers that no small motor has as volts."""
    scale = UNITS[heading.unit][1] if heading.unit in ("V", "mV") else None
    if scale is not None:
        return Drive(scale, f"in {heading.unit}")
    largest = float(np.max(np.abs(values), initial=0.0))
    if largest > (LARGEST_VOLTS if heading.quantity else _LARGEST_UNNAMED) and not np.any(values % 1.0):
        if FEWEST_MILLIVOLTS <= largest <= 1e3 * LARGEST_VOLTS and set(heading.words) & VOLTAGE_WORDS:
            return Drive(1e-3, "in mV (assumed; otherwise: --full-duty, --voltage-scale)")
        if set(heading.words) & VOLTAGE_WORDS and _is_mains(values, largest):
            usual = float(np.median(values[values != 0.0]))
            return Drive(
                None, f"stays near {usual:.4g}, which in V is more than a small motor gets{_OF_DUTY}", sure=False
            )
        return duty_drive(heading, values)
    if largest > MOST_VOLTS and heading.quantity is not None:
        if set(heading.words) & VOLTAGE_WORDS:
            return Drive(None, f"goes up to {largest:.4g}, more than a motor's volts", sure=False)
        return duty_drive(heading, values)  # an input, or a controller's u
    if heading.quantity is None and largest > LARGEST_VOLTS:
        return Drive(None, f"goes up to {largest:.4g}, more than a motor's volts", sure=False)
    if not set(heading.words) & VOLTAGE_WORDS and LARGEST_VOLTS < largest in FULL_DUTIES and _is_cut_off(values):
        return duty_drive(heading, values)
    if 0.0 < largest <= 1.0 and not set(heading.words) & VOLTAGE_WORDS:
        return Drive(1.0, "in V (assumed; but no value is above 1: of a share of the supply, say --full-duty 1)")
    return Drive(1.0, "in V (assumed; otherwise: --full-duty, --voltage-scale)")


def duty_drive(heading: Heading, values: Floats, full: float | None = None) -> Drive:
    """A duty, as a share of the supply's voltage."""
    if full:
        return Drive(None, f"as a duty of ±{full:g}", full)
    largest = float(np.max(np.abs(values), initial=0.0))
    if _is_called_pulse(heading) and (pulse := _pulse_drive(heading, values, largest)):
        return pulse
    if heading.unit == "%" and (largest > 1.0 or not np.any(values % 1.0)):
        return Drive(None, "as a duty in %", 100.0)
    if heading.unit == "%":  # which would be a motor that never gets 1 % of its supply
        return Drive(
            None, "as a share, as no value is above 1, whatever its name says (otherwise: --full-duty 100)", 1.0
        )
    if bits := _bits_by_name(heading.words, largest):
        full_of_bits = 2.0**bits - 1.0
        return Drive(
            None,
            f"as a duty of ±{full_of_bits:g} (assumed, of {bits} bits by its name; otherwise: --full-duty)",
            full_of_bits,
        )
    if (stray := find_stray_rows(values)).any() and (drive := _drive_but_for(stray, heading, values, largest)):
        return drive
    if largest in FULL_WHERE_REACHED:
        levels = np.unique(np.abs(values[values != 0.0]))
        half = len(levels) == 1 and any(largest == full // 2 for full in FULL_DUTIES)  # one level is as likely half
        return Drive(None, f"as a duty of ±{largest:g} (assumed; otherwise: --full-duty)", largest, sure=not half)
    if why := _why_in_volts(heading, values, largest):
        return Drive(1.0, f"in V (assumed, as {why}; otherwise: --full-duty, --voltage-scale)")
    if heading.quantity is None and largest < 100.0 and not np.any(values % 1.0):  # of 100 or of 255: nothing tells
        return Drive(None, f"as a duty of ±{largest:g} (assumed; otherwise: --full-duty)", largest, sure=False)
    return _drive_by_largest(heading, values, largest)


def _drive_but_for(stray: Bools, heading: Heading, values: Floats, largest: float) -> Drive | None:
    """What asks for the full duty where stray rows, of shape (K,), would decide; None where all others say the same."""
    without = duty_drive(heading, values[~stray])
    if without.full == _drive_by_largest(heading, values, largest).full:
        return None
    usual, number = float(np.max(np.abs(values[~stray]))), np.count_nonzero(stray)
    rows = "one, which is" if number == 1 else f"{number}, which are up to"
    doubt = f", up to {usual:g} in all rows but {rows} {largest:g}"
    return Drive(None, f"as a duty of ±{largest:g}", without.full or largest, sure=False, doubt=doubt)


def _pulse_drive(heading: Heading, values: Floats, largest: float) -> Drive | None:
    """What asks about pulses [µs] (K,), which are no share of the supply; None where they may be one."""
    if _PULSES[0] <= largest <= _PULSES[1]:
        if not are_pulses(heading, values):
            least = float(np.min(np.abs(values[values != 0.0])))
            digital = "as digital commands do (of DSHOT: --full-duty 2047 and --supply-voltage V)"
            return Drive(None, f"goes from {least:g} to {largest:g}, no pulse in µs but {digital}", sure=False)
        whose = "a servo's" if "servo" in heading.words else "an ESC's"
        return Drive(None, f"is {whose} pulse in µs and no duty, as it is 1000 or 1500 at 0 V", sure=False)
    if heading.unit == "us" and not {"esc", "servo"} & set(heading.words) and largest > 1.0:  # else read as a share
        return Drive(None, "is how long a pulse is in µs, and no number says how far they are apart", sure=False)
    return None


def _bits_by_name(words: tuple[str, ...], largest: float) -> int:
    """The bits of a timer that a name tells, up to the largest value of a column; 0 where it tells none.

    `pwm 12 bit` does; `pwm10` may be a pin, whose 8 bits end at 255: beyond them 10 are meant.
    """
    told = [int(one) for one, unit in zip(words, words[1:], strict=False) if unit in _BITS and one in _TIMERS]
    if not told and words[-1:] == ("10",) and words[-2:-1] and words[-2] in _TIMED and largest > _BITS_8:
        told = [10]
    return told[0] if len(told) == 1 and 1.0 < largest <= 2.0 ** told[0] - 1.0 else 0


def are_pulses(heading: Heading, values: Floats) -> bool:
    """Whether a column (K,) holds the pulses [µs] that a model's motor controller or servo gets."""
    pulses = np.sort(np.abs(values[values != 0.0]))
    if not _is_called_pulse(heading) or not len(pulses) or not _PULSES[0] <= pulses[-1] <= _PULSES[1]:
        return False
    return bool(pulses[int(_STRAY * len(pulses))] >= _SHORTEST_PULSE)


def _is_called_pulse(heading: Heading) -> bool:
    return is_pulse(heading.words, heading.unit) or (heading.quantity is Quantity.DUTY and heading.unit == "us")


def _drive_by_largest(heading: Heading, values: Floats, largest: float) -> Drive:
    """A duty as a share of the first full one that its largest does not pass."""
    if largest == HUNDRED and not np.any(values % 1.0):
        return _drive_of_hundred(heading, values)
    if 1.0 < largest < HUNDRED and not np.any(values % 1.0) and not set(heading.words) & _PER_CENT:
        return _drive_below_hundred(values)
    for candidate in FULL_DUTIES if not _is_odd_timer(largest) else ():
        if largest <= candidate:
            return Drive(None, f"as a duty of ±{candidate:g} (assumed; otherwise: --full-duty)", candidate)
    return Drive(None, f"as a duty of ±{largest:g} (assumed; otherwise: --full-duty)", largest, sure=False)


def _drive_of_hundred(heading: Heading, values: Floats) -> Drive:
    """Whole duties that come to 100 and no further: per cent as far as can be told, and not where 100 is all there is.

    One level that no name calls a share in per cent is as likely some step of a PWM of 8 bits.
    """
    levels = np.unique(np.abs(values[values != 0.0]))
    why = (
        "as a duty of ±100 (assumed, as none is larger and nothing says per cent; if full duty is 255, say "
        "--full-duty 255: voltages are 2.55 times too large else)"
    )
    sure = len(levels) > 1 or bool(_PER_CENT & set(heading.words))
    return Drive(None, why, HUNDRED, sure, doubt=_OF_BOTH.format(HUNDRED))


def _drive_below_hundred(values: Floats) -> Drive:
    """Whole duties that never come to 100: of 8 bits, and as likely in per cent where people chose their levels.

    A controller of 8 bits computes any whole number; one that computes per cent has fractions.
    """
    why = (
        f"as a duty of ±{_BITS_8:g} (assumed, as they are whole numbers; if they are per cent, say --full-duty 100: "
        "voltages are 2.55 times too small else)"
    )
    largest = float(np.max(np.abs(values), initial=0.0))
    return Drive(None, why, _BITS_8, sure=bool(np.any(values % _CHOSEN)), doubt=_OF_BOTH.format(largest))


def _why_in_volts(heading: Heading, values: Floats, largest: float) -> str:
    """Why what is called a command holds volts: they are a few, or are cut off where supplies are; empty where not."""
    of_controller = bool(_CONTROLLERS & set(heading.words))
    if heading.unit or set(heading.words) & (SHARES - _EFFORTS if of_controller else SHARES) or largest <= 1.0:
        return ""
    if largest <= _MOST_VOLTS:
        return "no duty is so small"
    cut_off = _is_cut_off(values) and bool(np.any(values % 1.0))
    return f"it is cut off at {largest:g}" if largest in _SUPPLIES and cut_off else ""


def _is_cut_off(values: Floats) -> bool:
    """Whether commands, shape (K,), come to their largest again and again."""
    return np.count_nonzero(np.abs(values) == np.max(np.abs(values), initial=0.0)) >= _CUT_OFF


def _is_mains(values: Floats, largest: float) -> bool:
    """Whether what is called a voltage, shape (K,), is a large machine's: beyond 8 bits, and on it never swings."""
    on = values[values != 0.0]
    return largest > _BITS_8 and largest not in FULL_DUTIES and bool(np.all(on >= _STEADY_SUPPLY * largest))


def _is_odd_timer(largest: float) -> bool:
    """Whether duties are those of a timer that counts to a number of its own: too many for 12 bits, too few for 16."""
    return FULL_DUTIES[-3] < largest < REACHED * FULL_DUTIES[-2]


def supply_scale(heading: Heading, values: Floats) -> tuple[float, str]:
    """Volts per unit of a supply's column, and the unit in words."""
    if heading.unit in ("V", "mV"):
        return UNITS[heading.unit][1] or 1.0, heading.unit
    if float(np.median(values)) > MILLIVOLTS_FROM:
        return 1e-3, "mV (assumed)"
    return 1.0, "V"


def is_supply(values: Floats, duty: Floats) -> bool:
    """Whether voltages, shape (K,), are those of a supply: they stay where a duty beside them passes 0 or turns."""
    largest = float(np.max(np.abs(values), initial=0.0))
    steady = bool(np.all(values >= _STEADY_SUPPLY * largest)) and largest > 0.0
    swing = np.ptp(np.abs(duty))
    return steady and bool(swing > 0.5 * np.max(np.abs(duty), initial=0.0))


def sags(values: Floats, duty: Floats, speed: Floats) -> bool:
    """Whether voltages are those of a supply under load: the faster a motor runs by its duty, the lower they are.

    What drives a motor is higher where it runs faster, and a supply is at its highest where the motor stands. All of
    shape (K,), in any unit; the duty may be a pulse, 1000 at rest.
    """
    size = np.abs(speed)
    top, largest = float(np.max(size, initial=0.0)), float(np.max(np.abs(values), initial=0.0))
    stands = size <= _STANDS * top
    if not stands.any() or stands.all() or float(np.min(values)) < _STEADY_SUPPLY * largest:
        return False
    rest = float(np.median(values[stands]))
    command = np.abs(duty - float(np.median(duty[stands])))
    highest = rest >= float(np.quantile(values[~stands], _USUALLY))
    return highest and correlate(values, size) < -_WITH and correlate(command, size) > _WITH


def drives(heading: Heading) -> bool:
    """Whether a name is that of what drives a motor."""
    return heading.quantity in (Quantity.VOLTAGE, Quantity.DUTY)


def leave_out_idle_efforts(table: Table, headings: Sequence[Heading]) -> list[Heading]:
    """Leave out efforts that are zero in every row, where another column drives: most robots' joint states have such.

    Of other names a drive that is zero is that of a motor which is not driven; so is an effort beside efforts alone,
    but for one among a joint's other fields, beside a command that is none of them.
    """
    efforts = [one for one in headings if drives(one) and _EFFORT in one.words]
    others = [one for one in headings if drives(one) and one not in efforts]
    if not others:
        fields = [one for one in efforts if _is_field_of_joint(table, one)]
        others = [one for one in efforts if one not in fields]
        efforts = fields
    if not others:
        return list(headings)
    return [one for one in headings if one not in efforts or np.any(table.numbers(one.name))]


def _is_field_of_joint(table: Table, effort: Heading) -> bool:
    """Whether the effort has the position or the velocity of the same joint beside it."""
    return any(effort.name.replace(_EFFORT, field) in table.names for field in ("position", "velocity"))


def find_same_levels(drive: Floats, motion: Floats) -> int:
    """Count the levels of a drive (K,), if a motion (K,) is the same number at all of them; else 0.

    A controlled speed comes to the very numbers of its set-point. What drives a motor is in volts or duties, and what
    it turns in another unit: both are the same at several levels by chance once in hundreds of logs.
    """
    top = float(np.quantile(np.abs(drive), USUAL)) if len(drive) else 0.0
    if top == 0.0:
        return 0
    usual = np.abs(drive) <= MOST * top
    drive, motion = drive[usual], motion[usual]
    with np.errstate(over="ignore"):  # a damaged cell may be any number
        drive, motion = drive / top, motion / top
    swing = float(np.ptp(drive))
    if swing == 0.0:
        return 0
    band = np.minimum(BANDS * (drive - drive.min()) / swing, BANDS - 1).astype(int)
    levels = [band == number for number in range(BANDS)]
    held = [rows for rows in levels if np.mean(rows) > LEAST_ROWS]
    held = [rows for rows in held if abs(float(np.median(drive[rows]))) > LEAST_SIZE]
    apart = [abs(float(np.median(motion[rows] - drive[rows]))) for rows in held]
    return len(held) if len(held) >= LEAST_LEVELS and max(apart) < SAME else 0
