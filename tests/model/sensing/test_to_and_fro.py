"""Edges that lead nowhere: within one slot of each other, for so long."""

from dataclasses import replace

import pytest

from motor_model.sample import Sample
from motor_model.sensing.motion_check import MotionCheck
from motor_model.sensing.to_and_fro import MANY, ToAndFro

STEP = 5_000_000  # [ns]
TWO = MotionCheck(12.0, single_channel=False)


def samples(counts: list[int], voltage: float = 7.2, every: int = 1) -> list[Sample]:
    """One count a sample, with a new edge in one of so many."""
    return [
        Sample(k * STEP, 0.0, voltage, count, k // every * every * STEP, 0.0)
        for k, count in enumerate(counts, start=every)
    ]


def stops(check: MotionCheck, seen: list[Sample]) -> float:
    """When [s] a plant stops its motor; infinite: never."""
    for sample in seen:
        check = check.see(sample)
        if check.stop:
            assert "edges are counted to and fro at 7.2 V, and lead nowhere: one of the encoder's two" in check.stop
            return (sample.sample_time - seen[0].sample_time) * 1e-9
    return float("inf")


def test_edges_within_a_slot_lead_nowhere_until_the_count_goes_on() -> None:
    seen = ToAndFro()
    for sample in samples([7, 8] * MANY):
        seen = seen.see(sample, anew=seen.edges == 0 and seen.since == 0)
    assert (seen.low, seen.high, seen.edges) == (7, 8, 2 * MANY - 1)
    assert seen.lasts(seen.since + 300_000_000, 0.3) and not seen.lasts(seen.since + 299_000_000, 0.3)
    assert seen.see(replace(sample, edge_count=9)).edges == seen.see(sample, anew=True).edges == 0
    assert replace(seen, edges=MANY - 1).lasts(10**10, 0.3) is False


@pytest.mark.parametrize("counts", [[0, 1] * 200, [0, 0, -1] * 200])
def test_a_plant_stops_a_motor_one_of_whose_channels_is_lost(counts: list[int]) -> None:
    """60 % of the voltage for ever, while it seemed to stand."""
    assert stops(TWO, samples(counts)) == pytest.approx(0.4, abs=0.011)
    assert stops(replace(TWO, stall_time=1.0), samples(counts)) == pytest.approx(1.0, abs=0.011)


def test_a_slow_motor_is_none_nor_what_one_channel_or_a_small_voltage_shows() -> None:
    assert stops(TWO, samples([k // 78 for k in range(1000)], every=78)) == float("inf")  # an edge in 0.39 s
    assert stops(replace(TWO, single_channel=True), samples([0, 1] * 200)) == float("inf")
    assert stops(TWO, samples([0, 1] * 200, voltage=5.9)) == float("inf")
    assert stops(replace(TWO, stall_time=0.0), samples([0, 1] * 200)) == float("inf")
    assert stops(TWO, samples([0, 1, 2, 1] * 200)) == float("inf")
