"""Exclude miscounted intervals: edges that were not counted, or counted twice, put them off by whole slots."""

import numpy as np
from scipy.ndimage import median_filter

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import ROBUST_SIGMA, fit_speeds, measure_scatter
from motor_identification.measurement.intervals import Intervals
from motor_identification.recording import Bools, Floats, Integers

WHOLE_SLOT_SIGMA = 4.0  # standard deviations from a whole number of slots (interfaces.md, "Gap")
WHOLE_SLOT_LEAST = 1e-3  # of a slot: the same where the scatter is as good as none
NEIGHBOURS = 9  # intervals whose median speed is not that of the few among them that are false
SMOOTH = 0.5  # of the scatter: neighbours that differ by less than so much show what the model does not know
LEAST_ALIKE, MOST_GROUPS = 100, 8  # intervals that a scatter is told from at least; groups at most
HEAVY_TAILS = 2.0  # RMS over the middle half's standard deviation, from which on no noise makes the tails
MOST_CLEANINGS = 8  # rounds of leaving out miscounted intervals: each makes the next easier to see


def mark_miscounts(data: Intervals, increments: Floats) -> Bools:
    """Mark the intervals whose travel [rad] is off by a whole number of slots, within 4 σ of others' scatter.

    Others are those about as long: what a random torque leaves grows with time. Where that is much more than what
    neighbours differ by, as beside a strong torque, an interval is compared with its neighbours' median speed, too.
    Shapes are (I,). Where 4 σ reach half a slot even so, nothing is marked.
    """
    moving = (data.slack == 0.0) & (data.edge[:, 0] >= 0)
    bad = np.zeros(len(increments), dtype=bool)
    if data.slot == 0.0 or not np.any(moving):
        return bad
    local = _beside_neighbours(data, moving, increments)
    for alike in _group_by_duration(data, moving):
        plain, beside = (_measure_scatter(off[alike]) for off in (increments, local))
        bad[alike] = _are_whole_slots(increments[alike] / data.slot, plain / data.slot)
        if beside < SMOOTH * plain:
            bad[alike] |= _are_whole_slots(local[alike] / data.slot, beside / data.slot)
    return bad


def _are_whole_slots(off: Floats, scatter: float) -> Bools:
    """Which are off by a whole number of slots, beside a scatter [slot]."""
    reach = max(WHOLE_SLOT_SIGMA * scatter, WHOLE_SLOT_LEAST)
    whole = np.round(off)
    return np.asarray((whole != 0.0) & (np.abs(off - whole) < reach) & (reach < 0.5))


def _beside_neighbours(data: Intervals, moving: Bools, increments: Floats) -> Floats:
    """Take the median speed of an interval and its neighbours out of what it is off by [rad]."""
    which = np.flatnonzero(moving)
    level = median_filter(increments[which] / data.duration[which], size=NEIGHBOURS, mode="nearest")
    local = np.array(increments)
    local[which] -= level * data.duration[which]
    return local


def _measure_scatter(values: Floats) -> float:
    """Measure the standard deviation of most values, from their median deviation."""
    return ROBUST_SIGMA * float(np.median(np.abs(values - np.median(values))))


def _group_by_duration(data: Intervals, which: Bools) -> list[Integers]:
    """Group intervals with others that are about as long: indices into all."""
    order = np.flatnonzero(which)[np.argsort(data.duration[which], kind="stable")]
    return np.array_split(order, int(np.clip(len(order) // LEAST_ALIKE, 1, MOST_GROUPS)))


def find_miscounts(estimate: Estimate) -> tuple[Bools, ...]:
    """Mark the miscounted intervals of every recording, judged by an estimate."""
    rows = zip(estimate.problem.intervals, estimate.increments, strict=True)
    return tuple(mark_miscounts(data, increments) for data, increments in rows)


def fit_robustly(estimate: Estimate) -> Estimate | None:
    """Fit most intervals, where some are so far off that they pull the fit of all; None where there are none such."""
    scatter = measure_scatter(estimate)
    return fit_speeds(estimate, scatter.robust) if scatter.rms > HEAVY_TAILS * scatter.robust else None


def exclude_miscounts(estimate: Estimate) -> Estimate:
    """Fit mean speeds, leave out the intervals that are off by whole slots, and fit again until there are none."""
    for _ in range(MOST_CLEANINGS):
        estimate = fit_speeds(estimate)
        estimate = fit_robustly(estimate) or estimate  # else false intervals hide each other
        bad = find_miscounts(estimate)
        if not any(marks.any() for marks in bad):
            break
        estimate = estimate.on(estimate.problem.without(bad))
    return estimate
