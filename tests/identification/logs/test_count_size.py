"""How large one count is."""

import numpy as np
import pytest

from motor_identification.logs.count_size import FINE, LEAST_LEVELS, MOST_EDGES, count_size, position_step
from motor_identification.logs.form import CsvForm, Kind

DEGREES = CsvForm("t", "u", "y", Kind.POSITION, "deg")
MOTION = np.cumsum(np.random.default_rng(2).integers(-3, 9, 400))


@pytest.mark.parametrize("step", [0.9, 1.0, 360 / 2800, 1 / 8192])
def test_the_step_of_positions_with_printed_digits(step: float) -> None:
    assert position_step(np.round(MOTION * step, 7)) == pytest.approx(step, rel=1e-5)
    assert position_step(MOTION[: LEAST_LEVELS - 1] * 1.0) == 0.0


@pytest.mark.parametrize("step", [30.0, 360 / 20])
def test_positions_of_a_fast_shaft_are_never_one_step_apart(step: float) -> None:
    """Of 12 counts a turn, 23 to 28 a row."""
    way = np.random.default_rng(4).integers(23, 29, 400)
    way[:20] = np.arange(20) + 4
    moved = np.cumsum(way) * step
    assert position_step(moved) == pytest.approx(step, rel=1e-9)
    beside = moved + step * np.random.default_rng(5).uniform(-0.2, 0.2, 400)
    assert position_step(beside) == 0.0


def test_positions_without_steps_have_none() -> None:
    smooth = np.cumsum(np.random.default_rng(3).normal(1.0, 0.3, 400))
    assert position_step(smooth) == 0.0
    size, edges, how = count_size(DEGREES, smooth, np.zeros(400))
    assert FINE[0] <= edges <= FINE[1] and size == pytest.approx(360 / edges) and "show no steps" in how


def test_a_step_that_is_a_whole_share_of_a_turn_is_the_count() -> None:
    assert count_size(DEGREES, MOTION * 0.9, np.zeros(400))[:2] == (pytest.approx(0.9), 400)
    size, edges, how = count_size(DEGREES, MOTION * 0.7, np.zeros(400))
    assert "no whole share of a turn" in how and 360 / size == pytest.approx(edges) and 360 <= edges <= 515
    assert edges <= MOST_EDGES
