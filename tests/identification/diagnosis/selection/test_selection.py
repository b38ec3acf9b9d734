"""A stepwise selection begins with a model fitted again, and is fitted again with every step."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosed import fitted, with_effect

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_fit import validate_model
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest
from motor_identification.diagnosis.selection import selection
from motor_identification.diagnosis.selection.selection import (
    Selection,
    SelectionStep,
    begin_beside_torque,
    begin_selection,
    may_be_miscounted,
)
from motor_identification.estimation.estimate import Estimate
from motor_identification.validation.hold_out import HoldOut

BELOW, ABOVE = 0.999, 1.001


def test_steps_are_added_and_the_model_is_fitted_again() -> None:
    estimate, hold_out = fitted(ks=0.4)
    start = begin_selection(estimate, hold_out, 3)
    assert start.steps == () and start.model.above_floor and start.workers == 3
    more = with_effect(estimate, "coulomb_friction", {"ks": 0.1})
    test = CandidateTest("coulomb_friction", start.model, validate_model(hold_out, more))
    found = start.add([SelectionStep(start.model, test, (test,), (), test.explains)])
    assert [step.found.effect for step in found.steps] == ["coulomb_friction"] and found.workers == 3
    assert found.model.effects == ("coulomb_friction",) and found.model.at_floor
    assert found.model.estimate.parameters.value("ks") == pytest.approx(0.4, rel=1e-3)
    assert found.model.estimate.simulations > more.simulations


def test_a_model_without_miscounts_is_judged_on_the_motion_that_candidates_will_be(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Directions read once more by the cleaner fit may make other intervals of the held-out motion."""
    estimate, hold_out = fitted(ks=0.4)
    judged: list[tuple[Model, HoldOut]] = []

    def validate(by: HoldOut, one: Estimate) -> Model:
        model = validate_model(by, estimate)
        judged.append((model, by))
        return model

    monkeypatch.setattr(type(hold_out), "correct_directions", lambda self, by: replace(self))
    monkeypatch.setattr(selection, "fit_robustly", lambda careful: careful)
    monkeypatch.setattr(selection, "validate_model", validate)
    monkeypatch.setattr(selection, "may_be_miscounted", lambda robust, floor: True)
    monkeypatch.setattr(Model, "at_floor", True)
    begun = begin_selection(estimate, hold_out, 1)
    model, by = judged[-1]
    assert begun.model is model and begun.hold_out is by and len(judged) == 2


@pytest.mark.parametrize(
    ("gains", "kept"),
    [
        ((BELOW,), 0),
        ((ABOVE, BELOW), 1),
        ((70.0, 20.0, ABOVE, -5.0), 3),
        ((ABOVE,) * 9, thresholds.SETTLING_ROUNDS),
    ],
)
def test_a_model_beside_a_torque_is_fitted_until_that_gains_nothing(
    gains: tuple[float, ...], kept: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Else what is tried beside it is credited with the rest of the way: any effect of no size was, by 92."""
    estimate, hold_out = fitted(ks=0.4)
    plain = validate_model(hold_out, estimate)
    likelihoods = iter(np.cumsum([0.0, *(gain * thresholds.SETTLED_LIKELIHOOD for gain in gains)]))
    fits: list[Selection] = []

    def begin(model: Model, by: HoldOut, workers: int, steps: tuple[SelectionStep, ...]) -> Selection:
        assert model is (fits[-1].model if fits else plain) and by is hold_out and (workers, steps) == (3, ())
        score = replace(model.score, likelihood=float(next(likelihoods)))
        fits.append(Selection(steps, replace(model, score=score), by, workers))
        return fits[-1]

    monkeypatch.setattr(selection, "_begin_once_beside_torque", begin)
    assert begin_beside_torque(plain, hold_out, 3) is fits[kept]
    assert len(fits) == 1 + min(kept + 1, thresholds.SETTLING_ROUNDS)


@pytest.mark.parametrize("times", [BELOW, ABOVE])
def test_miscounts_may_be_all_where_most_intervals_are_near_the_floor(times: float) -> None:
    estimate, _ = fitted()
    problem = estimate.problem
    residuals = problem.residuals(estimate.theta) * np.sqrt(problem.weight * len(problem.weight))
    typical = 1.4826 * float(np.median(np.abs(residuals)))
    assert may_be_miscounted(estimate, times * typical / thresholds.MISCOUNTED_GAP) == (times == ABOVE)
