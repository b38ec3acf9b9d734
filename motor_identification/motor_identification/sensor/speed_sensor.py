"""Find how a log's speeds were measured, where nobody said: counts within a window, or a value with white noise."""

from dataclasses import dataclass
from math import log10, radians, sqrt, tau

import numpy as np

from motor_identification.recording import Bools, Floats, Integers, Recording
from motor_identification.sensor.held_samples import find_frames
from motor_identification.sensor.parabola_scatter import measure_summed
from motor_identification.sensor.unseen_starts import mark_unseen_starts
from motor_identification.sensor.value_lattice import (
    MOST_SCATTER,
    are_whole_products,
    find_lattice,
    measure_blur,
    measure_scatter,
)
from motor_identification.sensor.white_noise import LEAST_SAMPLES, estimate_white_noise
from motor_identification.sensor.wrong_speeds import mark_silent_rows, mark_wrong_speeds
from motor_model.sample import Info, Measurement

# Times what counting leaves between neighbours, beyond which noise is more than the lattice, so that counting does not
# matter: UNDC's random telegraph has 1.7, a micromouse's loop in windows of 0.1 s 4.5. Where the step is one of printed
# digits, or one of which no encoder has so many a turn, it takes less to believe that it is not a count. Measured: 4.6
# to 10 of twelve simulated tachogenerators behind ten bits, with noise of half a per cent; 0.8 to 1.8 of four encoders.
NOISE_BEYOND, NOISE_BEYOND_DIGITS = 6.0, 1.5
# Steps: what counts at both ends of chained windows leave between neighbours, as if it were white (20/6/12, root of).
COUNT_NOISE = sqrt(20.0 / 6.0 / 12.0)
# Of counts within a window, nearly all are whole ones, or they have a count's noise where they were divided by rows of
# different lengths. Measured: means of four rows have a quarter of it, a first-order memory of 0.6 a third.
NEAR_WHOLE, MOSTLY_WHOLE, SMOOTHER = 0.05, 0.75, 0.5
UNTOLD = 0.01  # of the typical speed: the noise of values too few to tell it, such as those of a static curve
PRINTED_UNITS = (1.0, radians(1.0), tau / 60.0, tau)  # rad/s, deg/s, rpm, turns/s
# Nobody prints whole turns a second: those are counts of 100 a turn in rows of 10 ms, of 1,000 in 1 ms.
WHOLE_TURNS = 0.5
SAME_DIGIT = 1e-3  # of a decade
# Digits of rad/s are no counts: those are a part of a turn. Nor are digits of other units that would be so many of a
# turn: encoders have up to 8192 on a shaft, 20,000 if they are dear. Of the last digit: how exactly values are whole.
MOST_COUNTS, WHOLE_DIGIT = 20_000, 1e-2
# A turn of an encoder: more are last digits in a unit that nobody knows. Measured: 1,796,000 of whole counts a second
# in rows of 1 ms, behind a filter.
MOST_A_TURN = 1_000_000
# A converter's last bit: its range is one of these volts, or ten times them, in 2^n or 2^n − 1 steps; such as a
# tachogenerator's. A step by chance is as near to one of them in 1 % of the cases.
RANGES, BITS, SAME_RANGE = (1.0, 2.0, 2.5, 3.3, 5.0), (8, 10, 12, 13, 14, 16), 1e-4
# Of a step squared, what sums of counts leave of a parabola, beyond which they are none but a converter's steps, with
# noise that is summed up. Measured: 0.02 to 0.07 of counts, 0.45 to 0.6 of tachogenerators whose noise is a step. And
# of a count a turn, by which that is beside a whole one then: an eccentric disc is noise, too.
MOST_SUMMED, WHOLE_COUNT = 0.3, 0.05
# Of a count a turn, by which it is beside a whole one where only counts make it so: one step in 25 does by chance. And
# of the usual speed, the noise of such values that rows of uneven lengths may make, which stamps need not show, and
# times what they show: more is a motion that jumps. Measured: 0.05 to 0.09 of a motor of two rows that rubs.
EXACT_COUNT, OF_HIDDEN_ROWS, OF_ROWS = 0.02, 0.03, 3.0
OTHER_ROWS = 0.1  # relative: rows of one run that are not those of the log's typical one
LEAST_COUNTED = 0.03  # of the time between values: a mean over less is an instant's value, and no count over it
SHARPER = 0.7  # times what the multiples of a step scatter by: they are those of their own rows' lengths
SAME_ROW = 1e-3  # relative: rows that differ by no more have one length
# Of a row: what half of them differ by at most, where counts that lie between whole ones were smoothed. Of others the
# length that a program divided by is none that stamps of whole milliseconds, or late ones, show. Measured: 0.006 and
# less of a program at 20 Hz that kept a half; 4 of 60 logs with 0.1 and 0.2 had a filter made up.
EVEN_ROWS = 0.05
LONGEST_ROW = 5.0  # windows: what is longer is a pause, in which nothing may have been counted
SAME_PERIOD = 1e-6  # relative: a window that was not said is set to the sample period


@dataclass(frozen=True)
class SpeedSensor:
    """How speeds were measured; arrays of shape (F,), one entry for each value of its own."""

    row: Integers  # of the recording
    time: Floats  # [s] since the first sample, when each value was made
    window: float  # [s] that each is the mean over
    lag: float  # [s] how old the middle of that window is then
    frame: float  # [s] for which each value is held; 0 where every row has one of its own
    step: float  # [rad/s] of the lattice of values; 0 where there is none
    sigma: float  # [rad/s] of white noise, independent in each value; 0 where counting is what is known
    edges_per_revolution: int  # of the encoder's shaft: what was said or follows from the step; 0 without
    wrong: int = 0  # values that were left out, since no motor has them
    lengths: Floats | None = None  # [s] of their own rows, where counts were divided by those
    blurred: bool = False  # whether the few counts alone are near whole ones: others lie anywhere between

    @property
    def count(self) -> float:
        """[rad] one count within the window; 0 without counts."""
        return self.step * self.window if self.step > 0.0 else 0.0


def find_speed_sensor(recording: Recording) -> SpeedSensor:
    """Find the sensor of a recording of speeds: as far as `info` says, and from its values where it does not."""
    time, speed = recording.time, recording.speed
    row: Integers = np.arange(len(time), dtype=np.int64)
    made, frame = time, 0.0
    window, lag = _find_window(recording)
    frames = find_frames(time, speed)
    if frames is not None:
        row, made, frame = frames.row, frames.time, frames.period
        if is_assumed(recording.info):
            window, lag = frame, lag * frame / window
    right = ~(mark_silent_rows(speed[row]) | mark_unseen_starts(speed[row]))
    right[right] = ~mark_wrong_speeds(speed[row][right], recording.voltage[row][right])
    wrong, row, made = int(np.count_nonzero(~right)), row[right], made[right]
    counted = window > LEAST_COUNTED * (frame or recording.info.sample_period)
    said, gear = recording.info.edges_per_revolution, float(recording.info.gear)
    lengths = np.diff(time, prepend=time[0] - window)[row]
    lengths = np.where(lengths < LONGEST_ROW * window, lengths, window)
    uneven = float(np.std(lengths)) / window
    if said:
        step, sigma, edges = recording.info.edge_angle / window, 0.0, said
    else:
        step, sigma, edges = find_noise(
            speed[row], recording.voltage[row], window, counted, gear, uneven, not is_assumed(recording.info)
        )
    if not said and frames is None and is_assumed(recording.info) and np.std(lengths) > SAME_ROW * window:
        by_length = speed[row] * lengths / window  # counts of rows that differ lie on a lattice by their own lengths
        own, sigma_of_own, counts = find_noise(by_length, recording.voltage[row], window, counted, gear)
        whole = are_whole_products(speed[row], lengths, own * window)
        sharper = own > 0.0 and (step <= 0.0 or measure_blur(by_length, own) < SHARPER * measure_blur(speed[row], step))
        if sharper and not whole:
            return SpeedSensor(row, made, window, lag, frame, own, sigma_of_own, counts, wrong, lengths)
    blurred = not said and are_blurred(speed[row], step)
    return SpeedSensor(row, made, window, lag, frame, step, sigma, edges, wrong, blurred=blurred)


def are_blurred(values: Floats, step: float) -> bool:
    """Whether not all values (K,) are near to multiples of their step, but those of a few counts: 0 is no step.

    So are counts that were divided by lengths of rows which stamps do not show.
    """
    return step > 0.0 and measure_scatter(np.abs(values), step) > MOST_SCATTER


def _find_window(recording: Recording) -> tuple[float, float]:
    """[s] that each speed is the mean over, and how old its middle is: of the recording's own rows where it is assumed.

    The runs of one log may have rows at different distances.
    """
    info, own = recording.info, float(np.median(np.diff(recording.time)))
    if not info.speed_window:
        return info.sample_period, info.speed_lag
    if is_assumed(info) and abs(own - info.sample_period) > OTHER_ROWS * info.sample_period:
        return own, info.speed_lag * own / info.sample_period
    return info.speed_window, info.speed_lag


def is_assumed(info: Info) -> bool:
    """Tell whether nobody said what a speed is the mean over: an importer takes the sample period."""
    own = info.speed_window or info.sample_period
    return not info.speed_said and abs(own - info.sample_period) <= SAME_PERIOD * info.sample_period


def find_noise(
    values: Floats,
    voltage: Floats,
    window: float,
    counted: bool = True,
    gear: float = 1.0,
    uneven: float = 0.0,
    window_said: bool = False,
) -> tuple[float, float, int]:
    """Step [rad/s], white noise [rad/s] and counts a turn of the values; one of the first two is 0.

    counted: whether they may be counts, so that a lattice is one of counts and not what the values are rounded to.
    gear: turns of the encoder's shaft, whose those counts are, per turn of the values. uneven: the standard deviation
    of rows' lengths, of the usual one. window_said: whether somebody said the window, and with it that values are means
    over it.
    """
    moving = mark_motion(values)
    step, noise = find_lattice(values), estimate_white_noise(values[moving], voltage[moving])
    too_many = not window_said and tau > MOST_COUNTS * step * window * gear
    beyond = NOISE_BEYOND_DIGITS if too_many or _list_digits(values, step) or _is_last_bit(step) else NOISE_BEYOND
    counted = counted and step > 0.0 and not _is_of_digits(values, step, window)
    counted = counted and tau < MOST_A_TURN * step * window * gear and not are_converted(values, step, window * gear)
    if counted and noise < beyond * COUNT_NOISE * step:
        return step, 0.0, round(tau / (step * window * gear))
    typical = sqrt(float(np.mean(values**2)))
    jumps = noise > (OF_HIDDEN_ROWS + OF_ROWS * uneven) * typical
    if counted and jumps and not too_many and are_whole_counts(values, window * gear):
        return step, 0.0, round(tau / (step * window * gear))
    return 0.0, max(noise, step / sqrt(12.0)) or UNTOLD * typical, 0


def are_whole_counts(values: Floats, window: float) -> bool:
    """Whether values (K,) [rad/s] are, to the digit, multiples of a step of which a turn has a whole number.

    window: [s] in which counts would be so many a turn. Neither noise nor times between edges come to such values, nor
    printed digits or a converter's steps but by chance.
    """
    step = find_lattice(values)
    if step <= 0.0 or measure_scatter(np.abs(values), step) > EXACT_COUNT or _list_digits(values, step):
        return False
    turn = tau / (step * window)
    return turn >= 1.0 - EXACT_COUNT and abs(turn - round(turn)) < EXACT_COUNT and not _is_last_bit(step)


def are_converted(values: Floats, step: float, window: float) -> bool:
    """Whether the steps [rad/s] of values (K,) are those of a converter behind a noisy sensor, and no counts of these.

    window: [s] in which counts would be so many a turn.
    """
    turn = tau / (step * window) if step > 0.0 else 0.0
    return abs(turn - round(turn)) > WHOLE_COUNT and measure_summed(values, step) > MOST_SUMMED


def may_be_converted(recording: Recording) -> bool:
    """Whether steps of a recording's speeds that seem to be counts, which nobody said, may as well be a converter's.

    A turn has more of them than an encoder, or no whole number while they are noisier than counts are.
    """
    sensor, gear = find_speed_sensor(recording), float(recording.info.gear)
    if sensor.step <= 0.0 or recording.info.edges_per_revolution:
        return False
    turn, moving = tau / (sensor.step * sensor.window * gear), mark_motion(recording.speed)
    noise = estimate_white_noise(recording.speed[moving], recording.voltage[moving])
    noisy = noise > NOISE_BEYOND_DIGITS * COUNT_NOISE * sensor.step
    return turn > MOST_COUNTS or (noisy and abs(turn - round(turn)) > WHOLE_COUNT)


def is_converted(recording: Recording) -> bool:
    """Whether a recording's speeds are the steps of a converter: of a usual range in volts, or behind a noisy sensor.

    Times between edges, whose quotients lie on no such steps, they are not either.
    """
    step, window = find_lattice(recording.speed), recording.info.speed_window or recording.info.sample_period
    of_volts = _is_last_bit(step) and not _list_digits(recording.speed, step)
    return of_volts or are_converted(recording.speed, step, window * float(recording.info.gear))


def lies_on_steps(values: Floats) -> bool:
    """Whether values (K,) [rad/s] are multiples of a step that is no printed digit: of counts, or a converter's.

    However noisy. Times between edges, whose quotients lie on no such steps, they are not.
    """
    step = find_lattice(values)
    return step > 0.0 and not are_blurred(values, step) and not _list_digits(values, step)


def lies_between_counts(recording: Recording) -> bool:
    """Whether speeds of even rows are no whole counts within one, as was said, nor by their own lengths, but as noisy.

    Less noisy ones were smoothed as whoever reads a log sees: what is said of them all the same is believed.
    """
    info, speed = recording.info, recording.speed
    if info.measurement is not Measurement.SPEED or not info.edges_per_revolution:
        return False
    step = info.edge_angle / (info.speed_window or info.sample_period)
    lengths = np.diff(recording.time, prepend=recording.time[0] - info.sample_period)
    if np.median(np.abs(lengths / np.median(lengths) - 1.0)) > EVEN_ROWS:
        return False
    both = (speed, speed * lengths / info.sample_period)
    between = not any(np.mean(_mark_whole(one, step)) > MOSTLY_WHOLE for one in both)
    return between and not are_smoothed(speed, recording.voltage, step)


def are_said_counts(recording: Recording) -> bool:
    """Whether speeds of said counts are near to whole ones within their window, as no filter leaves them."""
    info, moving = recording.info, mark_motion(recording.speed)
    if info.measurement is not Measurement.SPEED or not info.edges_per_revolution or not moving.any():
        return False
    step = info.edge_angle / (info.speed_window or info.sample_period)
    return float(np.mean(_mark_whole(recording.speed[moving], step))) > MOSTLY_WHOLE


def find_counts(values: Floats, window: float) -> float:
    """Find the step that values (K,) [rad/s] are counts of within a window [s]; 0 of none, or of printed digits."""
    step = find_lattice(values)
    return 0.0 if _is_of_digits(values, step, window) else step


def are_smoothed(values: Floats, voltage: Floats, step: float) -> bool:
    """Whether speeds (K,) counted in steps were smoothed: they lie between whole counts, with less noise than those."""
    moving = mark_motion(values)
    if np.count_nonzero(moving) < LEAST_SAMPLES or np.mean(_mark_whole(values[moving], step)) > MOSTLY_WHOLE:
        return False
    return estimate_white_noise(values[moving], voltage[moving]) < SMOOTHER * COUNT_NOISE * step


def _mark_whole(values: Floats, step: float) -> Bools:
    """Mark values (K,) that are near to whole steps."""
    return np.asarray(np.abs(values / step - np.rint(values / step)) < NEAR_WHOLE)


def _list_digits(values: Floats, step: float) -> list[tuple[float, float]]:
    """List the units of which the step [rad/s] of values (K,) is a last digit 1, 0.1, 0.01 …, each with that [rad/s].

    To the digit: a count's step that comes near to one by chance is off by more where there are many of it.
    """
    places = [(unit, log10(step / unit)) for unit in PRINTED_UNITS if step > 0.0]
    near = [
        (unit, unit * 10.0 ** round(place))
        for unit, place in places
        if place < 0.5 and abs(place - round(place)) < SAME_DIGIT and not (unit == tau and step > WHOLE_TURNS * tau)
    ]
    return [
        (unit, digit) for unit, digit in near if np.all(np.abs(values / digit - np.rint(values / digit)) < WHOLE_DIGIT)
    ]


def _is_of_digits(values: Floats, step: float, window: float) -> bool:
    """Whether the step [rad/s] of values (K,) is that of printed digits, and of no counts within a window [s]."""
    return any(unit == 1.0 or tau > MOST_COUNTS * digit * window for unit, digit in _list_digits(values, step))


def _is_last_bit(step: float) -> bool:
    """Whether a step is what a converter resolves of a usual range in volts."""
    if step <= 0.0:
        return False
    ratios = [step * (2**bits - less) / range_ for bits in BITS for less in (0, 1) for range_ in RANGES]
    return any(abs(ratio / one - 1.0) < SAME_RANGE for ratio in ratios for one in (1.0, 10.0))


def mark_motion(values: Floats) -> Bools:
    """Mark values (K,) that do not repeat those before and after: a motor that stands shows no noise."""
    same = np.diff(values, prepend=np.nan) == 0.0
    return np.asarray(~(same & np.append(same[1:], False)))
