"""Make intervals from speeds that are one slot over the time between the latest two edges: the period method.

Such a value is the exact mean from one edge to the next, but its row does not say when they came: the latest within the
row, or within a slot's time where that is shorter, so that on average it is half that old. A slow motor's row repeats a
value until the next edge, or shows the time since the latest one; neither measures. Where values are 0, less than two
slots pass: after a rest, or a turn, two edges have to come.
"""

from math import sqrt

import numpy as np

from motor_identification.measurement.edit_intervals import append_standstills
from motor_identification.measurement.intervals import Intervals, index_intervals
from motor_identification.measurement.standstill import LEAST_STANDSTILL
from motor_identification.recording import Bools, Floats, Integers, Recording
from motor_identification.sensor.pulses.pulse_periods import mark_decays
from motor_identification.sensor.value_lattice import find_lattice
from motor_identification.sensor.white_noise import estimate_relative_noise

LEAST_ZEROS = 5.0  # rows, from the one before to the last of values of 0: fewer may be a row or two that were lost
UNTIL_TOLD = 2.0  # slots that a motor turns before a time between two edges is known, at rest or after a turn
FRESH = 0.5  # of a row: with two edges within it for certain its value is a new one
# Of a row: a slot's time by what is lost of a speed in a row, in speeds. From v on a motor stops within v²/2a, which is
# less than a slot from 0.5 on: then it may have had no edge in the row, and its value is an old one.
STOPS = 0.25
MOST_REPEATED = 0.02  # of new values that are those before by chance, which a stopping motor's are not
BEYOND_NEXT = 1.1  # times the next value that one after a turn may be
OLDER = 1.1  # rows: an edge came within the row before, stamps are a little off
STEADY = 2.0  # times its neighbours that a value may be, or they it, where it may be old
LEAST_NOISE = 0.005  # of a value: no cheap disc is more regular
SAME_SLOT = 1e-6  # relative: what a time between edges was computed from, or it from that
UNIFORM_SIGMA = 1.0 / sqrt(12.0)  # standard deviation of what is uniform over 1


def make_pulse_intervals(recording: Recording) -> Intervals:
    """Make the intervals of speeds whose `edge_period` [s] is the time between two edges that each was computed from.

    Each has an error of its own at either end: what the disc is off, and what the motor gains while the edge may come.
    """
    row, slot = recording.sample_period, measure_slot(recording)
    kept = np.flatnonzero(_mark_measured(recording))
    within = np.minimum(recording.edge_period[kept], row)  # [s] the latest edge came
    seen = recording.time[kept] - 0.5 * within - recording.edge_period[kept] >= 0.0
    kept, within = kept[seen], within[seen]
    period, speed, end = recording.edge_period[kept], recording.speed[kept], recording.time[kept] - 0.5 * within
    gain = np.abs(np.gradient(speed, end)) if len(end) > 1 else np.zeros(len(end))
    noise = _measure_noise(speed) * slot
    blur = np.hypot(noise, gain * period * within * UNIFORM_SIGMA) / sqrt(2.0)
    moving = index_intervals(
        np.round(end - period, 9),
        np.round(end, 9),
        speed,
        blur,
        independent=True,
        gear=float(recording.info.gear),
        window=float(np.median(period)) if len(period) else row,
        noise=float(np.median(blur)) if len(blur) else noise,
    )
    return append_standstills(moving, _find_standstills(recording), UNTIL_TOLD * slot)


def measure_slot(recording: Recording) -> float:
    """Measure the slot [rad] over whose times speeds were computed; 0 where no row says from what time, or not all."""
    slots = np.abs(recording.speed * recording.edge_period)[recording.speed != 0.0]
    slot = float(np.median(slots)) if len(slots) else 0.0
    return slot if np.all(np.abs(slots - slot) <= SAME_SLOT * slot) else 0.0


def _mark_measured(recording: Recording) -> Bools:
    """Mark rows (K,) that bring a new time between two edges."""
    time, speed, period, row = recording.time, recording.speed, recording.edge_period, recording.sample_period
    again = np.diff(speed, prepend=np.nan) == 0.0
    turning = period > 0.0
    by_chance = (period < row) & ~_mark_repeats_of_stops(time / row, speed, period / row, again)
    new = turning & (~again | by_chance & _repeat_by_chance(again[turning], period[turning] / row))
    at = np.flatnonzero(new & ~mark_decays(time, period, row))
    # An edge is a slot's time after the one before: where a value comes sooner, that was the time since one.
    sooner = np.diff(time[at]) < period[at[1:]] - OLDER * row
    at = at[~np.append(sooner, False)]
    turned = _mark_turns(time[at] / row, speed[at], period[at] / row, np.cumsum(speed == 0.0)[at])
    before, after = speed[at[:-1]], speed[at[1:]]
    small, large = (side(np.abs(before), np.abs(after)) for side in (np.minimum, np.maximum))
    alike = (before * after > 0.0) & (large < STEADY * small)
    steady = np.append(False, alike) & np.append(alike, False)
    measured = np.zeros(len(time), np.bool_)
    stops = _mark_stops(time[at] / row, speed[at], period[at] / row)
    measured[at[((period[at] < FRESH * row) | steady) & ~turned & ~stops]] = True
    return measured


def _repeat_by_chance(again: Bools, period: Floats) -> bool:
    """Decide whether new values often are those before them: of whole ticks of a timer. Else such a one is an old one.

    again: values (N,) that are those before. period: [rows] of the same shape; with two edges in a row a value is new.
    """
    return bool(np.count_nonzero(again[period < FRESH]) > MOST_REPEATED * np.count_nonzero(period < FRESH))


def _mark_repeats_of_stops(time: Floats, speed: Floats, period: Floats, again: Bools) -> Bools:
    """Mark rows (K,) whose value came so near to a stop or a turn that it is the old one where it comes again.

    Of times and periods (K,) [rows]; again: whether a row repeats the value before, by chance or as no edge came.
    """
    first = np.flatnonzero(~again)
    stops = _mark_stops(time[first], speed[first], period[first])
    return np.asarray(stops[np.cumsum(~again) - 1])


def _mark_turns(time: Floats, speed: Floats, period: Floats, zeros: Integers) -> Bools:
    """Mark values (N,) after a turn whose time may have begun before it: an edge was crossed there and back.

    Of times and periods (N,) [rows]. By what a speed gains in a row, and where it is more than the next one, which no
    motor's is that turns. zeros: how often 0 was shown until each; after one a board waits for two edges of one way.
    """
    size, change = np.abs(speed), np.abs(np.diff(speed)) / np.diff(time)
    turns = (speed[1:] * speed[:-1] < 0.0) & (np.diff(zeros) == 0)
    young = period[1:] * change > STOPS * size[1:]
    above = np.append(size[1:-1] > BEYOND_NEXT * size[2:], False)[: len(young)]
    return np.append(False, turns & (young | above))[: len(speed)]


def _mark_stops(time: Floats, speed: Floats, period: Floats) -> Bools:
    """Mark values (N,) so near to a stop or a turn that no edge may have come since, of times and periods (N,) [rows].

    By what is lost of a speed from the value before, or to the next one, in a row.
    """
    size, change = np.abs(speed), np.diff(speed) / np.diff(time)
    lost = np.maximum(np.append(0.0, -change * np.sign(speed[1:])), np.append(-change * np.sign(speed[:-1]), 0.0))
    return np.asarray(period * lost > STOPS * size) if len(speed) else np.zeros(0, np.bool_)


def _measure_noise(speed: Floats) -> float:
    """Measure the noise of speeds (K,), as a share of each: an error of a slot, of which it is one."""
    usual = sqrt(float(np.mean(speed**2))) if len(speed) else 0.0
    if usual == 0.0:
        return LEAST_NOISE
    return max(estimate_relative_noise(speed), find_lattice(speed) * UNIFORM_SIGMA / usual, LEAST_NOISE)


def _find_standstills(recording: Recording) -> tuple[Floats, Floats]:
    """Find start and end [s] of the times from the row before values of 0 to the last of them, in pieces.

    In pieces, for what goes back and comes again has moved; of a standstill, if there is one.
    """
    time, row = np.append(recording.time, 0.0), recording.sample_period
    stands = np.diff((recording.speed == 0.0).astype(np.int8), prepend=0, append=0)
    first, last = np.flatnonzero(stands > 0), np.flatnonzero(stands < 0) - 1
    pieces = []
    for start, stop in zip(time[first - 1], time[last], strict=True):
        rows = (stop - start) / row
        count = int(rows / ((LEAST_STANDSTILL if rows > LEAST_STANDSTILL else LEAST_ZEROS) + 1.0))
        pieces.append(np.linspace(start, stop, count + 1))
    none = [np.zeros(0)]
    return np.concatenate(none + [one[:-1] for one in pieces]), np.concatenate(none + [one[1:] for one in pieces])
