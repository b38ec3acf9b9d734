"""A selection beside a random torque is not the result where the model to begin with predicts the motion better."""

import pytest
from stub_models import stub_model, stub_test
from stub_selections import selection_of, step_of

from motor_identification import diagnose as module
from motor_identification.diagnosis import thresholds
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
    assert module._select(start, SILENT) == (start if begun else ended, ("coast_drive",))
