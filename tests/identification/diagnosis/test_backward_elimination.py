"""Backward elimination: what stands in is dropped, what is not needed goes, what is better replaces it."""

from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from diagnosed import fitted
from stub_models import stub_model, stub_test

from motor_identification.diagnosis import backward_elimination, thresholds
from motor_identification.diagnosis.backward_elimination import (
    choose_better,
    drop_stand_ins,
    drop_stand_ins_of_either,
    eliminate_backward,
    find_loss,
    is_better,
    keep_confirmed,
    list_replacements,
    stands_in_for_curve,
)
from motor_identification.diagnosis.candidate_model import Model, validate_model
from motor_identification.diagnosis.candidate_test import CandidateTest
from motor_identification.diagnosis.effect_fit import fit_with_effect
from motor_identification.diagnosis.effect_test import likelihood_threshold
from motor_identification.diagnosis.selection import Selection, SelectionStep
from motor_identification.discrepancy.structure import Structure
from motor_identification.noise.error_model import ErrorModel
from motor_identification.progress import ProgressReporter
from motor_identification.recording import Floats
from motor_identification.validation.hold_out import HoldOut

BELOW, ABOVE = 0.999, 1.001
SILENT = ProgressReporter(lambda stage: None, lambda: False)


def selection_of(gap: float, *steps: SelectionStep) -> Selection:
    _, hold_out = fitted()
    return Selection(steps, stub_model(gap, 0.0), hold_out, 1)


def step_of(effect: str, explains: float) -> SelectionStep:
    before = stub_model(9.0)
    found = stub_test(effect, before, 5.0, 100.0)
    return SelectionStep(before, found, (found,), (), explains)


@pytest.mark.parametrize(("times", "kept"), [(BELOW, 0), (ABOVE, 2)])
def test_a_stand_in_goes_and_all_that_was_found_after_it(times: float, kept: int) -> None:
    steps = step_of("quadratic_drag", times * thresholds.STAND_IN_SHARE), step_of("load_bias", 0.99)
    left = drop_stand_ins(selection_of(5.0, *steps))
    assert left.steps == steps[:kept]
    assert (left.model is steps[0].before) == (kept == 0)


@pytest.mark.parametrize(("times", "kept"), [(BELOW, 1), (ABOVE, 0)])
def test_at_the_floor_nothing_stands_in(times: float, kept: int) -> None:
    selection = selection_of(times * thresholds.EXPLAINED_GAP, step_of("load_bias", 0.5))
    assert len(drop_stand_ins(selection).steps) == kept


@pytest.mark.parametrize("held", [True, False])
def test_what_holds_the_motor_is_its_own_evidence_where_it_explains_standstills(
    monkeypatch: pytest.MonkeyPatch, held: bool
) -> None:
    asked: list[tuple[Model, Model]] = []
    monkeypatch.setattr(
        backward_elimination, "explains_standstills", lambda *models: bool(asked.append(models)) or held
    )
    steps = step_of("coulomb_friction", 0.7), step_of("quadratic_drag", 0.3)
    left = drop_stand_ins(selection_of(5.0, *steps))
    assert left.steps == steps[: int(held)] and left.model is (steps[1].before if held else steps[0].before)
    assert asked == [(steps[0].before, steps[1].before)]


@pytest.mark.parametrize(
    ("effect", "explains", "left", "kept"),
    [
        ("transport_delay", ABOVE * thresholds.APART_SHARE, ("spectrum",), 1),
        ("transport_delay", BELOW * thresholds.APART_SHARE, ("spectrum",), 0),
        ("transport_delay", 0.9, ("spectrum", "past"), 0),  # its own variable: it may stand in for another lag
        ("transport_delay", 0.9, (), 0),
        ("warm_up", 0.9, ("time",), 0),
        ("coulomb_friction", 0.9, ("angle", "time"), 1),
    ],
)
def test_what_only_angle_or_time_predict_is_nothing_that_a_finding_stands_in_for(
    effect: str, explains: float, left: tuple[str, ...], kept: int
) -> None:
    selection = selection_of(5.0, step_of(effect, explains))
    rest = tuple(Structure(name, 0.5, 100.0) for name in left)
    model = cast(Model, SimpleNamespace(complete=False, structure=rest))
    assert len(drop_stand_ins(replace(selection, model=model)).steps) == kept


@pytest.mark.parametrize(
    ("effect", "explains", "drive", "kept"),
    [
        ("coulomb_friction", ABOVE * thresholds.APART_SHARE, BELOW * thresholds.MINOR_SHARE, 1),
        ("coulomb_friction", BELOW * thresholds.APART_SHARE, BELOW * thresholds.MINOR_SHARE, 0),
        ("coulomb_friction", 0.9, ABOVE * thresholds.MINOR_SHARE, 0),
        ("quadratic_drag", 0.9, BELOW * thresholds.MINOR_SHARE, 0),
    ],
)
def test_friction_stands_in_for_nothing_that_goes_with_the_past(
    monkeypatch: pytest.MonkeyPatch, effect: str, explains: float, drive: float, kept: int
) -> None:
    monkeypatch.setattr(backward_elimination, "explains_standstills", lambda *models: False)
    rest = (Structure("past", 0.8, 100.0), Structure("drive", 0.8 * drive, 100.0))
    model = cast(Model, SimpleNamespace(complete=False, structure=rest))
    assert len(drop_stand_ins(replace(selection_of(5.0, step_of(effect, explains)), model=model)).steps) == kept
    left = replace(rest[0], significance=0.0)  # no curve over the past is certain
    model = cast(Model, SimpleNamespace(complete=False, structure=(left, rest[1])))
    assert not drop_stand_ins(replace(selection_of(5.0, step_of(effect, explains)), model=model)).steps


@pytest.mark.parametrize(("likelihood", "better"), [(90.0, False), (110.0, True)])
def test_a_model_is_judged_by_the_errors_of_one_without_an_effect_too(
    monkeypatch: pytest.MonkeyPatch, likelihood: float, better: bool
) -> None:
    """Their search may end in another place, where the larger model is likelier, too."""
    model, other = replace(stub_model(2.0), likelihood=100.0), ErrorModel(0.003, 0.0, 0.1, 0.05)
    again, asked = replace(model, likelihood=likelihood), []

    def judged(one: Model, hold_out: HoldOut, guess: ErrorModel, evaluations: int) -> Model:
        asked.append((one, guess))
        return again

    monkeypatch.setattr(backward_elimination, "judge_beside_torque", judged)
    chosen = backward_elimination._judge_by_errors_of(other, model, fitted()[1])
    assert chosen is (again if better else model) and asked == [(model, other)]


@pytest.mark.parametrize(
    ("times", "variable", "beside", "stands_in"),
    [
        (BELOW, "past", True, True),
        (ABOVE, "past", True, False),
        (BELOW, "speed", True, False),
        (BELOW, "past", False, False),
    ],
)
def test_what_a_curve_over_the_past_predicts_as_well_is_no_backlash(
    times: float, variable: str, beside: bool, stands_in: bool
) -> None:
    """With a gap of 5 before, 3 after and a floor of 1 rad/s it explains 16 parts of 24."""
    curve = Structure(variable, 16.0 / 24.0 / thresholds.CURVE_MARGIN / times, 100.0)
    without = cast(Model, SimpleNamespace(structure=(curve,), held=SimpleNamespace(gap=5.0)))
    current = cast(Model, SimpleNamespace(beside_torque=beside, held=SimpleNamespace(gap=3.0), sensor_floor=1.0))
    assert stands_in_for_curve(without, current) is stands_in


def test_of_two_selections_the_one_that_keeps_more() -> None:
    poor, rich = selection_of(4.0, step_of("load_bias", 0.9)), selection_of(5.0, step_of("load_bias", 0.99))
    assert drop_stand_ins_of_either(rich, poor).steps == rich.steps == drop_stand_ins_of_either(poor, rich).steps
    done = selection_of(1.0)
    assert drop_stand_ins_of_either(rich, done) is done


def test_findings_that_another_selection_confirms_are_kept() -> None:
    steps = step_of("coulomb_friction", 0.7), step_of("quadratic_drag", 0.3), step_of("load_bias", 0.3)
    selection = selection_of(5.0, *steps)
    kept = keep_confirmed(selection, ("coulomb_friction", "load_bias", "backlash"))
    assert kept.steps == steps[:1] and kept.model is steps[1].before
    assert keep_confirmed(selection, ("coulomb_friction", "quadratic_drag", "load_bias")) is selection


def test_a_line_in_the_spectrum_is_its_own_evidence() -> None:
    steps = step_of("torque_ripple", 0.1), step_of("load_bias", 0.99)
    assert drop_stand_ins(selection_of(5.0, *steps)).steps == steps


def test_of_what_is_as_much_better_the_most_common_replaces_a_finding() -> None:
    current = stub_model(1.0, 0.0, likelihood=-500.0)
    before = stub_model(2.0, 0.0, likelihood=-600.0)

    def better(name: str, evidence: float) -> CandidateTest:
        return CandidateTest(name, before, stub_model(1.0, 0.0, likelihood=-600.0 + evidence))

    zone, friction = better("dead_zone", 110.0), better("coulomb_friction", 110.0 - 0.9 * thresholds.TIE_LIKELIHOOD)
    assert choose_better([zone, friction], "load_step", current) is friction
    behind = better("coulomb_friction", 110.0 - 1.1 * thresholds.TIE_LIKELIHOOD)
    assert choose_better([zone, behind], "load_step", current) is zone
    assert choose_better([better("dead_zone", 1.0)], "load_step", current) is None


@pytest.mark.parametrize(
    ("instead", "effect", "margin"),
    [
        ("load_bias", "dead_zone", thresholds.RIVAL_MARGIN),  # as many parameters: it has to be the better one
        ("load_step", "dead_zone", thresholds.RIVAL_MARGIN),
        ("dead_zone", "load_step", -thresholds.RIVAL_MARGIN),  # fewer: it may be a little less likely
    ],
)
def test_what_replaces_a_finding(instead: str, effect: str, margin: float) -> None:
    current = stub_model(1.0, 0.0, likelihood=-500.0)
    for shift, better in ((-0.01, False), (0.01, True)):
        model = stub_model(1.0, 0.0, likelihood=-500.0 + margin + shift)
        assert is_better(CandidateTest(instead, current, model), effect, current) is better


def test_replacements_were_likely_where_it_was_found_and_are_not_there_already() -> None:
    before, least = stub_model(9.0), likelihood_threshold()
    found = stub_test("coulomb_friction", before, 5.0, 100.0)
    names = ("dead_zone", "load_bias", "quadratic_drag", "supply_sag", "voltage_limit")
    tests = [stub_test(name, before, 5.0, ABOVE * least) for name in names]
    step = SelectionStep(before, found, (found, *tests), (), 0.99)
    assert list_replacements(step, (), ("load_bias",)) == ["dead_zone", "quadratic_drag", "supply_sag"]
    assert len(list_replacements(step, (), ())) == thresholds.ELIMINATION_RIVALS
    weak = SelectionStep(before, found, (found, stub_test("dead_zone", before, 5.0, BELOW * least)), (), 0.99)
    assert list_replacements(weak, (), ()) == []


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


@pytest.mark.parametrize(("times", "few"), [(BELOW, True), (ABOVE, False)])
def test_a_few_moments_count_where_what_replaces_predicts_worse(times: float, few: bool) -> None:
    """A slow torque does in one moment what a load step does, but does not predict it."""
    moments = np.zeros(60)
    moments[7] = 100.0

    def model(gap: float, likelihood: float, moments: Floats) -> Model:
        held = SimpleNamespace(gap=gap)
        return cast(Model, SimpleNamespace(likelihood=likelihood, held=held, moments=moments, beside_torque=True))

    current = model(1.0, 100.0, moments)
    test = CandidateTest("load_bias", current, model(times * thresholds.WORSE_GAP, 0.0, np.zeros(60)))
    assert find_loss(test, "load_step", current) == (0.0 if few else 100.0)


@pytest.mark.parametrize(
    ("gap", "likelihood", "settled"),
    [(1.09, -600.0, True), (1.11, -600.0, False), (1.09, -499.0, False)],
)
def test_what_moves_nearly_alike_is_fitted_to_the_end_before_it_is_called_less_likely(
    monkeypatch: pytest.MonkeyPatch, gap: float, likelihood: float, settled: bool
) -> None:
    current = stub_model(1.0, 0.0, likelihood=-500.0)
    tried = CandidateTest("load_bias", stub_model(2.0, 0.0), stub_model(gap, 0.0, likelihood=likelihood))
    for end, better in ((-500.5, True), (-600.5, False)):
        again = stub_model(1.0, 0.0, likelihood=end)
        monkeypatch.setattr(backward_elimination, "fit_again", lambda model, hold_out, again=again: again)
        found = backward_elimination._settle(tried, current, cast(HoldOut, None)).model
        assert found is (again if settled and better else tried.model)
