"""Pairs that hide each other: what is tried with what, and where."""

from dataclasses import replace
from math import sqrt

import numpy as np
import pytest
from stub_models import LASTING_FLOOR, stub_held, stub_model, stub_test, with_effects
from stub_selections import selection_of, step_of

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model, Score
from motor_identification.diagnosis.candidate_test import CandidateTest, likelihood_threshold
from motor_identification.diagnosis.selection import hidden_pairs
from motor_identification.diagnosis.selection.hidden_pairs import (
    find_closing_pair,
    find_pair,
    list_compromises,
    list_partners,
    may_hide_pair,
)
from motor_identification.diagnosis.selection.selection import Selection, SelectionStep
from motor_identification.noise.error_model import ErrorModel
from motor_identification.progress import ProgressReporter

BELOW, ABOVE = 0.999, 1.001
SILENT = ProgressReporter(lambda stage: None, lambda: False)


def test_partners_are_likely_and_not_periodic_and_few() -> None:
    before, least = stub_model(5.0), likelihood_threshold()
    names = ("coulomb_friction", "quadratic_drag", "load_bias", "dead_zone")  # of equals the most common
    tests = [stub_test(name, before, 4.9, ABOVE * least) for name in names]
    ripple, weak = stub_test("torque_ripple", before, 4.0, 500.0), stub_test("load_step", before, 4.9, BELOW * least)
    assert list_partners([ripple, *tests, weak]) == tests[: thresholds.PAIR_PARTNERS]
    assert list_partners([tests[1], tests[0], weak]) == tests[:2]


@pytest.mark.parametrize(
    ("effect", "evidence", "explains", "tried"),
    [
        ("coulomb_friction", -54.0, 1.01, ["static_friction"]),
        ("coulomb_friction", -54.0, 0.99, []),
        ("load_bias", -54.0, 1.01, []),  # nothing comes with it only
        ("torque_ripple", -54.0, 1.01, []),
    ],
)
def test_what_another_comes_with_is_tried_with_that_however_unlikely_alone(
    monkeypatch: pytest.MonkeyPatch, effect: str, evidence: float, explains: float, tried: list[str]
) -> None:
    """A motor that breaks away: a Coulomb friction holds it too little, and slows it too much."""
    before, share = stub_model(5.0), explains * thresholds.COMPROMISE_SHARE
    first = stub_test(effect, before, sqrt(25.0 - share * 24.0), evidence)
    first = replace(first, model=with_effects(first.model, effect))
    second = stub_test("static_friction", first.model, 1.0, 300.0)
    asked: list[str] = []

    def try_effects(current: Model, hold_out: object, effects: list[str], *rest: object) -> list[CandidateTest]:
        asked.extend(effects)
        return [second] if "static_friction" in effects else []

    monkeypatch.setattr(hidden_pairs, "try_effects", try_effects)
    assert list_partners([first]) == []
    found = find_pair(selection_of(before), [first], SILENT)
    assert asked == tried
    assert [step.found.effect for step in found] == ([effect, *tried] if tried else [])


@pytest.mark.parametrize(
    ("gap", "times", "left", "found"),
    [
        (1.2, ABOVE, BELOW, True),
        (1.2, BELOW, BELOW, False),  # nothing lasts
        (1.2, ABOVE, ABOVE, False),  # and still does: a torque, perhaps
        (5.0, ABOVE, ABOVE, True),  # where more is left than counts hide, whatever lasts
    ],
)
def test_a_gap_that_coarse_counts_hide_from_row_to_row_is_asked_for_a_pair(
    monkeypatch: pytest.MonkeyPatch, gap: float, times: float, left: float, found: bool
) -> None:
    """A friction and a limit of the voltage, in speeds of 3.4 counts a row at most: 2.2 times the floor lasted."""
    lasting = thresholds.LASTING_GAP * LASTING_FLOOR
    before = stub_model(gap, min(times * lasting, gap))
    first = stub_test("coulomb_friction", before, gap, 20.0)
    second = stub_test("voltage_limit", first.model, 1.0, 20.0)
    second = replace(second, model=stub_model(min(gap, 1.2), left * lasting, 40.0))
    monkeypatch.setattr(hidden_pairs, "try_effects", lambda *rest: [second])
    monkeypatch.setattr(hidden_pairs, "choose_finding", lambda tests: tests[0])
    selection = selection_of(before)
    pair = find_pair(selection, [first], SILENT) if may_hide_pair(selection) else []
    assert bool(pair) is found


def test_what_is_likely_alone_is_no_compromise() -> None:
    before, least = stub_model(5.0), likelihood_threshold()
    for times, compromise in ((0.99, True), (1.01, False)):
        test = stub_test("coulomb_friction", before, 4.0, times * least)
        assert (list_compromises([test]) == [test]) is compromise
        assert (list_partners([test]) == [test]) is not compromise


@pytest.mark.parametrize(("opens", "left", "found"), [(6.0, 3.4, True), (6.0, 3.6, False), (4.9, 3.4, False)])
def test_beside_a_torque_what_is_likely_but_opens_the_gap_is_tried_with_what_closes_it(
    monkeypatch: pytest.MonkeyPatch, opens: float, left: float, found: bool
) -> None:
    """Friction on a coasting bridge: a torque of 4.5 % was learned in its place, and made the model complete."""
    errors, gains = ErrorModel(0.0, 0.0, 0.1, 0.05), np.ones(40)
    before = replace(stub_model(5.0), learned=errors, score=Score(0.0, scored=100, moments=0.0 * gains))
    first = replace(stub_model(opens), learned=errors, score=Score(40.0, held_out=1.0, scored=100, moments=gains))
    opening = CandidateTest("quadratic_drag", before, first)
    closing = CandidateTest("coast_drive", first, replace(first, held=stub_held(left)))
    step = step_of(closing)

    def pair(selection: Selection, tests: list[CandidateTest], reporter: object) -> list[SelectionStep]:
        assert tests == [opening]
        return [step_of(opening), step]

    monkeypatch.setattr(hidden_pairs, "find_pair", pair)
    steps = find_closing_pair(selection_of(before), [opening], SILENT)
    assert ([one.found.effect for one in steps] == ["quadratic_drag", "coast_drive"]) is found


def test_pairs_are_tried_above_the_floor_and_only_early() -> None:
    step = step_of(stub_test("load_bias", stub_model(9.0), 5.0, 100.0))
    few, many = [step] * (thresholds.PAIR_MOST_STEPS - 1), [step] * thresholds.PAIR_MOST_STEPS
    assert may_hide_pair(selection_of(stub_model(5.0), *few))
    assert not may_hide_pair(selection_of(stub_model(5.0), *many))
    assert not may_hide_pair(selection_of(stub_model(1.2, 0.0), *few))
