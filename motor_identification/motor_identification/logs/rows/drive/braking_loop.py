"""Recognise a loop that holds a shaft: its voltage brakes whatever moves the shaft, and drives nothing.

Its voltage goes against the motion all the time, as where two wires are exchanged. But it answers each change of the
speed, in the row or soon after, and rows of speed and voltage say that it does not drive the next ones.
"""

import numpy as np

from motor_identification.logs.signals import Floats, Signals

ROWS = 3  # before each, that are looked at: a controller answers within them, and they say how a speed goes on
# Measured, rows of 5 ms with 48 to 20,000 counts a turn: loops under random torques whose voltage is against the
# motion are found in 31 of 43 logs, and none in 454 of sines, steps, ramps and random levels with exchanged wires.
ROUGH = 0.05  # of the square of a voltage's changes, that those before do not foretell: those of a sine do
ANSWERED = 0.5  # of what they leave, that the speed's changes explain
FORETOLD = 0.1  # of a speed's square, that the rows before tell: else each may be that of its own voltage
DRIVES = -0.5  # how far a steady voltage drives a motor, in their RMS: exchanged wires have -1.1 and less


def brakes(signals: Signals) -> bool:
    """Decide whether voltages that go against speeds are a loop's that holds the shaft, in the signs as they are."""
    runs = [(signals.voltage[run], signals.motion[run]) for run in signals.runs.values()]
    runs = [(volts, speed) for volts, speed in runs if len(speed) > ROWS + 1]
    return bool(runs) and _answers(runs) and not _drives(runs)


def _answers(runs: list[tuple[Floats, Floats]]) -> bool:
    """Decide whether a voltage's changes answer those of the speed, against their way."""
    changes = [(np.diff(volts), np.diff(speed)) for volts, speed in runs]
    after = np.concatenate([volts[ROWS:] for volts, _ in changes])
    own = np.concatenate([_rows_before(volts, 1) for volts, _ in changes])
    motion = np.concatenate([_rows_before(speed, 0) for _, speed in changes])
    rough, _ = _fit(own, after)
    rest, gains = _fit(np.hstack([own, motion]), after)
    answered = rest < (1.0 - ANSWERED) * rough and float(np.sum(gains[ROWS:])) < 0.0
    return rough > ROUGH * float(after @ after) and answered


def _drives(runs: list[tuple[Floats, Floats]]) -> bool:
    """Decide whether a voltage drives the speeds that are against it, or rows are too far apart to tell."""
    after = np.concatenate([speed[ROWS:] for _, speed in runs])
    before = np.concatenate([np.hstack([_rows_before(speed, 1), _rows_before(volts, 1)]) for volts, speed in runs])
    rest, gains = _fit(before, after)
    if rest > (1.0 - FORETOLD) * float(after @ after):
        return True
    volts, speed = (float(np.sqrt(np.mean(np.concatenate(one) ** 2))) for one in zip(*runs, strict=True))
    fades = 1.0 - float(np.sum(gains[:ROWS]))
    return fades == 0.0 or float(np.sum(gains[ROWS:])) / fades * volts <= DRIVES * speed


def _rows_before(values: Floats, first: int) -> Floats:
    """The rows before each but the first few of shape (K,), from so many before it on; shape (K - ROWS, ROWS)."""
    return np.column_stack([values[ROWS - back : len(values) - back] for back in range(first, first + ROWS)])


def _fit(by: Floats, values: Floats) -> tuple[float, Floats]:
    """Fit values, shape (K,), by columns, shape (K, N): the sum of squares that is left, and the gains, shape (N,)."""
    gains = np.asarray(np.linalg.lstsq(by, values, rcond=None)[0], dtype=np.float64)
    rest = values - by @ gains
    return float(rest @ rest), gains
