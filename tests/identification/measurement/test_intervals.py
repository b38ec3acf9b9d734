"""Counts sampled without stamps: where the disc was, to within how much, and what a fit makes of it."""

from dataclasses import replace
from math import sqrt, tau

import numpy as np
import pytest
from plant import Truth, profiles, record
from recorded import as_counts

from motor_identification.identify import Request, SearchConfig, identify
from motor_identification.measurement.build_intervals import make_intervals
from motor_identification.measurement.intervals import index_intervals
from motor_identification.measurement.sampled_counts import (
    UNIFORM_SIGMA,
    Fixes,
    estimate_stamp_jitter,
    extract_count_changes,
    locate_fixes,
)
from motor_identification.recording import Floats, Recording, check
from motor_model.parameters import PAPER_KA, PAPER_KV

BASE = {"kv": PAPER_KV, "ka": PAPER_KA}
RUBBING = BASE | {"ks": 0.5}
SLOT = tau / 96


def counted(values: dict[str, float], drive: profiles.Profile, **how: float) -> tuple[Recording, Truth]:
    recording, truth = record(values, *drive, **({"single_channel": False} | how))  # type: ignore[arg-type]
    return check(as_counts(recording)), truth


def fixed(recording: Recording) -> Fixes:
    return locate_fixes(recording, extract_count_changes(recording))


def errors(fixes: Fixes, truth: Truth) -> Floats:
    """[slots] true minus fixed place, with the mean of every run taken out: a run's zero is not known."""
    angle = np.interp(fixes.time, truth.motion.time, truth.motion.angle) / SLOT
    error = fixes.way * angle - fixes.place
    for run in np.unique(fixes.run):
        error[fixes.run == run] -= np.mean(error[fixes.run == run])
    return np.asarray(error)


def test_intervals_are_told_in_the_order_in_which_they_begin() -> None:
    """However they are listed; of those that begin at once the first of the list is first."""
    start = np.array([0.4, 0.0, 0.2, 0.0])
    data = index_intervals(start, start + 0.2, np.arange(4.0), np.full(4, 0.01))
    assert data.order.tolist() == [1, 3, 2, 0] and data.speed[data.order].tolist() == [1.0, 3.0, 2.0, 0.0]


def test_at_constant_speed_a_slow_disc_is_known_better_than_a_slot() -> None:
    """The blur is the travel of one sample or a slot, whichever is less, over √12; and that is how errors scatter."""
    for speed, blur in ((2.0, 0.153), (5.0, 0.382), (10.0, 0.764), (40.0, 1.0), (77.7, 1.0)):
        volts = speed * PAPER_KV
        typical, scatter = [], []
        for seed in range(6):
            recording, truth = counted(BASE, profiles.step(volts, 3.0), seed=seed, start_speed=speed)
            fixes = fixed(recording)
            inner = slice(1, -1)  # the first and the last sample are fixes of half a slot
            typical.append(np.median(fixes.blur[inner]) / UNIFORM_SIGMA)
            scatter.append(np.sqrt(np.mean(errors(fixes, truth)[inner] ** 2)) / UNIFORM_SIGMA)
        assert np.median(typical) == pytest.approx(blur, rel=0.08)
        assert 0.75 < np.mean(scatter) / blur < 1.15


@pytest.mark.parametrize(
    ("uneven", "known", "tells"), [(0.0, False, True), (0.3, False, False), (0.3, True, True), (0.3, None, False)]
)
def test_a_disc_shows_where_the_lengths_of_rows_are_known(uneven: float, known: bool | None, tells: bool) -> None:
    """Speeds of counts that are whole by their own row's length were of an eccentric disc, and "not in the table"."""
    rows = 0.02 * (1.0 + uneven * np.random.default_rng(1).uniform(-1.0, 1.0, 200))
    end = np.cumsum(rows)
    length = rows if known else np.full(200, 0.02)
    some = index_intervals(end - length, end, np.ones(200), np.zeros(200), window=0.02, independent=known is None)
    assert some.tells_of_disc is tells


@pytest.mark.parametrize("volts", [1.5, 3.0, 12.0])
def test_the_blur_is_true_through_starts_stops_and_reversals(volts: float) -> None:
    score, left = [], []
    for seed in range(6):
        recording, truth = counted(RUBBING, profiles.random(volts, 4.0, seed=seed), seed=seed)
        fixes = fixed(recording)
        score.append(errors(fixes, truth) / fixes.blur)
        gaining = np.gradient(np.interp(fixes.time, truth.motion.time, truth.motion.speed), fixes.time) * fixes.way
        left.append(errors(fixes, truth)[gaining > 100.0])
    together = np.concatenate(score)
    assert 0.8 < np.sqrt(np.mean(together**2)) < 1.1 and len(together) > 800
    starting = np.concatenate(left)
    assert len(starting) > 10 and abs(np.mean(starting)) < 0.08  # half a slot less a sample's travel, if naively read


def test_runs_break_where_the_disc_turns_and_a_stand_in_between_is_evidence() -> None:
    drive = profiles.pieces([4.0, 0.0, -4.0, 0.0], [0.4, 0.5, 0.4, 0.5])
    recording, truth = counted(RUBBING, drive, seed=1)
    intervals = make_intervals(recording)
    still = np.flatnonzero(intervals.slack)
    assert len(still) == 1 and intervals.slack[still[0]] == SLOT
    start, end = intervals.time[intervals.first[still[0]]], intervals.time[intervals.last[still[0]]]
    assert 0.4 < start < 0.7 and 0.9 <= end < 0.95  # from the stop to the new start
    moving = intervals.slack == 0.0
    middle = 0.5 * (intervals.time[intervals.first] + intervals.time[intervals.last])[moving]
    assert np.all(intervals.speed[moving][middle < 0.8] > 0.0) and np.all(intervals.speed[moving][middle > 0.9] < 0.0)
    assert intervals.time[intervals.first[moving][0]] == 0.0  # it stood in the middle of a slot, as far as is known
    assert intervals.time[-1] == recording.duration
    assert intervals.blur[moving][0] == pytest.approx(SLOT / sqrt(12.0), rel=1e-6)


def test_standing_between_two_edges_of_different_directions_is_evidence_with_stamps_too() -> None:
    drive = profiles.pieces([4.0, 0.0, -4.0, 0.0], [0.4, 0.5, 0.4, 0.5])
    recording, truth = record(RUBBING, *drive, seed=1, single_channel=False)
    intervals = make_intervals(recording)
    still = np.flatnonzero(intervals.slack)
    begin, end = intervals.time[intervals.first[still]], intervals.time[intervals.last[still]]
    assert len(still) == 2 and np.all(end - begin > 0.1) and end[1] == recording.duration
    moved = np.interp(end, truth.motion.time, truth.motion.angle) - np.interp(
        begin, truth.motion.time, truth.motion.angle
    )
    assert np.all(np.abs(moved) < SLOT)


def jittering(recording: Recording, truth: Truth, sigma: float, seed: int) -> Recording:
    """Counts read at uneven instants and stamped `sigma` [s] beside them, but where the voltage changes."""
    random = np.random.default_rng(seed)
    exact = np.diff(recording.voltage, prepend=np.nan) != 0.0
    read = recording.time + np.where(exact, 0.0, random.uniform(0.0, 0.002, len(recording)))
    stamp = read + np.where(exact, 0.0, np.clip(random.normal(0.0, sigma, len(recording)), -0.0018, 0.0028))
    passed = np.concatenate([[0], np.cumsum(truth.edge_direction)])
    count = passed[np.searchsorted(truth.edge_time, read, side="right")]
    nanoseconds = recording.sample_time[0] + np.round(stamp * 1e9).astype(np.int64)
    return replace(recording, sample_time=nanoseconds, edge_count=count)


@pytest.mark.parametrize("sigma", [0.0, 3e-4, 8e-4])
def test_jittering_stamps_are_noticed_and_measured(sigma: float) -> None:
    found = []
    for seed in range(8):
        recording, truth = counted(RUBBING, profiles.pieces([4.0, 7.3, 11.1], 0.4), seed=seed)
        fixes = fixed(jittering(recording, truth, sigma, seed))
        found.append(estimate_stamp_jitter(replace(fixes, blur=np.full(len(fixes), UNIFORM_SIGMA))))
    assert np.median(found) == pytest.approx(sigma, rel=0.15, abs=1e-9)


def random_steps(seed: int, low: float, high: float, count: int, seconds: float) -> profiles.Profile:
    return profiles.pieces(np.random.default_rng(seed).uniform(low, high, count), seconds)


def starts_and_stops(seed: int) -> profiles.Profile:
    return profiles.pieces(np.random.default_rng(seed).uniform(0.9, 2.5, 6) * [1, 0, 1, 0, 1, 0], 0.3)


LATE = ("coulomb_friction", "transport_delay")
HONEST = {
    "fast, both ways, one channel": (lambda seed: random_steps(seed, -12.0, 12.0, 8, 0.3), {"single_channel": True}),
    "slow starts and stops": (starts_and_stops, {}),
    "a coarse disc": (lambda seed: random_steps(seed, -12.0, 12.0, 8, 0.3), {"edges": 16}),
}


@pytest.mark.slow
@pytest.mark.parametrize("case", HONEST)
def test_counts_alone_find_the_motor_without_bias_and_with_true_standard_errors(case: str) -> None:
    drive, how = HONEST[case]
    truth = RUBBING | {"delay": 0.0113}
    scores = []
    for seed in range(30):
        recording, _ = counted(truth, drive(seed), seed=seed, **how)
        fit = identify([recording], Request(LATE, SearchConfig(particles=30, epochs=40, seed=seed)))
        scores.append([(v - truth[name]) / fit.standard_errors[name] for name, v in fit.parameters.values.items()])
    assert np.all(np.isfinite(scores))
    spread, bias = np.std(scores, axis=0), np.mean(scores, axis=0) / np.std(scores, axis=0)
    assert np.all(spread > 0.6) and np.all(spread < 1.4), spread  # 30 recordings tell a spread to 13 %
    assert np.all(np.abs(bias) < 0.5), bias


def test_counts_are_used_to_the_bound_of_what_they_say() -> None:
    """Errors of kv and ka over 10 recordings, beside a fifth of a per mille and half a per mille. Read as counts of
    equal worth, with reversals inside intervals, they were 4 and 5 times as large."""
    off = []
    for seed in range(10):
        recording, _ = counted(RUBBING, profiles.random(12.0, 4.0, seed=seed), seed=seed)
        fit = identify([recording], Request(("coulomb_friction",), SearchConfig(particles=30, epochs=40)))
        off.append([fit.parameters.values[name] / BASE[name] - 1.0 for name in ("kv", "ka")])
    rms = np.sqrt(np.mean(np.square(off), axis=0))
    assert 2e-5 < rms[0] < 2e-4 and 5e-5 < rms[1] < 5e-4


@pytest.mark.parametrize(
    ("slow", "turns", "follows"),
    [(0.15, 0.9, True), (0.15, 1.1, False), (0.05, 0.9, False), (1.0, 0.1, True), (1.0, 0.0, False)],
)
def test_a_log_follows_the_turns_where_some_of_its_values_are_less_than_one_apart(
    slow: float, turns: float, follows: bool
) -> None:
    """A real log has rows 20 s apart, of up to 400 turns each: nothing that goes round once a turn shows in it."""
    count = 200
    start = 20.0 * np.arange(count)
    speed = tau / 20.0 * np.where(np.arange(count) < slow * count, turns, 400.0)
    data = index_intervals(start, start + 1.0, speed, np.full(count, 0.01))
    assert data.follows_turns is follows
    assert index_intervals(start, start + 1.0, speed / 3.0, np.full(count, 0.01), gear=3.0).follows_turns is follows
