"""Judge an effect by standstills alone: a motor that rests under a voltage is held, whatever else its model lacks.

What is not in the table bends a motion, and an effect of the table may stand in for that; nothing but friction or a
dead zone holds a motor at rest under a voltage that moves its model.
"""

import numpy as np

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.measurement.intervals import Intervals
from motor_identification.measurement.standstill import LEAST_STANDSTILL
from motor_identification.periodic.periodic_fit import LOAD_OVER_ANGLE
from motor_identification.recording import Bools, Floats, Integers, Recording
from motor_model.effects import EFFECT_BY_NAME

ABOUT_ONE = 1.5  # slots are irregular
Motion = tuple[Recording, Intervals, Floats]  # and simulated minus measured travel [rad] of every interval


def explains_standstills(before: Model, after: Model) -> bool:
    """Decide whether the model before moves where the motor stood under a voltage, and the model after much less."""
    false, left = measure_false_motion(before), measure_false_motion(after)
    return false > thresholds.LEAST_FALSE_MOTION and left < (1.0 - thresholds.HELD_SHARE) * false


def was_held(model: Model) -> bool:
    """Decide whether the motor stood under a voltage anywhere, and what holds it could show."""
    lag = model.estimate.parameters.time_constant
    return any(bool(find_held_intervals(recording, data, lag).any()) for recording, data, _ in _list_motions(model))


def list_hills(model: Model, effect: str) -> tuple[str, ...]:
    """List the effects that vary with the angle and hold a motor as a breakaway does, where it set off once or twice.

    From where it stood, a hill of a torque over the angle holds it as well; several places tell the two, or a friction
    that is seen to fall with the speed. Measured: a breakaway of 0.31 ± 0.07 V at one start from rest, of a motor with
    a friction of 0.21 V and a ripple of 0.09 V; either was as likely.
    """
    row = EFFECT_BY_NAME[effect]
    falls = [spec.name for spec in row.parameters[1:]]
    alike = row.holds and row.implies is not None and all(one in model.uncertainty.not_identifiable for one in falls)
    if not alike or LOAD_OVER_ANGLE in model.effects or count_departures(model) > thresholds.FEW_DEPARTURES:
        return ()
    return (LOAD_OVER_ANGLE,)


def count_departures(model: Model) -> int:
    """Count how often the motor stood still; what parts two of them lasts for a time constant at least."""
    lag = model.estimate.parameters.time_constant
    return sum(_count_stretches(data, _mark_still(one, data, lag), lag) for one, data, _ in _list_motions(model))


def _mark_still(recording: Recording, data: Intervals, lag: float) -> Bools:
    """Mark the intervals in which the motor did not move, as far as its sensor tells, whatever was applied."""
    anyway = np.ones(len(data.speed), dtype=int)
    long = data.duration > LEAST_STANDSTILL * recording.sample_period
    count = np.min(
        data.travel[~long & (data.travel > 0.0)], initial=np.inf
    )  # of those without stamps, which no slot has
    one = (data.speed == 0.0) | (long & (data.travel < ABOUT_ONE * np.maximum(data.slot, count)))
    return np.asarray(one | _mark_within_noise(data, anyway, lag))


def _count_stretches(data: Intervals, marks: Bools, lag: float) -> int:
    """Count stretches of marked intervals that are further apart than a lag [s]."""
    order = data.order[marks[data.order]]
    begin, end = data.time[data.first[order]], data.time[data.last[order]]
    return int(np.count_nonzero(begin[1:] - np.maximum.accumulate(end)[:-1] > lag)) + min(len(order), 1)


def measure_false_motion(model: Model) -> float:
    """Measure simulated travel where the motor stood under a voltage: the sum of squares, in units of the sensor's."""
    lag = model.estimate.parameters.time_constant
    return sum(_sum_false_motion(motion, model.noise.share, lag) for motion in _list_motions(model))


def _list_motions(model: Model) -> list[Motion]:
    problem, held = model.estimate.problem, model.held
    rows = list(zip(held.recordings, held.intervals, held.increments, strict=True))
    if not any(one is recording for one, _, _ in rows for recording in problem.recordings):
        rows += zip(problem.recordings, problem.intervals, model.estimate.increments, strict=True)
    return rows


def _sum_false_motion(motion: Motion, share: float, lag: float) -> float:
    recording, data, increments = motion
    still = find_held_intervals(recording, data, lag)
    scatter = np.sqrt(data.floor_squared(share * data.unit)) * data.duration
    unit = np.maximum(np.maximum(scatter, data.slot), data.slack)  # counts without stamps have no slot, but its slack
    return float(np.sum((increments[still] / unit[still]) ** 2))


def find_held_intervals(recording: Recording, data: Intervals, lag: float) -> Bools:
    """Find the intervals in which the motor did not move, though a voltage was applied in the end, and none against it.

    Not by more than one slot in many samples, where slots are what is known of its motion; nor, for some time constants
    `lag` [s] of the motor, by more than the noise of logged speeds.
    """
    begin = np.maximum(np.searchsorted(recording.time, data.time[data.first], side="right") - 1, 0)
    end = np.maximum(np.searchsorted(recording.time, data.time[data.last], side="left"), begin + 1)
    least = thresholds.HOLDING_VOLTAGE * float(np.max(np.abs(recording.voltage), initial=0.0))
    way = np.where(recording.voltage > least, 1, np.where(recording.voltage < -least, -1, 0))
    last = way[end - 1]
    against = np.where(last > 0, _count_between(way < 0, begin, end), _count_between(way > 0, begin, end))
    pushed = (last != 0) & (against == 0)
    long = data.duration > LEAST_STANDSTILL * recording.sample_period
    one_slot = long & (data.travel < ABOUT_ONE * data.slot)
    return np.asarray(((data.speed == 0.0) | one_slot | _mark_within_noise(data, last * pushed, lag)) & pushed)


def _mark_within_noise(data: Intervals, way: Integers, lag: float) -> Bools:
    """Mark speeds within their noise, of a motor that is pushed one way for some time constants `lag` [s] meanwhile.

    A filter that is undone leaves no zeros: of the digits that were printed, and of all that it kept.
    """
    marks = np.zeros(len(data.speed), dtype=bool)
    if data.window == 0.0:
        return marks
    near = (np.abs(data.speed) < thresholds.STILL_SIGMA * data.sigma) & (way != 0)
    number = np.cumsum(np.diff(np.where(near, way, 0)[data.order], prepend=0) != 0)  # of each stretch, as they follow
    lasts = np.bincount(number, weights=data.duration[data.order])
    several = np.bincount(number) > 1
    marks[data.order] = (several & (lasts > thresholds.STILL_CONSTANTS * lag))[number]
    return np.asarray(marks & near)


def _count_between(marks: Bools, begin: Integers, end: Integers) -> Integers:
    """Count the marks from each begin to its end."""
    total = np.concatenate([[0], np.cumsum(marks)])
    return np.asarray(total[end] - total[begin])
