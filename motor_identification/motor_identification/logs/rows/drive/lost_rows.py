"""Tell counts of single rows of which some are lost: what those counted is in no row, so that no sum is a position."""

from dataclasses import replace

import numpy as np

from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.signals import Floats, Signals

GAP = 1.5  # times the usual length of a row: a longer one has a lost one in it, or was late
LONGEST = 4.5  # times the same: across longer ones the rows on either side tell little
MADE_UP = 0.75  # times the same: with a shorter one behind it only a stamp was late
FEWEST = 3  # rows behind such ones that tell
COUNTS = 4.0  # of a row beside such a one: fewer tell one row's from those of two by chance
LOST = (
    "Caution: {0} counts one row of {1:.4g} ms, also behind rows that are missing ({2} times): what these counted is "
    "lost. It is read as the speed of each row."
)


def read_speeds_where_rows_are_lost(signals: Signals, form: CsvForm) -> tuple[Signals, CsvForm, list[str]]:
    """Read counts that were those of each row, and are summed up, as speeds where rows are lost; and say so.

    Behind a row that is missing a count is that of one row, as those beside it are. A loop that was late counts on.
    """
    steps = signals.steps()
    if not form.increments or form.time is None or len(steps) == 0:
        return signals, form, []
    period = float(np.median(steps))
    found = np.array([_compare(signals, run, period) for run in signals.runs.values()])
    told, counted, of_one, of_all = found.sum(axis=0)
    if told < FEWEST or abs(counted - of_one) >= abs(counted - of_all):
        return signals, form, []
    counts = np.diff(signals.motion, prepend=0.0)
    speeds = replace(signals, motion=counts / (period * 1e-9))
    read = replace(form, kind=Kind.SPEED, unit="count/s", increments=False)
    return speeds, read, [LOST.format(form.motion, period * 1e-6, int(told))]


def _compare(signals: Signals, run: slice, period: float) -> Floats:
    """Sum up over a run the rows behind missing ones, their counts, and what those beside them say of one and of all.

    period: [ns] of a row.
    """
    rows = np.diff(signals.time[run]) / period
    counts = np.abs(np.diff(signals.motion[run]))
    behind = np.flatnonzero((rows[1:-1] > GAP) & (rows[1:-1] < LONGEST) & (rows[2:] > MADE_UP)) + 1
    beside = 0.5 * (counts[behind - 1] + counts[behind + 1])
    alike = np.minimum(counts[behind - 1], counts[behind + 1]) >= np.maximum(COUNTS, 0.5 * beside)
    behind, beside = behind[alike], beside[alike]
    return np.array([len(behind), counts[behind].sum(), beside.sum(), (np.rint(rows[behind]) * beside).sum()])
