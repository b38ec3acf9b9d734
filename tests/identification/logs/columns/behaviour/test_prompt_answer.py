"""A motion that answers its drive too soon for the unit of its times."""

import numpy as np
import pytest

from motor_identification.logs.columns.behaviour.prompt_answer import (
    HELD,
    SOONEST,
    answers_too_soon,
    count_rows_to_answer,
)


def first_order(drive: np.ndarray, rows: float, noise: float = 0.0) -> np.ndarray:
    speed = np.zeros(len(drive))
    for k in range(1, len(drive)):
        speed[k] = speed[k - 1] + (drive[k - 1] - speed[k - 1]) * -np.expm1(-1.0 / rows)
    return speed + noise * np.random.default_rng(1).standard_normal(len(drive))


STEPS = np.repeat([0.0, 75.0, 0.0, -75.0, 40.0], 60)


@pytest.mark.parametrize("rows", [0.3, 3.0, 8.0])
def test_the_rows_of_an_answer(rows: float) -> None:
    assert count_rows_to_answer(STEPS, first_order(STEPS, rows, 0.3)) == pytest.approx(max(rows, 1.0), abs=1.0)


@pytest.mark.parametrize(("rows", "period", "soon"), [(0.3, 5e-4, True), (0.3, SOONEST, False), (10.0, 5e-4, False)])
def test_no_motor_answers_in_half_a_millisecond(rows: float, period: float, soon: bool) -> None:
    speed = first_order(STEPS, rows, 0.3)
    assert answers_too_soon(STEPS, speed, True, period) is soon
    assert answers_too_soon(STEPS, np.cumsum(speed), False, period) is soon


def test_nothing_is_told_of_what_is_not_held_or_not_seen() -> None:
    """Short levels of fast rows end before a motor is at its speed; counts of 0 and 1 a row are noise."""
    fast = np.repeat(np.resize([0.0, 75.0, -75.0], 30), HELD - 1)
    assert count_rows_to_answer(fast, first_order(fast, 50.0)) is None
    counts = np.floor(np.cumsum(first_order(STEPS, 40.0)) / 200.0)
    assert not answers_too_soon(STEPS, counts, False, 4e-4)
    assert count_rows_to_answer(STEPS, np.zeros(len(STEPS))) is None
    assert count_rows_to_answer(np.arange(300.0), np.arange(300.0)) is None


def test_a_level_that_a_motor_is_slow_to_reach_is_no_prompt_answer() -> None:
    held = np.repeat(np.resize([0.0, 75.0, -75.0], 30), HELD)
    assert not answers_too_soon(held, first_order(held, 50.0), True, 4e-4)
