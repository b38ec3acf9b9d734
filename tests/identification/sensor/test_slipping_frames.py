"""Held values whose clock slips against that of the log."""

import numpy as np
import pytest

from motor_identification.recording import Floats
from motor_identification.sensor.held_samples import find_frames
from motor_identification.sensor.slipping_frames import find_slipping_frames, mark_late_frames

ROW, FRAME = 0.005, 0.02


def angle(time: Floats) -> Floats:
    """[rad] of a flywheel that speeds up, after it has stood for a second."""
    run = np.maximum(time - 1.0, 0.0)
    return 40.0 * (run - 0.8 * (1.0 - np.exp(-run / 0.8)))


def slipping(count: float, late: int = 0) -> tuple[Floats, Floats]:
    """Times [s] and counts of `count` rad, in frames that slip by a row every half second and may come late."""
    time = np.arange(0.0, 8.0, ROW)
    made = FRAME * np.arange(400) + ROW * np.floor(np.arange(400) / 25.0) * 0.7
    seen = made + 0.2 * ROW
    for k in range(200, 200 + 20 * late, 20):
        seen[k : k + 2] += FRAME * 1.8, 0.0  # the frame is seen together with the next one's time, nearly
    frame = np.array([np.max(np.flatnonzero(seen <= t + 1e-9), initial=0) for t in time])
    return time, np.floor(angle(made)[frame] / count)


@pytest.mark.parametrize("count", [0.0005, 0.005])
def test_frames_without_an_even_grid(count: float) -> None:
    time, counts = slipping(count)
    frames = find_frames(time, counts)
    assert frames is not None and frames.period == pytest.approx(FRAME, rel=0.05)
    rate = np.diff(counts[frames.row]) / np.diff(frames.time) * count
    true = np.diff(angle(frames.time)) / np.diff(frames.time)
    moving = true > 4.0
    assert np.count_nonzero(moving) > 250 and np.quantile(np.abs(rate / true - 1.0)[moving], 0.9) < 0.08
    assert frames.time[0] < 0.03 and np.all(np.diff(frames.time) > 0.0)  # a standing motor has frames, too


@pytest.mark.parametrize("guess", [4, 5])
def test_a_guess_that_is_a_row_short_finds_the_same_frames(guess: int) -> None:
    """Frames of 5 rows that jitter by one now and then: of 0.2 ms rows a period of 0.983 ms was made, for 1.01 ms."""
    rows = np.tile([5] * 8 + [4, 6] + [5] * 8 + [6, 4], 40)
    changed = np.cumsum(rows)
    time = ROW * np.arange(changed[-1] + 5)
    values = np.repeat(angle(ROW * np.append(0, changed)), np.append(changed[0], np.append(rows[1:], 5)))
    frames = find_slipping_frames(time, values, np.flatnonzero(np.diff(values)) + 1, guess * ROW)
    assert frames is not None and frames[2] == pytest.approx(5.0 * ROW, rel=1e-3)


def test_one_count_at_a_time_is_not_held() -> None:
    """A coarse encoder on a motor that turns evenly repeats its count as regularly, and slips as well."""
    time = np.arange(0.0, 8.0, ROW)
    turned = time + 0.03 * np.sin(time)
    assert find_frames(time, np.floor(turned / 0.0203)) is None
    assert find_frames(time, 3.0 * np.floor(turned / 0.0203)) is None


def test_the_sum_of_the_latest_rows_is_not_held() -> None:
    """Counts of the latest 32 rows, rounded to whole ones a second: levels 31 or 32 apart, at irregular rows."""
    time = np.arange(0.0, 1.5, 0.001)
    counts = np.floor(angle(time + 1.0) * 20.0)
    latest = counts - np.concatenate([np.zeros(32), counts[:-32]])
    assert find_frames(time, np.floor(latest * 31.25) * 1.24) is None


@pytest.mark.parametrize(("levels", "held"), [(11, False), (12, True)])
def test_a_few_levels_are_counts(levels: int, held: bool) -> None:
    step = 40.0 + np.concatenate([np.arange(levels), np.arange(200) % levels])
    row = np.cumsum(4 + (np.arange(len(step)) % 7 == 0) - (np.arange(len(step)) % 7 == 3))
    time = np.arange(row[-1] + 4) * ROW
    values = np.cumsum(np.bincount(row, step, len(time)))
    assert (find_slipping_frames(time, values, row, 4 * ROW) is not None) == held
    assert find_slipping_frames(time * 3.0, values, row, 3.4 * ROW * 3.0) is None  # frames too short to tell


@pytest.mark.parametrize(
    ("short", "long", "late"),
    [
        (0.4, 1.6, True),
        (0.69, 1.41, True),
        (0.71, 1.29, False),
        (0.4, 2.1, False),
        (0.4, 1.0, False),
        (-0.2, 2.2, False),
    ],
)
def test_a_late_frame_is_made_up_for_by_the_next(short: float, long: float, late: bool) -> None:
    step = np.ones(20)
    step[9:11] = short, long
    for sign in (1.0, -1.0):
        marked = mark_late_frames(np.arange(21.0), sign * np.concatenate([[0.0], np.cumsum(step)]))
        assert list(np.flatnonzero(marked)) == ([10] if late else [])
