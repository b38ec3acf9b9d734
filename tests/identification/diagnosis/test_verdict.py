"""How a diagnosis ends, and missed edges as a finding."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from stub_models import stub_model

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.result import Finding, Verdict
from motor_identification.diagnosis.verdict import decide, find_missed_edges
from motor_model.effects import EFFECT_BY_NAME

SLOT = 0.3  # [rad] of 0.625 that the motor turns in an interval


def finding(*rivals: str) -> Finding:
    return Finding("coulomb_friction", 5.0, 1.0, 100.0, "", {}, (), rivals, "coast" if rivals else "")


AT, OVER = 0.999 * thresholds.EXPLAINED_GAP, 1.001 * thresholds.EXPLAINED_GAP


@pytest.mark.parametrize(
    ("gap", "findings", "hidden", "verdict", "profile"),
    [
        (AT, (), (), Verdict.NOTHING_MISSING, ""),
        (AT, (finding(),), (), Verdict.EXPLAINED, ""),
        (AT, (finding("dead_zone"),), (), Verdict.UNDECIDED, "coast"),
        (AT, (finding("dead_zone"),), ("warm_up",), Verdict.UNDECIDED, "coast"),
        (AT, (finding(),), ("coulomb_friction",), Verdict.EXPLAINED, ""),
        (AT, (), ("coulomb_friction",), Verdict.UNDECIDED, "ramps"),
        (OVER, (), (), Verdict.UNEXPLAINED, ""),
        (OVER, (finding(),), ("warm_up",), Verdict.UNEXPLAINED, "rich"),
        (OVER, (finding("dead_zone"),), ("warm_up",), Verdict.UNEXPLAINED, "coast"),
    ],
)
def test_how_it_ended(
    gap: float, findings: tuple[Finding, ...], hidden: tuple[str, ...], verdict: Verdict, profile: str
) -> None:
    assert decide(findings, stub_model(gap, 0.0), hidden) == (verdict, profile)


@pytest.mark.parametrize(
    ("confirms", "verdict", "profile"), [(False, Verdict.UNDECIDED, "ramps"), (True, Verdict.EXPLAINED, "")]
)
def test_one_response_explains_nothing(confirms: bool, verdict: Verdict, profile: str) -> None:
    model = stub_model(AT, 0.0)
    model = replace(model, held=replace(model.held, confirms=confirms))
    assert decide((finding(),), model, ()) == (verdict, profile)
    assert decide((), model, ()) == (Verdict.NOTHING_MISSING, "")
    more = stub_model(OVER, 0.0)
    left = decide((), replace(more, held=replace(more.held, confirms=confirms)), ())
    assert left == ((Verdict.UNDECIDED, "rich") if not confirms else (Verdict.UNEXPLAINED, ""))


@pytest.mark.parametrize("gap", [AT, OVER])
def test_what_is_not_determined_is_undecided_and_no_finding(gap: float) -> None:
    verdict, profile = decide((finding(),), stub_model(gap, 0.0), (), ("transport_delay",))
    assert verdict is Verdict.UNDECIDED and profile == EFFECT_BY_NAME["transport_delay"].shown_by


def short_by(slots: Sequence[float], gap: float = 1.0) -> Model:
    """A model on intervals of one slot each, some of which are short by whole slots and are not scored."""
    model = stub_model(gap, 0.0)
    (data,), count = model.held.intervals, len(model.held.counted)
    missed = np.zeros(count)
    missed[: len(slots)] = slots
    edge = np.column_stack([np.arange(count), np.arange(1, count + 1)])
    short = replace(data, slot=SLOT, edge=edge, speed=data.speed - missed * SLOT / data.duration)
    marks = missed != 0.0
    held = replace(model.held, intervals=(short,), scored=(~marks,), miscounted=int(marks.sum()))
    return replace(model, held=held)


@pytest.mark.parametrize("count", [thresholds.LEAST_MISSED_EDGES - 1, thresholds.LEAST_MISSED_EDGES])
def test_as_many_missed_edges_as_no_wrong_stamps_make(count: int) -> None:
    found = find_missed_edges(short_by([1] * count))
    assert (found is not None) == (count >= thresholds.LEAST_MISSED_EDGES)


def test_the_rate_of_missed_edges() -> None:
    found = find_missed_edges(short_by([1] * 5 + [2] * 2))
    assert found is not None and found.effect == "missed_edges" and found.evidence == 9.0
    assert found.parameters["miss_rate"] == pytest.approx((9.0 / 49.0, 3.0 / 49.0))  # 40 were counted
    assert found.gap_before > 2.0 and found.gap_after == pytest.approx(1.0)
    assert found.where == "7 intervals are short by whole slots, whatever the motor does"


def test_edges_counted_twice_are_none_that_were_missed() -> None:
    assert find_missed_edges(short_by([-1] * 8)) is None


@pytest.mark.parametrize(
    ("odd", "found"), [([-1] * 4, True), ([-1] * 5, False), ([1.5] * 16, True), ([1.5] * 18, False)]
)
def test_motion_that_went_astray_is_no_missed_edge(
    odd: list[float], found: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One and a half slots count as one or two that are missing, and as one that is none."""
    monkeypatch.setattr(f"{__name__}.SLOT", 0.32)
    monkeypatch.setattr(thresholds, "WHOLE_SLOT", (0.2, 0.2))
    assert (find_missed_edges(short_by([1] * 8 + odd)) is not None) == found


@pytest.mark.parametrize(("gap", "found"), [(AT, True), (OVER, False)])
def test_only_a_complete_model_tells_missed_edges(gap: float, found: bool) -> None:
    assert (find_missed_edges(short_by([1] * 12, gap)) is not None) is found


def test_without_slots_nothing_is_missed() -> None:
    assert (
        find_missed_edges(replace(stub_model(1.0, 0.0), held=replace(stub_model(1.0, 0.0).held, miscounted=9))) is None
    )


@pytest.mark.parametrize(("slot", "missed"), [(0.29, False), (0.3, True)])
def test_what_a_random_torque_may_do_is_no_missed_edge(
    slot: float, missed: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The stub's travel scatters by 0.0625 rad, and so far off is it too: 3.75 of that and once more are 0.297."""
    monkeypatch.setattr(f"{__name__}.SLOT", slot)
    assert (find_missed_edges(short_by([1] * 8)) is not None) == missed
