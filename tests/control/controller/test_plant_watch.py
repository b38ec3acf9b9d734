"""One plant, one that was restarted, two at once: told from the order of samples alone."""

import pytest

from motor_control.controller.plant_watch import PlantWatch, watch_plant
from motor_model.sample import Sample

PERIOD = 5_000_000  # [ns]


def watch(times: list[int], sample_period: float = 0.005, every: float = 0.005) -> list[PlantWatch]:
    state: PlantWatch | None = None
    seen = []
    for k, time in enumerate(times):
        state = watch_plant(state, Sample(time, 0.0, 0.0, k), k * every, sample_period)
        seen.append(state)
    return seen


def test_one_plant_whose_samples_may_be_lost() -> None:
    seen = watch([PERIOD * k for k in range(100) if k % 7])
    assert not any(one.two or one.restarted for one in seen)


def test_a_restart_is_one_step_back() -> None:
    seen = watch([PERIOD * k for k in range(50, 60)] + [PERIOD * k for k in range(20)])
    assert [one.restarted for one in seen].index(True) == 10 and sum(one.restarted for one in seen) == 1
    assert not any(one.two for one in seen)


@pytest.mark.parametrize("offset", [0, 200_000, 2_500_000, 4_900_000, 10**9 + 1_000_000])
def test_two_plants_are_told_within_a_few_samples(offset: int) -> None:
    """Whatever their clocks are apart, equal ones too."""
    times = [time for k in range(20) for time in (PERIOD * k, PERIOD * k + offset)]
    seen = watch(times, every=0.0025)
    assert [one.two for one in seen].index(True) < 6


def test_restarts_apart_are_not_two_plants() -> None:
    seen = watch([PERIOD * k for k in range(150)] * 3)
    assert sum(one.restarted for one in seen) == 2 and not any(one.two for one in seen)


@pytest.mark.parametrize(("told_after", "two"), [(1.9, False), (2.1, True)])
def test_a_plant_that_is_started_again_may_sample_more_often(told_after: float, two: bool) -> None:
    """It says so at about the time of its first samples; who never does is two."""
    state, now = None, 0.0
    seen = []
    for k in range(200):
        state, now = watch_plant(state, Sample(10**10 + PERIOD * k, 0.0, 0.0, k), now, 0.005), now + 0.005
    for k in range(3000):
        period = 0.005 if 0.001 * k < told_after else 0.001
        state, now = watch_plant(state, Sample(1_000_000 * k, 0.0, 0.0, k), now, period), now + 0.001
        seen.append(state)
    assert [one.restarted for one in seen].index(True) == 0 and sum(one.restarted for one in seen) == 1
    assert any(one.two for one in seen) is two


def test_a_board_that_was_reset_counts_anew_while_its_drivers_clock_goes_on() -> None:
    """Of an edge there is none yet, where there had been one: an angle that was asked for is somewhere else."""
    edges = [(0, 0), (0, 0), (7, 12_000_000), (8, 14_000_000), (0, 0), (0, 0), (1, 27_000_000)]
    state: PlantWatch | None = None
    seen = []
    for k, (count, edge_time) in enumerate(edges):
        state = watch_plant(state, Sample(PERIOD * k, 0.0, 0.0, count, edge_time), 0.005 * k, 0.005)
        seen.append(state)
    assert [one.restarted for one in seen] == [False] * 4 + [True, False, False]
    assert not any(one.two for one in seen)


@pytest.mark.parametrize(("apart", "two"), [(0.4, True), (0.6, False)])
def test_a_second_step_out_of_order_within_half_a_second_is_another_plants(apart: float, two: bool) -> None:
    state = None
    for now, time in ((0.0, 100 * PERIOD), (0.005, PERIOD), (0.005 + apart, 0)):
        state = watch_plant(state, Sample(time, 0.0, 0.0, 0), now, 0.005)
    assert state is not None and state.two is two
