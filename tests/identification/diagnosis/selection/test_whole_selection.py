"""A selection beside a random torque is not the result where the model to begin with predicts the motion better."""

import pytest
from stub_models import stub_model, stub_test, with_effects
from stub_selections import selection_of, step_of

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.evidence import static_evidence
from motor_identification.diagnosis.selection import whole_selection as module
from motor_identification.progress import ProgressReporter

SILENT = ProgressReporter(lambda stage: None, lambda: False)


@pytest.mark.parametrize(
    ("gap", "steps", "begun"), [(1.101, 0, True), (1.099, 0, False), (1.101, 1, True), (1.099, 1, False)]
)
def test_a_model_of_the_torque_alone_is_not_the_result(
    monkeypatch: pytest.MonkeyPatch, gap: float, steps: int, begun: bool
) -> None:
    """What the diagnosis began with predicts the motion better."""
    start = selection_of(stub_model(2.0))
    step = step_of(stub_test("dead_zone", start.model, 1.0, 100.0))
    ended = selection_of(stub_model(2.0 * gap), *([step] * steps))
    assert thresholds.GAP_CHANCE == 1.1
    monkeypatch.setattr(module, "select_forward", lambda selection, reporter: start)
    monkeypatch.setattr(module, "retry_with_another_first", lambda selection, reporter: start)
    monkeypatch.setattr(module, "select_beside_torque", lambda *rest: start)
    monkeypatch.setattr(module, "drop_undetermined", lambda selection, reporter: (ended, ("coast_drive",)))
    assert module.select(start, SILENT) == (start if begun else ended, ("coast_drive",))


@pytest.mark.parametrize(
    ("alone", "left", "found"),
    [
        (("coulomb_friction",), 0.9, "plain"),
        (("coulomb_friction",), 1.1 * thresholds.EXPLAINED_GAP, "nothing"),  # more than the sensor leaves
        (("coulomb_friction", "quadratic_drag"), 0.9, "nothing"),  # the same, and as untold
        (("coast_drive",), 0.9, "nothing"),  # another motor
    ],
)
def test_what_a_torque_adds_to_does_not_take_away_what_is_told_without_one(
    monkeypatch: pytest.MonkeyPatch, alone: tuple[str, ...], left: float, found: str
) -> None:
    """A fan's friction, drag and late command were found, at the floor, and nothing was named at 43 times that."""
    start = selection_of(stub_model(9.0))
    plain = selection_of(with_effects(stub_model(left), *alone))
    beside = selection_of(with_effects(stub_model(0.8), "coulomb_friction", "quadratic_drag"))
    monkeypatch.setattr(module, "select_forward", lambda selection, reporter: plain)
    monkeypatch.setattr(module, "retry_with_another_first", lambda selection, reporter: plain)
    monkeypatch.setattr(module, "retry_with_pair", lambda selection, reporter: plain)
    monkeypatch.setattr(module, "select_beside_torque", lambda *rest: beside)
    monkeypatch.setattr(module, "list_hidden_by_torque", lambda *rest: ())
    monkeypatch.setattr(module, "fits_slow_torque", lambda *rest: False)
    monkeypatch.setattr(module, "drop_undetermined", lambda selection, reporter: (selection, ()))
    untold = ("coulomb_friction", "quadratic_drag")
    monkeypatch.setattr(module, "find_untold", lambda model: untold if model.effects == untold else ())
    monkeypatch.setattr(static_evidence, "find_untold", lambda model: untold if model.effects == untold else ())
    chosen, names = module.select(start, SILENT)
    assert (chosen, names) == ((plain, ()) if found == "plain" else (start, untold))


@pytest.mark.parametrize(
    ("left", "again", "undetermined", "taken"),
    [
        (9.0, 0.9, (), True),
        (9.0, 1.1 * thresholds.EXPLAINED_GAP, (), False),  # structure is left from there, too
        (9.0, 0.9, ("warm_up",), False),
        (0.9, 0.8, (), False),  # nothing is left that would need it
    ],
)
def test_a_selection_that_leaves_structure_begins_anew_from_what_is_kindred(
    left: float, again: float, undetermined: tuple[str, ...], taken: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Friction did the work of a dead zone, which was found from there only, with all that was missing."""
    start = selection_of(stub_model(10.0))
    first = selection_of(stub_model(left, 0.0), step_of(stub_test("coulomb_friction", start.model, left, 100.0)))
    other = selection_of(stub_model(again, 0.0), step_of(stub_test("dead_zone", start.model, again, 90.0)))
    monkeypatch.setattr(module, "select_forward", lambda selection, *_, **__: other if selection is other else first)
    monkeypatch.setattr(module, "retry_with_another_first", lambda selection, reporter: selection)
    monkeypatch.setattr(module, "retry_with_pair", lambda selection, reporter: selection)
    monkeypatch.setattr(module, "begin_from_kindred", lambda selection: [other])
    ended = {id(first): (first, ()), id(other): (other, undetermined)}
    monkeypatch.setattr(module, "_select_from", lambda start, begun, found, plain, reporter: ended[id(plain)])
    assert module.select(start, SILENT) == ((other, ()) if taken else (first, ()))


@pytest.mark.parametrize(("gap", "torque"), [(2.9, True), (3.1, False)])
def test_a_torque_that_takes_the_place_of_the_motor_in_the_end_is_not_believed(
    gap: float, torque: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What was not determined was dropped beside it, and left five times what had been found without one."""
    start = selection_of(stub_model(9.0))
    plain = selection_of(stub_model(1.0, 0.0), step_of(stub_test("coulomb_friction", start.model, 1.0, 100.0)))
    beside = selection_of(stub_model(1.5, 0.0))
    left = selection_of(stub_model(gap, 0.0), step_of(stub_test("quadratic_drag", start.model, gap, 100.0)))
    assert thresholds.TORQUE_AS_MOTOR_GAP == 3.0
    monkeypatch.setattr(module, "select_forward", lambda *_, **__: plain)
    monkeypatch.setattr(module, "retry_with_another_first", lambda selection, reporter: selection)
    monkeypatch.setattr(module, "retry_with_pair", lambda selection, reporter: selection)
    monkeypatch.setattr(module, "select_beside_torque", lambda *rest: beside)
    monkeypatch.setattr(module, "begin_from_kindred", lambda selection: [])
    monkeypatch.setattr(module, "eliminate_backward", lambda selection, reporter: selection)
    monkeypatch.setattr(module, "drop_undetermined", lambda one, reporter: (left if one is beside else one, ()))
    monkeypatch.setattr(module, "list_hidden_by_torque", lambda *rest: ())
    monkeypatch.setattr(module, "find_untold", lambda model: ())
    chosen, _ = module.select(start, SILENT)
    assert chosen.model is (left if torque else plain).model


def test_what_comes_with_a_kindred_effect_is_tried_and_sizes_are_doubted_in_every_selection(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    start = selection_of(stub_model(9.0))
    plain = selection_of(stub_model(1.0, 0.0), step_of(stub_test("dead_zone", start.model, 1.0, 100.0)))
    dependent = selection_of(stub_model(0.9, 0.0), step_of(stub_test("coulomb_friction", start.model, 0.9, 110.0)))
    doubted = selection_of(stub_model(0.9, 0.0), step_of(stub_test("coulomb_friction", start.model, 0.9, 110.0)))
    monkeypatch.setattr(module, "select_forward", lambda *_, **__: plain)
    for name in ("retry_with_another_first", "retry_with_pair"):
        monkeypatch.setattr(module, name, lambda selection, reporter: selection)
    monkeypatch.setattr(module, "retry_with_dependent", lambda one, reporter: dependent if one is plain else one)
    monkeypatch.setattr(module, "select_beside_torque", lambda *rest: None)
    monkeypatch.setattr(module, "eliminate_backward", lambda selection, reporter: selection)
    monkeypatch.setattr(module, "drop_undetermined", lambda selection, reporter: (selection, ()))
    monkeypatch.setattr(module, "find_untold", lambda model: ())
    monkeypatch.setattr(module, "doubt_shared_sizes", lambda one: doubted if one.model is dependent.model else one)
    assert module.select(start, SILENT) == (doubted, ())
