"""Build intervals with a measured mean speed from every kind of recording.

An edge is an exact angle at a time known to the timer's tick, so that between two reported edges the mean speed is
Δcount·(2π/N)/Δt. A count that is read at the samples fixes the angle where it changes; a logged speed is a mean over a
window.
"""

from dataclasses import replace
from math import sqrt

import numpy as np

from motor_identification.measurement.edges import Edges, extract_edges, mark_one_way
from motor_identification.measurement.edit_intervals import append_standstills
from motor_identification.measurement.intervals import Intervals, index_intervals
from motor_identification.measurement.pulse_intervals import make_pulse_intervals, measure_slot
from motor_identification.measurement.sampled_counts import Changes, extract_count_changes, locate_fixes
from motor_identification.measurement.sanity_checks import check_counts
from motor_identification.measurement.standstill import (
    REST_RANGE,
    find_standstills_at_edges,
    find_standstills_at_reversals,
    find_standstills_of_noisy_angles,
)
from motor_identification.recording import Floats, Recording
from motor_identification.sensor.held_counts import drop_held_counts
from motor_identification.sensor.noisy_angle import Angles, find_noisy_angles
from motor_identification.sensor.pulses.missed_edges import mark_long_pairs, measure_missed_share
from motor_identification.sensor.speed_sensor import SpeedSensor, find_speed_sensor
from motor_model.errors import RecordingError
from motor_model.sample import Measurement

# Of both channels' flanks, against those of one: duty cycle and phase of cheap sensors are off by a third of a slot.
UNEVENNESS = 7.0
# Relative to the window of a logged speed: rows as long as that are its windows, though their stamps jitter. Counts
# were divided by the length that their lattice shows, what is on no lattice by that of its own row.
SAME_ROW, OWN_ROW = 0.01, 0.5


def make_intervals(recording: Recording) -> Intervals:
    """Make the intervals of a recording: what it says about the motion.

    Raises:
        RecordingError: there is less than three intervals of motion in it, or its numbers are those of no motor.
    """
    info = recording.info
    if info.measurement is Measurement.COUNTS and not info.single_channel:  # its directions are read again, row by row
        recording = drop_held_counts(recording)
        angles = find_noisy_angles(recording)
        if angles is not None:
            return _from_noisy_angles(recording, angles)
    if info.measurement is not Measurement.SPEED:
        check_counts(recording)
    intervals = _READERS[info.measurement](recording)
    if len(intervals.first) < 3:
        raise RecordingError(
            f"{recording.uri} shows only {len(intervals.first)} intervals of motion: record longer, or with a "
            "higher voltage."
        )
    return intervals


def _from_edges(recording: Recording) -> Intervals:
    return make_edge_intervals(recording, extract_edges(recording))


def make_edge_intervals(recording: Recording, edges: Edges) -> Intervals:
    """Make intervals between stamped edges with known directions.

    Where edges are missed among many, only between those that follow each other: from there to the next such pair the
    motor would seem slower by their share. Pairs with a missed edge between them are seen by their speed.
    """
    slot = recording.info.edge_angle
    one_way = mark_one_way(edges)
    # Several flanks of a period are as uneven as the sensor: pairs of them span no slot that could be compared.
    even = recording.info.quadrature <= 1
    missed = measure_missed_share(edges.time, edges.count, one_way) if even else None
    good = one_way
    if missed is not None:
        slots = np.abs(np.diff(edges.count))
        good = one_way & (slots == 1) & ~mark_long_pairs(slots, np.diff(edges.time))
    first, last = edges.only(np.flatnonzero(good)), edges.only(np.flatnonzero(good) + 1)
    speed = last.direction * np.abs(last.count - first.count) * slot / (last.time - first.time)
    # A stamp is uniform over a tick τ: its standard deviation is τ/√12, and that of the angle ω times as much.
    blur = np.abs(speed) * recording.info.edge_resolution / sqrt(12.0)
    moving = index_intervals(
        first.time,
        last.time,
        speed,
        blur,
        edge=np.column_stack([first.count, last.count]),
        slot=slot,
        left_out=int(np.count_nonzero(~one_way)),
        gear=float(recording.info.gear),
        unevenness=UNEVENNESS if recording.info.quadrature > 1 else 1.0,
    )
    moving = replace(moving, missed=missed)
    return append_standstills(moving, find_standstills_at_edges(recording, edges, ~one_way), slot)


def _from_counts(recording: Recording) -> Intervals:
    return make_count_intervals(recording, extract_count_changes(recording))


def make_count_intervals(recording: Recording, changes: Changes) -> Intervals:
    """Make intervals from counts read at the samples, between the instants at which they fix the angle."""
    slot = recording.info.edge_angle
    fixes = locate_fixes(recording, changes)
    good = (np.diff(fixes.run) == 0) & (fixes.way[1:] != 0) & (np.diff(fixes.time) > 0.0)
    begin, end = np.flatnonzero(good), np.flatnonzero(good) + 1
    start, stop = fixes.time[begin], fixes.time[end]
    speed = fixes.way[end] * (fixes.place[end] - fixes.place[begin]) * slot / (stop - start)
    # An interval's end is the next one's start; where a run begins, both ends have the larger blur.
    fresh = np.diff(begin, prepend=-2) != 1
    blur = slot * np.where(fresh, np.maximum(fixes.blur[begin], fixes.blur[end]), fixes.blur[end])
    moving = index_intervals(
        start,
        stop,
        speed,
        blur,
        place=None if recording.info.single_channel else slot * fixes.height[np.column_stack([begin, end])],
        left_out=int(np.count_nonzero(~good)),
        gear=float(recording.info.gear),
    )
    return append_standstills(moving, find_standstills_at_reversals(recording, changes), slot)


def _from_noisy_angles(recording: Recording, angles: Angles) -> Intervals:
    """Make intervals from angle to angle, each known to within its noise, but for those in which the shaft rests."""
    slot, time = recording.info.edge_angle, angles.time
    place = (angles.angle - angles.angle[0]) * slot
    speed = np.diff(place) / np.diff(time)
    rests = find_standstills_of_noisy_angles(time, angles.angle, angles.noise)
    rested = np.searchsorted(rests[0], time[:-1], side="right") > np.searchsorted(rests[1], time[1:], side="left")
    moves = ~rested
    moving = index_intervals(
        time[:-1][moves],
        time[1:][moves],
        speed[moves],
        np.full(np.count_nonzero(moves), angles.noise * slot),
        place=np.column_stack([place[:-1], place[1:]])[moves],
        gear=float(recording.info.gear),
    )
    return append_standstills(moving, rests, REST_RANGE * angles.noise * slot)


def _from_speed(recording: Recording) -> Intervals:
    """A logged speed is a mean over the source's window, with the noise that was said or is found in the values."""
    if measure_slot(recording) > 0.0:
        return make_pulse_intervals(recording)
    sensor = find_speed_sensor(recording)
    start, end = _find_windows(sensor)
    inside = start >= -1e-9
    start, end = np.round(np.maximum(start[inside], 0.0), 9), np.round(end[inside], 9)
    # A mean of counts is off by what the angle at either end is truncated by; white noise belongs to each value alone.
    noise = sensor.count / sqrt(12.0) if sensor.step > 0.0 else sensor.sigma * sensor.window / sqrt(2.0)
    return index_intervals(
        start,
        end,
        speed=recording.speed[sensor.row[inside]],
        blur=np.full(len(start), noise),
        independent=sensor.sigma > 0.0,
        gear=float(recording.info.gear),
        window=sensor.window,
        noise=noise,
    )


def _find_windows(sensor: SpeedSensor) -> tuple[Floats, Floats]:
    """[s] where the window of each speed starts and ends: at the value before, where windows and rows are as long."""
    end = sensor.time - sensor.lag + 0.5 * sensor.window
    start = end - sensor.window
    if sensor.lengths is not None:
        return end - sensor.lengths, end
    row = np.diff(end, prepend=-np.inf)
    if abs(float(np.median(row[1:])) - sensor.window) <= SAME_ROW * sensor.window:
        chained = np.abs(row - sensor.window) <= (SAME_ROW if sensor.step > 0.0 else OWN_ROW) * sensor.window
        start[chained] -= (row - sensor.window)[chained]
    return start, end


_READERS = {Measurement.EDGES: _from_edges, Measurement.COUNTS: _from_counts, Measurement.SPEED: _from_speed}
