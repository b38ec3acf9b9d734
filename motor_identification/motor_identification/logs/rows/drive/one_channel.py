"""Tell counts of one channel, which rise whichever way the motor turns, and which way it turned as it was driven.

A motor follows its voltage as a first-order lag. Where counts only rise while the voltage goes both ways, either it
never turned back, as under a load or a brake, and went the slower the lower the voltage was; or what was counted is how
far it went either way, and it was as fast under either sign. A fit of the motor then reads directions again
(`estimation/direction_correction.py`).
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.signal import lfilter

from motor_identification.logs.signals import Bools, Floats, Integers, Signals

FEWEST = 50  # rows that tell
EITHER_WAY = 0.05  # of the counts, that a motor makes each way: fewer are those of one that hardly turned back
BETTER = 0.5  # of what is left of the counts by a motor that turns one way only, if it is to turn both
A_PART = 4.0  # counts, as usual, in each of the parts of a run that are compared: of fewer, rounding hides the motion
FEWEST_PARTS = 20
ONE_CHANNEL = (
    "Caution: {} only rises while the voltage changes its sign, and as fast under either: it counts one channel, and "
    "the direction is not in it. The motor is taken to turn as it is driven, and a fit reads the directions again by "
    "its motion (assumed; better: log a count of both channels)."
)
ONE_CHANNEL_OR_LOAD = (
    "Caution: {} never goes back while the voltage drives as much one way as the other: it counts one channel, and the "
    "direction is not in it, or a load or a brake keeps the motor from turning back. Do not trust kv; log a count of "
    "both channels."
)
ALIKE = 0.1  # of its RMS, that a voltage's mean is at most which drives either way alike
AS_FAR = 0.5  # of how far it goes one way, that it goes the other way at least
# Time constants that are tried, from a tenth of a row, within which a motor is there, to a quarter of the longest run,
# evenly by their logarithm.
LAGS, SHORTEST = 32, 0.1
# Of their variance, that counts with a sign of their own leave at most, whatever their size leaves: a motor that is
# there within a row or two follows its voltage either way. Measured: 0.0008 to 0.0018 of three such motors; 0.03 and
# more of one channel's, with the command's sign, of motors of three rows and more.
HARDLY_ANY = 5e-3


def find_ways(signals: Signals) -> Floats | None:
    """Find which way a motor turned in each row, 1 or -1, shape (K,), whose counts only rise; None where they tell it.

    Args:
        signals: with counts, or an angle that was counted, as motion.
    """
    counted = [np.diff(signals.motion[run]) for run in signals.runs.values()]
    rises = all(bool(np.all(steps >= 0.0)) for steps in counted) and any(bool(np.any(steps)) for steps in counted)
    if len(signals) < FEWEST or not rises or not np.min(signals.voltage) < 0.0 < np.max(signals.voltage):
        return None
    best_way, both, one_way = None, 1.0, 1.0
    for driven in (_lag_voltage(signals, rows) for rows in _list_lags(signals)):
        both_left, one_way_left = _compare(signals, driven)
        one_way = min(one_way, one_way_left)
        if both_left < both:
            best_way, both = np.where(driven < 0.0, -1.0, 1.0), both_left
    if best_way is None or not both < BETTER * one_way or not _turns_both_ways(signals, best_way):
        return None
    return np.asarray(best_way, np.float64)


def never_goes_back(signals: Signals) -> bool:
    """Whether counts, or angles, go one way all the time under a voltage that drives as much one way as the other.

    Voltages make up for friction and for speed in the mean, and inertia for nothing: a motor that goes one way has a
    mean of its own.
    """
    steps = [np.diff(signals.motion[run]) for run in signals.runs.values()]
    moved = np.concatenate(steps) if steps else np.zeros(0)
    if np.count_nonzero(moved) < FEWEST or (np.any(moved < 0.0) and np.any(moved > 0.0)):
        return False
    volts = signals.voltage
    low, high = -float(np.min(volts)), float(np.max(volts))
    as_far = min(low, high) > AS_FAR * max(low, high)
    return as_far and abs(float(np.mean(volts))) < ALIKE * float(np.sqrt(np.mean(volts**2)))


def compare_signs(signals: Signals, steps: Floats) -> tuple[float, float]:
    """Compare what a motor that follows its voltage leaves of counts that only rise, and of the same with a sign.

    The least squares of either, alike where a sign of their own leaves hardly any of the motion. steps: with the sign,
    since the row before, shape (K,).
    """
    parts = _part_alike(signals)
    if parts is None:
        return 1.0, 1.0
    moved = np.abs(steps)
    either_way = _find_least(signals, lambda driven: parts.leave(moved, np.abs(driven)))
    signed = _find_least(signals, lambda driven: parts.leave(steps, driven))
    if signed < HARDLY_ANY:
        return 1.0, 1.0
    return either_way * parts.vary(moved), signed * parts.vary(steps)


def _find_least(signals: Signals, leave: Callable[[Floats], float]) -> float:
    """Find the least share that is left by a motor that follows its voltage, of any time constant."""
    tried = _list_lags(signals)
    left = [leave(_lag_voltage(signals, rows)) for rows in tried]
    best = int(np.argmin(left))
    around = np.log(tried[max(best - 1, 0)]), np.log(tried[min(best + 1, len(tried) - 1)])
    found = minimize_scalar(lambda lag: leave(_lag_voltage(signals, float(np.exp(lag)))), bounds=around)
    return min(left[best], float(found.fun))


def _list_lags(signals: Signals) -> Floats:
    """List the time constants, in rows, that are tried."""
    longest = max(run.stop - run.start for run in signals.runs.values())
    return np.geomspace(SHORTEST, max(0.25 * longest, 2.0), LAGS)


def _lag_voltage(signals: Signals, rows: float) -> Floats:
    """Lag the voltage (K,) as a motor follows it, from rest, of a time constant in rows: its mean over every row."""
    keep, driven = float(np.exp(-1.0 / rows)), np.zeros(len(signals))
    for run in signals.runs.values():
        voltage = signals.voltage[run][:-1]
        after = lfilter([1.0 - keep], [1.0, -keep], voltage)  # the row
        before = np.concatenate([[0.0], after[:-1]])[: len(after)]
        driven[run.start + 1 : run.stop] = voltage + (before - voltage) * rows * (1.0 - keep)
    return driven


def _compare(signals: Signals, driven: Floats) -> tuple[float, float]:
    """Compare counts with what drives both ways, and one way only: the shares of their variance that are left."""
    parts, moved = _part_alike(signals), count_up(signals)
    if parts is None:
        return 1.0, 1.0
    one_way = (driven, np.maximum(driven, 0.0), np.maximum(-driven, 0.0))
    return parts.leave(moved, np.abs(driven)), min(parts.leave(moved, way) for way in one_way)


@dataclass(frozen=True)
class _Parts:
    """Parts of a log's rows in which a motor made counts enough for rounding to hide little."""

    starts: Integers  # (P,) rows
    held: Floats  # (K,) [ns] since the row before, 0 where there is none

    @cached_property
    def lengths(self) -> Floats:
        """[ns] of every part."""
        return np.asarray(np.add.reduceat(self.held, self.starts), np.float64)

    def _rate(self, steps: Floats) -> Floats:
        told = self.lengths > 0.0
        return np.asarray(np.add.reduceat(steps, self.starts)[told] / self.lengths[told])

    def vary(self, steps: Floats) -> float:
        """The squares by which rates vary, of what is counted since the row before (K,)."""
        rate = self._rate(steps)
        return float(np.sum((rate - np.mean(rate)) ** 2))

    def leave(self, steps: Floats, speeds: Floats) -> float:
        """The share of those that speeds (K,) leave, whatever their unit and zero."""
        return _leave(self._rate(steps), self._rate(speeds * self.held))


def _part_alike(signals: Signals) -> _Parts | None:
    """Part the rows of counts that only rise; None where they are too few."""
    held = np.zeros(len(signals))
    for run in signals.runs.values():
        held[run.start + 1 : run.stop] = np.diff(signals.time[run])
    parts = _Parts(_part(count_up(signals)), held)
    return parts if np.count_nonzero(parts.lengths) >= FEWEST_PARTS else None


def count_up(signals: Signals) -> Floats:
    """What was counted since the row before, shape (K,), by each run."""
    moved = np.zeros(len(signals))
    for run in signals.runs.values():
        moved[run.start + 1 : run.stop] = np.diff(signals.motion[run])
    return moved


def _part(moved: Floats) -> Integers:
    """Part rows (K,) by how many counts they have, as usual: the first row of every part."""
    usual = float(np.mean(moved)) / _one_count(moved)
    return np.arange(0, len(moved), max(1, int(np.ceil(A_PART / usual))), dtype=np.int64)


def _one_count(moved: Floats) -> float:
    """The size of one count, or of what rises least."""
    return float(np.min(moved[moved > 0.0]))


def _leave(rate: Floats, by: Floats) -> float:
    """The share of a variance, shape (P,), that another column leaves of it."""
    rate, by = rate - np.mean(rate), by - np.mean(by)
    size = float(rate @ rate) * float(by @ by)
    return 1.0 - float(rate @ by) ** 2 / size if size > 0.0 else 1.0


def _turns_both_ways(signals: Signals, way: Floats) -> bool:
    """Whether a motor made enough of its counts in either way, shape (K,)."""
    back = whole = 0.0
    for run in signals.runs.values():
        steps: Floats = np.diff(signals.motion[run])
        turned: Bools = way[run][1:] < 0.0
        back, whole = back + float(np.sum(steps[turned])), whole + float(np.sum(steps))
    return EITHER_WAY * whole <= back <= (1.0 - EITHER_WAY) * whole
