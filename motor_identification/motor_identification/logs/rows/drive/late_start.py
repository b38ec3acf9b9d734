"""Leave out the beginning of a log in which nothing came of its voltage yet, where later steps are answered at once.

A host that logs from when it asks its board to run, or a relay that closes later: the motor starts though no voltage
changes, which friction does not let it, and much later than after any other step, so that it is no dead time.
"""

import numpy as np

from motor_identification.logs.form import CsvForm
from motor_identification.logs.rows.drive.unpowered_start import ROWS, list_advances
from motor_identification.logs.signals import Floats, Integers, Signals

LATER = 5.0  # times the rows in which the slowest later step is answered
FEWEST_STEPS = 2  # that are answered sooner
ANSWERED, BEYOND = 0.1, 2.0  # of what a step changes in the end, and times what speeds scatter by before it
COUNTS = 20.0  # that a motor gave in as many rows, once it ran


def drop_late_start(signals: Signals, form: CsvForm) -> tuple[Signals, list[str]]:
    """Leave out the first rows of runs in which a motor stands at one voltage, and is later than after any other step.

    Args:
        signals: rows (K,) of a log, in runs.
        form: how they are read.
    """
    keep, said = np.ones(len(signals), np.bool_), []
    for run in signals.runs.values():
        volts, motion = signals.voltage[run], signals.motion[run]
        speed = list_advances(motion, form.kind)
        still = int(np.argmax(speed != 0.0))
        steps = np.flatnonzero(np.diff(volts)) + 1
        if still < ROWS or volts[0] == 0.0 or (len(steps) and steps[0] <= still + ROWS) or len(steps) < FEWEST_STEPS:
            continue
        ran = np.abs(speed[still : steps[0]])
        if float(np.mean(ran)) * still < COUNTS * float(np.min(ran[ran > 0.0])):
            continue
        answers = _count_rows_to_answers(speed, steps)
        if len(answers) < FEWEST_STEPS or still < LATER * np.max(answers):
            continue
        keep[run.start : run.start + still - 1] = False
        said.append(
            f"Left out: the first {still - 1} rows, in which {form.motion} stands at {volts[0]:.3g} V and behind which "
            f"it starts though no voltage changes, later steps being answered within {int(np.max(answers))} rows: the "
            "motor was not powered yet, or not read (assumed)."
        )
    return signals.only(keep), said


def _count_rows_to_answers(speed: Floats, steps: Integers) -> Integers:
    """Count the rows until speeds (K,) answer each step of the voltage, shape (A,); without those that last too short.

    A speed that does not change in the end by much more than it scatters before a step answers nothing.
    """
    found = []
    ends = np.append(steps[1:], len(speed))
    for step, end in zip(steps, ends, strict=True):
        before, behind = speed[max(step - ROWS, 0) : step], speed[step:end]
        if len(behind) < 2 * ROWS or len(before) < ROWS:
            continue
        change = float(np.median(behind[len(behind) // 2 :]) - np.median(before))
        scatter = float(np.ptp(before))
        if abs(change) <= BEYOND * scatter:
            continue
        away = np.abs(behind - np.median(before)) > max(ANSWERED * abs(change), scatter)
        found.append(int(np.argmax(away)) + 1)
    return np.array(found, dtype=np.int64)
