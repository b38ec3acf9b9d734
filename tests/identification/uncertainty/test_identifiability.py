"""What a recording can tell: directions of the Jacobian, traces that others imitate, the profile that would tell."""

from dataclasses import replace

import numpy as np
import pytest
from plant import profiles, record
from small import THETA, TRUE, small_estimate

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.whitened_fit import make_whitened
from motor_identification.recording import check
from motor_identification.uncertainty.identifiability import (
    INVISIBLE,
    LEAST_SCALE,
    PRESENT_SIGMA,
    find_confusable_effects,
    mark_visible,
    measure_independence,
    scale_unknowns,
    suggest_profile,
)


def test_independence_is_the_sine_of_an_angle() -> None:
    columns = np.array([[1.0, 0.0, 1.0], [0.0, 1.0, 1.0], [0.0, 0.0, 0.1]])
    sines = measure_independence(columns)
    normal = np.linalg.norm([1.0, 1.0, 0.1])
    assert sines[2] == pytest.approx(0.1 / normal)
    assert sines[0] == pytest.approx(0.1 / np.hypot(0.1, 1.0))  # what (1, 1, 0.1) and (0, 1, 0) cannot make
    assert measure_independence(np.eye(3)) == pytest.approx([1.0, 1.0, 1.0])
    assert measure_independence(np.array([[1.0, 2.0], [1.0, 2.0]])) == pytest.approx([0.0, 0.0], abs=1e-7)
    assert measure_independence(np.array([[1.0, 0.0], [1.0, 0.0]])) == pytest.approx([1.0, 0.0])
    assert measure_independence(np.array([[2.0], [0.0]])) == pytest.approx([1.0])


@pytest.mark.parametrize("times", [0.5, 2.0])
def test_a_parameter_near_zero_is_scaled_by_its_box(times: float) -> None:
    estimate = small_estimate()
    unknowns = estimate.problem.unknowns
    least = LEAST_SCALE * (unknowns.high[2] - unknowns.low[2])
    scales = scale_unknowns(replace(estimate, theta=np.array([*THETA[:2], times * least])))
    assert scales[:2].tolist() == [1.0, 1.0] and scales[2] == pytest.approx(max(times, 1.0) * least)


@pytest.mark.parametrize(("times", "visible"), [(0.5, False), (2.0, True)])
def test_what_moves_the_speeds_by_rounding_alone_is_invisible(times: float, visible: bool) -> None:
    estimate = small_estimate()
    problem = estimate.problem
    moved = np.sqrt(problem.weight @ problem.jacobian(THETA) ** 2)
    rms = np.sqrt(problem.weight @ problem.speed**2)
    assert mark_visible(estimate, times * INVISIBLE * rms / moved).tolist() == [visible] * 3


def confusable(drive: profiles.Profile, errors: np.ndarray) -> dict[str, tuple[str, ...]]:
    recording = check(record(TRUE, *drive, seed=2, irregularity=0.003)[0])
    fit = make_whitened(fit_speeds(Estimate(make_problem([recording], ("coulomb_friction",)), THETA)))
    return find_confusable_effects(fit, fit.residuals.jacobian(fit.theta), errors, ())


def test_one_way_a_load_is_friction_and_both_ways_it_is_not() -> None:
    small = np.full(3, 1e-4)
    assert "load_bias" in confusable(profiles.pieces([4.0, 10.0, 7.0], 0.4), small)["coulomb_friction"]
    assert "load_bias" not in confusable(profiles.pieces([4.0, -10.0, 7.0], 0.4), small).get("coulomb_friction", ())


@pytest.mark.parametrize(("sigmas", "there"), [(0.9 * PRESENT_SIGMA, False), (1.1 * PRESENT_SIGMA, True)])
def test_what_is_not_there_is_confused_with_nothing(sigmas: float, there: bool) -> None:
    found = confusable(profiles.pieces([4.0, 10.0, 7.0], 0.4), np.array([1e-4, 1e-4, 0.4 / sigmas]))
    assert bool(found) is there


def test_the_profile_that_would_tell() -> None:
    assert suggest_profile(()) == ""
    assert suggest_profile(["dead_zone"]) == "coast" and suggest_profile(["dead_zone", "dead_zone"]) == "coast"
    assert suggest_profile(["dead_zone", "quadratic_drag"]) == "rich"
