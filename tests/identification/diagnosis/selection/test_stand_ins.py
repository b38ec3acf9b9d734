"""Drop what may only stand in for something: alone in the order of finding, or beside all others."""

from dataclasses import replace
from math import sqrt
from types import SimpleNamespace
from typing import cast

import pytest
from stub_models import stub_model, stub_test, with_effects
from stub_selections import step_of, stub_selection, stub_step

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest, share_explained
from motor_identification.diagnosis.selection import stand_ins
from motor_identification.diagnosis.selection.stand_ins import (
    doubt_instants,
    drop_stand_ins,
    drop_stand_ins_of_either,
    drop_unneeded,
    has_same_evidence,
    is_own_evidence,
    keep_confirmed,
)
from motor_identification.discrepancy.structure import Structure

BELOW, ABOVE = 0.999, 1.001


@pytest.mark.parametrize(("times", "kept"), [(BELOW, 0), (ABOVE, 2)])
def test_a_stand_in_goes_and_all_that_was_found_after_it(times: float, kept: int) -> None:
    steps = stub_step("quadratic_drag", times * thresholds.STAND_IN_SHARE), stub_step("load_bias", 0.99)
    left = drop_stand_ins(stub_selection(5.0, *steps))
    assert left.steps == steps[:kept]
    assert (left.model is steps[0].before) == (kept == 0)


@pytest.mark.parametrize(("times", "kept"), [(BELOW, 1), (ABOVE, 0)])
def test_at_the_floor_nothing_stands_in(times: float, kept: int) -> None:
    selection = stub_selection(times * thresholds.EXPLAINED_GAP, stub_step("load_bias", 0.5))
    assert len(drop_stand_ins(selection).steps) == kept


@pytest.mark.parametrize("held", [True, False])
def test_what_holds_the_motor_is_its_own_evidence_where_it_explains_standstills(
    monkeypatch: pytest.MonkeyPatch, held: bool
) -> None:
    asked: list[tuple[Model, Model]] = []
    monkeypatch.setattr(stand_ins, "explains_standstills", lambda *models: bool(asked.append(models)) or held)
    steps = stub_step("coulomb_friction", 0.7), stub_step("quadratic_drag", 0.3)
    left = drop_stand_ins(stub_selection(5.0, *steps))
    assert left.steps == steps[: int(held)] and left.model is (steps[1].before if held else steps[0].before)
    assert asked == [(steps[0].before, steps[1].before)]


@pytest.mark.parametrize(
    ("effect", "explains", "left", "kept"),
    [
        ("transport_delay", ABOVE * thresholds.APART_SHARE, ("spectrum",), 1),
        ("transport_delay", BELOW * thresholds.APART_SHARE, ("spectrum",), 0),
        ("transport_delay", 0.9, ("spectrum", "past"), 0),  # its own variable: it may stand in for another lag
        ("transport_delay", 0.9, (), 0),
        (
            "coast_drive",
            ABOVE * thresholds.APART_SHARE,
            ("spectrum", "past"),
            1,
        ),  # of the moment alone: it is explained
        ("coast_drive", BELOW * thresholds.APART_SHARE, ("past",), 0),
        ("coast_drive", 0.9, ("past", "speed_voltage"), 0),
        ("backlash", 0.9, ("past",), 0),
        ("warm_up", 0.9, ("past",), 0),
        ("warm_up", ABOVE * thresholds.SLOW_SHARE, ("time",), 1),  # heated otherwise than the table has it
        ("warm_up", BELOW * thresholds.SLOW_SHARE, ("time",), 0),
        ("load_step", 0.9, ("time",), 0),
        ("coulomb_friction", 0.9, ("angle", "time"), 1),
    ],
)
def test_what_only_angle_or_time_predict_is_nothing_that_a_finding_stands_in_for(
    effect: str, explains: float, left: tuple[str, ...], kept: int
) -> None:
    selection = stub_selection(5.0, stub_step(effect, explains))
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
    monkeypatch.setattr(stand_ins, "explains_standstills", lambda *models: False)
    monkeypatch.setattr(stand_ins, "explains_calm", lambda *models: False)
    rest = (Structure("past", 0.8, 100.0), Structure("drive", 0.8 * drive, 100.0))
    model = cast(Model, SimpleNamespace(complete=False, structure=rest))
    assert len(drop_stand_ins(replace(stub_selection(5.0, stub_step(effect, explains)), model=model)).steps) == kept
    left = replace(rest[0], significance=0.0)  # no curve over the past is certain
    model = cast(Model, SimpleNamespace(complete=False, structure=(left, rest[1])))
    assert not drop_stand_ins(replace(stub_selection(5.0, stub_step(effect, explains)), model=model)).steps


def stub_with(gap: float, *effects: str) -> Model:
    return with_effects(stub_model(gap, 0.0), *effects)


def gap_with(share: float, after: float) -> float:
    """The gap [rad/s] of which so much of the excess goes, where `after` is left and the floor is 1."""
    return sqrt((after**2 - share) / (1.0 - share))


@pytest.mark.parametrize(
    ("first", "second", "alone", "kept"),
    [
        (ABOVE, ABOVE, 0.5, 2),  # beside each other both are needed, whatever each explains alone
        (ABOVE, BELOW, ABOVE * thresholds.STAND_IN_SHARE, 1),
        (ABOVE, BELOW, BELOW * thresholds.STAND_IN_SHARE, 0),  # with the other the first one goes, too
    ],
)
def test_findings_are_kept_that_nothing_does_without_beside_the_others(
    monkeypatch: pytest.MonkeyPatch, first: float, second: float, alone: float, kept: int
) -> None:
    """Friction under a coasting bridge: in the order of finding neither would stay."""
    least, both = thresholds.STAND_IN_SHARE, stub_with(2.0, "coulomb_friction", "coast_drive")
    friction = stub_with(gap_with(first * least, 2.0), "coast_drive")
    coasting = stub_with(gap_with(second * least, 2.0), "coulomb_friction")
    rest = coasting if second < first else friction
    plain = stub_with(gap_with(alone, rest.held.gap))
    without = {("coulomb_friction", 2): friction, ("coast_drive", 2): coasting, (rest.effects[0], 1): plain}
    monkeypatch.setattr(stand_ins, "refit_without", lambda model, effect, _: without[effect, len(model.effects)])
    monkeypatch.setattr(stand_ins, "explains_standstills", lambda *models: False)
    steps = stub_step("coast_drive", 0.5), stub_step("coulomb_friction", 0.5)
    selection = replace(stub_selection(2.0, *steps), model=both)
    left = drop_unneeded(selection)
    assert len(left.steps) == kept and not drop_stand_ins(selection).steps
    assert left.model is (plain, rest, both)[kept]
    assert drop_stand_ins_of_either(selection, selection).steps == left.steps


@pytest.mark.parametrize("held", [True, False])
def test_what_holds_the_motor_stays_beside_others_whatever_it_explains(
    monkeypatch: pytest.MonkeyPatch, held: bool
) -> None:
    both, coasting = stub_with(2.0, "coulomb_friction", "coast_drive"), stub_with(2.5, "coulomb_friction")
    friction, plain = stub_with(gap_with(ABOVE * thresholds.STAND_IN_SHARE, 2.0), "coast_drive"), stub_with(9.0)
    without = {("coulomb_friction", 2): coasting, ("coast_drive", 2): friction, ("coast_drive", 1): plain}
    monkeypatch.setattr(stand_ins, "refit_without", lambda model, effect, _: without[effect, len(model.effects)])
    monkeypatch.setattr(stand_ins, "explains_standstills", lambda before, after: held and before is coasting)
    steps = stub_step("coast_drive", 0.5), stub_step("coulomb_friction", 0.5)
    left = drop_unneeded(replace(stub_selection(2.0, *steps), model=both))
    assert left.steps == (steps if held else ())


def test_at_the_floor_nothing_is_unneeded() -> None:
    selection = replace(stub_selection(1.0, stub_step("load_bias", 0.5)), model=stub_with(BELOW * 1.3, "load_bias"))
    assert drop_unneeded(selection) is selection


def test_of_two_selections_the_one_that_keeps_more(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stand_ins, "drop_unneeded", drop_stand_ins)
    poor, rich = stub_selection(4.0, stub_step("load_bias", 0.9)), stub_selection(5.0, stub_step("load_bias", 0.99))
    assert drop_stand_ins_of_either(rich, poor).steps == rich.steps == drop_stand_ins_of_either(poor, rich).steps
    done = stub_selection(1.0)
    assert drop_stand_ins_of_either(rich, done) is done


def test_findings_that_another_selection_confirms_are_kept() -> None:
    steps = stub_step("coulomb_friction", 0.7), stub_step("quadratic_drag", 0.3), stub_step("load_bias", 0.3)
    selection = stub_selection(5.0, *steps)
    kept = keep_confirmed(selection, ("coulomb_friction", "load_bias", "backlash"))
    assert kept.steps == steps[:1] and kept.model is steps[1].before
    assert keep_confirmed(selection, ("coulomb_friction", "quadratic_drag", "load_bias")) is selection


def test_a_line_in_the_spectrum_is_its_own_evidence() -> None:
    steps = stub_step("torque_ripple", 0.1), stub_step("load_bias", 0.99)
    assert drop_stand_ins(stub_selection(5.0, *steps)).steps == steps


@pytest.mark.parametrize(
    ("effect", "stood", "calm", "told"),
    [
        ("coulomb_friction", True, False, True),
        ("coulomb_friction", False, True, True),
        ("coulomb_friction", False, False, False),
        ("static_friction", True, False, True),
        ("static_friction", False, True, False),  # any bend of the motion over the speed looks like it
        ("transport_delay", True, True, False),
        ("torque_ripple", False, False, True),
    ],
)
def test_friction_is_told_by_standstills_or_by_most_of_the_time(
    monkeypatch: pytest.MonkeyPatch, effect: str, stood: bool, calm: bool, told: bool
) -> None:
    monkeypatch.setattr(stand_ins, "explains_standstills", lambda *models: stood)
    monkeypatch.setattr(stand_ins, "explains_calm", lambda *models: calm)
    assert is_own_evidence(effect, stub_model(5.0), stub_model(4.0)) is told


@pytest.mark.parametrize(("stands", "same"), [(True, False), (False, True)])
def test_what_replaces_a_friction_explains_what_that_is_told_by(
    monkeypatch: pytest.MonkeyPatch, stands: bool, same: bool
) -> None:
    """A delay may explain most of the time; not why a motor stood."""
    without, model, delayed = stub_model(5.0), stub_model(4.0), stub_model(3.0)
    monkeypatch.setattr(stand_ins, "explains_standstills", lambda before, one: stands and one is model)
    monkeypatch.setattr(stand_ins, "explains_calm", lambda before, one: one is delayed)
    assert has_same_evidence(delayed, without, model) is same


@pytest.mark.parametrize(
    ("effect", "less", "complete", "rivals"),
    [
        ("load_step", 0.019, False, ("coulomb_friction",)),
        ("load_step", 0.021, False, ()),
        ("load_step", 0.019, True, ()),
        ("quadratic_drag", 0.019, False, ()),  # at no instant
    ],
)
def test_an_instant_is_in_doubt_where_as_much_is_explained_without_one(
    monkeypatch: pytest.MonkeyPatch, effect: str, less: float, complete: bool, rivals: tuple[str, ...]
) -> None:
    """A load stepped where the command did: friction explained 0.949 of the gap, and the load step 0.951."""
    assert thresholds.NEARLY_AS_MUCH == 0.02
    before, after = stub_model(9.0), stub_model(1.0 if complete else 5.0, 0.0)
    share = share_explained(9.0, 5.0, after.unpredictable_gap) - less
    alike = CandidateTest("coulomb_friction", before, stub_model(4.0, likelihood=100.0))
    monkeypatch.setattr(stand_ins, "refit_without", lambda *rest: before)
    monkeypatch.setattr(stand_ins, "list_candidates", lambda *rest: ["coulomb_friction", "load_step", "torque_ripple"])
    monkeypatch.setattr(stand_ins, "try_effects", lambda model, hold_out, names, *rest: [alike] * len(names))
    monkeypatch.setattr(CandidateTest, "explains", share)
    selection = replace(stub_selection(5.0, step_of(stub_test(effect, before, 5.0, 100.0))), model=after)
    assert doubt_instants(selection).steps[0].rivals == rivals
