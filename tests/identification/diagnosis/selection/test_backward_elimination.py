"""Backward elimination: what stands in is dropped, what is not needed goes, what is better replaces it."""

from dataclasses import replace
from typing import cast

import pytest
from diagnosed import fitted, with_effect
from stub_models import rescored, stub_model, with_effects
from stub_selections import stub_step

from motor_identification.diagnosis.candidate_fit import validate_model
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest, likelihood_threshold
from motor_identification.diagnosis.fits.effect_fit import fit_with_effect
from motor_identification.diagnosis.selection import backward_elimination
from motor_identification.diagnosis.selection.backward_elimination import (
    eliminate_backward,
)
from motor_identification.diagnosis.selection.selection import Selection, SelectionStep
from motor_identification.discrepancy.structure import Structure
from motor_identification.noise.error_model import ErrorModel
from motor_identification.progress import ProgressReporter
from motor_identification.validation.hold_out import HoldOut
from motor_model.effects import EFFECT_BY_NAME

BELOW, ABOVE = 0.999, 1.001
SILENT = ProgressReporter(lambda stage: None, lambda: False)


@pytest.mark.parametrize(("likelihood", "better"), [(90.0, False), (110.0, True)])
def test_a_model_is_judged_by_the_errors_of_one_without_an_effect_too(
    monkeypatch: pytest.MonkeyPatch, likelihood: float, better: bool
) -> None:
    """Their search may end in another place, where the larger model is likelier, too."""
    model, other = stub_model(2.0, likelihood=100.0), ErrorModel(0.003, 0.0, 0.1, 0.05)
    again, asked = rescored(model, likelihood=likelihood), []

    def judged(one: Model, hold_out: HoldOut, guess: ErrorModel, evaluations: int) -> Model:
        asked.append((one, guess))
        return again

    monkeypatch.setattr(backward_elimination, "judge_beside_torque", judged)
    chosen = backward_elimination._judge_by_errors_of(other, model, fitted()[1])
    assert chosen is (again if better else model) and asked == [(model, other)]


def test_what_is_not_needed_beside_the_others_is_taken_back() -> None:
    """A dead zone was selected where friction was missing; beside friction it explains nothing."""
    estimate, hold_out = fitted(ks=0.4)
    bare = validate_model(hold_out, estimate)
    first = fit_with_effect(estimate, "dead_zone")
    assert first is not None
    with_zone = validate_model(hold_out, first)
    both = fit_with_effect(first, "coulomb_friction")
    assert both is not None
    last = validate_model(hold_out, both)
    zone, friction = CandidateTest("dead_zone", bare, with_zone), CandidateTest("coulomb_friction", with_zone, last)
    assert zone.evidence > likelihood_threshold()
    steps = (
        SelectionStep(bare, zone, (zone,), (), zone.explains),
        SelectionStep(with_zone, friction, (friction,), (), friction.explains),
    )
    left = eliminate_backward(Selection(steps, last, hold_out, 1), SILENT)
    assert [step.found.effect for step in left.steps] == ["coulomb_friction"]
    assert left.model.effects == ("coulomb_friction",) and left.model.at_floor
    assert left.model.estimate.parameters.value("ks") == pytest.approx(0.4, rel=1e-3)


@pytest.mark.parametrize(
    ("hidden", "step_time", "named"),
    [
        ({"bias_voltage": 0.3}, 1e-3, "load_bias"),
        ({"step_voltage": 0.6, "step_time": 2.5}, 2.5, "load_step"),
    ],
)
def test_a_load_that_came_before_the_motion_is_constant(hidden: dict[str, float], step_time: float, named: str) -> None:
    """It was selected without friction, which held the motor until it was driven; no other was likely there."""
    estimate, hold_out = fitted(ks=0.4, **hidden)
    bare = validate_model(hold_out, estimate)
    first = with_effect(estimate, "load_step", {"step_voltage": 0.3, "step_time": step_time})
    with_load = validate_model(hold_out, first)
    both = fit_with_effect(first, "coulomb_friction")
    assert both is not None and both.parameters.value("step_time") == pytest.approx(step_time, abs=0.01)
    last = validate_model(hold_out, both)
    load, friction = CandidateTest("load_step", bare, with_load), CandidateTest("coulomb_friction", with_load, last)
    steps = (
        SelectionStep(bare, load, (load,), ("quadratic_drag",), load.explains),
        SelectionStep(with_load, friction, (friction,), (), friction.explains),
    )
    left = eliminate_backward(Selection(steps, last, hold_out, 1), SILENT)
    assert [step.found.effect for step in left.steps] == [named, "coulomb_friction"]
    assert (left.steps[0].found is load) is (named == "load_step")  # which is not given away and found again
    assert left.model.effects == tuple(sorted((named, "coulomb_friction"))) and left.model.at_floor
    size = EFFECT_BY_NAME[named].parameters[0].name
    assert left.model.estimate.parameters.value(size) == pytest.approx(hidden[size], rel=1e-3)


def test_a_load_that_proves_constant_is_compared_with_what_does_its_work(monkeypatch: pytest.MonkeyPatch) -> None:
    """Motion one way: a load step was found alone, and neither friction nor dead zone was tried as its constant."""
    bare, loaded = stub_model(2.0, 0.0, likelihood=-500.0), stub_model(1.0, 0.0, likelihood=-400.0)
    constant = CandidateTest("load_bias", bare, with_effects(loaded, "load_bias"))
    given = iter([constant, None])
    monkeypatch.setattr(backward_elimination, "_find_constant", lambda *_: next(given))
    monkeypatch.setattr(backward_elimination, "refit_without", lambda *_: bare)
    tried: list[str] = []

    def try_in_place(selection: Selection, step: SelectionStep, *_: object) -> Selection:
        tried.append(step.found.effect)
        return selection

    monkeypatch.setattr(backward_elimination, "try_in_place", try_in_place)
    found = CandidateTest("load_step", bare, loaded)
    step = SelectionStep(bare, found, (found,), (), 1.0)
    left = eliminate_backward(Selection((step,), loaded, cast(HoldOut, None), 1), SILENT)
    assert [one.found.effect for one in left.steps] == ["load_bias"] == tried


@pytest.mark.parametrize(("outside", "again"), [(False, True), (True, False)])
def test_what_was_checked_beside_one_that_went_is_checked_without_it(
    monkeypatch: pytest.MonkeyPatch, outside: bool, again: bool
) -> None:
    """A dead zone beside a delay, which stood in for a friction: alone, a friction does as well."""
    names = ("dead_zone", "transport_delay", "quadratic_drag")
    model, checked = with_effects(stub_model(1.0), *names), list[tuple[str, bool]]()
    structure = Structure("past", 0.5, 100.0)

    def check(selection: Selection, step: SelectionStep, _: ProgressReporter, compared: bool) -> Selection:
        checked.append((step.found.effect, compared))
        if step.found.effect != "transport_delay":
            return selection
        left = selection.replace_step(step, None, with_effects(stub_model(1.0), "dead_zone", "quadratic_drag"))
        return replace(left, outside=structure) if outside else left

    monkeypatch.setattr(backward_elimination, "_check_step", check)
    steps = tuple(stub_step(name, 0.5) for name in names)
    left = eliminate_backward(Selection(steps, model, cast(HoldOut, None), 1), SILENT)
    assert [one.found.effect for one in left.steps] == ["dead_zone", "quadratic_drag"]
    assert checked == [(name, True) for name in names] + ([("dead_zone", False)] if again else [])


@pytest.mark.parametrize("of_sensor", [True, False])
def test_a_line_that_is_a_sensors_beside_all_that_was_found_later_is_taken_back(
    monkeypatch: pytest.MonkeyPatch, of_sensor: bool
) -> None:
    """Before a friction was found, the load of 2.00 cycles was likelier than such errors."""
    bare, rippling = stub_model(2.0, 0.0, likelihood=-500.0), stub_model(1.0, 0.0, likelihood=-400.0)
    asked: list[CandidateTest] = []

    def is_of_sensor(test: CandidateTest) -> bool:
        asked.append(test)
        return of_sensor

    monkeypatch.setattr(backward_elimination, "refit_without", lambda *_: bare)
    monkeypatch.setattr(backward_elimination, "is_of_sensor", is_of_sensor)
    monkeypatch.setattr(backward_elimination, "_find_outside", lambda *_: None)
    found = CandidateTest("torque_ripple", bare, rippling)
    step = SelectionStep(bare, found, (found,), (), 1.0)
    left = eliminate_backward(Selection((step,), rippling, cast(HoldOut, None), 1), SILENT)
    assert [one.found.effect for one in left.steps] == ([] if of_sensor else ["torque_ripple"])
    assert left.model is (bare if of_sensor else rippling) and asked == [found]
