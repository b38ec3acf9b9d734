"""A drive that was sampled in time, and one of steady states."""

import numpy as np
import pytest

from motor_identification.logs.columns.behaviour.swings import MOST_BY_HAND, MOST_SWEEPS, SMOOTH, goes_to_and_fro


@pytest.mark.parametrize(("sweeps", "in_time"), [(MOST_SWEEPS, False), (MOST_SWEEPS + 1, True)])
def test_waves_are_in_time_and_up_and_down_twice_is_not(sweeps: int, in_time: bool) -> None:
    assert goes_to_and_fro(-np.cos(np.pi * sweeps * np.linspace(0.0, 1.0, 101))) == in_time


@pytest.mark.parametrize(("count", "in_time"), [(MOST_BY_HAND, False), (MOST_BY_HAND + 1, True)])
def test_a_few_states_may_come_in_any_order(count: int, in_time: bool) -> None:
    assert goes_to_and_fro(np.random.default_rng(3).uniform(0.0, 12.0, count)) == in_time


@pytest.mark.parametrize(("step", "in_time"), [(0.9 * SMOOTH, True), (1.1 * SMOOTH, False)])
def test_small_steps_are_in_time(step: float, in_time: bool) -> None:
    place = np.arange(150) * step
    assert goes_to_and_fro(np.abs(place % 2.0 - 1.0)) == in_time


def test_one_value_goes_nowhere() -> None:
    assert not goes_to_and_fro(np.full(400, 3.0)) and not goes_to_and_fro(np.array([0.0, np.inf] * 200))
