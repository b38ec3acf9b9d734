"""Edges and intervals that a recording reports, against the truth of the independent plant."""

from dataclasses import replace
from math import sqrt, tau

import numpy as np
import pytest
from numpy.typing import NDArray
from plant import Truth, profiles, record
from recorded import as_counts, as_speed
from tiers import keep_fast

from motor_identification.estimation.residual import compute_residuals
from motor_identification.measurement.build_intervals import make_intervals
from motor_identification.measurement.edges import Edges, extract_edges, open_returns
from motor_identification.measurement.intervals import Intervals
from motor_identification.recording import Floats, Recording
from motor_model.errors import RecordingError
from motor_model.parameters import PAPER_KA, PAPER_KV
from motor_model.sample import Measurement

BASE = {"kv": PAPER_KV, "ka": PAPER_KA}
SLOT = tau / 96
TICK = 4e-6

MOTORS = {
    "base": BASE,
    "friction": BASE | {"ks": 0.5},
    "friction and delay": BASE | {"ks": 0.5, "delay": 0.02},
    "static friction": BASE | {"ks": 0.4, "breakaway_voltage": 0.9, "stribeck_speed": 5.0},
    "inductance": BASE | {"electrical_time_constant": 0.01},
}
DRIVES = {
    "reversals": profiles.reversals(8.0, 8, 0.4),
    "random": profiles.random(12.0, 5.0),
    "ramps": profiles.ramps(12.0, 1.0),
    "coast": profiles.coast(12.0, 2, 0.5),
    "staircase": profiles.staircase(12.0, 4, 0.2),
}


def true_number(edges: Edges, truth: Truth) -> NDArray[np.int64]:
    """Which of the plant's edges each reported one is, shape (E,)."""
    later = np.clip(np.searchsorted(truth.edge_time, edges.time), 1, len(truth.edge_time) - 1)
    earlier = edges.time - truth.edge_time[later - 1] < truth.edge_time[later] - edges.time
    return np.asarray(later - earlier)


@pytest.mark.parametrize("drive", keep_fast(DRIVES, "reversals", "random"))
@pytest.mark.parametrize("motor", MOTORS)
def test_no_interval_that_is_kept_has_a_wrong_direction(motor: str, drive: str) -> None:
    for seed, irregularity in enumerate((0.0, 0.01)):
        recording, truth = record(MOTORS[motor], *DRIVES[drive], seed=seed, disc_seed=seed, irregularity=irregularity)
        edges = extract_edges(recording)
        number = true_number(edges, truth)
        assert np.max(np.abs(truth.edge_time[number] - edges.time)) <= 0.5 * TICK + 2e-9
        assert np.array_equal(edges.count - edges.count[0], number - number[0])
        kept = (edges.direction[1:] == edges.direction[:-1]) & (edges.direction[1:] != 0)
        for k in np.flatnonzero(kept):
            assert np.all(truth.edge_direction[number[k] : number[k + 1] + 1] == edges.direction[k])
        turns = np.count_nonzero(np.diff(truth.edge_direction))
        assert turns >= 1
        assert turns <= np.count_nonzero(~kept) <= 3 * turns  # those around a turn, and no more
        assert np.count_nonzero(kept) > 0.96 * len(kept)


@pytest.mark.parametrize("edges", [2880, 8192])
def test_a_sign_that_changes_by_a_tick_is_moved_to_where_the_motor_turned(edges: int) -> None:
    """At 167 rad/s such edges come every few ticks: the board takes a tick more or less for a turn, at full speed."""
    drive = profiles.reversals(12.0, 8, 0.4)
    recording, truth = record(BASE | {"ks": 0.4, "delay": 0.006}, *drive, edges=edges, seed=1)
    found = extract_edges(recording)
    number = true_number(found, truth)
    sign = np.sign(recording.speed[np.searchsorted(recording.time, found.time)])
    speed, right = truth.edge_speed[number], truth.edge_direction[number]
    assert np.count_nonzero((sign != right) & (np.abs(speed) > 20.0)) > 50
    assert not np.any((found.direction != 0) & (found.direction != right) & (np.abs(speed) > 1.0))
    assert np.count_nonzero(found.direction == 0) <= 3 * np.count_nonzero(np.diff(right))


def test_two_channels_leave_out_only_the_interval_with_the_turn() -> None:
    """And the next one where the edge before was taken back: the next flank is half a slot away then."""
    for seed in range(4):
        recording, truth = record(MOTORS["friction"], *DRIVES["random"], seed=seed, single_channel=False)
        edges = extract_edges(recording)
        number = true_number(edges, truth)
        open_ones = edges.direction == 0
        assert np.array_equal(edges.direction[~open_ones], truth.edge_direction[number][~open_ones])
        turned = np.diff(truth.edge_direction[number], prepend=truth.edge_direction[number][:1]) != 0
        back = turned & (np.abs(np.diff(truth.edge_angle[number], prepend=np.inf)) < 0.1 * SLOT)
        assert np.all(open_ones[back]) and np.all(turned[open_ones]) and np.any(back)
        intervals = make_intervals(recording)
        assert intervals.left_out == np.count_nonzero(turned) + np.count_nonzero(open_ones) >= 4
        moving = intervals.slack == 0.0
        true = angle_at(truth, intervals.time)
        travel = (true[intervals.last] - true[intervals.first])[moving]
        assert np.abs(travel - (intervals.speed * intervals.duration)[moving]).max() < 0.01 * SLOT


@pytest.mark.parametrize(
    ("direction", "period", "quadrature", "known"),
    [
        ([1, 1, 1, 1], [0.0, 2.0, 0.0, 3.0], 1, [1, 1, 0, 1]),  # two forward and one back in a sample, then forward
        ([1, 1, -1, -1, -1], [0.0, 2.0, 0.0, 0.0, 3.0], 1, [1, 1, 0, -1, -1]),  # the flank after it is none
        ([1, 1, -1, 1, 1], [0.0, 2.0, 0.0, 0.0, 3.0], 1, [1, 1, 0, 0, 1]),  # unless it turns back at once
        ([1, 1, 1, 1], [0.0, 2.0, 0.0, 3.0], 4, [1, 1, 1, 1]),
        ([1, 1, -1, -1], [0.0, 0.0, 0.0, 0.0], 1, [1, 1, 0, -1]),  # no period was ever told
    ],
)
def test_an_edge_that_was_taken_back_is_open_whatever_came_before_and_after(
    direction: list[int], period: list[float], quadrature: int, known: list[int]
) -> None:
    assert open_returns(np.array(direction), np.array(period), quadrature).tolist() == known


def test_what_two_channels_see_of_a_motor_that_rocks_is_where_it_turned() -> None:
    """Down, up and down again within two samples: a wrong sign would put the interval off by whole slots."""
    for seed in range(6):
        drive = profiles.random(6.0, 6.0, seed, hold=(0.02, 0.12))
        recording, truth = record(BASE, *drive, seed=seed, single_channel=False, sample_rate=50.0, edges=200)
        intervals = make_intervals(recording)
        moving = intervals.slack == 0.0
        true = angle_at(truth, intervals.time)
        travel = (true[intervals.last] - true[intervals.first])[moving]
        assert np.abs(travel - (intervals.speed * intervals.duration)[moving]).max() < 0.01 * intervals.slot


@pytest.mark.parametrize("milliseconds", [50, 100])
def test_even_a_voltage_that_turns_all_the_time_leaves_most_directions_right(milliseconds: int) -> None:
    """What one channel cannot know, and how much of it: the plant's board follows the sign edge by edge."""
    drive = profiles.random(6.0, 5.0, hold=(0.01, 0.001 * milliseconds))
    recording, truth = record(BASE, *drive, seed=0)
    edges = extract_edges(recording)
    number = true_number(edges, truth)
    kept = (edges.direction[1:] == edges.direction[:-1]) & (edges.direction[1:] != 0)
    wrong = kept & (truth.edge_direction[number[1:]] != edges.direction[1:])
    assert np.count_nonzero(wrong) < 0.03 * np.count_nonzero(kept)
    assert np.count_nonzero(kept) > 0.9 * len(kept)


def angle_at(truth: Truth, time: Floats) -> Floats:
    """[rad] the plant's true angle at times [s]; its nodes are 50 µs apart."""
    return np.asarray(np.interp(time, truth.motion.time, truth.motion.angle))


def scores(recording: Recording, truth: Truth) -> tuple[Intervals, Floats]:
    """The truth's residuals over their sigma, where there is one."""
    intervals = make_intervals(recording)
    residual = compute_residuals(intervals, angle_at(truth, intervals.time))
    known = intervals.sigma > 0.0
    return intervals, residual[known] / intervals.sigma[known]


@pytest.mark.parametrize("drive", keep_fast(DRIVES, "reversals", "random"))
@pytest.mark.parametrize("motor", MOTORS)
def test_the_truth_scores_what_the_timer_leaves(motor: str, drive: str) -> None:
    recording, truth = record(MOTORS[motor], *DRIVES[drive], seed=7)
    intervals, score = scores(recording, truth)
    assert 0.9 < np.sqrt(np.mean(score**2)) < 1.1
    assert np.max(np.abs(score)) < sqrt(6.0) + 0.1  # two stamps, each half a tick off at most
    assert abs(np.mean(score)) < 0.1  # no bias: half a tick is added to a floored stamp
    assert len(score) > 400


@pytest.mark.parametrize(("edges", "least", "most"), [(96, 0.01, 0.3), (1000, 0.01, 0.3), (2880, 0.01, 0.3)])
def test_edges_hardly_further_apart_than_a_tick_are_not_taken_for_a_speed(
    edges: int, least: float, most: float
) -> None:
    """At 167 rad/s, 96 edges are 98 ticks apart, 1,000 are 9, 2,880 are 3: there only the latest in a sample counts."""
    recording, truth = record(BASE | {"ks": 0.4}, *DRIVES["staircase"], edges=edges, seed=1)
    taken = extract_edges(recording)
    assert np.diff(taken.time)[np.diff(taken.count) == 1].min() > 19.0 * TICK
    steps = np.diff(recording.edge_count)
    both = np.count_nonzero(steps) + np.count_nonzero(steps > 1)  # edges with a stamp or a period
    assert (len(taken.time) > 0.95 * both) == (edges == 96)
    assert len(taken.time) >= np.count_nonzero(steps) - 10
    data = make_intervals(recording)
    left = compute_residuals(data, angle_at(truth, data.time))
    assert least < sqrt(float(left**2 @ data.duration / data.duration.sum())) < most


def test_a_coarser_timer_leaves_more() -> None:
    typical = []
    for tick in (1e-6, 2e-5):
        recording, truth = record(BASE, *DRIVES["random"], seed=1, tick=tick)
        intervals, score = scores(recording, truth)
        assert 0.9 < np.sqrt(np.mean(score**2)) < 1.1
        typical.append(float(np.median(intervals.sigma)))
    assert typical[1] / typical[0] == pytest.approx(20.0, rel=0.07)  # less: edges near each other count no more


def test_irregular_slots_score_above_the_timer() -> None:
    recording, truth = record(BASE, *DRIVES["random"], seed=1, irregularity=0.01)
    assert 8.0 < np.sqrt(np.mean(scores(recording, truth)[1] ** 2)) < 14.0


def test_intervals_follow_each_other_and_cover_the_motion() -> None:
    recording, truth = record(BASE, *DRIVES["random"], seed=3)
    intervals = make_intervals(recording)
    moving = intervals.slack == 0.0
    begin, end = intervals.time[intervals.first[moving]], intervals.time[intervals.last[moving]]
    assert np.all(end > begin) and np.all(begin[1:] >= end[:-1])
    assert np.array_equal(intervals.duration[moving], end - begin)
    assert 0.95 < np.sum(end - begin) / recording.duration <= 1.0
    assert intervals.time[0] == 0.0 and np.all(np.diff(intervals.time) > 0.0)


def test_a_standing_motor_is_evidence_before_the_first_edge_and_after_the_last() -> None:
    drive = profiles.pieces([0.0, 8.0, 0.0], [0.5, 0.5, 1.5])
    recording, truth = record(BASE | {"ks": 0.5}, *drive, seed=0)
    intervals = make_intervals(recording)
    still = np.flatnonzero(intervals.slack)
    assert len(still) == 2 and np.all(intervals.slack[still] == SLOT) and np.all(intervals.speed[still] == 0.0)
    assert intervals.time[intervals.first[still[0]]] == 0.0
    assert intervals.time[intervals.last[still[1]]] == recording.duration
    creeping = compute_residuals(intervals, 0.5 * intervals.time)[still]
    assert creeping == pytest.approx(0.5 - SLOT / intervals.duration[still], rel=1e-9)  # all but the slot it may move
    assert compute_residuals(intervals, -0.5 * intervals.time)[still] == pytest.approx(-creeping, rel=1e-9)
    assert np.all(compute_residuals(intervals, 0.9 * SLOT * intervals.time / recording.duration)[still] == 0.0)


def test_sampled_counts_are_known_to_a_slot() -> None:
    recording, truth = record(BASE, *DRIVES["random"], seed=2, single_channel=False)
    counts = as_counts(recording)
    assert counts.info.measurement is Measurement.COUNTS
    intervals, score = scores(counts, truth)
    assert 0.7 < np.sqrt(np.mean(score**2)) < 1.1
    assert np.max(np.abs(score)) < sqrt(6.0) * 1.001
    assert 800 < len(score) <= len(recording)


@pytest.mark.parametrize("window", [1, 4])
def test_speeds_are_means_over_their_window(window: int) -> None:
    recording, truth = record(BASE, *DRIVES["random"], seed=2, single_channel=False)
    speed = as_speed(recording, window)
    intervals, score = scores(speed, truth)
    assert len(score) == len(recording) - window  # windows that began before the recording are left out
    assert np.allclose(intervals.duration, 0.005 * window, rtol=0, atol=1e-9)
    assert 0.8 < np.sqrt(np.mean(score**2)) < 1.1
    late = np.sqrt(np.mean(scores(as_speed(recording, window, lag=0.02), truth)[1] ** 2))
    assert late > 2.0  # a wrong lag is seen


def test_degenerate_reports_leave_no_interval_rather_than_a_wrong_one() -> None:
    recording, truth = record(BASE, *profiles.step(10.0, 0.5), seed=1)
    whole = make_intervals(recording)
    for period in (0.0, np.nan, -1.0):
        fewer = make_intervals(replace(recording, edge_period=np.full(len(recording), period)))
        assert 0 < len(fewer.first) < len(whole.first)  # the edge before the latest is not known then
        assert np.all(np.isfinite(fewer.speed)) and np.max(np.abs(fewer.speed)) < 160.0
    doubled = replace(recording, edge_time=np.repeat(recording.edge_time[::2], 2)[: len(recording)])
    assert np.all(np.isfinite(make_intervals(doubled).speed))
    with pytest.raises(RecordingError, match=r"9\d of 9\d edge_time values lie outside the sample that counted"):
        make_intervals(replace(recording, edge_time=np.zeros(len(recording), dtype=np.int64)))
