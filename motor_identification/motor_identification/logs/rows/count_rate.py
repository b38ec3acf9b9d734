"""How fast sampled counts change: between the latest two changes, so that a coarse encoder in a fast log has no spikes.

It is what `motor/speed` says too: the latest period's speed, bounded by one count over the time since the latest
change; a count that goes back is the same edge crossed again, and no speed.
"""

import numpy as np

from motor_identification.logs.rows.held import find_fresh_rows
from motor_identification.logs.signals import Floats, Integers, Signals


def count_rates(signals: Signals, counts: Integers) -> tuple[Floats, list[str]]:
    """[counts/s] of all rows, shape (K,); where a log holds its values, that of the latest fresh one, and a finding."""
    rate = np.zeros(len(counts))
    periods = []
    for run in signals.runs.values():
        time, here = signals.time[run], counts[run]
        rows, period = find_fresh_rows(time, here.astype(np.float64))
        latest = np.searchsorted(rows, np.arange(len(time)), side="right") - 1
        rate[run] = _rates(here[rows], (time[rows] - time[0]) * 1e-9)[latest]
        periods += [period] if period else []
    if not periods:
        return rate, []
    said = f"Values are held: the sensor has a new one every {np.median(periods) * 1e3:.3g} ms; a fit uses those alone."
    return rate, [said]


def _rates(counts: Integers, time: Floats) -> Floats:
    """[counts/s] at times [s]; the first row has none, and takes that of the second."""
    changed = np.flatnonzero(np.diff(counts)) + 1
    if not len(changed):
        return np.zeros(len(counts))
    before = np.concatenate(([0], changed[:-1]))  # of the first nothing is known but that it took so long
    change = counts[changed] - counts[before]
    again = (np.abs(change) == 1) & (np.sign(change) == -np.sign(np.concatenate(([0], change[:-1]))))
    between = np.where(again, 0.0, change / (time[changed] - time[before]))
    latest = np.searchsorted(changed, np.arange(len(counts)), side="right") - 1
    known = latest >= 0
    since = np.where(known, time - time[changed[np.maximum(latest, 0)]], np.inf)
    most = np.divide(1.0, since, out=np.full(len(since), np.inf), where=since > 0.0)
    rate = np.where(known, between[np.maximum(latest, 0)], 0.0)
    rate = np.sign(rate) * np.minimum(np.abs(rate), np.where(since > 0.0, np.maximum(most, 0.0), np.inf))
    rate[0] = rate[1]
    return np.asarray(rate, dtype=np.float64)
