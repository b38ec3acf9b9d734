"""Begin a run at every level of a log that has rows while a level is held, and none between two of them.

A program sets a level, logs for half a second, stops the motor, waits, and goes on with the next one. Its log says
nothing of the stop: by the rows, the motor ran on under the level before. A reader that stalls, or a row that is lost,
comes at any time, and the level is the same behind it as before: there the motor went on as commanded.
"""

import numpy as np

from motor_identification.logs.rows.parts import name_by_voltage
from motor_identification.logs.signals import Bools, Signals
from motor_identification.sensor.row_clock import LONGEST

FEWEST = 3  # gaps with another level behind: fewer are stalls by chance
MOSTLY = 0.9  # of the changes of the level are in gaps: a program that logs each of its commands has them anywhere
HALF = 0.5  # of the gaps have another level behind: stalls that come at any time seldom do
ROWS = 4  # of a level, as usual: fewer are the rows of a log that has one whenever something changes


def split_between_levels(signals: Signals) -> tuple[Signals, list[str]]:
    """Begin a run behind every gap, where the voltage holds from gap to gap and changes in gaps; and say so."""
    gap = _mark_gaps(signals)
    if not _has_levels_apart(signals, gap):
        return signals, []
    lost = float(np.diff(signals.time, prepend=signals.time[:1])[gap].sum()) * 1e-9
    parts = name_by_voltage(signals.split(gap))
    said = (
        f"The voltage changes only where rows are missing, in {np.count_nonzero(gap)} gaps ({lost:.3g} s in all): what "
        f"was applied in them is not known, and behind each a run begins with a speed of its own: {len(parts.runs)} "
        "runs, a bag each."
    )
    return parts, [said]


def _mark_gaps(signals: Signals) -> Bools:
    """Mark the rows (K,) that have a gap before them, in their run."""
    steps = signals.steps()
    forward = steps[steps > 0]
    before = np.diff(signals.time, prepend=signals.time[:1])
    before[[run.start for run in signals.runs.values()]] = 0
    usual = float(np.median(forward)) if len(forward) else np.inf
    return np.asarray(before > LONGEST * usual)


def _has_levels_apart(signals: Signals, gap: Bools) -> bool:
    """Decide whether levels are logged one by one, with these gaps (K,) between them."""
    changes = np.diff(signals.voltage, prepend=signals.voltage[:1]) != 0.0
    changes[[run.start for run in signals.runs.values()]] = False
    gaps, levels = np.count_nonzero(gap), np.count_nonzero(gap & changes)
    rows = len(signals) / (gaps + len(signals.runs))
    return bool(
        levels >= FEWEST and levels >= MOSTLY * np.count_nonzero(changes) and levels >= HALF * gaps and rows >= ROWS
    )
