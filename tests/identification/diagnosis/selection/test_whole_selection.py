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
