"""A controller that answers by a clock of its own, asked by a loop that sees it later and later."""

import numpy as np
import pytest

from motor_identification.recording import Floats
from motor_identification.sensor.held_samples import find_frames
from motor_identification.sensor.own_clock import lay_own_clock

ROW, FRAME = 0.005, 0.02


def angle(time: Floats) -> Floats:
    """[rad] of a flywheel that speeds up, after it has stood for a second."""
    run = np.maximum(time - 1.0, 0.0)
    return 40.0 * (run - 0.8 * (1.0 - np.exp(-run / 0.8)))


def asked(period: float, count: float = 0.0005, seconds: float = 8.0) -> tuple[Floats, Floats, Floats]:
    """Times [s] and counts of a controller that answers every 20 ms, and when each row's answer was made.

    A loop of `period` [s] asks it, so that the answers that it has are older and older, until it misses one.
    """
    time = np.arange(0.0, seconds, ROW)
    read = np.floor(time / period + 1e-9) * period
    made = np.floor(read / FRAME + 1e-9) * FRAME
    return time, np.floor(angle(made) / count), made


def test_a_missed_answer_is_known_by_the_way_of_two() -> None:
    time, counts, made = asked(0.0205)
    frames = find_frames(time, counts, position=True)
    assert frames is not None and frames.period == pytest.approx(FRAME, rel=1e-3)
    moving = frames.time > 1.2
    rate = np.diff(counts[frames.row][moving]) / np.diff(frames.time[moving]) * 0.0005
    true = np.diff(angle(made[frames.row][moving])) / np.diff(made[frames.row][moving])
    assert np.count_nonzero(np.diff(made[frames.row][moving]) > 1.5 * FRAME) >= 5  # missed
    assert np.max(np.abs(rate / true - 1.0)) < 0.02
    by_rows = find_frames(time, counts)
    assert by_rows is not None  # at the rows at which they were seen, a missed answer is a motor twice as fast
    moving = by_rows.time > 1.2
    rate = np.diff(counts[by_rows.row][moving]) / np.diff(by_rows.time[moving]) * 0.0005
    assert np.max(rate) > 1.4 * np.max(true)


def test_frames_of_an_own_clock_are_within_the_record_and_in_order() -> None:
    for begin in range(8):
        time, counts, _ = asked(0.0205)
        frames = find_frames(time[begin:] - time[begin], counts[begin:], position=True)
        assert frames is not None and np.all(np.diff(frames.time) > 0.0) and np.all(np.diff(frames.row) >= 0)
        assert frames.time[0] >= 0.0 and frames.time[-1] <= time[-1] - time[begin]


def test_a_motor_that_stood_for_long_is_counted_by_the_period() -> None:
    time, counts, _ = asked(0.0205, seconds=12.0)
    later = np.append(np.zeros(400), counts)[: len(time)]  # 3 s that the motor stands, but for one count
    later[3] = -1.0
    frames = find_frames(time, later, position=True)
    assert frames is not None and frames.period == pytest.approx(FRAME, rel=2e-3)


@pytest.mark.parametrize("period", [FRAME, 0.0205])
def test_a_motor_that_turns_as_its_rows_say_has_no_other_clock(period: float) -> None:
    """Frames read when the loop asked: whether it asks every 20 ms or later, ways go with the rows that show them."""
    time = np.arange(0.0, 8.0, ROW)
    read = np.floor(time / period + 1e-9) * period
    counts = np.floor(angle(read) / 0.0005)
    frames = find_frames(time, counts, position=True)
    assert frames is not None and frames.period == pytest.approx(period, rel=1e-2)


def test_few_ways_tell_no_clock() -> None:
    time, counts, _ = asked(0.0205)
    changed = np.flatnonzero(np.diff(counts)) + 1
    assert lay_own_clock(time, counts, changed, FRAME, time[:0]) is not None
    assert lay_own_clock(time, counts, changed[-14:], FRAME, time[:0]) is None  # 13 ways
