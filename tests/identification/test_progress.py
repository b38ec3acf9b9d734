"""Progress of a long computation: it goes up and never arrives early, and stops where its caller says so."""

import pytest

from motor_identification import progress
from motor_identification.progress import HALF, Heartbeat, ProgressReporter, Stage, Stopped, TimeLimit


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


def test_a_time_limit_counts_once_there_is_a_result_and_keeps_the_best() -> None:
    now = [0.0]
    limit = TimeLimit[float](10.0, lambda: False, lambda one, other: one < other, lambda: now[0])
    now[0] = 10.1
    assert not limit.over()  # nothing to return yet
    for result in (3.0, 1.0, 2.0):
        limit.keep(result)
    assert limit.best == 1.0 and limit.reached and limit.over()
    now[0] = 9.9
    assert not limit.reached and not limit.over()
    now[0], limit.done = 10.1, True
    assert not limit.over()


def test_a_search_that_begins_again_has_the_time_that_is_left() -> None:
    now = [0.0]
    limit = TimeLimit[float](10.0, lambda: False, lambda one, other: one < other, lambda: now[0])
    limit.keep(1.0)
    limit.done, now[0] = True, 9.9
    assert limit.begin_again() and limit.best is None and not limit.over()
    limit.keep(2.0)
    now[0] = 10.1
    assert limit.over() and limit.best == 2.0
    limit.done = True
    assert not limit.begin_again() and limit.best == 2.0 and limit.done


def test_what_a_search_begins_with_is_a_result() -> None:
    limit = TimeLimit[float](0.0, lambda: False, lambda one, other: one < other, iter(range(9)).__next__)
    assert not limit.over()
    limit.keep(1.0)
    limit.begin_with(2.0)
    assert limit.best == 2.0 and limit.over()


def test_what_is_done_at_the_end_goes_on_from_there() -> None:
    stages: list[Stage] = []
    late = ProgressReporter(stages.append, lambda: False).beyond(0.95)
    for share in (0.1, 0.97):
        late.report("step 1", share, "", 0.5)
    assert [stage.share for stage in stages] == [0.95, 0.97]


def test_a_callers_wish_is_no_time_limit() -> None:
    limit = TimeLimit[float](10.0, lambda: True, lambda one, other: one < other, lambda: 0.0)
    limit.keep(1.0)
    assert limit.over() and not limit.reached
