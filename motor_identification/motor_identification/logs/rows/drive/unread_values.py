"""Leave out single rows in which a position was not read, and 0 was logged in its place: no data is not zero."""

import numpy as np

from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.signals import Bools, Floats, Signals

MOST_ROWS = 3  # zeros at once: of more, a counter may have been reset
FEWEST_STEPS = 50  # between other rows, by which it is known how far the motor goes in one
FAR = 3.0  # times the longest of those steps, from 0: a motor that passes 0 is a step from it


def drop_unread_values(signals: Signals, form: CsvForm) -> tuple[Signals, list[str]]:
    """Leave out rows of positions that are 0 between two that go on from each other, far from 0."""
    if form.kind is Kind.SPEED or form.increments or form.wrap is not None:
        return signals, []
    keep = np.ones(len(signals), np.bool_)
    for run in signals.runs.values():
        keep[run] = ~_find_unread(signals.motion[run])
    number = int(np.count_nonzero(~keep))
    if not number:
        return signals, []
    rows = "1 row" if number == 1 else f"{number} rows"
    why = f"whose {form.motion} is 0 between two that go on from each other: it was not read (assumed)"
    return signals.only(keep), [f"Left out: {rows}, {why}."]


def _find_unread(motion: Floats) -> Bools:
    """Which positions, shape (K,), are no readings."""
    read = np.flatnonzero(motion)
    found = np.zeros(len(motion), np.bool_)
    steps, apart = np.abs(np.diff(motion[read])), np.diff(read)
    beside = steps[apart == 1]
    if len(beside) < FEWEST_STEPS:
        return found
    longest, furthest = float(np.sort(beside)[-2]), float(np.max(np.abs(motion)))  # the longest of all may be a jump
    for k in np.flatnonzero((apart > 1) & (apart <= MOST_ROWS + 1)):
        ends = np.abs(motion[read[k : k + 2]])
        goes_on = steps[k] <= apart[k] * longest
        begins_again = np.max(ends) >= furthest - longest  # at a turn, as an angle that goes to and fro there
        if goes_on and FAR * longest < np.min(ends) and not begins_again:
            found[read[k] + 1 : read[k + 1]] = True
    return found
