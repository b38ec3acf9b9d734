"""Tell times in too small a unit by a motion that answers its drive sooner than any motor's does."""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

SOONEST = 2e-3  # [s] in which no motor gets to its speed
AT_ONCE = 1.0  # rows: a motor that takes more may be as quick as that
HELD = 20  # rows of a level by which an answer is told
BEFORE = 3  # rows before it, at least
CLEAR = 5.0  # times the noise: an answer
LARGE = 0.2  # of the largest answer: others are of loads, or of friction
ARRIVED = 0.63  # of the way, as after a time constant


def answers_too_soon(drive: Floats, motion: Floats, is_speed: bool, period: float) -> bool:
    """Whether a motion, shape (K,), answers steps of its drive, of the same shape, sooner than any motor could.

    Args:
        drive: in any unit, held at levels.
        motion: in any unit, a speed or a position.
        is_speed: whether it is a speed.
        period: [s] between rows.
    """
    with np.errstate(over="ignore", invalid="ignore"):  # a damaged cell may be any number
        rows = count_rows_to_answer(drive, motion if is_speed else np.diff(motion, prepend=motion[:1]))
    return rows is not None and rows <= AT_ONCE and period < SOONEST


def count_rows_to_answer(drive: Floats, speed: Floats) -> float | None:
    """Count the rows after a step of a drive, shape (K,), until a speed, shape (K,), is there; None where none tells.

    The median of all steps to a level that is held; a speed that goes on changing is not there before its end.
    """
    begins = np.concatenate(([0], np.flatnonzero(np.diff(drive)) + 1, [len(drive)]))
    answers: list[tuple[float, int]] = []  # how far, and after how many rows
    for last, begin, end in zip(begins, begins[1:], begins[2:], strict=False):
        if end - begin < HELD or begin - last < BEFORE:
            continue
        before, settled = speed[max(last, begin - HELD) : begin], speed[(begin + end) // 2 : end]
        start = float(np.median(before))
        way = float(np.median(settled)) - start
        noise = max(float(np.ptp(before[-BEFORE:])), float(np.std(settled)))
        if abs(way) > CLEAR * noise:
            arrived = (speed[begin:end] - start) / way >= ARRIVED
            answers.append((abs(way), int(np.argmax(arrived))))
    most = max((way for way, _ in answers), default=0.0)
    told = [rows for way, rows in answers if way > LARGE * most]
    return float(np.median(told)) if told else None
