"""A slow sensor in a fast log: its frames are found, and a motor that turns evenly is not taken for one."""

import numpy as np
import pytest

from motor_identification.sensor.held_samples import Frames, find_frames

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
