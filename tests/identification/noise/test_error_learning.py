"""A random torque is learned with its strength and correlation time, and not where there is none."""

from dataclasses import replace

import numpy as np
import pytest
from plant import profiles, record
from recorded import as_speed, without_count

from motor_identification.estimation.direction_correction import correct_directions
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.problem import make_problem
from motor_identification.noise import error_learning
from motor_identification.noise.error_data import ErrorData, log_likelihood, make_error_data
from motor_identification.noise.error_learning import estimate_disturbance, learn_error_model
from motor_identification.noise.error_model import ErrorModel, Lag
from motor_identification.recording import check

KV, KA = 0.07, 0.0055
LAG = Lag(KV / KA, KA)


def leave(torque: float, time: float, irregularity: float) -> list[ErrorData]:
    """What the true motor leaves in a recording beside a random torque."""
    values = {"kv": KV, "ka": KA, "random_torque": torque, "random_torque_time": time, "random_torque_seed": 4.0}
    drive = profiles.random(12.0, 20.0, 5)
    recording, _truth = record(values, *drive, seed=5, irregularity=irregularity, disc_seed=5)
    problem = make_problem([check(recording)], ())
    specs = problem.unknowns.specs
    theta = np.array([np.log(x) if spec.logarithmic else x for x, spec in zip((KV, KA), specs, strict=True)])
    estimate = correct_directions(Estimate(problem, theta))
    return [make_error_data(*row) for row in zip(estimate.problem.intervals, estimate.increments, strict=True)]


@pytest.mark.parametrize(("torque", "time", "share"), [(0.15, 0.05, 0.01), (0.03, 0.05, 0.005), (0.1, 0.015, 0.0)])
def test_strength_and_time_are_learned_within_their_errors(torque: float, time: float, share: float) -> None:
    rows = leave(torque, time, share)
    model = learn_error_model(rows, LAG)
    found = estimate_disturbance(rows, model, LAG)
    assert found is not None
    assert 0.8 * torque < found.rms_voltage < 1.2 * torque
    assert 0.6 * time < found.correlation_time < 1.6 * time
    assert abs(found.rms_voltage - torque) < 3.5 * found.rms_error < torque
    assert abs(found.correlation_time - time) < 3.5 * found.time_error
    assert model.share == pytest.approx(share, abs=0.0015)


@pytest.mark.parametrize("share", [0.0, 0.01])
def test_a_perfect_motor_has_no_random_torque(share: float) -> None:
    rows = leave(0.0, 0.05, share)
    model = learn_error_model(rows, LAG)
    assert model.rms_voltage < 1e-3
    assert estimate_disturbance(rows, ErrorModel(share, 0.0, 0.0, 1.0), LAG) is None
    assert model.share == pytest.approx(share, abs=0.0015)


def test_the_learned_model_is_more_likely_than_its_neighbours() -> None:
    rows = leave(0.1, 0.05, 0.005)
    model = learn_error_model(rows, LAG)
    best = log_likelihood(rows, model, LAG)
    for factor in (0.7, 1.4):
        other = ErrorModel(model.share, 0.0, factor * model.rms_voltage, model.correlation_time)
        assert log_likelihood(rows, other, LAG) < best - 5.0


def test_no_model_is_scored_twice(monkeypatch: pytest.MonkeyPatch) -> None:
    scored: list[ErrorModel] = []

    def note(rows: list[ErrorData], model: ErrorModel, lag: Lag) -> float:
        scored.append(model)
        return log_likelihood(rows, model, lag)

    monkeypatch.setattr(error_learning, "log_likelihood", note)
    learn_error_model(leave(0.1, 0.05, 0.005), LAG)
    assert len(set(scored)) == len(scored) > 50


def log_speeds(noise: float, step: float, torque: float = 0.0) -> tuple[list[ErrorData], float]:
    """What the true motor leaves in a log of counted speeds with white noise [rad/s] beside, on a lattice [rad/s], and
    the noise that counting alone leaves at either end [rad/s]."""
    values = {"kv": KV, "ka": KA, "random_torque": torque, "random_torque_time": 0.05, "random_torque_seed": 4.0}
    recording, truth = record(values, *profiles.random(12.0, 30.0, 5), seed=5, edges=6, sample_rate=100.0)
    logged = as_speed(recording)
    counts = np.diff(np.floor(truth.angle / step / logged.info.speed_window), prepend=0.0)
    more = np.round(noise / step * np.random.default_rng(1).standard_normal(len(counts)))
    logged = check(without_count(replace(logged, speed=step * (counts + more))))
    problem = make_problem([logged], ())
    specs = problem.unknowns.specs
    theta = np.array([np.log(x) if spec.logarithmic else x for x, spec in zip((KV, KA), specs, strict=True)])
    (data,) = problem.intervals
    assert not data.independent and data.window == pytest.approx(0.01)  # taken for counts
    return [make_error_data(data, *Estimate(problem, theta).increments)], float(data.noise / data.window)


@pytest.mark.parametrize("torque", [0.0, 0.1])
def test_white_noise_beside_a_lattice_is_the_sensors_and_no_torque(torque: float) -> None:
    rows, counting = log_speeds(0.9, 0.7, torque)
    model = learn_error_model(rows, LAG)
    assert np.sqrt(2.0) * model.share * counting == pytest.approx(0.9, rel=0.1)
    assert 0.8 * torque <= model.rms_voltage <= 1.2 * torque


def test_a_lattice_alone_has_no_noise_beside() -> None:
    rows, _ = log_speeds(0.0, 0.7)
    model = learn_error_model(rows, LAG)
    assert model.share < 0.8 and model.rms_voltage < 0.02


def test_a_share_that_was_far_off_does_not_hide_the_right_correlation_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """From the grid's shares a fast torque seems likelier, though the slow one is by 300 where the share is right."""
    rows = leave(0.0, 0.05, 0.0)
    far, slow = 0.08, 0.5

    def log_likelihood_of_two_summits(rows: list[ErrorData], model: ErrorModel, lag: Lag) -> float:
        if model.rms_voltage == 0.0:
            return -10_000.0 - abs(np.log(max(model.share, 1e-9) / 0.002))
        off, away = np.log(model.share / far), np.log(model.correlation_time / slow)
        fast = 1.0 / (1.0 + (model.correlation_time / 0.02) ** 4)  # a plain
        return -1000.0 * off**2 + 400.0 * np.exp(-(away**2)) + (100.0 + 300.0 * abs(off)) * fast

    monkeypatch.setattr(error_learning, "log_likelihood", log_likelihood_of_two_summits)
    model = learn_error_model(rows, LAG)
    assert model.share == pytest.approx(far, rel=0.05) and model.correlation_time == pytest.approx(slow, rel=0.1)


def leave_of_loads(lengths: list[float]) -> list[ErrorData]:
    """What kv and ka alone leave in runs of so many seconds, each under a constant load of its own."""
    rows = []
    for length, load in zip(lengths, 0.1 * np.random.default_rng(6).standard_normal(len(lengths)), strict=True):
        drive = profiles.random(12.0, length, 5)
        recording, _truth = record({"kv": KV, "ka": KA, "bias_voltage": float(load)}, *drive, seed=5)
        problem = make_problem([check(recording)], ())
        specs = problem.unknowns.specs
        theta = np.array([np.log(x) if spec.logarithmic else x for x, spec in zip((KV, KA), specs, strict=True)])
        estimate = correct_directions(Estimate(problem, theta))
        rows += [make_error_data(*row) for row in zip(estimate.problem.intervals, estimate.increments, strict=True)]
    return rows


@pytest.mark.parametrize("lengths", [[1.0] * 10, [1.0] * 10 + [10.0]])
@pytest.mark.parametrize("share", [error_learning.LONGEST_SHARE, 10.0])
def test_what_stays_for_all_of_a_run_is_no_torque_that_was_seen_to_be_random(
    share: float, lengths: list[float], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Such a torque did what friction does in runs at levels of their own; one long run among them does not matter."""
    monkeypatch.setattr(error_learning, "LONGEST_SHARE", share)
    rows = leave_of_loads(lengths)
    run = float(np.median([row.duration.sum() for row in rows]))
    found = learn_error_model(rows, LAG)
    assert found.rms_voltage > 0.01
    assert (found.correlation_time <= 0.2501 * run) is (share < 1.0)


def test_a_single_run_may_have_any_torque() -> None:
    """Nothing differs from run to run there; to bound its time would make a slow one too weak, and too sure of it."""
    found = learn_error_model(leave(0.1, 3.0, 0.0), LAG)
    assert found.correlation_time > 1.0
