"""Rows that are far quicker than the motion are joined, and only as many as are more than enough."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from plant import profiles, record
from recorded import as_counts, as_speed

from motor_identification.estimation import thinning
from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.thinning import count_joined, thin_out, thin_problem
from motor_identification.measurement.build_intervals import make_intervals
from motor_identification.recording import Recording, check
from motor_model.parameters import PAPER_KA, PAPER_KV

MOTOR = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.3}  # of 65 ms
STAIRS = profiles.staircase(12.0, 6, 0.5)


@cache
def stamped_edges() -> Recording:
    """At 1,000 samples a second."""
    return record(MOTOR, *STAIRS, sample_rate=1000.0, edges=4096, single_channel=False)[0]


def logged() -> Recording:
    """Speeds of 1,000 rows a second."""
    return check(as_speed(stamped_edges()))


def rows_joined(recording: Recording, enough: int, monkeypatch: pytest.MonkeyPatch) -> int:
    monkeypatch.setattr(thinning, "ENOUGH", enough)
    return count_joined([recording], [make_intervals(recording)])


@pytest.mark.parametrize(("share", "rows"), [(1.01, 1), (0.99, 2), (0.49, 4), (0.24, 8), (0.01, 8)])
def test_as_many_rows_are_joined_as_leave_enough(share: float, rows: int, monkeypatch: pytest.MonkeyPatch) -> None:
    recording = logged()
    count = len(make_intervals(recording).first)
    assert rows_joined(recording, int(share * count), monkeypatch) == rows


def test_a_motion_that_is_as_quick_as_the_rows_stays_as_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    assert rows_joined(logged(), 1000, monkeypatch) > 1
    tremble = logged()
    quick = 30.0 * (-1.0) ** (np.arange(len(tremble)) // 2)
    assert rows_joined(check(replace(tremble, speed=tremble.speed + quick)), 1000, monkeypatch) == 1


def test_the_travel_is_that_of_the_rows(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(thinning, "ENOUGH", 1500)
    recordings = [logged(), logged()]
    intervals = [make_intervals(recording) for recording in recordings]
    joined = thin_out(recordings, intervals)
    for before, after in zip(intervals, joined, strict=True):
        assert len(after.first) < 0.3 * len(before.first)
        assert after.speed @ after.duration == pytest.approx(before.speed @ before.duration, rel=1e-9)
    monkeypatch.setattr(thinning, "ENOUGH", 1_000_000)
    assert thin_out(recordings, intervals) == tuple(intervals)


def test_edges_with_stamps_stay_as_they_are(monkeypatch: pytest.MonkeyPatch) -> None:
    stamped = check(stamped_edges())
    assert rows_joined(stamped, 100, monkeypatch) == 1 < rows_joined(check(as_counts(stamped)), 100, monkeypatch)


@pytest.mark.parametrize("effects", [(), ("coulomb_friction",)])
def test_only_who_asks_for_it_gets_a_thin_problem(monkeypatch: pytest.MonkeyPatch, effects: tuple[str, ...]) -> None:
    monkeypatch.setattr(thinning, "ENOUGH", 1500)
    whole, thinned = make_problem([logged()], effects), thin_problem(make_problem([logged()], effects, workers=2))
    assert len(thinned.intervals[0].first) < 0.6 * len(whole.intervals[0].first)
    assert thinned.unknowns.effects == whole.unknowns.effects == effects
    assert (thinned.workers, whole.workers) == (2, 1)


def test_a_quick_look_joins_thinned_rows_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """Else it would be no quicker: eight rows that were joined are longer than the four that it looks at."""
    monkeypatch.setattr(thinning, "ENOUGH", 500)
    problem = make_problem([logged()], ())
    thinned = thin_problem(problem)
    rows = thinned.intervals[0].rows
    assert rows > 1 and problem.intervals[0].rows == 1
    for one in (problem, thinned):
        assert 0.19 < len(one.coarsen(4.0).weight) / len(one.weight) < 0.3


def test_only_a_thin_problem_joins_commands(monkeypatch: pytest.MonkeyPatch) -> None:
    noise = 0.01 * np.random.default_rng(2).standard_normal(len(logged()))
    whole = make_problem([check(replace(logged(), voltage=logged().voltage + noise))], ())
    monkeypatch.setattr(thinning, "ENOUGH", 500)
    thinned = thin_problem(whole)
    (every, volts), (fewer, _mean) = whole.commands[0], thinned.commands[0]
    assert len(every) == len(volts) == len(logged()) and len(fewer) < 0.3 * len(every)
