"""How large one count is, and how many there are in a turn: said, seen in the data, or fine enough to stand for it.

The counts of a turn need not be whole: a converter behind a potentiometer, printed digits and a gear have no regard for
turns. `motor/info` has whole counts of an encoder's turn, and the turns of the encoder in one of the output: 102.4
counts a turn are 102, and a gear of 256/255.
"""

from dataclasses import dataclass, replace
from fractions import Fraction
from math import ceil, floor, log10, pi

import numpy as np

from motor_identification.logs.form import UNITS, CsvForm, Kind
from motor_identification.logs.position_lattice import Lattice, find_position_lattice
from motor_identification.logs.signals import Floats
from motor_identification.sensor.white_noise import estimate_white_noise
from motor_model.errors import RecordingError
from motor_model.gearing.gear import LEAST, MOST, MOST_TEETH

# How far, relatively, the counts of a turn may be from those said or from a whole number: they scale what is measured
# where positions are counted, and only the noise floor where speeds are given.
AGREE_COUNTS, AGREE_SPEED = 1e-4, 1e-3
MOST_EDGES = 10_000_000  # a turn: a finer encoder than is sold, and within what motor/info can say
FEWEST_COUNTS = 8  # of an encoder's turn that is made up: slots that are told apart
# Counts from row to row, at most, where counts stand for a position without steps: as many as an encoder of a thousand
# lines has on such a motor. More would make a jump of every reversal, and are finer than any model.
COUNTS_A_ROW = 30.0
FINE = (360, 1_000_000)  # counts a turn that stand for a position without steps: at least, at most
PRINTED = 1e-8  # of a position's unit: how far its turns may be from numbers of 32 bits, printed with 9 decimals
FINER = 0.5  # of a lattice's step: where 32 bits resolve less than that, half of what they round is off it,
OFF_STEP = 0.25  # by so much of the step at least
ENOUGH_FINER = 16  # positions there that are on it are none by chance
SURE = 3.0  # standard errors within which a step is taken for a simple share of so many turns at most:
MOST_TURNS = 16
# Counts of a turn, and of so many a share, by which a number of counts is off a whole one: two decimals of a speed of
# 432 counts leave 0.01, and a period that rows did not have makes it anything.
OFF_WHOLE, OFF_SHARE = 0.02, 2e-5
MEANT, AS_IT_WAS = 0.12, 1e-3  # of a row, by which it is longer than the one that was meant: at most, at least
CLOCKS = 1e-4  # by which the crystals of two machines differ at most: no row is known better
LAST_DIGIT = 1e-6  # of the last decimal, within which a step is it
# What a wrong unit leaves: a step in rad/s that is a number of two digits, to so much of it, as a count's is in rpm but
# never in rad/s; digits that rounding leaves as well are none. Or counts of a turn that are whole in another unit, and
# by chance in so many of a hundred at most.
ROUND_STEP, OF_ROUNDING = 1e-5, (10, 20, 25, 50, 100)
ANY_CHANCE = 0.1
UNITS_OF_A_TURN = ("rad/s", "deg/s", "rpm", "rev/s")


@dataclass(frozen=True)
class Count:
    """One count of a column of positions, and the encoder that has such counts."""

    size: float  # in the form's unit
    edges: int  # in a turn of the encoder's shaft
    gear: Fraction  # turns of the encoder's shaft in a turn of the output
    per_turn: float  # counts in the turn that the user means: `edges`, where they are whole
    how: str = ""  # where that comes from, in words
    origin: float = 0.0  # position of count 0, in the form's unit
    stands_for: bool = False  # whether such counts are not in the data, but fine enough to stand for it


def count_size(form: CsvForm, values: Floats, voltage: Floats, levels: Floats | None = None) -> Count:
    """Size one count of positions in the form's unit and of voltages [V], both of shape (K,).

    levels: the positions before they were unwrapped, where they were: a fast shaft is on each level in some turn.

    Raises:
        RecordingError: it is not to be had, or contradicts the edges per revolution.
    """
    unit = form.unit_size
    if unit is None:  # the file counts by itself
        if form.edges_per_revolution is None:
            raise RecordingError("The size of a count is unknown: give --edges-per-revolution.")
        return _whole(form, form.count_quantum or 1.0, form.edges_per_revolution)
    turn = 2.0 * pi / unit / float(form.gear)  # of the encoder's shaft
    if form.count_quantum:
        return _said(form, form.count_quantum, turn, values)
    if form.edges_per_revolution:
        return _whole(form, turn / form.edges_per_revolution, form.edges_per_revolution)
    way = float(np.quantile(np.abs(np.diff(values)), 0.9))  # from row to row
    lattice = find_position_lattice(values) or _within_a_turn(levels, values, turn)
    if lattice and turn / lattice.step < MOST_EDGES and not _is_rounding(lattice, values, 2.0 * pi / unit):
        return _seen(form, lattice, turn, way <= COUNTS_A_ROW * lattice.step and lattice.holds(values))
    noise = estimate_white_noise(values, voltage)
    coarse = max(noise, way / COUNTS_A_ROW)
    return _fine(form, turn, coarse, f" (assumed: the values show no steps, and noise of {noise:.2g} {form.unit})")


def _is_rounding(lattice: Lattice, values: Floats, turn: float) -> bool:
    """Whether a lattice is that of numbers of 32 bits, as which positions, shape (K,), were kept: no encoder's.

    Or their turns were, and somebody made radians of them and printed these.
    """
    return _are_short(values, lattice.step, 0.0) or _are_short(values / turn, lattice.step / turn, PRINTED / turn)


def _are_short(numbers: Floats, step: float, off: float) -> bool:
    """Whether numbers (K,) on a lattice of a step are of 32 bits but for so much, which is less than they resolve.

    An encoder's counts are, too, if a turn has a power of two: but nearer to 0, where 32 bits resolve more, they are on
    its lattice still.
    """
    with np.errstate(over="ignore"):
        short = numbers.astype(np.float32)
    resolved = np.spacing(np.abs(short)).astype(np.float64)
    if step >= 2.0 * resolved.max() or off >= resolved.max() or np.any(np.abs(short - numbers) > off):
        return False
    finer = numbers[resolved < FINER * step] / step
    return len(finer) < ENOUGH_FINER or bool(np.any(np.abs(finer - np.rint(finer)) > OFF_STEP))


def _within_a_turn(levels: Floats | None, values: Floats, turn: float) -> Lattice | None:
    """The lattice of positions within a turn, shape (K,), if those that go on over all turns lie on it, either way."""
    lattice = None if levels is None else find_position_lattice(levels)
    if lattice is None or abs(turn / lattice.step - round(turn / lattice.step)) > AGREE_COUNTS * turn / lattice.step:
        return None
    lattice = replace(lattice, step=turn / round(turn / lattice.step))
    ways = (lattice, replace(lattice, origin=-lattice.origin))
    return next((one for one in ways if one.holds(values)), None)


def _whole(form: CsvForm, size: float, edges: int, how: str = "", origin: float = 0.0) -> Count:
    return Count(size, edges, form.gear, edges, how, origin)


def _said(form: CsvForm, size: float, turn: float, values: Floats) -> Count:
    """A count of the size that was said: a whole share of the encoder's turn, or the step that the values have."""
    exact = turn / size
    if form.edges_per_revolution or abs(exact - round(exact)) <= AGREE_COUNTS * exact or exact > MOST_EDGES:
        return _whole(form, size, agree_on_edges(form, exact, AGREE_COUNTS))
    lattice = find_position_lattice(values)
    if lattice and abs(size - lattice.step) <= max(AGREE_COUNTS * size, SURE * lattice.error):
        said = Lattice(size, 0.0, lattice.origin)
        made = _fractional(form, said, Fraction(exact).limit_denominator(MOST_TEETH), "")
        if made and said.holds(values):
            return made
    return _whole(form, size, agree_on_edges(form, exact, AGREE_COUNTS))


def _seen(form: CsvForm, lattice: Lattice, turn: float, matters: bool) -> Count:
    """A count that is the step of the values' lattice; where a step that is no whole share does not matter, finer."""
    exact = turn / lattice.step
    if abs(exact - round(exact)) <= AGREE_COUNTS * exact and round(exact) >= 1:
        return _whole(form, lattice.step, round(exact), " (assumed: the smallest step in the data)", lattice.origin)
    per_turn = _simple_share(exact, SURE * exact * lattice.error / lattice.step)
    made = _fractional(form, lattice, per_turn, " (assumed: values are multiples of it)") if matters else None
    how = f" (assumed: values are multiples of {lattice.step:.4g} {form.unit}, no whole share of a turn)"
    return made or _fine(form, turn, lattice.step, how)


def _simple_share(exact: float, error: float) -> Fraction:
    """The simplest ratio of counts and turns that an uncertain number of counts a turn may be."""
    for turns in range(1, MOST_TURNS + 1):
        share = Fraction(round(exact * turns), turns)
        if abs(float(share) - exact) <= max(error, 1e-9 * exact):
            return share
    return Fraction(exact).limit_denominator(MOST_TEETH)


def _fractional(form: CsvForm, lattice: Lattice, per_turn: Fraction, how: str) -> Count | None:
    """Whole counts of an encoder that a gear turns a little faster or slower; None where no gear does."""
    if per_turn <= 0:
        return None
    turns = ceil(FEWEST_COUNTS / per_turn) if per_turn < FEWEST_COUNTS else 1
    edges = round(per_turn * turns)
    gear = Fraction(form.gear * per_turn / edges).limit_denominator(MOST_TEETH)
    if not LEAST <= gear <= MOST:
        return None
    size = 2.0 * pi / (form.unit_size or 1.0) / float(edges * gear)
    return Count(size, edges, gear, float(per_turn), how, lattice.origin)


def _fine(form: CsvForm, turn: float, size: float, how: str) -> Count:
    """Counts fine enough to stand for values without steps, whose noise or step is `size`."""
    wanted = turn / size if size > 0.0 else float(FINE[1])
    edges = int(min(max(wanted, FINE[0]), FINE[1]))
    digits = 10 ** max(int(log10(edges)) - 1, 0)
    edges = edges // digits * digits
    return Count(turn / edges, edges, form.gear, edges, how, stands_for=True)


def agree_on_edges(form: CsvForm, exact: float, tolerance: float) -> int:
    """Whole counts of a turn, if a count's size leads to them and they are those that were said.

    Raises:
        RecordingError: it does not.
    """
    edges = form.edges_per_revolution or max(round(min(exact, MOST_EDGES + 1.0)), 1)
    if edges > MOST_EDGES:
        raise RecordingError(
            f"The counts come to {exact:.3g} per revolution, more than any encoder has: check --count-quantum."
        )
    if abs(exact - edges) > tolerance * edges:
        expected = f"{edges}" if form.edges_per_revolution else "a whole number"
        raise RecordingError(
            f"The counts come to {exact:.6g} per revolution, not {expected}: "
            "check --count-quantum, --edges-per-revolution and --unit."
        )
    return edges


def doubt_counts(counts: float, period: float, step: float, digit: float) -> str:
    """Say what else makes a step of speeds, where the counts of a turn by it are no whole ones; empty where they are.

    Args:
        counts: of a turn, by the step within the period.
        period: [s] that a speed is taken for the mean over.
        step: of the speeds, in the unit of the log.
        digit: the place of their last decimal; 0 where they have more than can be told.
    """
    if abs(counts - round(counts)) <= OFF_WHOLE + OFF_SHARE * counts:
        return ""
    if digit > 0.0 and abs(step / digit - 1.0) < LAST_DIGIT:
        return (
            f" That is no whole number, and {step:g} the last decimal: more likely the speeds were rounded to it "
            "(log more decimals, or counts)."
        )
    place = 10.0 ** floor(log10(period))
    meant = place * round(period / place)
    longer = period / meant - 1.0
    if abs(longer) <= AS_IT_WAS and abs(counts - round(counts)) <= CLOCKS * counts:
        return ""
    such = f", such as {1e3 * meant:.4g} ms (of {counts * period / meant:.5g} counts then, and" if meant else ""
    if not AS_IT_WAS < abs(longer) < MEANT:
        such = ""
    share = f" speeds {100.0 * abs(longer):.2g} % too {'large' if longer > 0.0 else 'small'})" if such else ""
    return (
        f" That is no whole number: the speeds may have been computed with a period that the rows did not have{such}"
        f"{share}, were rounded, or are those of a gear's output (--gear-ratio). Log the counts, or say how long a "
        "speed was counted (--speed-window)."
    )


def _is_printed(angle: float) -> bool:
    """Whether an angle is one digit in a place of its own: 1, 2 or 5 there."""
    digits = angle / 10.0 ** floor(log10(angle))
    return min(abs(digits / digit - 1.0) for digit in (1.0, 2.0, 5.0, 10.0)) < ROUND_STEP


def doubt_unit(unit: str, counts: float, step: float, window: float) -> str:
    """Say that speeds may be in another unit than was said, by a step that none of theirs makes; else empty.

    Args:
        unit: that was said, of speeds.
        counts: of a turn, by the step in that unit.
        step: of the speeds, in that unit.
        window: [s] that a step is of: an angle in rad that was printed to so many digits has round steps, too.
    """
    if unit not in UNITS_OF_A_TURN or not counts > 0.0:
        return ""
    mantissa = step / 10.0 ** (floor(log10(step)) - 1)
    if unit == "rad/s" and abs(mantissa - round(mantissa)) < ROUND_STEP * mantissa:
        if round(mantissa) in OF_ROUNDING or _is_printed(step * window):
            return ""
        return (
            f" A count is a round {step:.3g} in rpm or deg/s, and never in rad/s, of which a turn has 2π: check --unit."
        )
    if abs(counts - round(counts)) <= OFF_WHOLE + OFF_SHARE * counts:
        return ""
    sizes = UNITS[Kind.SPEED]
    others = {one: counts * (sizes[unit] or 1.0) / (sizes[one] or 1.0) for one in UNITS_OF_A_TURN if one != unit}
    near = {one: OFF_WHOLE + OFF_SHARE * many for one, many in others.items()}
    whole = [one for one, many in others.items() if abs(many - round(many)) <= near[one] and many >= FEWEST_COUNTS]
    if len(whole) != 1 or 2.0 * near[whole[0]] > ANY_CHANCE:
        return ""
    return f" In {whole[0]} it would be {round(others[whole[0]])}: check --unit."


def doubt_window(counts: float, window: float, held: int) -> str:
    """Say what encoder it is, of so many counts a turn by windows [s] of a row, where most speeds stay for more rows.

    Args:
        counts: of a turn, by the step within the window.
        window: [s] of one row.
        held: rows for which most speeds stay; 0 where none do.
    """
    if not held:
        return ""
    return (
        f" But most values stay for {held} rows: if a new one came every {1e3 * held * window:.4g} ms, it has "
        f"{counts / held:.5g} (--speed-window {held * window:.4g}), and rows that have a new one each came later than "
        "they say."
    )
