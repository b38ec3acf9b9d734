"""A fitting problem: weights by time, derivatives by differences, views of the same recordings."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from small import THETA, TRUE, small_problem, small_recording

from motor_identification.estimation import problem as problem_module
from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.residual import simulate_residuals
from motor_identification.measurement.time_blocks import TimeBlocks
from motor_identification.progress import Stopped
from motor_identification.recording import Floats
from motor_model.errors import RecordingError


def test_cost_is_the_time_weighted_mean_square() -> None:
    problem = make_problem([small_recording(0), small_recording(1)], ("coulomb_friction",))
    duration = np.concatenate([data.duration for data in problem.intervals])
    assert problem.weight == pytest.approx(duration / duration.sum()) and problem.weight.sum() == pytest.approx(1.0)
    wrong = THETA + [0.02, 0.0, 0.0]
    residuals = problem.residuals(wrong)
    assert problem.cost(wrong) == pytest.approx(float(problem.weight @ residuals**2))
    parts = problem.split(residuals)
    assert [len(part) for part in parts] == [len(data.first) for data in problem.intervals]
    for travel, part, data in zip(problem.to_travel(residuals), parts, problem.intervals, strict=True):
        assert travel == pytest.approx(part * data.duration)


@pytest.mark.parametrize("workers", [1, 2, 5])
def test_the_jacobian_is_the_derivative(workers: int) -> None:
    problem = replace(small_problem(), workers=workers)
    jacobian = problem.jacobian(THETA)
    for column, step in zip(jacobian.T, 1e-4 * np.eye(3), strict=True):
        slope = (problem.residuals(THETA + step) - problem.residuals(THETA - step)) / 2e-4
        assert np.linalg.norm(column - slope) < 0.01 * np.linalg.norm(slope)


def test_a_recording_is_simulated_for_what_concerns_it(monkeypatch: pytest.MonkeyPatch) -> None:
    turning = small_recording(1).between(0.1, 0.7)  # it begins on a moving motor: an unknown of its own
    problem = make_problem([small_recording(0), turning], ("coulomb_friction",))
    theta = np.append(THETA, 9.0 / TRUE["kv"])
    assert len(problem.unknowns.low) == 4
    first = len(problem.intervals[0].first)
    simulated = []

    def counted(vectors: Floats, *rest: Any) -> Floats:
        simulated.append(len(vectors))
        return simulate_residuals(vectors, *rest)

    monkeypatch.setattr(problem_module, "simulate_residuals", counted)
    jacobian = problem.jacobian(theta)
    assert np.all(jacobian[:first, 3] == 0.0) and np.abs(jacobian[first:, 3]).max() > 0.5
    assert sum(simulated) == 2 + 3 + 4  # the residuals once, then what moves each recording
    assert problem.jacobian(theta) == pytest.approx(jacobian) and problem.cost(theta) > 0.0
    assert sum(simulated) == 2 + 3 + 4  # nothing anew


def test_joined_intervals_are_fewer_and_say_the_same() -> None:
    problem = small_problem()
    coarse = problem.coarsen(4.0)
    assert len(coarse.weight) < 0.5 * len(problem.weight) and coarse.coarseness > 1.0
    wrong = THETA + [0.05, 0.0, 0.0]
    assert coarse.cost(wrong) == pytest.approx(problem.cost(wrong), rel=0.1)


def test_what_is_kept_out_stays_out_when_intervals_are_read_again() -> None:
    problem, blocks = small_problem(), TimeBlocks(4)
    kept = problem.keeping_out(blocks)
    count = len(kept.weight)
    assert 0.7 * len(problem.weight) < count < 0.8 * len(problem.weight)
    assert not blocks.mark(kept.intervals[0], 0.005).any()
    assert len(kept.with_intervals(problem.intervals).weight) == count
    assert len(problem.with_intervals(problem.intervals).weight) == len(problem.weight)


def test_the_measured_angle_anchors_what_is_periodic() -> None:
    problem = small_problem()
    held = problem.on_measured_angle(THETA, (*problem.unknowns.effects, "torque_ripple"))
    assert "ripple_voltage" in held.unknowns.names and len(held.tracks) == 1
    assert held.anchors[0] == pytest.approx(held.tracks[0].at(held.intervals[0].time))
    assert len(problem.anchors[0]) == 0


def test_it_stops_when_it_is_told_to() -> None:
    told = [False]
    problem = make_problem([small_recording()], (), stopped=lambda: told[0])
    assert problem.cost(THETA[:2]) > 0.0
    told[0] = True
    for simulate in (problem.cost, problem.jacobian, problem.angles):
        with pytest.raises(Stopped):
            simulate(THETA[:2])


def test_what_cannot_be_fitted_is_refused() -> None:
    recording = small_recording()
    with pytest.raises(RecordingError, match="the voltage is always 0"):
        make_problem([replace(recording, voltage=0.0 * recording.voltage)], ())
    short = recording.between(0.0, 0.03)
    with pytest.raises(RecordingError, match=r"\d+ unknowns cannot be fitted to \d+ intervals"):
        make_problem([short], ("static_friction", "load_step", "torque_ripple", "backlash", "warm_up", "dead_zone"))
