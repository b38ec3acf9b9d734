"""The motion column of a log as speeds and counts: what it is exact about, and what had to be assumed."""

from dataclasses import dataclass, replace
from math import inf, pi, tau

import numpy as np

from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.count_size import (
    AGREE_SPEED,
    LAST_DIGIT,
    agree_on_edges,
    count_size,
    doubt_counts,
    doubt_unit,
    doubt_window,
)
from motor_identification.logs.form import LENGTHS, CsvForm, Kind
from motor_identification.logs.position_lattice import LEAST_LEVELS, ON_GRID, printed_digit
from motor_identification.logs.rows.bursts import cut_stalls
from motor_identification.logs.rows.count_rate import count_rates
from motor_identification.logs.rows.drive.command_sign import (
    COMMANDS_SIGN,
    take_off_commands_sign,
    take_off_commands_sign_of_speeds,
)
from motor_identification.logs.rows.drive.one_channel import (
    ONE_CHANNEL,
    ONE_CHANNEL_OR_LOAD,
    find_ways,
    never_goes_back,
)
from motor_identification.logs.rows.drive.own_counts import take_fed_back
from motor_identification.logs.rows.flicker import remove_flicker
from motor_identification.logs.rows.resets import split_at_resets
from motor_identification.logs.rows.row_lengths import divide_by_own_rows, find_window
from motor_identification.logs.rows.speed_sign import give_signs
from motor_identification.logs.rows.swapped_sign import turn_round
from motor_identification.logs.rows.wraps import unwrap
from motor_identification.logs.signals import Floats, Integers, Signals
from motor_identification.sensor.held_samples import count_held_rows, find_frames
from motor_identification.sensor.pulses.pulse_periods import are_times_of_slot
from motor_identification.sensor.pulses.timer_ticks import are_over_slots
from motor_identification.sensor.running_mean import find_running_mean, size_of_count, take_single_rows
from motor_identification.sensor.short_window import find_step_ratio, may_be_other_edges
from motor_identification.sensor.speed_sensor import are_blurred, are_smoothed, find_counts, find_noise
from motor_identification.sensor.value_lattice import find_lattice
from motor_identification.timing.unit_zeros import measure_gain_of_mean
from motor_model.errors import RecordingError
from motor_model.gearing.gear import edge_angle
from motor_model.sample import Info, Measurement

_FAR = 5.5  # times between the steps of speeds and one count, below the 2π, 9.5 and 57.3 of mistaken units
# Times finer than a count, and last digits, that a step is one of digits: a wrong unit makes it 360 times finer. How
# near to what a wrong unit makes it, of all there are, a finer one is no digit's: a real 44 is not that of radians.
_FINER, _FEW_DIGITS = 400.0, 10.0
_MANY_COUNTS = 10.0  # within a row at most: of a wrong unit's count, which is too large, speeds have fewer
_MISTAKEN, _AS_MISTAKEN = (6.0, 2.0 * pi, 30.0 / pi, 180.0 / pi, 60.0, 360.0), 0.03
# Counts of a row in motion, by median, from which on its speed says as much as the angle: one is then a quarter of it.
# Of fewer, speeds of single rows are little but their rounding, which the angle does not sum up.
MANY_A_ROW = 4.0
MANY_FED_BACK = 16.0  # the same where a loop's command answers the rounding: what it says of the next row is no motion
AS_SAID = 0.02  # relative: how far a count that is seen in rows of one period may be from the encoder's that was said
FED_BACK = (
    "Speeds in {} are counts of single rows, which the command answers (a speed loop on them): they are summed up to "
    "positions, in which their rounding is not (assumed; otherwise: --speed-window)."
)
STAYS = (
    "Speeds in {} stay as long as a slot of {} per revolution takes at them: they were timed between edges, not "
    "counted (found; otherwise: --speed-window)."
)
TIMED = "Speeds in {} are one angle over whole ticks of a timer each: they were timed between edges, not counted."
FLANKS = (2, 4)  # times as many as the rising ones of one channel: so are edges most often said wrong
OR_EDGES = "Or there are {:.4g} counts per revolution, and not {} (--edges-per-revolution): the steps are those, too."
STEPPED = (
    "Caution: speeds are multiples of {:.4g} {}, {:.3g} counts of {} per revolution within a row: there are {:.4g} "
    "(--edges-per-revolution), or a speed is counted for less than a row (--speed-window {:.3g})."
)
# Of log likelihood, by which speeds are means of what single rows counted rather than counts of rows, which most are.
# Measured: 3 and more of 97 % of 241 short logs of such means, less than 0 of 9 of 500 of plain counts that fit one.
LIKELIER = 3.0
LARGEST_COUNT = 2**53  # counts and positions beyond are no whole numbers any more


@dataclass(frozen=True)
class Motion:
    """Speeds [rad/s] and counts of the signals' rows, each of shape (K,), with the info that says how to read them."""

    signals: Signals
    speed: Floats
    counts: Integers
    info: Info
    findings: tuple[str, ...]


def read_motion(form: CsvForm, info: Info, signals: Signals) -> Motion:
    """What the column says.

    Raises:
        RecordingError: the size of a count is not to be had, or contradicts the edges per revolution; counts jump.
    """
    if form.unit_size is None and form.unit in LENGTHS:
        raise RecordingError(f"{form.motion} is in {form.unit}: say how far a turn goes (--units-per-revolution).")
    if form.kind is Kind.SPEED:
        return _mean_speeds(form, info, signals)
    return _counts(form, info, signals)


def _mean_speeds(form: CsvForm, info: Info, signals: Signals) -> Motion:
    unit = form.unit_size
    if unit is None:
        raise RecordingError(
            f"{form.motion} is in {form.unit}: say how many there are in a turn (--edges-per-revolution)."
        )
    signals, lengths = (signals, []) if form.speed_window else divide_by_own_rows(signals, form.nominal_period)
    signals, signs = _give_own_signs(form, signals)
    summing = form.speed_window is None and form.speed_lag is None and not form.count_quantum
    fed_back = _sum_up_fed_back(form, info, signals) if summing else None
    if fed_back is not None:
        return replace(fed_back, findings=(*lengths, *signs, *fed_back.findings))
    signals, turned = (signals, []) if form.signs_as_they_are else turn_round(signals, is_speed=True)
    signals, means, one = (signals, [], inf) if form.speed_window else _undo_running_mean(signals, info.sample_period)
    values = signals.motion
    few = bool(means) and _median_size(values) < MANY_A_ROW * one
    if few and summing:
        counted = _count_rows(form, info, signals, one)
        return replace(counted, findings=(*signs, *turned, *means, *counted.findings))
    usual, uneven = find_window(signals, info.sample_period)
    window, edges = form.speed_window or usual, form.edges_per_revolution or 0
    shorter, stepped = (1.0, []) if form.speed_window else _find_shorter_window(form, values, edges, window)
    window /= shorter
    lag = 0.5 * window if form.speed_lag is None else form.speed_lag
    if form.count_quantum:
        turn = 2.0 * pi / float(form.gear)  # of the encoder's shaft
        edges = agree_on_edges(form, turn / (form.count_quantum * unit * window), AGREE_SPEED)
    smoothed: list[str] = []
    if edges:
        edges, smoothed = _confirm_edges(form, signals, edges, edge_angle(edges, form.gear) / window / unit, window)
    info = replace(info, measurement=Measurement.SPEED, speed_window=window, speed_lag=lag, edges_per_revolution=edges)
    row = "a row of the shortest" if uneven else "one sample period"
    row = "one count within that is the step of the values" if shorter > 1.0 else row
    assumed = "" if form.speed_window else f" (assumed: {row}; otherwise: --speed-window)"
    placed = "" if form.speed_lag is not None else " (assumed: the window ends there; otherwise: --speed-lag)"
    findings = (
        f"Speeds without counts: each is the mean over {window * 1e3:.4g} ms{assumed}.",
        f"The middle of that window is {lag * 1e3:.4g} ms before the row's time{placed}.",
        *([uneven] if uneven and not form.speed_window else []),
        *stepped,
        *(smoothed or [_about_count(form, signals, edges, window)]),
        *lengths,
        *signs,
        *turned,
        *means,
    )
    return Motion(signals, values * unit, np.zeros(len(values), np.int64), info, findings)


def _find_shorter_window(form: CsvForm, values: Floats, edges: int, row: float) -> tuple[float, list[str]]:
    """Find how many times longer than its window a row [s] is, by the steps of speeds of said counts; 1 where it is it.

    Speeds in counts have steps of one within their window, whatever a turn has; of others a turn may have been counted
    by one flank of each slot, which a caution says. Farther off a unit is mistaken.
    """
    if not edges:
        return 1.0, []
    count = edge_angle(edges, form.gear) / row / (form.unit_size or 1.0)
    ratio = find_step_ratio(values, count)
    if not 0.0 < ratio < _FAR or abs(ratio * count / (printed_digit(values) or np.inf) - 1.0) < LAST_DIGIT:
        return 1.0, []
    if form.unit == "count/s" or not may_be_other_edges(ratio, edges):
        return ratio, []
    if round(ratio) not in FLANKS:
        return ratio, [OR_EDGES.format(edges / round(ratio), edges)]
    return 1.0, [STEPPED.format(ratio * count, form.unit, ratio, edges, edges / ratio, row / ratio)]


def _give_own_signs(form: CsvForm, signals: Signals) -> tuple[Signals, list[str]]:
    """Give speeds the signs of the motion where they have none, or the command's; and say so."""
    bare = None if form.signs_as_they_are else take_off_commands_sign_of_speeds(signals)
    if bare is None:
        return give_signs(signals)
    signed, said = give_signs(bare)
    return (signed, [COMMANDS_SIGN.format(form.motion), *said]) if said else (signals, [])


def _undo_running_mean(signals: Signals, period: float) -> tuple[Signals, list[str], float]:
    """Take what single rows counted, of speeds that are running means of it by all runs; say so, and a count's size."""
    found, motion = set(), np.array(signals.motion, np.float64)
    for run in signals.runs.values():
        steps = np.diff(signals.time[run]) * 1e-9
        regular = len(steps) > 0 and float(np.max(np.abs(steps - period))) < 0.5 * period
        rows = find_running_mean(signals.motion[run]) if regular else 0
        single = take_single_rows(signals.motion[run], rows) if rows else None
        if (
            single is not None
            and measure_gain_of_mean(signals.motion[run], single, signals.voltage[run], rows) < LIKELIER
        ):
            single = None  # counts of short logs fit a window by chance, but are not likelier by it
        found.add(rows if single is not None else 0)
        motion[run] = signals.motion[run] if single is None else single
    rows = found.pop() if len(found) == 1 else 0
    if not rows:
        return signals, [], inf
    said = (
        f"Speeds are running means of {rows} rows, as their counts show: the counts of single rows are taken (assumed; "
        "otherwise: --speed-window)."
    )
    return replace(signals, motion=motion), [said], size_of_count(signals.motion, rows)


def _sum_up_fed_back(form: CsvForm, info: Info, signals: Signals) -> Motion | None:
    """Sum up what single rows counted and a loop's command answers; None of other speeds, or another encoder's."""
    taken = take_fed_back(signals, info.sample_period)
    if taken is None:
        return None
    counted, one = taken
    seen, edges = one * (form.unit_size or 1.0) * info.sample_period, form.edges_per_revolution
    as_said = edges is None or abs(seen / edge_angle(edges, form.gear) - 1.0) < AS_SAID
    if not as_said or _median_size(counted.motion) >= MANY_FED_BACK * one:
        return None
    motion = _count_rows(form, info, counted, one)
    return replace(motion, findings=(FED_BACK.format(form.motion), *motion.findings))


def _median_size(values: Floats) -> float:
    """Compute the middle size of what is not 0 among values of shape (K,)."""
    return float(np.median(np.abs(values[values != 0.0])))


def _count_rows(form: CsvForm, info: Info, signals: Signals, one: float) -> Motion:
    """Read what single rows counted as positions [rad], every run from 0; `one`: a count's size in the form's unit."""
    edges = form.edges_per_revolution
    size = edge_angle(edges, form.gear) if edges else one * (form.unit_size or 1.0) * info.sample_period
    position = np.zeros(len(signals))
    for run in signals.runs.values():
        position[run] = np.cumsum(np.rint(signals.motion[run] / one)) * size
    return _counts(replace(form, kind=Kind.POSITION, unit="rad"), info, replace(signals, motion=position))


def _about_count(form: CsvForm, signals: Signals, edges: int, window: float) -> str:
    """One count in the form's unit, said or seen by whoever reads the bag, within a window [s]."""
    unit = form.unit_size or 1.0
    if edges:
        size = edge_angle(edges, form.gear) / window / unit
        return f"One count ({edges} per revolution) within the window is {size:.4g} {form.unit}."
    step, noise, _ = find_noise(
        signals.motion * unit,
        signals.voltage,
        window,
        gear=float(form.gear),
        uneven=_measure_unevenness(signals),
        window_said=bool(form.speed_window),
    )
    if step > 0.0:
        frame = 0.0 if form.speed_window else _measure_frame(signals)
        counts = tau / (step * (frame or window)) / float(form.gear)
        what = "Values of a few counts are near" if are_blurred(signals.motion * unit, step) else "Values are"
        new, within = (f", a new one every {frame * 1e3:.4g} ms", "that") if frame else ("", "the window")
        return (
            f"{what} multiples of {step / unit:.4g} {form.unit}{new}: one count within {within} if the encoder has "
            f"{counts:.5g} per revolution (assumed; otherwise: --edges-per-revolution)."
            f"{doubt_counts(counts, frame or window, step / unit, printed_digit(signals.motion))}"
            f"{'' if read_heading(form.motion).unit else doubt_unit(form.unit, counts, step / unit, frame or window)}"
            f"{'' if frame or form.speed_window else doubt_window(counts, window, _count_held_rows(signals))}"
        )
    coarse = find_lattice(signals.motion)
    said = "Speeds show no counts"
    if coarse > 0.0 and _median_size(signals.motion) < MANY_A_ROW * coarse:
        said = f"Speeds are multiples of {coarse:.4g} {form.unit}, too coarse to tell much (log more digits, or counts)"
    return (
        f"{said}: noise of {noise / unit:.2g} {form.unit}, as between neighbours, is assumed "
        "(otherwise: --edges-per-revolution)."
    )


def _measure_unevenness(signals: Signals) -> float:
    """Measure the standard deviation of the lengths of the rows of the most uneven run, of the usual one."""
    rows = [np.diff(signals.time[run]) for run in signals.runs.values()]
    return max((float(np.std(one) / max(np.median(one), 1.0)) for one in rows if len(one)), default=0.0)


def _count_held_rows(signals: Signals) -> int:
    """Count the rows for which most speeds of a run are held; 0 where none are."""
    return max(map(count_held_rows, (signals.motion[run] for run in signals.runs.values())), default=0)


def _measure_frame(signals: Signals) -> float:
    """Measure for how long [s] the longest run's speeds are held, as whoever reads the bag sees; 0 where none is."""
    run = max(signals.runs.values(), key=lambda run: run.stop - run.start)
    time: Floats = (signals.time[run] - signals.time[run.start]) * 1e-9
    frames = find_frames(time, signals.motion[run])
    return frames.period if frames else 0.0


def _confirm_edges(form: CsvForm, signals: Signals, edges: int, count: float, window: float) -> tuple[int, list[str]]:
    """Edges per revolution, whose count in the form's unit within a window [s] is given; none of smoothed speeds.

    Raises:
        RecordingError: a unit or the window is wrong; what is given in counts has no unit that could be.
    """
    if are_over_slots(signals.motion, count * window):
        return 0, [TIMED.format(form.motion)]
    if _stay_as_timed(signals, form.unit_size or 1.0, count, window):
        return 0, [STAYS.format(form.motion, edges)]
    smoothed = are_smoothed(signals.motion, signals.voltage, count)
    smoothed |= form.unit == "count/s" and _are_finer(signals.motion, count)  # whose unit is not the encoder's to say
    if not smoothed or form.unit != "count/s":
        _check_steps(form, signals.motion, edges, count)
    if not smoothed:
        return edges, []
    said = f"Speeds in {form.motion} lie between whole counts of {edges} per revolution: they were smoothed, or timed."
    return 0, [said]


def _stay_as_timed(signals: Signals, unit: float, count: float, window: float) -> bool:
    """Whether speeds in a unit [rad/s], that are no counts of a size in it, stay in all runs as long as those take."""
    if find_counts(signals.motion, window) > 0.0:
        return False
    time, speed = np.asarray(1e-9 * signals.time), np.asarray(unit * signals.motion)
    return all(are_times_of_slot(unit * count * window, time[run], speed[run]) for run in signals.runs.values())


def _are_finer(values: Floats, count: float) -> bool:
    """Whether speeds lie on a grid that is far finer than one count in a row."""
    step = find_lattice(values) if len(np.unique(values)) >= LEAST_LEVELS else 0.0
    return 0.0 < step < count / _FAR


def _check_steps(form: CsvForm, values: Floats, edges: int, count: float) -> None:
    """Speeds that lie on a grid show the size of one count; far from what was said, a unit or a window is wrong.

    But for a grid of printed digits that is finer than any wrong unit makes it, or of the last digit as no wrong unit
    makes it: speeds that were timed between edges, or smoothed.
    """
    step = find_lattice(values) if len(np.unique(values)) >= LEAST_LEVELS else 0.0
    digit, many = printed_digit(values), float(np.max(np.abs(values), initial=0.0)) > _MANY_COUNTS * count
    if step < count / _FINER and step <= _FEW_DIGITS * digit:
        return
    if (
        many
        and 0.0 < step < min(count, 1.5 * digit)
        and all(abs(count / step / one - 1.0) > _AS_MISTAKEN for one in _MISTAKEN)
    ):
        return
    if step > 0.0 and not 1.0 / _FAR < step / count < _FAR:
        raise RecordingError(
            f"Speeds in {form.motion} change in steps of {step:.4g} {form.unit}, but one count ({edges} per "
            f"revolution) is {count:.4g}: check --unit, --edges-per-revolution and --speed-window, or leave the second "
            "away if speeds were smoothed or timed."
        )


def _counts(form: CsvForm, info: Info, signals: Signals) -> Motion:
    levels = signals.motion
    signals, wrapped = unwrap(signals, form)
    bare = None if form.signs_as_they_are else take_off_commands_sign(signals)
    signals = signals if bare is None else bare
    one_channel = not form.signs_as_they_are and find_ways(signals) is not None
    signals, turned = (signals, []) if form.signs_as_they_are or one_channel else turn_round(signals, is_speed=False)
    count = count_size(form, signals.motion, signals.voltage, levels if wrapped else None)
    largest = float(np.max(np.abs(signals.motion))) / count.size
    if not largest < LARGEST_COUNT:
        raise RecordingError(
            f"{signals.path}: {form.motion} comes to {largest:.3g} counts, beyond what can be counted: check the "
            "column and --count-quantum."
        )
    signals, stalled = cut_stalls(signals, form.motion)
    signals, reset = split_at_resets(signals, form, lambda values: np.rint(values / count.size).astype(np.int64))
    exact = (signals.motion - count.origin) / count.size
    counts = np.rint(exact).astype(np.int64)
    rounded = 0.5 * printed_digit(signals.motion) / count.size
    beside = float(np.max(np.abs(exact - counts))) - rounded
    counts, flicker = remove_flicker(signals, counts) if form.kind is Kind.POSITION else (counts, [])
    rate, held = count_rates(signals, counts)
    ways = find_ways(signals) if one_channel else None
    stuck = ways is None and not form.signs_as_they_are and never_goes_back(signals)
    speed = rate * edge_angle(count.edges, count.gear) * (1.0 if ways is None else ways)
    info = replace(
        info, measurement=Measurement.COUNTS, edges_per_revolution=count.edges, single_channel=ways is not None
    )
    if count.gear != 1:
        info = replace(info, gear_ratio=float(count.gear))
    per_turn = f"{count.edges}" if count.per_turn == count.edges else f"{count.per_turn:.6g}"
    findings = [
        *wrapped,
        *turned,
        *([] if bare is None else [COMMANDS_SIGN.format(form.motion)]),
        *([] if ways is None else [ONE_CHANNEL.format(form.motion)]),
        *([ONE_CHANNEL_OR_LOAD.format(form.motion)] if stuck else []),
        *stalled,
        *reset,
        f"Sampled counts without time stamps: one count is {count.size:.6g} {form.unit}, {per_turn} per "
        f"revolution{count.how}.",
        "The angle is known to one count at each row's time; the speed is that between its latest changes.",
        *flicker,
        *held,
    ]
    if beside > ON_GRID and not count.stands_for:
        findings.append(f"Caution: values are up to {beside:.2f} counts off whole counts: check --count-quantum.")
    return Motion(signals, speed, counts, info, tuple(findings))
