"""Edges that a board had no time to count: now and then, in a burst, and again and again."""

import pytest

from motor_model.sensing.shed_edges import MOST, ShedEdges

MS = 1_000_000  # [ns]


def stops(period: int, times: list[int], driven: bool = True) -> int | None:
    """How many samples [ns] apart the motor is stopped after, with so many sheddings in each; None: it is not."""
    check = ShedEdges().see(0, 0, driven)
    for count, shed in enumerate(times, start=1):
        check = check.see(count * period, shed, driven)
        if check.stop:
            assert check.stop.startswith("edges came faster than the board can count them")
            return count
    return None


@pytest.mark.parametrize(
    ("period", "each", "samples"), [(MS, 1, 21), (5 * MS, 1, 21), (20 * MS, 4, 6), (100 * MS, 20, 2)]
)
def test_a_motor_that_is_too_fast_is_stopped_within_0_2_seconds(period: int, each: int, samples: int) -> None:
    """With samples as far apart as may be; a board's steps are 5 ms at most."""
    assert stops(period, [each] * 100) == samples
    assert period * samples <= 200 * MS


def test_twenty_times_within_0_2_seconds_are_not_too_many() -> None:
    assert stops(5 * MS, [1] * MOST + [0] * 100) is None
    assert stops(5 * MS, [1, 0] * 200) is None  # 20 of 40, for two seconds
    assert stops(5 * MS, [1, 0] * 20 + [1, 1]) == 42  # 21 of 40
    assert stops(5 * MS, ([1] * MOST + [0] * 40) * 10) is None


@pytest.mark.parametrize("period", [MS, 5 * MS, 100 * MS])
def test_a_burst_in_one_sample_is_one_burst(period: int) -> None:
    assert stops(period, [0, 255, *[0] * 50]) is None


def test_what_comes_without_a_voltage_does_not_count() -> None:
    assert stops(5 * MS, [1] * 100, driven=False) is None
    check = ShedEdges()
    for k in range(30):
        check = check.see(5 * k * MS, 1, driven=True)
    assert check.stop
    check = check.see(150 * MS, 1, driven=False)
    assert not check.stop and not check.see(155 * MS, 1, driven=True).stop
