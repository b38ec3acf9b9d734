"""A slow sensor in a fast log: its frames are found, and a motor that turns evenly is not taken for one."""

import numpy as np
import pytest

from motor_identification.sensor.held_samples import Frames, count_held_rows, find_frames

Array = np.ndarray


def motion(time: Array) -> Array:
    return 50.0 * np.sin(2.0 * time) + 20.0 * np.sin(9.0 * time + 1.0)


def held(row_period: float, frame: float, step: float = 0.0, jitter: float = 0.0, seed: int = 0) -> tuple[Array, Array]:
    """Rows of a log at which the latest frame is seen; the sensor's clock is its own."""
    random = np.random.default_rng(seed)
    time = np.arange(0.0, 10.0, row_period)
    time = time + jitter * row_period * random.uniform(-0.5, 0.5, len(time))
    made = np.arange(-frame * random.uniform(), 11.0, frame)
    values = motion(made)
    if step:
        values = np.floor(values / step) * step
    return time - time[0], values[np.searchsorted(made, time, side="right") - 1]


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(
    ("row", "frame", "jitter"),
    [(0.005, 0.02, 0.0), (0.005, 0.02, 0.1), (0.011, 0.1, 0.1), (0.005, 0.0123, 0.1), (0.01, 0.02, 0.0)],
)
def test_frames_are_found_with_their_own_times(row: float, frame: float, seed: int, jitter: float) -> None:
    time, values = held(row, frame, jitter=jitter, seed=seed)
    found = find_frames(time, values)
    assert isinstance(found, Frames)
    assert found.period == pytest.approx(frame, rel=2e-3)
    assert len(found.row) == pytest.approx(10.0 / frame, abs=2)
    assert np.diff(found.time) == pytest.approx(frame, rel=2e-3)
    # Seen at the sensor's own times, within half a row: the value is that of the motion then.
    error = values[found.row] - motion(found.time)
    assert np.sqrt(np.mean(error[2:] ** 2)) < 3.0 + 250.0 * 0.6 * row  # [rad/s] by at most 290 rad/s²


def test_a_coarse_value_that_repeats_for_a_while_is_still_one_of_a_frame() -> None:
    time, values = held(0.005, 0.02, step=5.0)
    found = find_frames(time, values)
    assert found is not None and found.period == pytest.approx(0.02, rel=2e-3)


@pytest.mark.parametrize("step", [0.0, 0.5, 5.0, 20.0])
def test_rows_with_values_of_their_own_are_not_held(step: float) -> None:
    time = np.arange(0.0, 10.0, 0.005)
    values = motion(time)
    assert find_frames(time, np.floor(values / step) * step if step else values) is None


def test_a_motor_that_stands_or_turns_evenly_is_not_held() -> None:
    time, random = np.arange(0.0, 10.0, 0.005), np.random.default_rng(0)
    assert find_frames(time, np.zeros(len(time))) is None
    now_and_then = np.cumsum(random.uniform(size=len(time)) < 0.03)
    assert find_frames(time, now_and_then.astype(float)) is None


def test_four_frames_are_too_few() -> None:
    time, values = held(0.005, 0.02)
    assert find_frames(time[:20], values[:20]) is None
    assert find_frames(time[:100], values[:100]) is not None


def buffered(rows: int, noise: float = 4.0) -> Array:
    """Whole values that stay for some rows, but for 40 of them on end that came one a row, after every 200."""
    random = np.random.default_rng(7)
    values = np.rint(3.0 * motion(0.001 * np.arange(9000.0)) + random.normal(0.0, noise, 9000))
    stays = np.where(np.arange(9000) % 240 < 200, rows, 1)
    return np.repeat(values, stays)


@pytest.mark.parametrize("rows", [2, 3, 5])
def test_values_that_are_held_but_for_some_that_came_too_soon(rows: int) -> None:
    values = buffered(rows)
    assert find_frames(0.0005 * np.arange(len(values)), values) is None, "they lie on no even grid"
    assert count_held_rows(values) == rows


def test_values_that_are_not_held_or_never_seen_to_be() -> None:
    assert count_held_rows(buffered(1)) == 0 and count_held_rows(np.zeros(100)) == 0 == count_held_rows(np.ones(1))
    assert count_held_rows(buffered(2)[:300]) == 0, "too few"
    for step in (5.0, 20.0):
        slow = np.floor(motion(np.arange(0.0, 10.0, 0.001)) / step) * step
        assert count_held_rows(slow) == 0, "they stay for as long as they like"
    mostly = np.concatenate((buffered(2), buffered(1), buffered(1), buffered(1)))
    assert count_held_rows(mostly) == 0
