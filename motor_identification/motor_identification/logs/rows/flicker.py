"""Counts of a converter flicker: its noise crosses a flank many times, which is no motion."""

import numpy as np

from motor_identification.logs.signals import Integers, Signals

# Of the changes, that take back the one before: from here on noise makes them. An encoder's do so where the motor turns
# round; the counts of a potentiometer on a converter of 10 bits do in three of four.
MOSTLY = 0.5
FEWEST_CHANGES = 20  # that tell


def remove_flicker(signals: Signals, counts: Integers) -> tuple[Integers, list[str]]:
    """Let counts, shape (K,), follow values once these leave the two counts about a flank; and a finding where they do.

    What that costs, one count at a reversal, no reader relies on: an encoder may count the other flank there.
    """
    steps = [counts[run][1:] - counts[run][:-1] for run in signals.runs.values()]
    changes = [step[step != 0] for step in steps]
    taken_back = sum(int(np.count_nonzero(_take_back(change))) for change in changes)
    number = sum(map(len, changes))
    if number < FEWEST_CHANGES or taken_back <= MOSTLY * number:
        return counts, []
    followed = counts.copy()
    for run in signals.runs.values():
        followed[run] = _follow(counts[run])
    said = (
        f"{taken_back} of {number} changes take back the count before, which is a converter's noise and no motion: "
        "counts go on where values leave both."
    )
    return followed, [said]


def _take_back(change: Integers) -> Integers:
    """Which changes, shape (C,), go back by the count that the one before went, shape (C − 1,)."""
    return np.asarray((np.abs(change[1:]) == 1) & (change[1:] * change[:-1] < 0))


def _follow(counts: Integers) -> Integers:
    """The lower of two counts that go with the values, shape (K,)."""
    changed = np.append(0, np.flatnonzero(np.diff(counts)) + 1)
    low, lows = int(counts[0]), []
    for count in counts[changed].tolist():
        low = min(max(low, count - 1), count)
        lows.append(low)
    held = np.diff(np.append(changed, len(counts)))
    return np.repeat(np.asarray(lows, np.int64), held)
