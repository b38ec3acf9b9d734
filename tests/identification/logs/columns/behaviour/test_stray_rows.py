"""Single rows beyond all others, and the points that they lost."""

import numpy as np
import pytest

from motor_identification.logs.columns.behaviour.stray_rows import find_stray_rows, restore_points


def made(row: float, rows: int = 100, beside: tuple[float, float] = (190.4, 190.12), at: int = 20) -> np.ndarray:
    values = 190.0 + 3.0 * np.sin(np.arange(rows) / 7.0)
    values[at - 1 : at + 2] = beside[0], row, beside[1]
    return values


@pytest.mark.parametrize(
    ("values", "stray"),
    [
        (made(1902.0), True),
        (made(-1902.0), True),
        (made(380.0), False),  # not beyond twice all others
        (made(390.0), True),
        (made(1902.0, rows=49), False),
        (made(1902.0, beside=(190.0, 150.0)), False),  # a step
        (made(1902.0, beside=(0.0, 0.0)), False),  # a pulse
        (np.append(np.full(99, 190.4), 1902.0), False),  # nobody knows what comes
        (np.where(np.arange(100) % 20 == 10, 1902.0, 190.4), False),  # five: no accident
    ],
)
def test_a_row_far_beyond_all_others_and_back_is_stray(values: np.ndarray, stray: bool) -> None:
    assert np.flatnonzero(find_stray_rows(values)).tolist() == ([20] if stray else [])


@pytest.mark.parametrize(
    ("row", "mended"),
    [(1902.0, 190.2), (19012.0, 190.12), (190400.0, 190.4), (1850.0, 185.0), (1500.0, None), (1902.5, None)],
)
def test_a_point_that_was_lost_is_put_back(row: float, mended: float | None) -> None:
    values = made(row)
    restored, which = restore_points(values)
    assert restored[20] == pytest.approx(mended or row) and which.sum() == (mended is not None)
    assert np.array_equal(np.delete(restored, 20), np.delete(values, 20)) and values[20] == row


def test_whole_numbers_have_no_point_to_lose() -> None:
    values = np.full(100, 19.0)
    values[20] = 190.0
    assert not restore_points(values)[1].any() and find_stray_rows(values).sum() == 1


@pytest.mark.parametrize(("kick", "level"), [(12.0, 1.2), (1.0, 0.1), (12.5, 1.25)])
def test_a_kick_that_starts_a_motor_has_lost_no_point(kick: float, level: float) -> None:
    values = np.full(100, level)
    values[20] = kick
    assert not restore_points(values)[1].any() and find_stray_rows(values).sum() == 1
