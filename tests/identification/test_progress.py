"""Progress of a long computation: it goes up and never arrives early, and stops where its caller says so."""

import pytest

from motor_identification import progress
from motor_identification.progress import HALF, Heartbeat, ProgressReporter, Stage, Stopped


def test_a_stage_of_unknown_length_goes_on_as_long_as_something_is_done(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(progress, "TELL_EVERY", 0.0)
    told: list[tuple[str, float]] = []
    working = Heartbeat(lambda text, share: told.append((text, share)))
    assert not any(working() for _ in range(10)) and told == []  # a search tells its own progress
    working.begin("least squares", 0.5, 0.9)
    for _ in range(3 * HALF):
        assert working() is False
    assert told[0] == ("least squares", 0.5)
    assert told[HALF] == (f"least squares, {HALF} simulations", pytest.approx(0.7))
    assert told[3 * HALF] == (f"least squares, {3 * HALF} simulations", pytest.approx(0.85))
    shares = [share for _, share in told]
    assert all(a < b for a, b in zip(shares, shares[1:], strict=False)) and shares[-1] < 0.9


def test_it_tells_a_few_times_a_second_and_not_at_every_simulation() -> None:
    told: list[float] = []
    working = Heartbeat(lambda text, share: told.append(share))
    working.begin("least squares", 0.5, 0.9)
    for _ in range(500):
        working()
    assert 1 <= len(told) < 50


def test_a_diagnosis_that_is_stopped_says_so() -> None:
    stages: list[Stage] = []
    ProgressReporter(stages.append, lambda: False).report("step 1", 0.3, "backlash", 0.5)
    assert stages == [Stage("step 1", 0.3, "backlash", 0.5)]
    with pytest.raises(Stopped, match=r"^the diagnosis was stopped\.$"):
        ProgressReporter(stages.append, lambda: True).report("step 2", 0.4, "", 0.5)
    assert len(stages) == 1
