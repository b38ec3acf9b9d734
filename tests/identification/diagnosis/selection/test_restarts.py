"""A selection begins anew where its first effect leads nowhere."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest
from stub_models import LASTING_FLOOR, StubModel, rescored, stub_model, stub_test, with_effects
from stub_selections import selection_of, step_of

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_test import CandidateTest, likelihood_threshold
from motor_identification.diagnosis.selection import restarts as module
from motor_identification.diagnosis.selection.restarts import (
    begin_from_kindred,
    list_other_firsts,
    retry_with_another_first,
    retry_with_dependent,
    retry_with_pair,
)
from motor_identification.diagnosis.selection.selection import SelectionStep
from motor_identification.noise.error_model import ErrorModel
from motor_identification.progress import ProgressReporter

BELOW, ABOVE = 0.999, 1.001
AT, OVER = 0.999 * thresholds.EXPLAINED_GAP, 1.2 * thresholds.EXPLAINED_GAP  # of a gap, the floor being 1
SILENT = ProgressReporter(lambda stage: None, lambda: False)


def test_other_first_effects_are_nearly_as_likely() -> None:
    before, share = stub_model(9.0), thresholds.SECOND_START_EVIDENCE
    found = stub_test("load_bias", before, 5.0, 100.0)
    names = ("dead_zone", "supply_sag", "quadratic_drag")
    near = [stub_test(name, before, 5.0, 100.0 * share * ABOVE) for name in names]
    far = stub_test("coulomb_friction", before, 5.0, 100.0 * share * BELOW)
    assert list_other_firsts(step_of(found, *near, far)) == near[: thresholds.SECOND_STARTS]
    assert list_other_firsts(step_of(found, near[0], far)) == near[:1]
    weak = stub_test("load_bias", before, 5.0, likelihood_threshold() * 1.1)
    by_chance = stub_test("dead_zone", before, 5.0, likelihood_threshold() * BELOW)
    assert list_other_firsts(step_of(weak, by_chance)) == []


def test_a_load_that_is_there_from_the_start_is_no_first_step_either(monkeypatch: pytest.MonkeyPatch) -> None:
    """In a speed loop it was no finding, was tried as another first one, and stayed: a load step at no known time."""
    before = stub_model(9.0)
    found, others = stub_test("transport_delay", before, 5.0, 100.0), ("load_step", "load_bias")
    tests = [stub_test(name, before, 5.0, 95.0) for name in others]
    assert list_other_firsts(step_of(found, *tests)) == tests
    monkeypatch.setattr(module, "is_there_from_the_start", lambda test: test is tests[0])
    assert list_other_firsts(step_of(found, *tests)) == tests[1:]


def test_what_does_not_come_back_over_the_angle_is_no_first_step(monkeypatch: pytest.MonkeyPatch) -> None:
    """A disc that turned by 0.56 was no finding, and a selection began with its eccentricity."""
    before = stub_model(9.0)
    found, others = stub_test("transport_delay", before, 5.0, 100.0), ("encoder_eccentricity", "load_bias")
    tests = [stub_test(name, before, 5.0, 95.0) for name in others]
    assert list_other_firsts(step_of(found, *tests)) == tests
    monkeypatch.setattr(module, "comes_back", lambda test: test is not tests[0])
    assert list_other_firsts(step_of(found, *tests)) == tests[1:]


@pytest.mark.parametrize(
    ("found", "begun"),
    [
        ("coulomb_friction", ["dead_zone"]),
        ("dead_zone", ["coulomb_friction"]),
        ("load_bias", ["load_step"]),
        ("transport_delay", []),  # what is kindred to it was not likely
        ("supply_sag", []),
    ],
)
def test_what_is_kindred_to_the_first_finding_begins_a_selection(
    found: str, begun: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    before, least = stub_model(9.0), likelihood_threshold()
    sizes = {"dead_zone": 1.1, "coulomb_friction": 1.1, "load_step": 1.1, "armature_inductance": 0.9, "warm_up": 9.0}
    others = [stub_test(name, before, 8.0, times * least) for name, times in sizes.items() if name != found]
    monkeypatch.setattr(module, "is_there_from_the_start", lambda test: False)
    monkeypatch.setattr(module, "begin_selection", lambda estimate, hold_out, workers, steps: steps)
    first = selection_of(stub_model(4.0), step_of(stub_test(found, before, 5.0, 100.0), *others))
    steps = [one for (one,) in begin_from_kindred(first)]  # type: ignore[misc]
    assert [one.found.effect for one in steps] == begun
    assert begin_from_kindred(selection_of(stub_model(9.0))) == []
    monkeypatch.setattr(module, "is_there_from_the_start", lambda test: True)
    assert begin_from_kindred(first) == []


def test_nothing_begins_anew_without_a_step_or_at_the_floor() -> None:
    nothing = selection_of(stub_model(9.0))
    assert retry_with_another_first(nothing, SILENT) is nothing
    found = selection_of(stub_model(1.1, 0.0), step_of(stub_test("load_bias", stub_model(9.0), 1.0, 100.0)))
    assert retry_with_another_first(found, SILENT) is found


@pytest.mark.parametrize(
    ("likelier", "gap", "named", "rivals"),
    [
        (4.9, 0.9995, "coulomb_friction", ("load_bias",)),  # the same motion in other words: both, the first as it was
        (5.1, 0.9995, "load_bias", ()),
        (4.9, 0.998, "load_bias", ()),
        (-0.4, 1.0005, "coulomb_friction", ("load_bias",)),
        (-0.6, 1.0005, "coulomb_friction", ()),
        (-0.4, 1.002, "coulomb_friction", ()),
    ],
)
def test_another_first_effect_that_leads_to_the_same_motion_is_a_rival(
    monkeypatch: pytest.MonkeyPatch, likelier: float, gap: float, named: str, rivals: tuple[str, ...]
) -> None:
    before, after = stub_model(9.0), stub_model(4.0)
    first = stub_test("coulomb_friction", before, 4.0, 100.0)
    other = stub_test("load_bias", before, 4.0, 99.0)
    step = replace(step_of(first), tests=(first, other), rivals=("load_bias",), explains=0.5)
    begun = replace(selection_of(after, step), model=after)
    again = rescored(replace(after, held=stub_model(4.0 * gap).held), likelihood=after.likelihood + likelier)
    second = replace(step_of(other), rivals=())
    monkeypatch.setattr(module, "begin_selection", lambda *rest: begun)
    monkeypatch.setattr(module, "select_forward", lambda *rest, **how: replace(begun, steps=(second,), model=again))
    found = retry_with_another_first(begun, SILENT)
    assert found.steps[0].found.effect == named and found.steps[0].rivals == rivals


@pytest.mark.parametrize(
    ("steps", "further", "gap", "likelier", "taken"),
    [
        (thresholds.MANY_STEPS, 2, 1.0, 0.0, True),
        (thresholds.MANY_STEPS - 1, 1, 1.0, 0.0, False),  # a few findings are not doubted
        (thresholds.MANY_STEPS, thresholds.MANY_STEPS, 1.0, 7.0, False),  # the same in another order
        (thresholds.MANY_STEPS, thresholds.MANY_STEPS, 1.0, 9.0, True),  # as many, of which one is another
        (thresholds.MANY_STEPS, thresholds.MANY_STEPS + 1, 1.0, 9.0, False),
        (thresholds.MANY_STEPS, 2, 1.0, -0.1, False),
        (thresholds.MANY_STEPS, 2, 4.0, 9.0, False),  # it explains less
    ],
)
def test_of_two_complete_models_the_one_with_fewer_findings_is_taken_or_the_likelier_one(
    monkeypatch: pytest.MonkeyPatch, steps: int, further: int, gap: float, likelier: float, taken: bool
) -> None:
    before = stub_model(9.0)
    first, other = stub_test("dead_zone", before, 4.0, 100.0), stub_test("coulomb_friction", before, 4.0, 99.0)
    later = step_of(stub_test("load_bias", before, 1.0, 50.0))
    many = selection_of(stub_model(1.0, 0.0), step_of(first, other), *[later] * (steps - 1))
    model = stub_model(gap, 0.0 if gap == 1.0 else None, likelier)
    fewer = replace(many, steps=(step_of(other), *[later] * (further - 1)), model=model)
    monkeypatch.setattr(module, "begin_selection", lambda *rest: many)
    monkeypatch.setattr(module, "select_forward", lambda *rest, **how: fewer)
    assert (retry_with_another_first(many, SILENT) is fewer) is taken


@pytest.mark.parametrize(
    ("slow", "gap", "likelier", "taken"),
    [
        (1.01, 0.49, 1.0, True),
        (1.01, 0.51, 1.0, False),
        (1.01, 0.49, -1.0, False),
        (0.99, 0.49, 1.0, False),  # of a motion that is not at rest with it
    ],
)
def test_a_static_curve_that_a_slow_torque_makes_complete_is_doubted(
    monkeypatch: pytest.MonkeyPatch, slow: float, gap: float, likelier: float, taken: bool
) -> None:
    """A limit of the voltage, where friction under a coasting bridge leaves a third: a staircase of 5 s a level."""
    before, left = stub_model(40.0), 20.0
    first, other = stub_test("voltage_limit", before, left, 100.0), stub_test("coast_drive", before, 25.0, 90.0)
    begun = selection_of(replace(stub_model(left), random=True), step_of(first, other))
    assert thresholds.HALVED_GAP == 0.5
    errors = ErrorModel(0.0, 0.0, 1.0, slow * thresholds.SLOW_TORQUE / begun.model.lag.rate)
    monkeypatch.setattr(StubModel, "errors", errors)
    model = replace(stub_model(gap * left, likelihood=begun.model.likelihood + likelier), random=True)
    pair = replace(begun, steps=(step_of(other), step_of(first)), model=model)
    monkeypatch.setattr(module, "begin_selection", lambda *rest: begun)
    monkeypatch.setattr(module, "select_forward", lambda *rest, **how: pair)
    assert begun.model.complete
    assert (retry_with_another_first(begun, SILENT) is pair) is taken


@pytest.mark.parametrize(
    ("lasting", "left", "likelier", "taken"),
    [
        (1.01, 0.49, 1.0, True),
        (1.01, 0.51, 1.0, False),
        (1.01, 0.49, -1.0, False),
        (0.99, 0.49, 1.0, False),  # nothing lasts
    ],
)
def test_what_a_coarse_sensor_hides_from_row_to_row_is_doubted_where_it_lasts(
    monkeypatch: pytest.MonkeyPatch, lasting: float, left: float, likelier: float, taken: bool
) -> None:
    """A dead zone in the place of a friction and a warming-up: of 24 slots at 500 rows a second."""
    before, gap = stub_model(5.0), 1.29
    least = lasting * thresholds.LASTING_GAP * LASTING_FLOOR
    first, other = stub_test("dead_zone", before, gap, 100.0), stub_test("coulomb_friction", before, gap, 90.0)
    begun = selection_of(stub_model(gap, least), step_of(first, other))
    model = stub_model(gap, left * least, begun.model.likelihood + likelier)
    pair = replace(begun, steps=(step_of(other), step_of(first)), model=model)
    monkeypatch.setattr(module, "begin_selection", lambda *rest: begun)
    monkeypatch.setattr(module, "select_forward", lambda *rest, **how: pair)
    assert begun.model.complete and begun.model.at_floor
    assert (retry_with_another_first(begun, SILENT) is pair) is taken


@pytest.mark.parametrize(
    ("first", "gap", "confirms", "likelier", "smaller", "taken"),
    [
        ("load_step", OVER, True, 1.0, 0.9, True),
        ("load_bias", OVER, True, 1.0, 0.9, False),  # which needs no instant
        ("load_step", AT, True, 1.0, 0.9, False),  # nothing is left
        ("load_step", OVER, False, 1.0, 0.9, False),  # one response tells no two
        ("load_step", OVER, True, -1.0, 0.9, False),
        ("load_step", OVER, True, 1.0, 1.1, False),
    ],
)
def test_two_effects_together_are_tried_instead_of_an_instant_that_leaves_a_gap(
    monkeypatch: pytest.MonkeyPatch,
    first: str,
    gap: float,
    confirms: bool,
    likelier: float,
    smaller: float,
    taken: bool,
) -> None:
    """In steps one way a load step takes more than a friction or a drag, each alone."""
    before, model = stub_model(9.0), stub_model(gap, 0.0)
    model = replace(model, held=replace(model.held, confirms=confirms))
    friction, again = (stub_test(name, before, 8.0, 50.0) for name in ("coulomb_friction", "load_step"))
    begun = selection_of(model, step_of(stub_test(first, before, gap, 100.0), friction, again))
    other = selection_of(rescored(stub_model(smaller * gap, 0.0), likelihood=model.likelihood + likelier))
    tried: list[list[str]] = []

    def find_pair(start: Any, tests: list[CandidateTest], reporter: Any) -> list[SelectionStep]:
        tried.append([test.effect for test in tests])
        return [step_of(friction)]

    start = SimpleNamespace(add=lambda pair: None, model=object(), hold_out=object(), workers=1)

    def try_effects(model: Any, hold_out: Any, effects: list[str], *rest: Any) -> list[CandidateTest]:
        """By what is held out of the new start: of what the first one did, directions may have been read otherwise."""
        assert model is start.model and hold_out is start.hold_out
        return [stub_test(effect, before, 8.0, 50.0) for effect in effects]

    monkeypatch.setattr(module, "find_pair", find_pair)
    monkeypatch.setattr(module, "try_effects", try_effects)
    monkeypatch.setattr(module, "begin_selection", lambda *rest: start)
    monkeypatch.setattr(module, "select_forward", lambda *rest, **how: other)
    assert retry_with_pair(begun, SILENT) is (other if taken else begun)
    assert all(names == ["coulomb_friction"] for names in tried)


@pytest.mark.parametrize(("random", "beside", "tried"), [(True, True, False), (True, False, True), (False, True, True)])
def test_no_two_are_tried_instead_of_an_instant_that_something_was_found_beside(
    monkeypatch: pytest.MonkeyPatch, random: bool, beside: bool, tried: bool
) -> None:
    """If nothing but a random torque is left."""
    before, model = stub_model(9.0), replace(stub_model(OVER, 0.0), random=random)  # type: ignore[call-arg]
    steps = [step_of(stub_test(name, before, OVER, 100.0)) for name in ("load_step", "coulomb_friction")]
    begun = selection_of(model, *steps[: 1 + beside])
    assert model.complete is random
    asked: list[object] = []
    monkeypatch.setattr(module, "begin_selection", lambda *rest: begun)
    monkeypatch.setattr(module, "try_effects", lambda *rest: [])
    monkeypatch.setattr(module, "find_pair", lambda *rest: asked.append(rest) or [])
    assert retry_with_pair(begun, SILENT) is begun and bool(asked) is tried


@pytest.mark.parametrize(
    ("found", "gain", "gap", "end", "tried", "taken"),
    [
        ("dead_zone", ABOVE, 4.0, 4.5, True, True),
        ("dead_zone", BELOW, 4.0, 4.5, True, False),  # no likelier than what was found in its place
        ("dead_zone", ABOVE, 4.0, 5.5, True, False),  # what comes of it leaves more
        ("dead_zone", ABOVE, 9.0, 4.5, True, False),  # no finding
        ("coulomb_friction", ABOVE, 4.0, 4.5, False, False),  # beside which it was tried already
        ("load_bias", ABOVE, 4.0, 4.5, False, False),  # which no friction is kindred to
    ],
)
def test_what_comes_with_a_kindred_effect_alone_is_tried_beside_that(
    monkeypatch: pytest.MonkeyPatch, found: str, gain: float, gap: float, end: float, tried: bool, taken: bool
) -> None:
    """A dead zone stood before the friction that a motor breaks away with, and a drag that was not there beside it."""
    before, least = stub_model(9.0), likelihood_threshold()
    first = stub_test(found, before, 5.0, 100.0)
    friction = stub_test("coulomb_friction", before, 5.0, 95.0)
    friction = replace(friction, model=with_effects(friction.model, "coulomb_friction"))
    friction = first if found == "coulomb_friction" else friction
    current = rescored(with_effects(stub_model(5.0), found), likelihood=110.0)
    begun = replace(selection_of(current, step_of(first, friction)), model=current)
    again = selection_of(friction.model, step_of(friction))
    asked: list[list[str]] = []

    def try_effects(model: Any, hold_out: Any, effects: list[str], *rest: Any) -> list[CandidateTest]:
        asked.append(effects)
        return [stub_test(effect, model, gap, 110.0 + gain * least - model.likelihood) for effect in effects]

    other = selection_of(rescored(stub_model(end), likelihood=110.0 + 2.0 * least))
    monkeypatch.setattr(module, "list_candidates", lambda effects, *_: ["static_friction", "quadratic_drag"])
    monkeypatch.setattr(module, "begin_selection", lambda *rest: again)
    monkeypatch.setattr(module, "try_effects", try_effects)
    monkeypatch.setattr(module, "select_forward", lambda *rest, **how: other)
    assert retry_with_dependent(begun, SILENT) is (other if taken else begun)
    assert asked == ([["static_friction"]] if tried else [])


def test_nothing_is_tried_beside_a_kindred_effect_that_was_judged_beside_a_torque(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    before = stub_model(9.0)
    first, friction = stub_test("dead_zone", before, 5.0, 100.0), stub_test("coulomb_friction", before, 5.0, 95.0)
    model = replace(with_effects(friction.model, "coulomb_friction"), learned=ErrorModel(0.0, 0.0, 0.1, 0.1))
    begun = selection_of(with_effects(stub_model(5.0), "dead_zone"), step_of(first, replace(friction, model=model)))
    monkeypatch.setattr(module, "list_candidates", lambda *_: ["static_friction"])
    monkeypatch.setattr(module, "begin_selection", lambda *rest: pytest.fail("it was tried"))
    assert retry_with_dependent(begun, SILENT) is begun
