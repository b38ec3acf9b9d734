"""A motor that turns when its recording begins is told from one that starts, by its first edges."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from plant import profiles, record
from recorded import as_counts, as_speed

from motor_identification.identify import Request, SearchConfig, identify
from motor_identification.measurement.initial_speed import estimate_initial_speed
from motor_identification.recording import Floats, Recording, check
from motor_model.parameters import PAPER_KA, PAPER_KV

TRUTH = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.3}


def begun(speed: float, seed: int, counts: bool, edges: int, delay: float = 0.0) -> Recording:
    """A recording of a board just switched on: its first sample reports no speed."""
    levels = np.random.default_rng(seed).uniform(3.0, 12.0, 2)
    recording, _ = record(
        TRUTH | {"delay": delay}, *profiles.pieces(levels, 0.2), seed=seed, start_speed=speed, edges=edges,
        single_channel=not counts,
    )  # fmt: skip
    assert recording.speed[0] == 0.0
    return as_counts(recording) if counts else recording


@pytest.mark.parametrize("counts", [False, True])
@pytest.mark.parametrize("edges", [24, 96, 500])
def test_a_motor_that_stood_is_not_taken_to_turn(edges: int, counts: bool) -> None:
    found = [estimate_initial_speed(begun(0.0, seed, counts, edges, 0.01 * (seed % 2))) for seed in range(20)]
    assert np.count_nonzero(found) <= (1 if counts and edges == 24 else 0)


@pytest.mark.parametrize("counts", [False, True])
@pytest.mark.parametrize("edges", [24, 96, 500])
def test_a_motor_that_turned_is_seen_and_its_speed_is_near(edges: int, counts: bool) -> None:
    found = np.array([estimate_initial_speed(begun(80.0, seed, counts, edges)) for seed in range(20)])
    assert np.count_nonzero(found) >= (14 if counts and edges == 24 else 17)
    assert np.median(np.abs(found[found != 0.0] / 80.0 - 1.0)) < 0.2
    assert np.all(found[found != 0.0] > 40.0) and np.all(found < 120.0)


def test_what_is_reported_is_believed_and_a_logged_speed_too() -> None:
    recording, _ = record(TRUTH, *profiles.step(10.0, 1.0), seed=0)
    part = recording.between(0.3, 1.0)
    assert estimate_initial_speed(part) == part.speed[0] > 50.0
    assert estimate_initial_speed(as_speed(recording)) == 0.0
    assert estimate_initial_speed(as_speed(part)) == as_speed(part).speed[0]


@pytest.mark.parametrize("lag", [2.0, 8.0, 100.0])
@pytest.mark.parametrize("sigma", [0.01, 1.0])
def test_noise_of_a_logged_speed_at_rest_is_no_motion(sigma: float, lag: float) -> None:
    """Neither of one that stays, nor of one that gains 100 rad/s within so many rows; one that turned is seen."""
    rows = np.arange(400)
    for seed in range(10):
        noise = sigma * np.random.default_rng(seed).standard_normal(400)
        for driven in (0.0, 1.0):
            exact = 100.0 * driven * (1.0 - np.exp(-rows / lag))
            log = logged(exact + noise, np.full(400, driven))
            assert log.speed[0] != 0.0 and estimate_initial_speed(log) == 0.0
            moving = logged(exact + 10.0 * sigma + noise, np.full(400, driven))
            assert estimate_initial_speed(moving) == moving.speed[0]


def test_a_slow_motor_is_seen_to_turn_by_a_few_dozen_counts() -> None:
    """A third of a count in a row: the first one is nothing beyond counting, a parabola through the first is."""
    angle = 0.33 * np.arange(401) + 0.9
    values = np.diff(np.floor(angle))
    assert values[0] == 1.0 and estimate_initial_speed(logged(values, np.ones(400))) == 1.0


def logged(speed: Floats, voltage: Floats) -> Recording:
    return replace(any_log(), speed=speed, voltage=voltage)


@cache
def any_log() -> Recording:
    recording, _ = record(TRUTH, *profiles.step(10.0, 5.0), seed=0)
    return as_speed(recording).at_rows(np.arange(400))


@pytest.mark.parametrize("counts", [False, True])
def test_the_fit_of_a_motor_that_turned_finds_its_first_speed(counts: bool) -> None:
    truth = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.5}
    for seed in range(4):
        drive = profiles.pieces([6.0, 3.0, 9.0], 0.4)
        recording, _ = record(truth, *drive, seed=seed, start_speed=60.0, single_channel=not counts)
        recording = check(as_counts(recording) if counts else recording)
        fit = identify([recording], Request(("coulomb_friction",), SearchConfig(particles=30, epochs=40)))
        assert fit.start_speeds[0] == pytest.approx(60.0, abs=0.5 if counts else 0.02)
        assert 0.8 < fit.residual_rms / fit.noise_floor < 1.15
        for name, value in fit.parameters.values.items():
            assert abs(value - truth[name]) < 4.0 * fit.standard_errors[name]
