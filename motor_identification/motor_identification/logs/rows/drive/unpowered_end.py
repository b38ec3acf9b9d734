"""Leave out the end of a log in which a motor was driven and not powered: a fuse or its driver had switched it off."""

import numpy as np

from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.rows.drive.unpowered_start import (
    HALF,
    MOSTLY,
    ROWS,
    find_standing_voltage,
    mark_motion,
)
from motor_identification.logs.signals import Floats, Signals


def drop_unpowered_end(signals: Signals, form: CsvForm) -> tuple[Signals, list[str]]:
    """Leave out the last rows of runs in which the motor stands at voltages at half of which it ran before."""
    keep, said = np.ones(len(signals), np.bool_), []
    for run in signals.runs.values():
        volts, moves = np.abs(signals.voltage[run]), mark_motion(signals.motion[run], form.kind)
        ran = _count_rows_until_rest(signals.motion[run], form.kind)
        stood = find_standing_voltage(volts[ran:])
        little = (volts[:ran] > 0.0) & (volts[:ran] <= HALF * stood)
        if np.count_nonzero(little) < ROWS or np.mean(moves[:ran][little]) < MOSTLY:
            continue
        keep[run.start + ran + 1 : run.stop] = False
        said.append(
            f"Left out: the last {len(moves) - ran - 1} rows, in which {form.motion} stands at up to {stood:.3g} V and "
            f"before which it ran at {HALF * stood:.3g} V and less: the motor was switched off, or held (assumed)."
        )
    return signals.only(keep), said


def _count_rows_until_rest(motion: Floats, kind: Kind) -> int:
    """How many rows there are until a motor rests for good: its speeds, shape (K,), are 0, or its counts the last."""
    moves = motion != (0.0 if kind is Kind.SPEED else motion[-1])
    return int(np.flatnonzero(moves)[-1]) + 1 if moves.any() else 0
