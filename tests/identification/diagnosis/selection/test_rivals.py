"""What is tried in the place of a finding: what replaces it, and what is its rival."""

from dataclasses import replace

import pytest
from diagnosed import fitted
from stub_models import stub_model, stub_test, with_effects
from stub_selections import step_of, stub_selection

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_fit import validate_model
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest, likelihood_threshold
from motor_identification.diagnosis.fits.effect_fit import fit_with_effect
from motor_identification.diagnosis.selection import rivals as module
from motor_identification.diagnosis.selection.rivals import (
    check_beside_torque,
    list_replacements,
)
from motor_identification.diagnosis.selection.selection import SelectionStep
from motor_identification.noise.error_model import ErrorModel
from motor_identification.progress import ProgressReporter
from motor_identification.validation.hold_out import HoldOut

BELOW, ABOVE = 0.999, 1.001
SILENT = ProgressReporter(lambda stage: None, lambda: False)


def test_replacements_were_likely_where_it_was_found_and_are_not_there_already() -> None:
    before, least = stub_model(9.0), likelihood_threshold()
    found = stub_test("coulomb_friction", before, 5.0, 100.0)
    names = ("dead_zone", "load_bias", "quadratic_drag", "supply_sag", "voltage_limit")
    tests = [stub_test(name, before, 5.0, ABOVE * least) for name in names]
    step = SelectionStep(before, found, (found, *tests), (), 0.99)
    assert list_replacements(step, (), ("load_bias",)) == ["dead_zone", "quadratic_drag", "supply_sag"]
    assert len(list_replacements(step, (), ())) == thresholds.ELIMINATION_RIVALS
    alike = replace(step, rivals=("voltage_limit", "direction_asymmetry"))  # whatever was likelier there
    assert list_replacements(alike, (), ("load_bias",)) == ["voltage_limit", "direction_asymmetry", "dead_zone"]
    many = replace(step, rivals=names)
    assert list_replacements(many, (), ()) == list(names)
    weak = SelectionStep(before, found, (found, stub_test("dead_zone", before, 5.0, BELOW * least)), (), 0.99)
    assert list_replacements(weak, (), ()) == []
    estimate, hold_out = fitted(ks=0.4)
    friction = fit_with_effect(estimate, "coulomb_friction")
    assert friction is not None
    beside = replace(step, before=validate_model(hold_out, friction), rivals=("load_bias",))
    assert list_replacements(beside, (), ()) == [
        "load_bias",
        "coulomb_friction",
        "dead_zone",
    ]  # and what was lost since
    assert list_replacements(beside, (), ("coulomb_friction",)) == ["load_bias", "dead_zone", "quadratic_drag"]


@pytest.mark.parametrize(
    ("evidence", "loss", "rivals"),
    [
        (BELOW * thresholds.TIE_LIKELIHOOD, 1.0, ()),  # it does nothing
        (ABOVE * thresholds.TIE_LIKELIHOOD, BELOW * thresholds.RIVAL_MARGIN, ("coulomb_friction",)),
        (ABOVE * thresholds.TIE_LIKELIHOOD, ABOVE * thresholds.RIVAL_MARGIN, ()),
    ],
)
def test_what_does_as_well_beside_the_torque_that_is_left_is_a_rival(
    monkeypatch: pytest.MonkeyPatch, evidence: float, loss: float, rivals: tuple[str, ...]
) -> None:
    """As if the rest was white a dead zone had been likelier than the friction that is there, by hundreds."""
    before, friction = stub_model(9.0), stub_model(2.4, likelihood=0.0)
    found, other = (
        stub_test("dead_zone", before, 5.0, 900.0),
        stub_test("coulomb_friction", before, 5.0, 600.0),
    )
    selection = stub_selection(2.0, SelectionStep(before, found, (found, other), (), 0.99))
    begun = replace(selection, model=with_effects(stub_model(2.0, likelihood=loss), "dead_zone"))
    without = with_effects(stub_model(4.0, likelihood=-evidence))
    monkeypatch.setattr(module, "begin_beside_torque", lambda *_: begun)
    monkeypatch.setattr(module, "refit_without", lambda model, *_: without if model is begun.model else 0)
    monkeypatch.setattr(
        module,
        "try_effects",
        lambda model, hold_out, names, *_: [CandidateTest(name, model, friction) for name in names],
    )
    left = check_beside_torque(selection, SILENT)
    assert left.steps == (replace(selection.steps[0], rivals=rivals),) and left.model is selection.model


@pytest.mark.parametrize(("times", "rivals"), [(BELOW, ("coulomb_friction",)), (ABOVE, ())])
def test_what_leaves_more_than_its_torque_does_is_no_rival(
    monkeypatch: pytest.MonkeyPatch, times: float, rivals: tuple[str, ...]
) -> None:
    """A drag was as likely as a real motor's breakaway, beside a torque that left two and a half times as much."""
    before = stub_model(9.0)
    other = stub_model(2.0 * times * thresholds.WORSE_GAP, likelihood=0.0)
    found, known = stub_test("dead_zone", before, 5.0, 900.0), stub_test("coulomb_friction", before, 5.0, 600.0)
    selection = stub_selection(2.0, SelectionStep(before, found, (found, known), (), 0.99))
    begun = replace(selection, model=with_effects(stub_model(2.0, likelihood=0.0), "dead_zone"))
    without = with_effects(stub_model(8.0, likelihood=-2.0 * thresholds.TIE_LIKELIHOOD))
    monkeypatch.setattr(module, "begin_beside_torque", lambda *_: begun)
    monkeypatch.setattr(module, "refit_without", lambda model, *_: without if model is begun.model else 0)
    monkeypatch.setattr(
        module, "try_effects", lambda model, hold_out, names, *_: [CandidateTest(name, model, other) for name in names]
    )
    assert [step.rivals for step in check_beside_torque(selection, SILENT).steps] == [rivals]


@pytest.mark.parametrize(
    ("times", "kept"), [(BELOW, ("coulomb_friction",)), (ABOVE, ("coulomb_friction", "dead_zone"))]
)
def test_what_the_torque_that_is_left_has_no_need_of_is_dropped(
    monkeypatch: pytest.MonkeyPatch, times: float, kept: tuple[str, ...]
) -> None:
    """Whatever it was needed for as if the rest was white; and the least likely first, each beside the others."""
    likelihoods = {
        ("coulomb_friction", "dead_zone"): 50.0,
        ("coulomb_friction",): 50.0 - times * thresholds.TIE_LIKELIHOOD,
    }
    before, effects = stub_model(9.0), ("coulomb_friction", "dead_zone")
    steps = [SelectionStep(before, stub_test(name, before, 5.0, 900.0), (), (), 0.99) for name in effects]
    plain = replace(stub_selection(2.0, *steps), model=with_effects(stub_model(2.0), *effects))

    def refit(model: Model, effect: str, hold_out: HoldOut) -> Model:
        left = tuple(name for name in model.effects if name != effect)
        return with_effects(stub_model(3.0, likelihood=likelihoods.get(left, 0.0)), *left)

    begun = replace(plain, model=with_effects(stub_model(2.0, likelihood=50.0), *effects))
    monkeypatch.setattr(module, "begin_beside_torque", lambda *_: begun)
    monkeypatch.setattr(module, "refit_without", refit)
    monkeypatch.setattr(module, "try_effects", lambda *_: [])
    left = check_beside_torque(plain, SILENT)
    assert tuple(step.found.effect for step in left.steps) == kept == left.model.effects


@pytest.mark.parametrize(
    ("with_it", "left", "random", "kept"),
    [
        (1.0, 1.0, False, 0),
        (1.0, 3.0, False, 1),
        (2.0, 2.0 * BELOW * thresholds.WORSE_GAP, False, 0),  # neither leaves what its torque does
        (2.0, 2.0 * ABOVE * thresholds.WORSE_GAP, False, 1),
        (2.0, 2.0 * BELOW * thresholds.TORQUE_AS_MOTOR_GAP, True, 0),
        (2.0, 2.0 * ABOVE * thresholds.TORQUE_AS_MOTOR_GAP, True, 1),  # a torque in the place of the motor
    ],
)
def test_a_torque_that_does_not_leave_what_it_should_drops_nothing(
    monkeypatch: pytest.MonkeyPatch, with_it: float, left: float, random: bool, kept: int
) -> None:
    """A breakaway that a slow torque was likelier than, beside which the gap rose to twice what that leaves."""
    before, effect = stub_model(9.0), "static_friction"
    step = SelectionStep(before, stub_test(effect, before, 1.0, 900.0), (), (), 0.99)
    begun = replace(stub_selection(1.0, step), model=with_effects(stub_model(with_it, likelihood=50.0), effect))
    without = replace(with_effects(stub_model(left, likelihood=64.0)), random=random)
    assert begun.model.complete is (with_it == 1.0) and without.complete is (random or left == 1.0)
    monkeypatch.setattr(module, "begin_beside_torque", lambda *_: begun)
    monkeypatch.setattr(module, "refit_without", lambda *_: without)
    monkeypatch.setattr(module, "try_effects", lambda *_: [])
    assert len(check_beside_torque(begun, SILENT).steps) == kept


@pytest.mark.parametrize(
    ("effect", "instead", "loss", "alike"),
    [
        ("coulomb_friction", "load_bias", BELOW * thresholds.RIVAL_MARGIN, True),  # the same, where nothing turns back
        ("coulomb_friction", "load_bias", ABOVE * thresholds.RIVAL_MARGIN, False),
    ],
)
def test_what_is_replaced_is_a_rival_if_it_is_as_likely_from_where_the_other_leads(
    monkeypatch: pytest.MonkeyPatch, effect: str, instead: str, loss: float, alike: bool
) -> None:
    bare, better = stub_model(5.0, likelihood=-900.0), stub_model(1.0, likelihood=-100.0)
    again = stub_model(1.0, likelihood=-100.0 - loss)
    monkeypatch.setattr(module, "try_effects", lambda model, _, names, *__: [CandidateTest(*names, model, again)])
    test = CandidateTest(instead, bare, better)
    assert module._is_as_likely_from_there(effect, test, bare, stub_selection(2.0)) is alike


@pytest.mark.parametrize(
    ("escaped", "gain", "neither"), [(ABOVE, BELOW, True), (BELOW, BELOW, False), (ABOVE, ABOVE, False)]
)
def test_what_is_better_only_than_a_local_minimum_is_not_needed_either(
    escaped: float, gain: float, neither: bool
) -> None:
    """A limit beyond all that was applied, in the place of a friction without which a fit had ended far away."""
    stuck, least = stub_model(1.02, likelihood=-900.0), likelihood_threshold()
    bare = stub_model(0.299, likelihood=-900.0 + escaped * least)
    better = stub_model(0.296, likelihood=bare.likelihood + gain * least)
    assert module._needs_neither(CandidateTest("voltage_limit", stuck, better), bare) is neither


@pytest.mark.parametrize("needed", [True, False])
def test_where_neither_is_needed_a_finding_goes(monkeypatch: pytest.MonkeyPatch, needed: bool) -> None:
    without, bare = (with_effects(stub_model(1.0, likelihood=value)) for value in (-900.0, -150.0))
    current = with_effects(stub_model(0.2, likelihood=-200.0), "coulomb_friction")
    better = CandidateTest("load_bias", without, with_effects(stub_model(0.3, likelihood=-100.0), "load_bias"))
    step = step_of(CandidateTest("coulomb_friction", without, current))
    selection = replace(stub_selection(2.0, step), model=current)
    monkeypatch.setattr(module, "list_replacements", lambda *_: ["load_bias"])
    monkeypatch.setattr(module, "try_effects", lambda *_: [better])
    monkeypatch.setattr(module, "start_from_same_size", lambda test, *_: test)
    monkeypatch.setattr(module, "_drop_without_own_evidence", lambda tests, *_: tests)
    monkeypatch.setattr(module, "refit_without", lambda *_: bare)
    monkeypatch.setattr(module, "_needs_neither", lambda test, model: not needed and model is bare)
    monkeypatch.setattr(module, "_is_as_likely_from_there", lambda *_: False)
    left = module.try_in_place(selection, step, without, current, SILENT)
    assert [one.found.effect for one in left.steps] == (["load_bias"] if needed else [])
    assert left.model is (better.model if needed else bare)


@pytest.mark.parametrize(
    ("effect", "seen", "left"),
    [
        ("coulomb_friction", True, ["dead_zone"]),
        ("coulomb_friction", False, ["transport_delay", "dead_zone"]),
        ("quadratic_drag", True, ["transport_delay", "dead_zone"]),  # it holds nothing
    ],
)
def test_what_is_seen_to_hold_the_motor_is_replaced_by_what_holds_it(
    monkeypatch: pytest.MonkeyPatch, effect: str, seen: bool, left: list[str]
) -> None:
    """A delay bends the transients of a robot more than its friction does, but it moves where that stood."""
    without, current = stub_model(5.0), stub_model(4.0)
    tests = [stub_test(name, without, 3.0, 200.0) for name in ("transport_delay", "dead_zone")]
    monkeypatch.setattr(module, "is_own_evidence", lambda name, one, other: seen)
    monkeypatch.setattr(module, "has_same_evidence", lambda other, *_: other is tests[1].model)
    kept = module._drop_without_own_evidence(tests, effect, without, current)
    assert [test.effect for test in kept] == left


@pytest.mark.parametrize("at_once", [True, False])
def test_what_is_there_from_the_start_takes_no_place(monkeypatch: pytest.MonkeyPatch, at_once: bool) -> None:
    """In a motion one way a load step at its beginning does the work of a friction, and is likelier by chance."""
    without = with_effects(stub_model(5.0, likelihood=-900.0))
    current = with_effects(stub_model(2.0, likelihood=-200.0), "coulomb_friction")
    step = step_of(CandidateTest("coulomb_friction", without, current), stub_test("load_step", without, 2.0, 600.0))
    load = CandidateTest("load_step", without, with_effects(stub_model(1.5, likelihood=-100.0), "load_step"))
    monkeypatch.setattr(module, "catch_up", lambda current, *_: current)
    monkeypatch.setattr(module, "try_effects", lambda *_: [load])
    monkeypatch.setattr(module, "is_there_from_the_start", lambda test: at_once)
    monkeypatch.setattr(module, "is_own_evidence", lambda *_: False)
    monkeypatch.setattr(module, "_is_as_likely_from_there", lambda *_: False)
    monkeypatch.setattr(module, "refit_without", lambda *_: without)
    selection = replace(stub_selection(2.0, step), model=current)
    (left,) = module.try_in_place(selection, step, without, current, SILENT).steps
    assert left.found.effect == ("coulomb_friction" if at_once else "load_step")


@pytest.mark.parametrize("comes_back", [True, False])
def test_what_does_not_come_back_over_the_angle_takes_no_place_but_is_a_rival(
    monkeypatch: pytest.MonkeyPatch, comes_back: bool
) -> None:
    """A disc that turned by 0.56 took a load's place, and half of 106 s went into what went with it."""
    without = with_effects(stub_model(5.0, likelihood=-900.0))
    current = with_effects(stub_model(2.0, likelihood=-200.0), "torque_ripple")
    disc = "encoder_eccentricity"
    step = step_of(CandidateTest("torque_ripple", without, current), stub_test(disc, without, 2.0, 600.0))
    test = CandidateTest(disc, without, with_effects(stub_model(1.5, likelihood=-100.0), disc))
    monkeypatch.setattr(module, "catch_up", lambda current, *_: current)
    monkeypatch.setattr(module, "try_effects", lambda *_: [test])
    monkeypatch.setattr(module, "drop_chance_harmonics", lambda tests: tests)
    monkeypatch.setattr(module, "comes_back", lambda one: one is test and comes_back)
    monkeypatch.setattr(module, "find_rivals", lambda *_: ())
    monkeypatch.setattr(module, "_is_as_likely_from_there", lambda *_: False)
    monkeypatch.setattr(module, "refit_without", lambda *_: without)
    selection = replace(stub_selection(2.0, step), model=current)
    (left,) = module.try_in_place(selection, step, without, current, SILENT).steps
    assert (left.found.effect, left.rivals) == ((disc, ()) if comes_back else ("torque_ripple", (disc,)))


@pytest.mark.parametrize(
    ("effect", "gap", "gain", "rivals"),
    [
        ("transport_delay", BELOW, BELOW, ()),
        ("transport_delay", ABOVE, BELOW, ("transport_delay",)),
        ("transport_delay", ABOVE, ABOVE, ()),
        ("quadratic_drag", ABOVE, BELOW, ()),  # no lag
    ],
)
def test_what_is_replaced_by_what_leaves_more_is_its_rival(
    monkeypatch: pytest.MonkeyPatch, effect: str, gap: float, gain: float, rivals: tuple[str, ...]
) -> None:
    """A dead time left less of unseen motion than the inductance that was likelier beside a random torque."""
    without = with_effects(stub_model(5.0, likelihood=-900.0))
    current = with_effects(stub_model(2.0, likelihood=-200.0), effect)
    step = step_of(CandidateTest(effect, without, current), stub_test("armature_inductance", without, 2.0, 600.0))
    instead = with_effects(
        stub_model(gap * thresholds.SAME_GAP * 2.0, likelihood=gain * thresholds.CONTRADICTED - 200.0),
        "armature_inductance",
    )
    monkeypatch.setattr(module, "catch_up", lambda current, *_: current)
    monkeypatch.setattr(module, "try_effects", lambda *_: [CandidateTest("armature_inductance", without, instead)])
    monkeypatch.setattr(module, "_is_as_likely_from_there", lambda *_: False)
    monkeypatch.setattr(module, "refit_without", lambda *_: without)
    monkeypatch.setattr(module, "is_own_evidence", lambda *_: False)
    selection = replace(stub_selection(2.0, step), model=current)
    (left,) = module.try_in_place(selection, step, without, current, SILENT).steps
    assert (left.found.effect, left.rivals) == ("armature_inductance", rivals)


@pytest.mark.parametrize(
    ("effect", "alone", "gap", "share", "rivals"),
    [
        ("coast_drive", ABOVE, BELOW, ABOVE, ("coast_drive",)),
        ("coast_drive", BELOW, BELOW, ABOVE, ()),  # it was less likely alone, too
        ("coast_drive", ABOVE, ABOVE, ABOVE, ()),  # it leaves more
        ("coast_drive", ABOVE, BELOW, BELOW, ()),  # beside the torque it is told from the other by far
        ("dead_zone", ABOVE, BELOW, ABOVE, ()),  # of what holds the motor another rule decides
    ],
)
def test_what_leaves_no_more_and_was_likelier_alone_is_a_rival_of_what_is_likelier_beside_a_torque(
    monkeypatch: pytest.MonkeyPatch, effect: str, alone: float, gap: float, share: float, rivals: tuple[str, ...]
) -> None:
    """A drag was named for certain, and a coasting bridge left less: only what was assumed of the torque told them."""
    other = "coulomb_friction" if effect == "dead_zone" else "quadratic_drag"
    without, instead = with_effects(stub_model(5.0, likelihood=-1000.0)), stub_model(2.0, likelihood=0.0)
    least = (1.0 - thresholds.LITTLE_OF_LEFT) * 1000.0
    current = with_effects(stub_model(gap * 2.0, likelihood=share * least - 1000.0), effect)
    plain = stub_model(5.0)
    step = step_of(stub_test(effect, plain, 2.0, alone * 600.0), stub_test(other, plain, 2.0, 600.0))
    better = CandidateTest(
        other, without, with_effects(replace(instead, learned=ErrorModel(0.0, 0.1, 0.01, 1.0)), other)
    )
    monkeypatch.setattr(module, "catch_up", lambda current, *_: current)
    monkeypatch.setattr(module, "start_from_same_size", lambda test, *_: test)
    monkeypatch.setattr(module, "settle", lambda test, *_: test)
    monkeypatch.setattr(module, "try_effects", lambda *_: [better])
    monkeypatch.setattr(module, "_is_as_likely_from_there", lambda *_: False)
    monkeypatch.setattr(module, "refit_without", lambda *_: without)
    monkeypatch.setattr(module, "is_own_evidence", lambda *_: False)
    monkeypatch.setattr(module, "holds_nearly_as_well", lambda *_: False)
    selection = replace(stub_selection(2.0, step), model=current)
    (left,) = module.try_in_place(selection, step, without, current, SILENT).steps
    assert (left.found.effect, left.rivals) == (other, rivals)


LEAST_LEAD = thresholds.HOLDING_LEAD * 800.0  # of the evidence below


@pytest.mark.parametrize(
    ("effect", "instead", "gain", "found", "rivals"),
    [
        ("dead_zone", "coulomb_friction", BELOW * -LEAST_LEAD, "dead_zone", ("coulomb_friction",)),
        ("dead_zone", "coulomb_friction", ABOVE * -LEAST_LEAD, "dead_zone", ()),
        ("coulomb_friction", "dead_zone", -0.5 * LEAST_LEAD, "coulomb_friction", ()),  # which every motor has
        ("coulomb_friction", "dead_zone", 0.5 * LEAST_LEAD, "dead_zone", ("coulomb_friction",)),
        ("coulomb_friction", "dead_zone", 2.0 * LEAST_LEAD, "dead_zone", ()),
    ],
)
def test_a_friction_in_the_place_of_a_dead_zone_is_its_rival_unless_that_is_far_likelier(
    monkeypatch: pytest.MonkeyPatch, effect: str, instead: str, gain: float, found: str, rivals: tuple[str, ...]
) -> None:
    """What has no name bends a motion where it turns back, too: a dead zone was likelier beside it by up to 0.29."""
    without = with_effects(stub_model(5.0, likelihood=-1000.0))
    current = with_effects(stub_model(2.0, likelihood=-200.0), effect)
    step = step_of(CandidateTest(effect, without, current), stub_test(instead, without, 2.0, 600.0))
    other = with_effects(stub_model(2.0, likelihood=gain - 200.0), instead)
    monkeypatch.setattr(module, "catch_up", lambda current, *_: current)
    monkeypatch.setattr(module, "start_from_same_size", lambda test, *_: test)
    monkeypatch.setattr(module, "settle", lambda test, *_: test)
    monkeypatch.setattr(module, "try_effects", lambda *_: [CandidateTest(instead, without, other)])
    monkeypatch.setattr(module, "_is_as_likely_from_there", lambda *_: False)
    monkeypatch.setattr(module, "refit_without", lambda *_: without)
    monkeypatch.setattr(module, "is_own_evidence", lambda *_: False)
    selection = replace(stub_selection(2.0, step), model=current)
    (left,) = module.try_in_place(selection, step, without, current, SILENT).steps
    assert (left.found.effect, left.rivals) == (found, rivals)
