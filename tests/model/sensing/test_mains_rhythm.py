"""Hum of the mains has a rhythm that few motors have; a motor's slots and its speed tremble more."""

from math import tau

import numpy as np
import pytest

from motor_model.parameters import paper_motor
from motor_model.sample import Sample
from motor_model.sensing.board import BoardConfig, SimulatedBoard
from motor_model.sensing.mains_rhythm import EDGES, EVEN, Rhythm, follow_rhythm, is_mains


def heard(
    rate: float, seconds: float, tremble: float = 0.0, seed: int = 0, sample_rate: float = 200.0, voltage: float = 6.0
) -> Rhythm:
    """The rhythm of edges at a rate [1/s], which tremble by a share of a period."""
    random = np.random.default_rng(seed)
    edges = (np.arange(int(seconds * rate) + 1) + tremble * random.standard_normal(int(seconds * rate) + 1)) / rate
    rhythm = Rhythm()
    for k in range(round(seconds * sample_rate)):
        now = k / sample_rate
        passed = edges[edges <= now]
        edge = 10**9 + round(passed[-1] * 1e9) if passed.size else 0
        sample = Sample(10**9 + round(now * 1e9), 9.0, voltage, int(passed.size), edge, 1.0 / rate)
        rhythm = follow_rhythm(rhythm, sample)
    return rhythm


def test_the_rates_of_the_mains() -> None:
    assert all(map(is_mains, (49.4, 50.6, 60.8, 99.0, 101.4, 121.0)))
    assert not any(map(is_mains, (0.0, 49.0, 51.0, 55.0, 61.0, 98.0, 118.0, 150.0)))


@pytest.mark.parametrize("sample_rate", [200.0, 1000.0])
@pytest.mark.parametrize("rate", [50.0, 59.8, 100.0, 120.3])
def test_hum_is_told_after_ten_edges(rate: float, sample_rate: float) -> None:
    assert not heard(rate, 10.0 / rate, sample_rate=sample_rate).hums
    assert heard(rate, 13.0 / rate + 0.01, sample_rate=sample_rate).hums


@pytest.mark.parametrize(("tremble", "share"), [(0.001, 1.0), (0.003, 0.75), (0.01, 0.0)])
def test_crossings_that_tremble_and_slots_that_are_irregular(tremble: float, share: float) -> None:
    told = [heard(100.0, 1.0, tremble, seed).hums for seed in range(40)]
    assert sum(told) >= share * len(told) and (share or not any(told))


def test_it_ends_with_another_rate_and_with_silence() -> None:
    rhythm = heard(100.0, 1.0)
    late = Sample(rhythm.sample_time + 25_000_000, 9.0, 6.0, rhythm.count, rhythm.edge_time)
    assert rhythm.hums and not follow_rhythm(rhythm, late).hums
    edge = rhythm.edge_time + 8_000_000
    faster = Sample(edge + 1_000_000, 9.0, 6.0, rhythm.count + 1, edge)
    assert not follow_rhythm(rhythm, faster).hums and follow_rhythm(rhythm, faster).edges == 0


def test_the_time_under_no_voltage_is_counted_while_it_lasts() -> None:
    assert heard(100.0, 1.0, voltage=6.0).at_rest == 0.0
    rhythm = heard(100.0, 1.0, voltage=0.0)
    assert 0.8 < rhythm.at_rest < 0.95
    driven = Sample(rhythm.sample_time + 5_000_000, 9.0, 6.0, rhythm.count, rhythm.edge_time)
    assert follow_rhythm(rhythm, driven).at_rest == rhythm.at_rest
    assert heard(70.0, 1.0, voltage=0.0).at_rest == 0.0


@pytest.mark.parametrize("irregularity", [0.01, 0.03])
def test_a_motor_that_turns_at_that_rate_on_a_usual_disc_is_none(irregularity: float) -> None:
    speed, hums, mains, even = 100.0 * tau / 24, 0, 0, 1.0
    for seed in range(5):
        config = BoardConfig(edges_per_revolution=24, slot_irregularity=irregularity, seed=seed)
        board, rhythm = SimulatedBoard(paper_motor(), config), Rhythm()
        for _ in range(600):
            rhythm = follow_rhythm(rhythm, board.sample(speed * paper_motor().value("kv")))
            hums += rhythm.hums
            if rhythm.edges >= EDGES and is_mains(1.0 / rhythm.period):
                mains, even = mains + 1, min(even, rhythm.scatter**0.5)
    assert hums == 0 and mains > 100 and even > EVEN
