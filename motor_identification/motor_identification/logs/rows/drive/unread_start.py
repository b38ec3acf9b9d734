"""Leave out the beginning of a log in which a motor was driven and its angle not yet read: it is caught up at once."""

import numpy as np

from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.signals import Floats, Signals

FEWEST_DRIVEN = 3  # rows at rest under a voltage: a dead time is no longer than that, or is followed by no jump
FURTHER = 3.0  # times the longest way of any later row: no motor is as quick as it starts
FEWEST_ROWS = 50  # behind it, by which it is known how far the motor goes in one


def drop_unread_start(signals: Signals, form: CsvForm) -> tuple[Signals, list[str]]:
    """Leave out the first rows of runs of positions up to one that catches up with what was not read before."""
    if form.kind is Kind.SPEED:
        return signals, []
    keep, said = np.ones(len(signals), np.bool_), []
    for run in signals.runs.values():
        motion, volts = signals.motion[run], np.abs(signals.voltage[run])
        row = _find_catching_up(motion, volts)
        if row == 0:
            continue
        keep[run.start : run.start + row] = False
        way = abs(motion[row] - motion[row - 1])
        said.append(
            f"Left out: the first {row} rows, in which {form.motion} stands, behind which it goes {way:.4g} at once, "
            f"over {FURTHER:.0f} times as far as in any other row: it was not read yet (assumed)."
        )
    return signals.only(keep), said


def _find_catching_up(motion: Floats, volts: Floats) -> int:
    """The row in which positions, shape (K,), catch up, by not more than the motor can have gone; 0 where none does."""
    steps = np.abs(np.diff(motion))
    first = int(np.argmax(steps > 0.0))  # the step from this row to the next
    driven, later = int(np.count_nonzero(volts[: first + 1])), steps[first + 1 :]
    if driven < FEWEST_DRIVEN or np.count_nonzero(later) < FEWEST_ROWS:
        return 0
    longest = float(np.max(later))
    return first + 1 if FURTHER * longest < steps[first] <= (driven + 1) * longest else 0
