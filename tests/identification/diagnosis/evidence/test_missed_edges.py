"""Missed edges are counted, and told from what else makes an interval short."""

import pytest
from stub_models import short_by, stub_model

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.evidence.missed_edges import MissedEdges, count_missed_edges


def counted(*slots: float, slot: float = 0.3) -> MissedEdges:
    found = count_missed_edges(short_by(slots, slot=slot))
    assert found is not None
    return found


def test_what_is_short_by_whole_slots_is_counted() -> None:
    found = counted(*[1] * 5, *[2] * 2)
    assert found == MissedEdges(short=9.0, counted=40.0, odd=0)
    assert found.rate == pytest.approx(9.0 / 49.0) and found.rate_error == pytest.approx(3.0 / 49.0)


@pytest.mark.parametrize(("count", "certain"), [(4, False), (5, True)])
def test_as_many_as_no_wrong_stamps_make(count: int, certain: bool) -> None:
    assert thresholds.LEAST_MISSED_EDGES == 5
    assert counted(*[1] * count).certain is certain


def test_edges_counted_twice_are_none_that_were_missed() -> None:
    assert counted(*[-1] * 8) == MissedEdges(short=0.0, counted=40.0, odd=8)


@pytest.mark.parametrize(
    ("odd", "certain"), [([-1] * 4, True), ([-1] * 5, False), ([1.5] * 16, True), ([1.5] * 18, False)]
)
def test_motion_that_went_astray_is_no_missed_edge(
    odd: list[float], certain: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One and a half slots count as one or two that are missing, and as one that is none."""
    monkeypatch.setattr(thresholds, "WHOLE_SLOT", (0.2, 0.2))
    assert counted(*[1] * 8, *odd, slot=0.32).certain is certain


@pytest.mark.parametrize(("slot", "missed"), [(0.29, False), (0.3, True)])
def test_what_a_random_torque_may_do_is_no_missed_edge(slot: float, missed: bool) -> None:
    """The stub's travel scatters by 0.0625 rad, and so far off is it too: 3.75 of that and once more are 0.297."""
    assert counted(*[1] * 8, slot=slot).certain is missed


def test_without_slots_nothing_is_missed() -> None:
    assert count_missed_edges(stub_model(1.0, 0.0)) is None
