"""A speed that is not the one of the plant's own edges."""

from dataclasses import replace
from math import inf

import pytest
from fault_bench import LIMIT, SLOT

from motor_control.controller.faults import contradiction
from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.motion import Motion
from motor_model.sample import Sample

ENCODER = Config(slot=SLOT)


def told(reported: float, counted: float, config: Config = ENCODER, jump: int = 0) -> tuple[float, str]:
    """When [s] a reported speed and one by edges [rad/s] contradict each other, and what is said; jump: of a count."""
    state, rest, silent = contradiction.begin(reported), 0.0, 0.0
    for k in range(400):
        rest += abs(counted) / SLOT * 0.005
        edges, rest = int(rest) + (jump if k == 100 else 0), rest - int(rest)
        sample = Sample(k * 5_000_000, reported, 6.0)
        silent = 0.0 if edges else silent + 0.005
        look = Seen(sample, reported, Motion(edges=edges, silent=silent), 50.0, 0.005, LIMIT)
        reason, state = contradiction.check(config, state, look)
        if reason:
            return k * 0.005, reason
    return inf, ""


@pytest.mark.parametrize(
    ("reported", "counted"),
    [(0.0, 100.0), (-50.0, 170.0), (50.0, 0.0), (8.0, 1.5), (1.0, 0.0), (100.0, 50.0), (50.0, 100.0)],
)
def test_a_speed_that_is_not_the_one_of_the_edges_is_told(reported: float, counted: float) -> None:
    when, reason = told(reported, counted)
    assert 0.3 <= when < 1.0
    assert reason.startswith("The plant says ") and "whether the driver repeats itself" in reason


@pytest.mark.parametrize(
    ("reported", "counted"),
    [(100.0, 65.0), (65.0, -100.0), (24.0, 12.0), (12.0, 24.0), (0.0, 2.5), (0.05, 0.0), (-3.0, 3.0)],
)
def test_bursts_slow_edges_and_a_direction_are_none(reported: float, counted: float) -> None:
    """Below 40 edges a second (2.6 rad/s) nothing is averaged; beyond, a factor of 3, and from 400 on of 1.6."""
    assert told(reported, counted) == (inf, "")


def test_a_slow_speed_without_an_edge_is_told_when_three_should_have_come() -> None:
    when, reason = told(0.2, 0.0)  # an edge every third of a second
    assert 1.2 < when < 1.4 and reason.startswith("The plant says 0.2 rad/s on motor/speed, and its edges ")


def test_a_count_that_jumps_once_is_none() -> None:
    """A board that was reset counts from 0 again."""
    assert told(100.0, 100.0, jump=50_000) == (inf, "")


@pytest.mark.parametrize("config", [Config(), Config(slot=SLOT, stall_time=0.0)])
def test_where_no_edges_are_counted_or_nothing_shall_stop_it_is_none(config: Config) -> None:
    assert told(0.0, 100.0, config) == (inf, "")


def told_by_stamps(age: float, dt: float = 0.005, edges: int = 3, tick: float = 4e-6, kv: float = 0.07) -> int:
    """After how many samples edge times of an age [s] are told; 0: never. Every other sample has no edge."""
    state = contradiction.begin(50.0)
    for k in range(1, 41):
        came = edges if k % 2 else 0
        time = round((10.0 + k * dt) * 1e9)
        sample = Sample(time, 50.0, 6.0, edge_time=round(time - age * 1e9))
        look = Seen(sample, 50.0, Motion(edges=came), 50.0, dt, LIMIT)
        reason, state = contradiction.check(replace(ENCODER, tick=tick, kv=kv), state, look)
        if reason.startswith("The plant's edges do not come when it says: the latest was counted"):
            return k
    return 0


@pytest.mark.parametrize(
    ("age", "after"), [(0.0, 0), (0.01, 0), (0.0101, 9), (-0.005, 0), (-0.0051, 9), (1e9, 9), (-1e9, 9)]
)
def test_edges_that_were_counted_now_and_came_at_another_time_are_told(age: float, after: int) -> None:
    """A clock of another epoch, or one that stands; five samples with edges."""
    assert told_by_stamps(age) == after
    assert told_by_stamps(age, tick=0.0) == told_by_stamps(age, kv=0.0) == 0  # not stamped, or nothing goes by it
    assert told_by_stamps(age, edges=0) == 0
