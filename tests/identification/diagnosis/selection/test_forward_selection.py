"""Forward selection: what is selected, what is tried in pairs, and where it begins once more."""

from dataclasses import replace
from math import sqrt
from typing import Any

import numpy as np
import pytest
import stub_models
from diagnosed import fitted
from plant import record
from stub_models import StubModel, rescored, stub_held, stub_model, stub_test
from stub_selections import selection_of, step_of

from motor_identification.diagnosis import candidate_test, thresholds
from motor_identification.diagnosis.candidate_model import Model, Score
from motor_identification.diagnosis.candidate_test import CandidateTest, likelihood_threshold
from motor_identification.diagnosis.effect_test import choose_finding
from motor_identification.diagnosis.selection import forward_selection
from motor_identification.diagnosis.selection.forward_selection import (
    may_hide_pair,
    select_forward,
    verify_findings,
)
from motor_identification.diagnosis.selection.selection import Selection, SelectionStep, begin_selection
from motor_identification.diagnosis.start import begin
from motor_identification.estimation.request import Request
from motor_identification.measurement.intervals import Intervals
from motor_identification.noise.error_model import ErrorModel
from motor_identification.progress import ProgressReporter, Stage
from motor_identification.recording import check

BELOW, ABOVE = 0.999, 1.001
AT, OVER = 0.999 * thresholds.EXPLAINED_GAP, 1.2 * thresholds.EXPLAINED_GAP  # of a gap, the floor being 1
SILENT = ProgressReporter(lambda stage: None, lambda: False)


@pytest.mark.parametrize("better", [True, False])
def test_beside_a_torque_the_model_is_fitted_again_from_where_a_finding_leads(
    better: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What the candidate found by luck counts for the model without the effect as well."""
    errors = ErrorModel(0.0, 0.0, 0.1, 0.05)
    gains = np.ones(40)
    before = replace(stub_model(5.0), learned=errors, score=Score(0.0, scored=100, moments=0.0 * gains))
    lucky = replace(stub_model(4.9), learned=errors, score=Score(40.0, held_out=1.0, scored=100, moments=gains))
    again = rescored(before, likelihood=39.0 if better else -1.0, moments=gains if better else 0.0 * gains)
    monkeypatch.setattr(forward_selection, "refit_without", lambda model, effect, hold_out: again)
    selection, tests = verify_findings(selection_of(before), [CandidateTest("load_bias", before, lucky)])
    assert (selection.model is again) == better and (choose_finding(tests) is None) == better
    plain = stub_test("load_bias", stub_model(5.0), 1.0, 100.0)
    assert verify_findings(selection_of(plain.before), [plain])[1] == [plain]


def added(selection: Selection, steps: list[SelectionStep]) -> Selection:
    """Steps added, nothing fitted."""
    return replace(selection, steps=(*selection.steps, *steps), model=steps[-1].found.model)


class Fake:
    """Tests of effects with given evidence, on stub models; what was added is remembered."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, gaps: list[float]):
        self.gaps, self.tried = gaps, list[tuple[str, ...]]()
        monkeypatch.setattr(forward_selection, "try_effects", self.try_effects)
        monkeypatch.setattr(Selection, "add", added)
        names = ["coulomb_friction", "load_bias"]
        monkeypatch.setattr(forward_selection, "list_candidates", lambda effects, judged, beside_torque: names)
        monkeypatch.setattr(forward_selection, "promises_anything", lambda model: False)
        monkeypatch.setattr(forward_selection, "list_promised", lambda model: [])
        monkeypatch.setattr(Model, "effects", ())

    def try_effects(self, current: Model, hold_out: Any, effects: list[str], *rest: Any) -> list[CandidateTest]:
        self.tried.append(tuple(effects))
        later = [gap for gap in self.gaps if gap < current.held.gap]
        after = later[0] if later else current.held.gap
        return [stub_test(effect, current, after, 1000.0 * (after < current.held.gap)) for effect in effects]


def test_effects_are_added_until_none_is_a_finding(monkeypatch: pytest.MonkeyPatch) -> None:
    fake = Fake(monkeypatch, [6.0, 3.0, 1.0])
    stages: list[Stage] = []
    found = select_forward(selection_of(stub_model(9.0)), ProgressReporter(stages.append, lambda: False))
    assert [step.found.model.held.gap for step in found.steps] == pytest.approx([6.0, 3.0, 1.0])
    assert all(step.found.effect == "coulomb_friction" for step in found.steps)  # of equals the earlier in the table
    assert all(step.rivals == ("load_bias",) for step in found.steps)
    assert found.model.at_floor and len(fake.tried) >= 3


@pytest.mark.parametrize(("known", "count"), [({"coulomb_friction"}, 0), ({"load_bias"}, 3), (set(), 3)])
def test_a_selection_ends_where_another_went_on(monkeypatch: pytest.MonkeyPatch, known: set[str], count: int) -> None:
    Fake(monkeypatch, [6.0, 3.0, 1.0])
    monkeypatch.setattr(StubModel, "effects", ("coulomb_friction",))
    found = select_forward(selection_of(stub_model(9.0)), SILENT, known=frozenset(known))
    assert len(found.steps) == count


@pytest.mark.parametrize("relevant", [True, False])
def test_a_line_has_to_promise_more_than_what_may_be_found_and_no_more(
    monkeypatch: pytest.MonkeyPatch, relevant: bool
) -> None:
    """A ripple worth 2,644 was not tried: a load that left most of the gap was likelier than its spectrum promised."""
    Fake(monkeypatch, [])
    monkeypatch.setattr(forward_selection, "list_candidates", lambda *_: ["load_bias", "torque_ripple"])
    promised: list[float] = []

    def try_effects(current: Model, hold_out: Any, effects: list[str], *rest: Any) -> list[CandidateTest]:
        if effects == ["torque_ripple"]:
            promised.extend(rest[2:])
        likely = 1000.0 * (effects == ["load_bias"])
        return [stub_test(name, current, 1.0 + 7.0 * (not relevant) * bool(likely), likely) for name in effects]

    monkeypatch.setattr(forward_selection, "try_effects", try_effects)
    monkeypatch.setattr(forward_selection, "choose_finding", lambda tests: None)
    monkeypatch.setattr(forward_selection, "find_pair", lambda *_: [])
    select_forward(selection_of(stub_model(9.0)), SILENT, pairs=False)
    assert promised == [1000.0 if relevant else 0.0]


def test_no_more_findings_than_the_most(monkeypatch: pytest.MonkeyPatch) -> None:
    gaps = [100.0 * 0.5**k for k in range(1, 12)]
    Fake(monkeypatch, [gap for gap in gaps if gap > 2.0])
    monkeypatch.setattr(thresholds, "MOST_FINDINGS", 3)
    assert len(select_forward(selection_of(stub_model(100.0)), SILENT).steps) == 3
    monkeypatch.setattr(thresholds, "MOST_FINDINGS", 4)
    assert len(select_forward(selection_of(stub_model(100.0)), SILENT).steps) == 4


@pytest.mark.parametrize(("most", "count"), [(3, 3), (4, 4), (9, 5)])
def test_what_is_likelier_than_a_finding_is_one_more(monkeypatch: pytest.MonkeyPatch, most: int, count: int) -> None:
    """As the sixth finding, an asymmetry was likelier than a load step and a dead zone that had stood in for it."""
    fake = Fake(monkeypatch, [100.0 * 0.5**k for k in range(1, 7)])
    evidence = iter([500.0, 300.0, 50.0, 60.0, 70.0, 40.0, 30.0])
    plain = fake.try_effects
    known: dict[float, float] = {}

    def speak(current: Model, hold_out: Any, effects: list[str], *rest: Any) -> list[CandidateTest]:
        said = known.setdefault(current.held.gap, next(evidence, 30.0))
        tests = plain(current, hold_out, effects, *rest)
        return [stub_test(one.effect, current, one.model.held.gap, said * (one.evidence > 0.0)) for one in tests]

    monkeypatch.setattr(forward_selection, "try_effects", speak)
    monkeypatch.setattr(thresholds, "MOST_FINDINGS", 3)
    monkeypatch.setattr(thresholds, "MOST_WITH_STAND_INS", most)
    assert len(select_forward(selection_of(stub_model(100.0)), SILENT).steps) == count


def test_one_response_tells_one_effect(monkeypatch: pytest.MonkeyPatch) -> None:
    Fake(monkeypatch, [100.0 * 0.5**k for k in range(1, 5)])
    start = stub_model(100.0)
    assert may_hide_pair(selection_of(start))
    assert len(select_forward(selection_of(start), SILENT).steps) > thresholds.MOST_OF_ONE_RESPONSE == 1
    show_one_response(monkeypatch)
    once = stub_model(100.0)
    assert not may_hide_pair(selection_of(once))
    assert len(select_forward(selection_of(once), SILENT).steps) == 1


@pytest.mark.parametrize(("side", "count"), [(BELOW, 1), (ABOVE, 2)])
def test_one_response_tells_a_second_effect_that_explains_all_the_rest(
    monkeypatch: pytest.MonkeyPatch, side: float, count: int
) -> None:
    show_one_response(monkeypatch)
    rest = sqrt(1.0 + (1.0 - side * thresholds.STAND_IN_SHARE) * (40.0**2 - 1.0))
    Fake(monkeypatch, [40.0, rest, 1.0])
    assert len(select_forward(selection_of(stub_model(100.0)), SILENT).steps) == count  # and never a third


def show_one_response(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let stub models have been fitted to all of one response."""
    monkeypatch.setattr(stub_models, "stub_held", lambda *given: replace(stub_held(*given), seen=True, confirms=False))


def test_friction_is_selected_from_a_recording_that_hides_it(monkeypatch: pytest.MonkeyPatch) -> None:
    names = ("coulomb_friction", "quadratic_drag", "load_bias")
    lacking = lambda effects, judged, beside_torque: [name for name in names if name not in effects]  # noqa: E731
    monkeypatch.setattr(forward_selection, "list_candidates", lacking)
    estimate, hold_out = fitted(ks=0.4)
    start = begin_selection(estimate, hold_out, 1)
    assert start.steps == () and start.model.above_floor
    found = select_forward(start, SILENT)
    assert [step.found.effect for step in found.steps] == ["coulomb_friction"]
    assert found.steps[0].explains > 0.99 and found.model.at_floor
    ks = found.model.estimate.parameters.value("ks")
    assert ks == pytest.approx(0.4, rel=1e-3) and found.model.estimate.simulations > start.model.estimate.simulations


@pytest.mark.parametrize(("likely", "gap", "refused"), [(2.0, 8.9, True), (0.5, 8.9, False), (2.0, 4.0, False)])
def test_it_is_told_where_something_likely_takes_away_too_little(
    likely: float, gap: float, refused: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    Fake(monkeypatch, [])
    monkeypatch.setattr(candidate_test, "explains_standstills", lambda *_: False)
    evidence = likely * likelihood_threshold()

    def try_effects(current: Model, hold_out: Any, effects: list[str], *rest: Any) -> list[CandidateTest]:
        after = min(gap, current.held.gap)
        return [stub_test(name, current, after, evidence * (after < current.held.gap)) for name in effects]

    monkeypatch.setattr(forward_selection, "try_effects", try_effects)
    found = select_forward(selection_of(stub_model(9.0)), SILENT, pairs=False)
    assert found.refused is refused and bool(found.steps) is (gap == 4.0)


@pytest.mark.parametrize(("gap", "promised", "refused"), [(0.9, True, True), (0.9, False, False), (9.0, True, False)])
def test_it_is_told_where_something_is_promised_at_the_floor(
    gap: float, promised: bool, refused: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No gap shows there what takes away little of a coarse sensor's; likelihoods beside a torque do."""
    Fake(monkeypatch, [])
    monkeypatch.setattr(forward_selection, "promises_anything", lambda model: promised)
    found = select_forward(selection_of(stub_model(gap, 0.0)), SILENT, pairs=False)
    assert found.refused is refused and found.model.at_floor is (gap < 1.0)


@pytest.mark.parametrize(
    ("beside", "promised", "tried"),
    [
        (True, ["load_bias"], ["load_bias", "voltage_limit"]),
        (True, [], []),
        (False, ["load_bias"], []),
        (True, ["warm_up"], []),
    ],
)
def test_what_leaves_nothing_that_lasts_is_given_only_what_is_promised(
    beside: bool, promised: list[str], tried: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """And beside that a limit, which no scan can promise: a sag was named in the place of a likelier one, untried."""
    fake, names = Fake(monkeypatch, []), ["coulomb_friction", "load_bias", "voltage_limit"]
    monkeypatch.setattr(forward_selection, "list_candidates", lambda *rest: names)
    monkeypatch.setattr(forward_selection, "list_promised", lambda model: promised)
    monkeypatch.setattr(forward_selection, "find_promised_pair", lambda selection: [])
    errors = ErrorModel(0.0, 0.0, 0.0, 1.0)
    quiet = replace(stub_model(0.9, 0.0), learned=errors if beside else None)
    assert quiet.quiet
    select_forward(selection_of(quiet), SILENT)
    assert sorted(effect for effects in fake.tried for effect in effects) == tried


@pytest.mark.parametrize("beside", [True, False])
def test_two_that_are_promised_together_are_selected_beside_a_torque(
    beside: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    Fake(monkeypatch, [])
    start = replace(stub_model(0.9, 0.0), learned=ErrorModel(0.0, 0.0, 0.0, 1.0) if beside else None)
    first = stub_test("coulomb_friction", start, 0.9, 100.0)
    pair = [step_of(first), step_of(stub_test("quadratic_drag", first.model, 0.9, 100.0), explains=1.0)]
    monkeypatch.setattr(forward_selection, "find_promised_pair", lambda selection: [] if selection.steps else pair)
    assert list(select_forward(selection_of(start), SILENT).steps) == (pair if beside else [])


@pytest.mark.parametrize(
    ("line", "counted", "follows", "left", "told"),
    [
        (True, True, True, 0.9, False),
        (False, True, True, 0.9, True),
        (False, False, True, 0.9, False),
        (False, True, False, 0.9, False),  # many turns a row
        (False, True, True, 0.99 * thresholds.SHRINKING_GAP, True),
        (False, True, True, 1.01 * thresholds.SHRINKING_GAP, False),  # it follows a random torque
    ],
)
def test_a_load_once_a_turn_is_tried_where_no_line_is_found(
    line: bool, counted: bool, follows: bool, left: float, told: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of ripples of 0.15 and 0.72 V beside friction, lines promised nothing, and they were likelier by 64 and 45."""
    monkeypatch.setattr(Intervals, "tells_of_disc", counted)
    monkeypatch.setattr(Intervals, "follows_turns", follows)
    monkeypatch.setattr(CandidateTest, "relevant", True)
    monkeypatch.setattr(forward_selection, "list_candidates", lambda *_: ["torque_ripple"])
    monkeypatch.setattr(forward_selection, "promises_anything", lambda model: False)
    monkeypatch.setattr(forward_selection, "find_pair", lambda *_: [])
    monkeypatch.setattr(Selection, "add", added)
    tried: list[Model] = []

    def find_no_line(current: Model, hold_out: Any, effects: list[str], *_: Any) -> list[CandidateTest]:
        none = CandidateTest("torque_ripple", current, current)
        return [stub_test("torque_ripple", current, 5.0, 1.0) if line else none for _ in effects]

    def turn(current: Model, _: Any) -> CandidateTest:
        tried.append(current)
        return stub_test("torque_ripple", current, left * current.held.gap, 1000.0 / len(tried) ** 9)

    monkeypatch.setattr(forward_selection, "try_effects", find_no_line)
    monkeypatch.setattr(forward_selection, "try_load_once_a_turn", turn)
    monkeypatch.setattr(forward_selection, "has_few_turns", lambda _: False)
    found = select_forward(selection_of(stub_model(9.0)), SILENT)
    assert [step.found.effect for step in found.steps] == (["torque_ripple"] if told else [])
    assert bool(tried) is (counted and follows and not line)


def test_a_load_once_a_turn_is_no_disc_in_few_turns(monkeypatch: pytest.MonkeyPatch) -> None:
    """The spectrum promises less of it than the disc gains, which is then likely and takes away most."""
    time = 0.01 * np.arange(800)
    volts = np.repeat([3.0, 6.0, 4.0, 7.0], 200)
    load = {"ripple_voltage": 1.2, "ripple_cycles": 1.0, "ripple_phase": 0.3}
    run = check(record({"kv": 2.0, "ka": 0.2, **load}, time, volts, seed=1)[0])
    start = begin([run], (), Request(), bool).selection
    tests: list[CandidateTest] = []

    def choose(tried: list[CandidateTest]) -> CandidateTest | None:
        tests[:] = tried
        return None

    monkeypatch.setattr(forward_selection, "choose_finding", choose)
    monkeypatch.setattr(forward_selection, "find_pair", lambda *_: [])
    select_forward(start, SILENT)
    lines = {test.effect: test.evidence for test in tests if test.effect in ("torque_ripple", "encoder_eccentricity")}
    assert len(lines) == 2 and sum(test.effect == "torque_ripple" for test in tests) == 1
    assert lines["torque_ripple"] > lines["encoder_eccentricity"] > likelihood_threshold()
