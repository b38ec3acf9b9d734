"""Take a sign off a motion that is the voltage's: one channel is counted, and the program adds the way that it drives.

After the voltage has changed its sign a motor turns on for a while, and such counts go back at once, as fast as they
came. So none goes against the voltage, not even in the rows in which the motor still turns on, and how far the motor
went either way follows from how it was driven, whichever way: which counts with a sign of their own do not.
"""

from dataclasses import replace

import numpy as np

from motor_identification.logs.rows.drive.one_channel import compare_signs, count_up, find_ways
from motor_identification.logs.signals import Bools, Floats, Signals

AGAINST = 0.01  # of the counts, that may go against the voltage: edges came between the sign and the row
# Rows behind that in which the voltage's sign changed, and how much of their counts may go against it. Measured: all of
# them of a motor that stops within three rows, in a log so long that they are 0.3 % of its counts; none of one channel.
BEHIND = 3
AGAINST_BEHIND = 0.25
FEWEST_TURNS = 3  # changes of the voltage's sign at which the motor turns
MOSTLY = 0.5  # of these changes, at which the counts go back as well: a controller brakes a motor for some rows first
# Of the largest counts of a row, that it turns by there at least: one that has coasted nearly to a stop before it is
# driven the other way goes there at once, whoever gives the sign. Measured: 0.05 of a tachogenerator.
AT_SPEED = 0.1
BETTER = 0.5  # of what counts with a sign of their own leave of a motor that follows its voltage, without it
COMMANDS_SIGN = (
    "Caution: {} goes the way of the voltage's sign, at once and as fast as before: one channel was counted, and has "
    "the sign of the command. It is taken off."
)


def take_off_commands_sign(signals: Signals) -> Signals | None:
    """Take the voltage's sign off counts, or an angle that was counted; None where they have none, or one of their own.

    The result rises only, each run from its first value.
    """
    if not np.min(signals.voltage) < 0.0 < np.max(signals.voltage):
        return None
    steps = count_up(signals)
    ways = [_find_way(signals, late) for late in (0, 1)]
    against = [float(np.sum(np.abs(steps[steps * way < 0.0]))) for way in ways]
    moved = float(np.sum(np.abs(steps)))
    if not moved or min(against) > AGAINST * moved or not np.any(steps < 0.0):
        return None
    way = ways[int(np.argmin(against))]
    slow = AT_SPEED * float(np.max(np.abs(steps)))
    turns = (way[1:] * way[:-1] < 0.0) & (np.abs(steps[1:]) > slow) & (np.abs(steps[:-1]) > slow)
    back = np.count_nonzero(turns & _go_back(steps, slow))
    if back < FEWEST_TURNS or back <= MOSTLY * np.count_nonzero(turns) or _turns_on(steps, way):
        return None
    unsigned = signals.motion.copy()
    for run in signals.runs.values():
        unsigned[run] = signals.motion[run.start] + np.cumsum(np.abs(steps[run]))
    bare = replace(signals, motion=unsigned)
    either_way, signed = compare_signs(bare, steps)
    return bare if either_way < BETTER * signed and find_ways(bare) is not None else None


def _go_back(steps: Floats, slow: float) -> Bools:
    """Tell behind which rows, shape (K - 1,), or a row off, counts (K,) change their sign, and are not slow."""
    back = (steps[1:] * steps[:-1] < 0.0) & (np.abs(steps[1:]) > slow) & (np.abs(steps[:-1]) > slow)
    return np.convolve(back, np.ones(3), mode="same") > 0.0


def _turns_on(steps: Floats, way: Floats) -> bool:
    """Decide whether counts (K,) go on against the voltage's sign (K,) in the rows behind its changes."""
    behind = np.zeros(len(steps), bool)
    for turn in np.flatnonzero(way[1:] * way[:-1] < 0.0) + 1:
        behind[turn + 1 : turn + 1 + BEHIND] = True
    counts = np.abs(steps[behind])
    return float(np.sum(counts[(steps * way)[behind] < 0.0])) > AGAINST_BEHIND * float(np.sum(counts))


def take_off_commands_sign_of_speeds(signals: Signals) -> Signals | None:
    """Take the voltage's sign off speeds; None where they have none, or one of their own."""
    travel = np.zeros(len(signals))
    for run in signals.runs.values():
        travel[run] = np.cumsum(signals.motion[run] * np.diff(signals.time[run], prepend=signals.time[run.start]))
    told = take_off_commands_sign(replace(signals, motion=travel)) is not None
    return replace(signals, motion=np.abs(signals.motion)) if told else None


def _find_way(signals: Signals, late: int) -> Floats:
    """Find the latest sign of the voltage before each row, or up to it, shape (K,)."""
    way = np.zeros(len(signals))
    for run in signals.runs.values():
        sign = np.sign(signals.voltage[run])
        latest = np.maximum.accumulate(np.where(sign != 0.0, np.arange(len(sign)), 0))
        way[run] = sign[latest] if late else np.append(0.0, sign[latest][:-1])
    return way
