"""Find the slot over whose times speeds were computed: the period method, whose values are the older the slower.

Where a motor is slow enough, how long values stay tells the slot, or how they fall. Else its motion does: such a value
is the mean from one edge to the next, on average a whole period slot/|v| old, so that of all slots the motor is fitted
to the speeds as each would have them, and the likeliest is compared with the same rows' values by the likeliest other
timing (`error_likelihood.py`). Not where speeds show a filter: both come late, and what was smoothed has a noise of its
own. Where all speeds are over whole ticks of a timer, times between edges is what they are, and slots are those of
ticks as there are.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import inf, isfinite

import numpy as np

from motor_identification.estimation.problem import Problem
from motor_identification.recording import Bools, Floats, Integers, Recording
from motor_identification.sensor.pulses.pulse_periods import (
    LONGEST_SLOT,
    contradicts,
    find_slot_by_decays,
    find_slot_by_stays,
    score_stays,
)
from motor_identification.sensor.pulses.pulse_periods import (
    STEPS as FINE_STEPS,
)
from motor_identification.sensor.pulses.timer_ticks import list_slots
from motor_identification.sensor.speed_sensor import find_speed_sensor
from motor_identification.sensor.value_lattice import find_lattice
from motor_identification.timing.error_likelihood import measure_log_likelihood
from motor_identification.timing.shaped_fit import ShapedFit, Shaper
from motor_identification.timing.timing import LEAST_DELAY, Timing
from motor_model.effects import LAGGING
from motor_model.errors import RecordingError

# Slots that are tried: so many rows at the usual speed (shorter ones make no difference), then nearer to the likeliest.
GRID = tuple(0.003 * 3.0**k for k in range(7))
STEPS = (1.7, 1.3, 1.12, 1.06)
LEAST_ROWS = 30  # that tell
SAME_SLOT = 0.15  # of a slot that stays tell, mostly to some per cent
# Of log likelihood: of slots of ticks that are as likely, the longest is taken. By half a slot values after a turn that
# began before it seem new; by twice one a few are left out. Measured: 3.5 of half a slot, by which 0.5 rad/s were left
# of a motor that leaves 0.09.
AS_LIKELY = 5.0
UNDONE = 0.2  # of the dead time by another timing, at most, that is left by a slot which undoes it


@dataclass(frozen=True)
class SlotGain:
    """How much likelier speeds over the times of a slot are than the same rows' values by another timing."""

    slot: float  # [rad]
    gain: float  # of log likelihood
    rows: int
    undoes: bool = False  # a dead time that the other timing asks for
    stays: float = 0.0  # values that stay as long as the slot says, less those that do not


def find_shown_slot(recordings: Sequence[Recording]) -> float:
    """Find the slot [rad] that values themselves show: by how they fall between edges, or how long they stay; 0."""
    return find_decay_slot(recordings) or find_stays_slot(recordings)


def find_stays_slot(recordings: Sequence[Recording]) -> float:
    """Find the slot [rad] by how long values stay, that of whole ticks where these are near; 0 where none shows.

    Nor does counts' of single rows: they stay, too, while a motor turns evenly.
    """
    ticks = list_tick_slots(recordings)
    timed = [one for one in recordings if ticks or find_speed_sensor(one).step == 0.0]
    slot = _find_slot(find_slot_by_stays, timed)
    near = [one for one in ticks if abs(one - slot) < SAME_SLOT * slot]
    return min(near, key=lambda one: abs(one - slot), default=slot)


def find_decay_slot(recordings: Sequence[Recording]) -> float:
    """Find the slot [rad] by how values fall between edges; 0 where that tells none."""
    return _find_slot(find_slot_by_decays, recordings)


def list_tick_slots(recordings: Sequence[Recording]) -> tuple[float, ...]:
    """List the slots [rad] that speeds may be over which are whole ticks of a timer; empty where they are none."""
    found = (list_slots(one.speed, LONGEST_SLOT) for one in recordings)
    return next((slots for slots in found if slots), ())


def are_coarse(recordings: Sequence[Recording]) -> bool:
    """Decide whether speeds are so few of their own steps that they do not tell how much time a slot took."""
    return any(_measure_usual_speed([one]) < FINE_STEPS * find_lattice(one.speed) for one in recordings)


def _find_slot(find: Callable[[Floats, Floats], float], recordings: Sequence[Recording]) -> float:
    found = [slot for one in recordings if (slot := find(one.time, one.speed)) > 0.0]
    return float(np.median(found)) if found else 0.0


def find_likeliest_slot(shaper: Shaper, instants: Timing, other: Timing) -> SlotGain:
    """Find the slot by which a shaper's speeds are likeliest beside another timing; of those that ticks tell, if any.

    instants: whether voltages hold from the rows on or held until them.
    """
    plain = shaper.fit(other)
    usual = measure_usual_travel(shaper.recordings)

    def judge(slot: float) -> SlotGain:
        return judge_slot(shaper, replace(instants, slot=slot), other, plain)

    if ticks := list_tick_slots(shaper.recordings):
        judged = [judge(slot) for slot in ticks]
        least = max(map(_rate, judged)) - AS_LIKELY
        return max((one for one in judged if _rate(one) >= least), key=lambda one: one.slot)
    best = max(map(judge, (usual * share for share in GRID)), key=_rate)
    if best.gain > 0.0:
        for step in STEPS:
            best = max(best, judge(best.slot / step), judge(best.slot * step), key=_rate)
    return best


def measure_gain_over_lag(shaper: Shaper, timing: Timing, other: Timing) -> float:
    """Measure how much likelier speeds are by a timing with a slot than by another one beside what lags in a motor.

    The age of values is a lag, and gains a little where something else lags: speeds that were smoothed.
    """
    return judge_slot(shaper, timing, other, shaper.fit(other), LAGGING).gain


def measure_usual_travel(recordings: Sequence[Recording]) -> float:
    """Measure how far [rad] a motor usually turns in a row."""
    return min(recording.sample_period for recording in recordings) * _measure_usual_speed(recordings)


def judge_slot(shaper: Shaper, timing: Timing, other: Timing, plain: ShapedFit, beside: Sequence[str] = ()) -> SlotGain:
    """Judge a timing with a slot beside another one without, which may have more effects.

    plain: the recordings fitted by that other timing.
    """
    slot = timing.slot
    if slot > LONGEST_SLOT:
        return SlotGain(slot, -np.inf, 0)
    stays = [score_stays(one.time, one.speed, slot) for one in shaper.recordings]
    if any(map(contradicts, stays)) and not list_tick_slots(shaper.recordings):  # of ticks, many values are alike
        return SlotGain(slot, -np.inf, 0)
    try:
        periods = shaper.fit(timing)
    except RecordingError:  # by so long a slot hardly any row brings a value of its own
        return SlotGain(slot, -np.inf, 0)
    moving = [np.flatnonzero(data.slack == 0.0) for data in periods.estimate.problem.intervals]
    if not all(len(some) for some in moving) or sum(map(len, moving)) < LEAST_ROWS:
        return SlotGain(slot, -np.inf, 0)
    rows = _find_rows(plain.estimate.problem, periods.estimate.problem, moving)
    alone = replace(shaper, restrict=_restrict_to(rows, shaper.restrict)).fit(other, beside)
    undoes = plain.delay > LEAST_DELAY * plain.estimate.problem.sample_period and periods.delay < UNDONE * plain.delay
    return SlotGain(slot, measure_gain_of_speeds(alone, periods), sum(map(len, moving)), undoes, sum(stays))


def measure_gain_of_speeds(before: ShapedFit, after: ShapedFit) -> float:
    """Measure how much likelier one fit's speeds are than another's of the same rows, where a motor moved.

    Minus infinity where there are too few, or some are no numbers.
    """
    old, new = _list_errors(before), _list_errors(after)
    count = min(old.shape[1], new.shape[1])  # at the beginning a row may have no whole window
    one, other = (measure_log_likelihood(*some[:, some.shape[1] - count :]) for some in (old, new))
    return other - one if isfinite(one) else -inf


def _list_errors(fitted: ShapedFit) -> Floats:
    """List simulated less measured, and simulated, speeds [rad/s] of all intervals of motion, shape (2, I)."""
    estimate = fitted.estimate
    both = [
        np.stack([left / data.duration, left / data.duration + data.speed])[:, data.slack == 0.0]
        for left, data in zip(estimate.increments, estimate.problem.intervals, strict=True)
    ]
    return np.concatenate(both, axis=1)


def _rate(one: SlotGain) -> float:
    """Rate a slot beside others: a value that stays by chance as long as it says is one in three."""
    return one.gain + one.stays


def _find_rows(instants: Problem, periods: Problem, moving: Sequence[Integers]) -> list[Integers]:
    """Find the intervals of instants, by their number, that belong to those of periods: the row after their end."""
    pairs = zip(instants.intervals, periods.intervals, moving, strict=True)
    ends = [(one.time[one.last], other.time[other.last[some]]) for one, other, some in pairs]
    return [np.minimum(np.searchsorted(row, end), len(row) - 1) for row, end in ends]


def _restrict_to(
    rows: Sequence[Integers], restrict: Callable[[Problem], Problem] | None
) -> Callable[[Problem], Problem]:
    """Restrict a problem to intervals of these numbers, of those that it is restricted to anyway."""

    def restricted(problem: Problem) -> Problem:
        seen = problem if restrict is None else restrict(problem)
        return seen.without(
            tuple(_mark_others(len(data.first), some) for data, some in zip(seen.intervals, rows, strict=True))
        )

    return restricted


def _mark_others(count: int, numbers: Integers) -> Bools:
    others = np.ones(count, np.bool_)
    others[numbers] = False
    return others


def _measure_usual_speed(recordings: Sequence[Recording]) -> float:
    speed: Floats = np.abs(np.concatenate([recording.speed for recording in recordings]))
    return float(np.median(speed[speed > 0.0])) if np.any(speed) else 0.0
