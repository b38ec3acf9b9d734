"""Findings of what was selected: missed edges among them, what came nearest, and what is not told to be unseen."""

from dataclasses import replace

import pytest
from stub_models import short_by, stub_model, stub_test
from stub_selections import selection_of, step_of

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.findings import find_missed_edges, find_nearest, leave_out_named
from motor_identification.diagnosis.result import Finding, Nearest
from motor_identification.sensor.pulses.missed_edges import MissedShare

AT, OVER = 0.999 * thresholds.EXPLAINED_GAP, 1.001 * thresholds.EXPLAINED_GAP


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


@pytest.mark.parametrize(("gap", "found"), [(AT, True), (OVER, False)])
def test_only_a_complete_model_tells_missed_edges(gap: float, found: bool) -> None:
    assert (find_missed_edges(short_by([1] * 12, gap)) is not None) is found


@pytest.mark.parametrize("gap", [AT, OVER])
def test_edges_themselves_tell_the_share_that_was_missed_whatever_the_model(gap: float) -> None:
    model = short_by([1], gap)
    (data,) = model.held.intervals
    told = replace(model, held=replace(model.held, intervals=(replace(data, missed=MissedShare(0.03, 0.002)),)))
    found = find_missed_edges(told)
    assert found is not None and found.effect == "missed_edges" and found.parameters == {"miss_rate": (0.03, 0.002)}
    assert found.evidence == pytest.approx(112.5)  # of log likelihood, at 15 standard errors
    assert "whatever the motor does" in found.where


@pytest.mark.parametrize(("miscounted", "found"), [(4, False), (5, True)])
def test_intervals_that_are_scored_are_not_miscounted(miscounted: int, found: bool) -> None:
    model = short_by([1] * 12)
    model = replace(model, held=replace(model.held, miscounted=miscounted))
    assert (find_missed_edges(model) is not None) is found


def test_without_slots_nothing_is_missed() -> None:
    model = stub_model(1.0, 0.0)
    assert find_missed_edges(replace(model, held=replace(model.held, miscounted=9))) is None


@pytest.mark.parametrize(
    ("gaps", "told"),
    [
        ([20.0, 10.0, 8.0], ("load_bias", "dead_zone")),  # the third does little
        ([20.0, 15.0, 8.0], ("load_bias", "dead_zone", "load_step")),
        ([8.1, 8.0], ("load_bias",)),
        ([20.0, 24.0 * thresholds.NEAREST_GAP * 1.01], None),
        ([], None),
    ],
)
def test_what_comes_nearest_are_the_first_effects_that_do_most(gaps: list[float], told: tuple[str, ...] | None) -> None:
    """Of 24 rad/s without any: 80 % in squares of what all take away."""
    models = [stub_model(24.0), *map(stub_model, gaps)]
    names = ("load_bias", "dead_zone", "load_step")
    steps = [
        step_of(stub_test(name, before, after, 100.0)) for name, before, after in zip(names, models, gaps, strict=False)
    ]
    found = find_nearest(selection_of(models[-1], *steps), 24.0)
    assert found == (None if told is None else Nearest(told, pytest.approx(gaps[len(told) - 1])))


@pytest.mark.parametrize(("share", "told"), [(0.99, True), (1.01, False)])
def test_of_motion_that_was_fitted_the_nearest_takes_away_more(share: float, told: bool) -> None:
    """As of a flywheel on a coasting bridge: 996 times the floor, and nothing was said but that."""
    gap = share * 24.0 * thresholds.HALVED_GAP
    after = replace(stub_model(gap), held=replace(stub_model(gap).held, seen=True))
    step = step_of(stub_test("coast_drive", stub_model(24.0), gap, 100.0))
    assert (find_nearest(selection_of(after, step), 24.0) is not None) is told


def test_what_may_be_missing_is_not_told_to_be_unseen() -> None:
    hidden = ("coulomb_friction", "dead_zone", "backlash")
    found = Finding("coulomb_friction", 5.0, 1.0, 100.0, "", {}, (), ("dead_zone",), "coast")
    assert leave_out_named(hidden, (), ()) == hidden
    assert leave_out_named(hidden, (), ("coulomb_friction",)) == ("dead_zone", "backlash")
    assert leave_out_named(hidden, (found,), ()) == ("coulomb_friction", "backlash")
