"""What a recording determines nothing of is no finding."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from diagnosed import fitted, with_effect
from plant import profiles, record
from stub_models import StubModel, same_errors, stub_model, with_effects

from motor_identification.diagnose import diagnose
from motor_identification.diagnosis import candidate_model, thresholds
from motor_identification.diagnosis.candidate_fit import validate_model
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest, likelihood_threshold
from motor_identification.diagnosis.result import Verdict
from motor_identification.diagnosis.selection import chance as chance_of
from motor_identification.diagnosis.selection import determination
from motor_identification.diagnosis.selection.chance import has_vague_instant, is_chance_size
from motor_identification.diagnosis.selection.determination import (
    drop_undetermined,
    drop_undetermined_at_once,
    find_limits_hit,
    find_undetermined,
    is_needed,
    is_of_no_motor,
    is_steady_beside_torque,
    is_undetermined,
)
from motor_identification.diagnosis.selection.selection import Selection, SelectionStep
from motor_identification.discrepancy.structure import Structure
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.parameter_space import map_theta
from motor_identification.noise.error_model import ErrorModel
from motor_identification.progress import ProgressReporter
from motor_identification.recording import check
from motor_identification.uncertainty.standard_errors import Uncertainty, estimate_uncertainty
from motor_model.effects import EFFECT_BY_NAME
from motor_model.parameters import PAPER_KA, PAPER_KV

SILENT = ProgressReporter(lambda stage: None, lambda: False)


def give_sizes_by_chance(monkeypatch: pytest.MonkeyPatch, chance: bool) -> None:
    """Let every size be one by chance, or none."""
    for module in (determination, chance_of):
        monkeypatch.setattr(module, "is_chance_size", lambda *_: chance)


@pytest.mark.parametrize(
    ("effect", "unknown", "undetermined"),
    [
        ("load_step", ("step_voltage",), True),  # the instant is the recording's
        ("load_step", ("step_time",), False),
        ("backlash", ("backlash_angle",), False),
        ("backlash", ("backlash_angle", "load_fraction"), False),  # each is unsure because the other is
        ("warm_up", ("resistance_rise", "warm_up_time"), True),  # it may be anything that changes
        ("warm_up", ("warm_up_time",), False),
        ("transport_delay", ("delay",), True),
        ("coulomb_friction", ("kv", "ka"), False),
    ],
)
def test_an_effect_is_undetermined_where_its_one_parameter_is(
    effect: str, unknown: tuple[str, ...], undetermined: bool
) -> None:
    assert is_undetermined(effect, unknown) == undetermined


def test_a_friction_that_motion_both_ways_determines_stays() -> None:
    estimate, hold_out = fitted(ks=0.4)
    after = validate_model(hold_out, with_effect(estimate, "coulomb_friction", {"ks": 0.3}))
    before = validate_model(hold_out, estimate)
    assert find_undetermined(after) == () and find_undetermined(before) == ()
    test = CandidateTest("coulomb_friction", before, after)
    selection = Selection((SelectionStep(before, test, (test,), (), 1.0),), after, hold_out, 1)
    assert drop_undetermined(selection, SILENT) == (selection, ())


def test_what_a_recording_does_not_determine_is_dropped_and_named() -> None:
    """An inductance that is not there."""
    estimate, hold_out = fitted()
    before = validate_model(hold_out, estimate)
    after = validate_model(hold_out, with_effect(estimate, "armature_inductance", {"electrical_time_constant": 1e-6}))
    test = CandidateTest("armature_inductance", before, after)
    selection = Selection((SelectionStep(before, test, (test,), (), 1.0),), after, hold_out, 1)
    left, names = drop_undetermined(selection, SILENT)
    assert names == ("armature_inductance",) and left.steps == () and left.model.effects == ()
    assert left.model.held.gap == pytest.approx(before.held.gap, rel=1e-6)


@pytest.mark.parametrize(
    ("sigma", "steadiness", "effect", "rivals", "told"),
    [
        (1.01, 1.01 * likelihood_threshold(), "coulomb_friction", (), True),
        (0.99, 1.01 * likelihood_threshold(), "coulomb_friction", (), False),
        (1.01, 0.99 * likelihood_threshold(), "coulomb_friction", (), False),  # a few moments speak for it
        (1.01, 1.01 * likelihood_threshold(), "coulomb_friction", ("dead_zone",), False),
        (1.01, 1.01 * likelihood_threshold(), "torque_ripple", (), False),
        (1.01, 1.01 * likelihood_threshold(), "load_step", (), False),
        (None, 1.01 * likelihood_threshold(), "coulomb_friction", (), False),  # more than a torque is left
        (None, 1.01 * thresholds.STEADY_LIKELIHOOD, "coast_drive", (), True),
        (None, 0.99 * thresholds.STEADY_LIKELIHOOD, "coast_drive", (), False),
    ],
)
def test_what_the_motion_speaks_for_all_the_time_is_told_beside_a_torque(
    monkeypatch: pytest.MonkeyPatch,
    sigma: float | None,
    steadiness: float,
    effect: str,
    rivals: tuple[str, ...],
    told: bool,
) -> None:
    """By its standard error it may have its size by chance."""
    own = EFFECT_BY_NAME[effect].parameters[0]
    problem = SimpleNamespace(unknowns=SimpleNamespace(names=(own.name,)))
    fit, limit = SimpleNamespace(problem=problem, theta=np.array([own.off + 0.3])), thresholds.STEADY_BESIDE_TORQUE
    beside = None if sigma is None else (fit, same_errors(0.3 / (sigma * limit)))
    step = cast(SelectionStep, SimpleNamespace(found=SimpleNamespace(effect=effect), rivals=rivals))

    def steady(unknown: tuple[str, ...] = (), beside_torque: bool = True) -> bool:
        model = SimpleNamespace(
            told_beside_torque=beside,
            beside_torque=beside_torque,
            uncertainty=SimpleNamespace(not_identifiable=unknown),
        )
        selection = cast(Selection, SimpleNamespace(model=model))
        return is_steady_beside_torque(step, selection, selection)

    monkeypatch.setattr(CandidateTest, "steadiness", steadiness)
    give_sizes_by_chance(monkeypatch, True)
    assert steady() is told
    assert not steady(beside_torque=False)
    give_sizes_by_chance(monkeypatch, False)
    assert not steady()  # it ended at a limit of the search
    assert steady((own.name,)) is (told and sigma is not None)


@pytest.mark.parametrize(("share", "vague"), [(0.99, False), (1.01, True), (np.nan, False)])
def test_a_load_that_may_come_on_at_any_time_is_none(
    monkeypatch: pytest.MonkeyPatch, share: float, vague: bool
) -> None:
    """A slow torque is one; what cannot be told where a motor stands still is not."""
    estimate, hold_out = fitted()
    model = validate_model(hold_out, with_effect(estimate, "load_step", {"step_voltage": 0.3, "step_time": 0.3}))
    names, (recording, *_) = model.whitened.problem.unknowns.names, model.whitened.problem.recordings
    errors = np.zeros(len(model.whitened.theta))
    errors[names.index("step_time")] = share * thresholds.VAGUE_INSTANT * recording.duration
    known = SimpleNamespace(errors=errors, not_identifiable=())
    monkeypatch.setattr(candidate_model, "estimate_uncertainty", lambda *_: known)
    assert has_vague_instant("load_step", model) == vague
    assert find_undetermined(model) == (("load_step",) if vague else ())
    worse = stub_model(10.0 * model.held.gap, 0.0)  # which a torque that was learned may leave
    assert is_needed(found_step(model, model, "load_step"), model, worse) != vague


def test_how_sure_a_model_is_is_asked_once(monkeypatch: pytest.MonkeyPatch) -> None:
    estimate, hold_out = fitted()
    model = validate_model(hold_out, with_effect(estimate, "coulomb_friction", {"ks": 0.3}))
    asked: list[Any] = []

    def count(*given: Any) -> Uncertainty:
        asked.append(estimate_uncertainty(*given))
        return asked[-1]

    monkeypatch.setattr(candidate_model, "estimate_uncertainty", count)
    assert not is_undetermined("coulomb_friction", model.uncertainty.not_identifiable)  # its size is looked at, too
    find_undetermined(model)
    assert len(asked) == 1


@pytest.mark.parametrize(("sigma", "chance"), [(0.99, True), (1.01, False)])
def test_a_line_that_was_fitted_to_all_there_is_has_to_be_sure(
    monkeypatch: pytest.MonkeyPatch, sigma: float, chance: bool
) -> None:
    estimate, hold_out = fitted()
    model = validate_model(
        hold_out, with_effect(estimate, "encoder_eccentricity", {"eccentricity": 0.01, "eccentricity_phase": 0.5})
    )
    at = model.whitened.problem.unknowns.names.index("eccentricity")
    errors = np.full(len(model.whitened.theta), abs(model.whitened.theta[at]) / (sigma * thresholds.SURE_LINE))
    monkeypatch.setattr(
        candidate_model, "estimate_uncertainty", lambda *_: SimpleNamespace(errors=errors, not_identifiable=())
    )
    seen = replace(model, held=replace(model.held, seen=True))
    assert is_chance_size("encoder_eccentricity", seen) == chance
    assert not is_chance_size("encoder_eccentricity", model)  # held-out motion has confirmed it
    errors *= thresholds.SURE_LINE / thresholds.LIKELY_LINE  # but nothing confirms what may be none
    assert is_chance_size("encoder_eccentricity", model) == chance
    errors /= thresholds.SURE_LINE / thresholds.LIKELY_LINE
    step, worse = found_step(seen, seen, "encoder_eccentricity"), stub_model(10.0 * seen.held.gap, 0.0)
    assert not is_needed(step, seen, worse) and is_needed(step, model, worse)


def test_a_step_by_chance_is_not_named(monkeypatch: pytest.MonkeyPatch) -> None:
    estimate, hold_out = fitted()
    before = validate_model(hold_out, estimate)
    after = validate_model(hold_out, with_effect(estimate, "load_step", {"step_voltage": 1e-4, "step_time": 0.3}))
    selection = Selection((found_step(before, after, "load_step"),), after, hold_out, 1)
    give_sizes_by_chance(monkeypatch, True)
    left, names = drop_undetermined(selection, SILENT)
    assert before.complete and names == () and left.steps == () and left.model.effects == ()


def test_a_step_that_predicts_is_no_chance(monkeypatch: pytest.MonkeyPatch) -> None:
    """The one block of time that its instant is in makes its errors wide; without it the motion is missed."""
    estimate, hold_out = fitted(step_voltage=0.8, step_time=2.0)
    before = validate_model(hold_out, estimate)
    after = validate_model(hold_out, with_effect(estimate, "load_step", {"step_voltage": 0.7, "step_time": 2.0}))
    assert before.held.gap > 2.0 * after.held.gap
    selection = Selection((found_step(before, after, "load_step"),), after, hold_out, 1)
    give_sizes_by_chance(monkeypatch, True)
    assert drop_undetermined(selection, SILENT) == (selection, ())


@pytest.mark.parametrize(("step", "stays"), [(1e-4, False), (0.7, True)])
def test_what_is_not_determined_is_dropped_when_the_time_is_used_up(
    monkeypatch: pytest.MonkeyPatch, step: float, stays: bool
) -> None:
    """By its errors neither is; the larger one is seen in the gap."""
    give_sizes_by_chance(monkeypatch, True)
    estimate, hold_out = fitted(step_voltage=0.8 if stays else 0.0, step_time=2.0)
    before = validate_model(hold_out, estimate)
    after = validate_model(hold_out, with_effect(estimate, "load_step", {"step_voltage": step, "step_time": 2.0}))
    selection = Selection((found_step(before, after, "load_step"),), after, hold_out, 1)
    left = drop_undetermined_at_once(selection)
    assert (left.model.effects == ("load_step",) and left.steps == selection.steps) is stays
    assert (left.model.effects == () and left.steps == ()) is not stays


@pytest.mark.parametrize(
    ("effect", "rivals", "limits", "times", "needed"),
    [
        ("coulomb_friction", (), (), 1.001, True),
        ("coulomb_friction", (), (), 0.999, False),
        ("coulomb_friction", ("dead_zone",), (), 1.001, False),
        ("coulomb_friction", (), ("ks",), 1.001, False),  # a limit of the search is no value
        ("coulomb_friction", (), ("drag",), 1.001, True),
        ("warm_up", ("coulomb_friction",), ("resistance_rise",), 1.001, True),
    ],
)
def test_what_the_gap_shows_is_needed_though_its_errors_are_wide(
    monkeypatch: pytest.MonkeyPatch,
    effect: str,
    rivals: tuple[str, ...],
    limits: tuple[str, ...],
    times: float,
    needed: bool,
) -> None:
    monkeypatch.setattr(determination, "find_limits_hit", lambda model: limits)
    model, without = stub_model(2.0, 0.0), stub_model(2.0 * times * thresholds.WORSE_GAP, 0.0)
    assert is_needed(found_step(without, model, effect, rivals), model, without) is needed
    at_sea = replace(model, not_identifiable=("kv",))
    assert not is_needed(found_step(without, at_sea, effect, rivals), at_sea, without)  # as anything is there


@pytest.mark.parametrize(
    ("complete", "without_complete", "needed"), [(True, False, True), (True, True, False), (False, False, False)]
)
def test_one_of_several_is_needed_where_all_is_explained_with_it_and_not_without(
    monkeypatch: pytest.MonkeyPatch, complete: bool, without_complete: bool, needed: bool
) -> None:
    """A dead time of 26 ± 9 ms or an inductance, of eight steps, likelier by 253, was told as nothing determined."""
    monkeypatch.setattr(determination, "find_limits_hit", lambda model: ())
    model, without = stub_model(2.0, 0.0), stub_model(4.0, 0.0)
    is_complete = {id(model): complete, id(without): without_complete}
    monkeypatch.setattr(StubModel, "complete", property(lambda one: is_complete[id(one)]))
    monkeypatch.setattr(determination, "is_chance_size", lambda effect, model: False)
    step = found_step(without, model, "transport_delay", ("armature_inductance",))
    assert is_needed(step, model, without) is needed


@pytest.mark.parametrize(
    ("unknown", "limits", "needed"),
    [
        (("resistance_rise", "warm_up_time"), ("resistance_rise",), False),
        (("resistance_rise", "warm_up_time"), ("warm_up_time",), True),
        (("warm_up_time",), ("resistance_rise",), True),
        (("resistance_rise", "warm_up_time"), (), True),  # their product shows
    ],
)
def test_a_size_at_a_limit_is_not_needed_where_nothing_of_it_is_known(
    monkeypatch: pytest.MonkeyPatch, unknown: tuple[str, ...], limits: tuple[str, ...], needed: bool
) -> None:
    """A warming-up by the most that is searched, at no known rate, was named in 3.8 s of a toy robot."""
    monkeypatch.setattr(determination, "find_limits_hit", lambda model: limits)
    without = stub_model(2.002 * thresholds.WORSE_GAP, 0.0)
    model = replace(stub_model(2.0, 0.0), not_identifiable=unknown)
    assert is_needed(found_step(without, model, "warm_up"), model, without) is needed


@pytest.mark.parametrize("no_ripple", [True, False])
def test_what_bends_the_motion_over_the_place_is_no_ripple_however_much_goes_with_it(
    monkeypatch: pytest.MonkeyPatch, no_ripple: bool
) -> None:
    """A cart that a spring pulls back had a ripple of 10.5 V, of 10 ± 100 cycles a turn, in 0.02 rad."""
    monkeypatch.setattr(determination, "find_limits_hit", lambda model: ())
    monkeypatch.setattr(determination, "is_no_ripple", lambda model, effect: no_ripple)
    model, without = stub_model(2.0, 0.0), stub_model(9.0, 0.0)
    assert is_needed(found_step(without, model, "torque_ripple"), model, without) is not no_ripple


@pytest.mark.parametrize(
    ("explained", "chance", "needed"), [(True, True, False), (True, False, True), (False, True, True)]
)
def test_a_size_by_chance_is_not_needed_where_all_is_explained_without_it(
    monkeypatch: pytest.MonkeyPatch, explained: bool, chance: bool, needed: bool
) -> None:
    """A load step of 0.050 ± 0.049 V was named beside the static friction of a real motor that starts anew."""
    monkeypatch.setattr(determination, "find_limits_hit", lambda model: ())
    monkeypatch.setattr(determination, "has_vague_instant", lambda effect, model: False)
    give_sizes_by_chance(monkeypatch, chance)
    gap = 0.999 * thresholds.EXPLAINED_GAP if explained else 1.001 * thresholds.EXPLAINED_GAP
    model, without = stub_model(gap / (1.001 * thresholds.WORSE_GAP), 0.0), stub_model(gap, 0.0)
    assert is_needed(found_step(without, model, "load_step"), model, without) is needed


def test_an_exchange_of_rivals_in_a_circle_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither of two that do each other's work is determined, and each gives way to the other."""
    models = {name: with_effects(stub_model(2.0, 0.0), name) for name in ("coulomb_friction", "dead_zone")}
    plain, other = (
        with_effects(stub_model(5.0, 0.0)),
        {"coulomb_friction": "dead_zone", "dead_zone": "coulomb_friction"},
    )
    start = found_step(plain, models["dead_zone"], "dead_zone", ("coulomb_friction",))
    asked: list[str] = []

    def exchange(selection: Selection, step: SelectionStep, without: Model) -> Selection:
        name = other[step.found.effect]
        asked.append(name)
        assert len(asked) < 10
        return selection.replace_step(step, found_step(plain, models[name], name, (step.found.effect,)), models[name])

    monkeypatch.setattr(determination, "find_undetermined", lambda model: model.effects)
    monkeypatch.setattr(determination, "drop_step", lambda one, step: replace(one, steps=(), model=plain))
    monkeypatch.setattr(determination, "_replace_by_rival", exchange)
    left, names = drop_undetermined(Selection((start,), models["dead_zone"], fitted()[1], 1), SILENT)
    assert names == () and asked == ["coulomb_friction", "dead_zone"] and left.model.effects == ("dead_zone",)


@pytest.mark.parametrize("complete", [True, False])
def test_what_was_dropped_does_not_come_back_in_the_place_of_another(
    monkeypatch: pytest.MonkeyPatch, complete: bool
) -> None:
    """An eccentricity of unknown size explains more than the friction; whether it is told or not, friction stays."""
    plain, gap = with_effects(stub_model(9.0)), 1.0 if complete else 5.0
    one = with_effects(stub_model(gap, 0.0), "coulomb_friction")
    line = with_effects(stub_model(gap, 0.0), "encoder_eccentricity")
    both = with_effects(stub_model(gap, 0.0), "coulomb_friction", "encoder_eccentricity")
    friction, eccentricity = found_step(plain, one, "coulomb_friction"), found_step(one, both, "encoder_eccentricity")
    begun = Selection((friction, eccentricity), both, fitted()[1], 1)
    smaller = Selection((friction,), one, fitted()[1], 1)
    exchanged = Selection((found_step(plain, line, "encoder_eccentricity"),), line, fitted()[1], 1)
    monkeypatch.setattr(
        determination, "find_undetermined", lambda model: model.effects[-1:] if line.effects[0] in model.effects else ()
    )
    monkeypatch.setattr(determination, "drop_step", lambda *_: smaller)
    give_sizes_by_chance(monkeypatch, True)
    monkeypatch.setattr(determination, "is_needed", lambda *_: False)
    monkeypatch.setattr(determination, "eliminate_backward", lambda *_: exchanged)
    left, names = drop_undetermined(begun, SILENT)
    assert left is smaller and names == (() if complete else ("encoder_eccentricity",))


def found_step(before: Model, after: Model, effect: str, rivals: tuple[str, ...] = ()) -> SelectionStep:
    test = CandidateTest(effect, before, after)
    return SelectionStep(before, test, (test,), rivals, 1.0)


def test_a_rival_that_is_determined_takes_the_place(monkeypatch: pytest.MonkeyPatch) -> None:
    """Friction was taken for a dead zone, which says nothing of its size; the other name does, and both are said."""
    estimate, hold_out = fitted(ks=0.4)
    before = validate_model(hold_out, estimate)
    after = validate_model(hold_out, with_effect(estimate, "dead_zone", {"dead_zone_voltage": 0.3}))
    selection = Selection((found_step(before, after, "dead_zone", ("coulomb_friction",)),), after, hold_out, 1)
    monkeypatch.setattr(determination, "_find_unknown", lambda model: ("dead_zone_voltage",))
    left, names = drop_undetermined(selection, SILENT)
    (step,) = left.steps
    assert names == () and left.model.effects == ("coulomb_friction",) and left.model.at_floor
    assert (step.found.effect, step.rivals) == ("coulomb_friction", ("dead_zone",))
    monkeypatch.setattr(determination, "_find_unknown", lambda model: ("dead_zone_voltage", "ks"))
    left, names = drop_undetermined(selection, SILENT)
    assert names == ("coulomb_friction", "dead_zone") and left.steps == ()


@pytest.mark.parametrize(
    ("chance", "complete", "kept"),
    [
        (("dead_zone", "coulomb_friction"), True, ()),
        (("dead_zone",), True, ("coulomb_friction",)),
        (("dead_zone", "coulomb_friction"), False, ("dead_zone",)),  # something is missing there
    ],
)
def test_a_rival_of_no_size_takes_no_place_where_all_is_explained_without_either(
    monkeypatch: pytest.MonkeyPatch, chance: tuple[str, ...], complete: bool, kept: tuple[str, ...]
) -> None:
    """A drag of 1.4 standard errors gave way to a limit that was none either, and that to the drag: one was named."""
    before = with_effects(stub_model(2.0, 0.0, likelihood=-20.0))
    monkeypatch.setattr(StubModel, "complete", property(lambda one: complete or bool(one.effects)))
    monkeypatch.setattr(determination, "is_chance", lambda effect, model: effect in chance)
    monkeypatch.setattr(determination, "find_undetermined", lambda model: set(model.effects).intersection(chance))
    monkeypatch.setattr(determination, "_find_unknown", lambda model: ())
    monkeypatch.setattr(determination, "drop_step", lambda one, step: replace(one, steps=(), model=before))
    monkeypatch.setattr(determination, "is_needed", lambda *_: False)
    monkeypatch.setattr(determination, "is_steady_beside_torque", lambda *_: False)
    monkeypatch.setattr(
        determination,
        "try_effects",
        lambda model, hold_out, names, *_: [
            CandidateTest(name, model, with_effects(stub_model(2.0, 0.0), name)) for name in names
        ],
    )
    zone = with_effects(stub_model(2.0, 0.0), "dead_zone")
    start = Selection((found_step(before, zone, "dead_zone", ("coulomb_friction",)),), zone, fitted()[1], 1)
    left, names = drop_undetermined(start, SILENT)
    assert tuple(one.found.effect for one in left.steps) == kept and names == ()


@pytest.mark.parametrize(
    ("effect", "at_limit"), [("transport_delay", True), ("encoder_eccentricity", True), ("coast_drive", False)]
)
def test_a_limit_of_the_search_is_no_value_but_one_of_physics_is(effect: str, at_limit: bool) -> None:
    estimate, _ = fitted(ks=0.4)
    more = estimate.problem.with_effects((effect,))
    name = EFFECT_BY_NAME[effect].parameters[0].name
    place = more.unknowns.names.index(name)
    begin = {spec.name: np.array(1e-3) for spec in EFFECT_BY_NAME[effect].parameters}
    theta = map_theta(estimate.problem.unknowns, estimate.theta, more.unknowns, begin)
    theta[place] = more.unknowns.high[place]
    model = cast(Model, SimpleNamespace(estimate=Estimate(more, theta), effects=(effect,)))
    assert find_limits_hit(model) == ((name,) if at_limit else ())
    assert not is_of_no_motor(model)
    theta[place], theta[more.unknowns.names.index("kv")] = 0.0, more.unknowns.high[more.unknowns.names.index("kv")]
    assert is_of_no_motor(model) is True


@pytest.mark.parametrize("at_limit", [True, False])
def test_a_size_at_a_limit_of_the_search_is_none_though_the_rest_is_determined(
    monkeypatch: pytest.MonkeyPatch, at_limit: bool
) -> None:
    """A backlash of 1 rad, the largest that is looked for, with a share of the load that is sure."""
    model = with_effects(stub_model(1.0, 0.0), "backlash")
    limits = ("backlash_angle",) if at_limit else ("load_fraction",)
    monkeypatch.setattr(determination, "find_limits_hit", lambda model: limits)
    give_sizes_by_chance(monkeypatch, False)
    assert find_undetermined(model) == (("backlash",) if at_limit else ())


def test_of_two_that_do_each_others_work_the_needless_one_goes(monkeypatch: pytest.MonkeyPatch) -> None:
    """A load that is not there beside the friction that is: without the load the friction is determined."""
    estimate, hold_out = fitted(ks=0.4)
    bare = validate_model(hold_out, estimate)
    friction = with_effect(estimate, "coulomb_friction", {"ks": 0.3})
    after = validate_model(hold_out, friction)
    more = friction.problem.with_effects(("coulomb_friction", "load_bias"))
    start = map_theta(friction.problem.unknowns, friction.theta, more.unknowns, {"bias_voltage": np.array(0.01)})
    last = validate_model(hold_out, fit_speeds(Estimate(more, start)))
    steps = found_step(bare, after, "coulomb_friction"), found_step(after, last, "load_bias")
    assert steps[0].found.evidence > steps[1].found.evidence
    monkeypatch.setattr(
        determination, "_find_unknown", lambda model: ("ks", "bias_voltage") if len(model.effects) == 2 else ()
    )
    give_sizes_by_chance(monkeypatch, False)
    for order in (steps, (replace(steps[1], found=replace(steps[1].found, before=bare)), steps[0])):
        left, names = drop_undetermined(Selection(order, last, hold_out, 1), SILENT)
        assert names == ("load_bias",) and left.model.effects == ("coulomb_friction",)
        assert left.model.estimate.parameters.value("ks") == pytest.approx(0.4, rel=1e-2)


@pytest.mark.parametrize(
    ("times", "complete", "kept"), [(1.01, False, True), (0.99, False, False), (1.01, True, False), (0.99, True, False)]
)
def test_what_is_left_stays_where_without_it_the_gap_has_structure(
    monkeypatch: pytest.MonkeyPatch, times: float, complete: bool, kept: bool
) -> None:
    """A friction beside a sag that nothing is determined of: a torque that is as slow would do as well."""
    before, after = stub_model(9.0, 0.0), stub_model(1.4, 0.0)
    bare = SimpleNamespace(held=SimpleNamespace(gap=1.4 * times * thresholds.WORSE_GAP), complete=complete, effects=())
    smaller = Selection((found_step(before, after, "coulomb_friction"),), after, fitted()[1], 1)
    rest = replace(smaller, steps=(), model=cast(Model, bare))
    monkeypatch.setattr(determination, "find_undetermined", lambda model: ("supply_sag",) if model is last else ())
    monkeypatch.setattr(determination, "drop_step", lambda *_: smaller)
    monkeypatch.setattr(determination, "eliminate_backward", lambda *_: rest)
    monkeypatch.setattr(determination, "find_limits_hit", lambda model: ())
    last = stub_model(1.0, 0.0)
    begun = replace(smaller, steps=(*smaller.steps, found_step(after, last, "supply_sag")), model=last)
    give_sizes_by_chance(monkeypatch, False)
    left, names = drop_undetermined(begun, SILENT)
    assert names == ("supply_sag",) and left is (smaller if kept else rest)


def test_a_single_step_says_what_may_be_missing_and_no_size() -> None:
    """One way, one level, friction and a load that comes: nothing of either can be told from the gain."""
    values = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.5}
    recording = check(record(values, *profiles.step(9.0), seed=3)[0])
    found = diagnose([recording])
    assert found.verdict is Verdict.UNDECIDED
    for finding in found.findings:
        assert any(np.isfinite(sigma) for _, sigma in finding.parameters.values())


@pytest.mark.parametrize(
    ("each", "beside", "outside", "kept"),
    [
        (1.01, (True, True), False, True),
        (0.99, (True, True), False, False),
        (1.01, (False, True), False, False),  # likelihoods of two kinds
        (1.01, (True, False), False, False),
        (1.01, (True, True), True, False),  # for which they stood in
    ],
)
def test_what_a_slow_torque_does_in_turn_for_each_stays_where_it_does_not_for_all(
    monkeypatch: pytest.MonkeyPatch, each: float, beside: tuple[bool, bool], outside: bool, kept: bool
) -> None:
    """Friction and asymmetry of ten runs at levels of their own: neither was missed alone, both were by 18."""
    torque = ErrorModel(0.1, 0.0, 0.1, 1.0)
    plain, one = stub_model(2.0, 0.0), stub_model(1.5, 0.0, 9.0)
    both = stub_model(1.4, 0.0, 2.0 * each * likelihood_threshold())
    both, plain = (
        replace(model, learned=torque if with_it else None)
        for model, with_it in zip((both, plain), beside, strict=True)
    )
    steps = found_step(plain, one, "coulomb_friction"), found_step(one, both, "direction_asymmetry")
    smaller = Selection(steps, both, fitted()[1], 1)
    structure = Structure("past", 0.9, 100.0, relevant=True, cause="") if outside else None
    rest = replace(smaller, steps=(), model=plain, outside=structure)
    monkeypatch.setattr(determination, "eliminate_backward", lambda *_: rest)
    monkeypatch.setattr(determination, "predicts_far_worse", lambda *_: False)
    assert determination._eliminate_unless_seen(smaller, SILENT) is (smaller if kept else rest)
