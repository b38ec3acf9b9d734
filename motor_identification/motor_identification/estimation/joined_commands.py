"""Join the commands of a long recording's rows: a simulation takes a step for every command that is another one.

A speed loop, or a supply that is measured, has another command in every row, however little it differs. Where rows are
joined because they are far quicker than the motion (`thinning.py`), the mean of their commands moves the motor alike.
"""

import numpy as np

from motor_identification.recording import Bools, Floats, Recording, once
from motor_model.compiled import compiled

# Of the largest voltage for one row: what a mean command lacks or has too much within its rows, at most. That is a
# hundredth of what a motor may gain in a row, of which its time constant has twenty and more. Measured, of a loop that
# answers the noise of its speeds at 1 kHz: mean speeds over the joined rows differ by 2e-6 of the top speed (RMS).
MOST_LACKING = 0.01

Commands = tuple[Floats, Floats]  # times [s] and voltages [V] from then on


def join_commands(recording: Recording, rows: int) -> Commands:
    """Join the commands of up to so many rows to their mean, where that moves a motor as they do; equal ones always."""
    known = _keep_joined(recording)
    if rows not in known:
        most = MOST_LACKING * float(np.abs(recording.voltage).max()) * recording.sample_period
        begins, volts = np.zeros(len(recording), dtype=np.bool_), np.empty(len(recording))
        _join(recording.time, recording.voltage, rows, most, begins, volts)
        known[rows] = recording.time[begins], volts[begins]
    return known[rows]


@once
def _keep_joined(recording: Recording) -> dict[int, Commands]:
    """What was joined of a recording, by the number of rows."""
    return {}


@compiled
def _join(time: Floats, voltage: Floats, rows: int, most: float, begins: Bools, volts: Floats) -> None:
    """Mark the rows (K,) that a joined command begins with, and fill its voltage there; most: [V·s] it may lack."""
    count, k = len(time), 0
    while k < count:
        end, mean = k + 1, voltage[k]
        while end < count and voltage[end] == mean:
            end += 1
        if end == k + 1:  # another one in the next row already
            for stop in range(k + 2, min(k + rows, count - 1) + 1):
                level = _average(time, voltage, k, stop)
                if _measure_lack(time, voltage, k, stop, level) > most:
                    break
                end, mean = stop, level
        begins[k], volts[k] = True, mean
        k = end


@compiled
def _average(time: Floats, voltage: Floats, start: int, stop: int) -> float:
    """Average [V] what rows from one to before another hold."""
    whole = 0.0
    for i in range(start, stop):
        whole += voltage[i] * (time[i + 1] - time[i])
    return float(whole / (time[stop] - time[start]))


@compiled
def _measure_lack(time: Floats, voltage: Floats, start: int, stop: int, level: float) -> float:
    """Measure the most [V·s] by which the sum of those rows' voltages is off that of their mean on the way."""
    off = most = 0.0
    for i in range(start, stop):
        off += (voltage[i] - level) * (time[i + 1] - time[i])
        most = max(most, abs(off))
    return most
