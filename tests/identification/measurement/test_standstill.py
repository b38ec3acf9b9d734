"""Times without an edge are evidence that the motor hardly moved, if they are long, and if one can be sure of them."""

import numpy as np
import pytest
from handmade import turning

from motor_identification.measurement import standstill
from motor_identification.measurement.edges import Edges, extract_edges
from motor_identification.measurement.sampled_counts import Changes, extract_count_changes
from motor_identification.measurement.standstill import (
    LEAST_STANDSTILL,
    REST_ROWS,
    find_standstills_at_edges,
    find_standstills_at_reversals,
    find_standstills_of_noisy_angles,
)
from motor_identification.recording import Floats
from motor_model.sample import Measurement


def late(begin: float) -> object:
    """A disc that stands until `begin` [s], turns evenly for half a second, and stands again."""

    def slots(time: Floats) -> Floats:
        return 400.0 * np.clip(time - begin, 0.0, 0.5) + 1e-6 * time

    return slots


@pytest.mark.parametrize(("begin", "found"), [(0.08, False), (0.2, True)])
def test_before_the_first_edge(begin: float, found: bool) -> None:
    recording = turning(late(begin), begin + 0.5)  # type: ignore[arg-type]
    edges = extract_edges(recording)
    start, end = find_standstills_at_edges(recording, edges, np.zeros(len(edges.time) - 1, dtype=bool))
    assert (len(start) > 0) is found
    if found:
        assert start[0] == 0.0 and begin - 0.006 < end[0] <= begin + 0.003  # up to the sample before any edge


@pytest.mark.parametrize(("rest", "found"), [(0.09, False), (0.12, True)])
def test_after_the_last_edge(rest: float, found: bool) -> None:
    recording = turning(late(0.0), 0.5 + rest)  # type: ignore[arg-type]
    edges = extract_edges(recording)
    start, end = find_standstills_at_edges(recording, edges, np.zeros(len(edges.time) - 1, dtype=bool))
    assert (len(start) > 0) is found
    if found:
        assert start[-1] == pytest.approx(edges.time[-1]) and end[-1] == pytest.approx(0.5 + rest)


@pytest.mark.parametrize(("skipped", "found"), [(1, True), (2, False)])
def test_at_a_turn_the_next_edge_ends_it_only_if_none_was_missed(skipped: int, found: bool) -> None:
    recording = turning(late(0.0), 0.5)  # type: ignore[arg-type]
    edges = Edges(np.array([0.0, 0.3, 0.5]), np.array([5, 5 + skipped, 6 + skipped]), np.array([1, -1, -1]))
    start, end = find_standstills_at_edges(recording, edges, np.array([True, False]))
    assert ((0.0 in start.tolist()) and (0.3 in end.tolist())) is found


def test_where_no_edge_came_at_all_it_stood_all_the_time() -> None:
    recording = turning(late(0.4), 0.3)  # type: ignore[arg-type]
    nothing = Edges(np.empty(0), np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64))
    start, end = find_standstills_at_edges(recording, nothing, np.empty(0, dtype=bool))
    assert start.tolist() == [0.0] and end.tolist() == pytest.approx([0.3])


@pytest.mark.parametrize(("samples", "found"), [(20, False), (23, True)])
def test_counts_stand_around_a_turn(samples: int, found: bool) -> None:
    """From the last change one way to the sample before the first change back; 100 ms are not enough."""
    recording = turning(late(0.0), 1.0, Measurement.COUNTS)  # type: ignore[arg-type]
    assert standstill.LEAST_STANDSTILL * recording.sample_period == pytest.approx(0.1)
    before = extract_count_changes(recording).sample[10]
    changes = Changes(np.array([before - 3, before, before + samples]), np.array([1, 1, -1]), np.array([0, 0, 1]))
    start, end = find_standstills_at_reversals(recording, changes)
    assert (len(start) == 1) is found
    if found:
        assert (start[0], end[0]) == (recording.time[before], recording.time[before + samples - 1])


def test_noisy_angles_rest_where_they_differ_by_noise_alone() -> None:
    random, time = np.random.default_rng(0), 0.005 * np.arange(3000)
    noise = random.normal(0.0, 0.6, len(time))
    stops = np.interp(time, [5.0, 8.0], [0.0, 150.0])
    start, end = find_standstills_of_noisy_angles(time, stops + noise, 0.6)
    assert start[0] == 0.0 and end[-1] == time[-1] and len(start) == 2
    assert 4.7 < end[0] <= 5.0 and 8.0 <= start[1] < 8.3
    for speed in (1.0, 5.0, 20.0):  # counts a second: 0.2 of the noise in twenty rows, and more
        assert len(find_standstills_of_noisy_angles(time, speed * time + noise, 0.6)[0]) == 0
    swing = np.sin(2.0 * np.pi * np.maximum(time - 5.0, 0.0) / 5.0)  # as slow as a rest, and back where it began
    for size, rests in ((0.0, 1), (2.0, 0), (12.0, 0)):
        quick = 100.0 * np.minimum(time, 5.0) + 0.6 * size * swing
        assert len(find_standstills_of_noisy_angles(time, quick + noise, 0.6)[0]) == rests
    for stays, rests in ((0.5, 0), (2.0, 1)):
        rows = stays * REST_ROWS * LEAST_STANDSTILL * 0.005
        short = 40.0 * (np.minimum(time, 5.0) + np.maximum(time - 5.0 - rows, 0.0))
        assert len(find_standstills_of_noisy_angles(time, short + noise, 0.6)[0]) == rests
    assert len(find_standstills_of_noisy_angles(time[:10], noise[:10], 0.6)[0]) == 0
