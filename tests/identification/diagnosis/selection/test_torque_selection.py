"""Whether what was found without a random torque is judged again beside one, and which of the two is believed."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from stub_models import StubModel, late_by, rescored, stub_model, stub_test, with_effects
from stub_selections import selection_of, step_of

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import likelihood_threshold, pair_threshold
from motor_identification.diagnosis.selection import torque_selection as module
from motor_identification.diagnosis.selection.selection import Selection
from motor_identification.noise.error_model import ErrorModel
from motor_identification.progress import ProgressReporter

SILENT = ProgressReporter(lambda stage: None, lambda: False)


def seen(model: Model, by_fit: bool) -> Model:
    """The model, judged by motion that its fit has seen, or not."""
    return replace(model, held=replace(model.held, seen=by_fit))


def selected(monkeypatch: pytest.MonkeyPatch, plain: Selection, begun: Selection, ended: Selection) -> Selection | None:
    """What is selected where nothing is fitted: the selections beside a torque are given."""
    monkeypatch.setattr(Model, "complete", True)
    monkeypatch.setattr(module, "may_be_of_gains", lambda step, hold_out: step.before.noise.drift > 0.0)
    monkeypatch.setattr(module, "begin_beside_torque", lambda *rest: begun)
    monkeypatch.setattr(module, "select_forward", lambda selection, *_, **__: selection)
    monkeypatch.setattr(module, "eliminate_backward", lambda selection, reporter: ended)
    return module.select_beside_torque(plain, plain, SILENT)


@pytest.mark.parametrize(
    ("by_fit", "gain", "believed"), [(True, 0.9, True), (True, 1.1, False), (False, 0.9, False), (False, -9.0, False)]
)
def test_a_gap_that_was_fitted_is_no_prediction(
    by_fit: bool, gain: float, believed: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Beside a torque the load step goes, and the gap doubles: that counts where the motion was held out."""
    before = seen(stub_model(8.0), by_fit)
    step = step_of(stub_test("load_step", before, 4.0, 100.0))
    plain = selection_of(seen(stub_model(4.0), by_fit), step)
    begun = selection_of(rescored(plain.model, likelihood=gain * likelihood_threshold()), step)
    ended = selection_of(seen(stub_model(2.0 * thresholds.WORSE_GAP * 4.0), by_fit))
    assert (selected(monkeypatch, plain, begun, ended) is ended) is believed


@pytest.mark.parametrize(("times", "believed"), [(0.999, True), (1.001, False)])
def test_a_prediction_is_compared_with_that_of_findings_that_stay(
    times: float, believed: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A load and a coasting bridge left 3.1 rad/s, and stood in for three others: two of those left 8.8 of 9.0."""
    before = seen(stub_model(8.0), False)
    stands_in = step_of(stub_test("load_bias", before, 3.0, 100.0))
    plain = selection_of(seen(stub_model(3.0), False), stands_in)
    monkeypatch.setattr(module, "drop_stand_ins_of_either", lambda one, other: selection_of(before))
    begun = selection_of(rescored(plain.model, likelihood=0.0), stands_in)
    ended = selection_of(seen(stub_model(times * thresholds.WORSE_GAP * 8.0), False))
    assert (selected(monkeypatch, plain, begun, ended) is ended) is believed


@pytest.mark.parametrize(
    ("times", "by_fit", "explained", "takes"),
    [(1.01, True, True, True), (0.99, True, True, False), (1.01, True, False, False), (1.01, False, True, True)],
)
def test_what_is_left_beside_a_torque_may_take_the_place_of_the_motor(
    times: float, by_fit: bool, explained: bool, takes: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Five stairs: 0.061 rad/s were left of a friction on a coasting bridge, 0.31 of a drag beside a torque."""
    monkeypatch.setattr(Model, "complete", explained)
    plain = selection_of(seen(stub_model(4.0), by_fit))
    left = selection_of(seen(stub_model(times * thresholds.TORQUE_AS_MOTOR_GAP * 4.0), by_fit))
    assert module.takes_place_of_motor(left, plain) is takes


@pytest.mark.parametrize(("times", "believed"), [(0.99, True), (1.01, False)])
def test_a_torque_in_the_place_of_the_motor_is_none(
    times: float, believed: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """However likely: beside one of 3 % a log one way left 84 rad/s of which kv and ka alone leave 14."""
    before = seen(stub_model(8.0), True)
    step = step_of(stub_test("transport_delay", before, 4.0, 100.0))
    plain = selection_of(seen(stub_model(4.0), True), step)
    begun = selection_of(rescored(plain.model, likelihood=0.0), step)
    ended = selection_of(seen(stub_model(times * thresholds.TORQUE_AS_MOTOR_GAP * 4.0), True))
    assert (selected(monkeypatch, plain, begun, ended) is ended) is believed


@pytest.mark.parametrize(
    ("by_fit", "volts", "believed"), [(True, 8.1, True), (True, 7.9, False), (False, 7.9, True), (False, 8.1, True)]
)
def test_beside_a_torque_beyond_all_that_was_applied_nothing_is_found(
    by_fit: bool, volts: float, believed: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Four real runs of one level each: a load was likelier by 26 beside 20 V of 7.9, and left as much as before."""
    monkeypatch.setattr(StubModel, "errors", ErrorModel(0.0, 0.0, 8.0, 0.01))
    applied = SimpleNamespace(voltage=np.array([0.0, -volts, volts / 2.0]))
    held = replace(seen(stub_model(4.0), by_fit).held, recordings=cast(Any, (applied,)))
    plain = selection_of(replace(stub_model(4.0), held=held))
    ended = selection_of(
        replace(plain.model, score=plain.model.score), step_of(stub_test("load_bias", plain.model, 3.9, 26.0))
    )
    assert (selected(monkeypatch, plain, plain, ended) is ended) is believed


@pytest.mark.parametrize(
    ("refused", "more", "torque", "believed"),
    [
        (True, "transport_delay", 0.1, True),
        (True, "transport_delay", 0.0, False),
        (True, "load_bias", 0.0, True),
        (True, "", 0.1, False),
        (False, "load_bias", 0.1, False),
    ],
)
def test_what_was_refused_is_looked_for_once_more(
    refused: bool, more: str, torque: float, believed: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """At the sensor's floor nothing else is judged again: more is believed; a lag only beside a torque [V]."""
    monkeypatch.setattr(StubModel, "errors", ErrorModel(0.0, 0.0, torque, 1.0))
    plain = replace(selection_of(stub_model(1.0, 0.0)), refused=refused)
    ended = selection_of(stub_model(0.999, 0.0, estimate=late_by(0.1)))
    effects: dict[int, Any] = {id(ended.model): (more,) if more else ()}
    monkeypatch.setattr(StubModel, "effects", property(lambda model: effects.get(id(model), ())))
    assert not plain.model.above_floor and not plain.model.lasts
    assert (selected(monkeypatch, plain, plain, ended) is ended) is believed


@pytest.mark.parametrize(("effect", "again"), [("load_step", True), ("warm_up", True), ("dead_zone", False)])
def test_what_comes_and_goes_in_time_has_to_hold_beside_a_torque(
    effect: str, again: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """However near to the sensor's floor: a slow torque does in one moment what a load step does."""
    step = step_of(stub_test(effect, stub_model(1.1, 0.0), 1.0, 100.0))
    plain, ended = selection_of(stub_model(1.0, 0.0), step), selection_of(stub_model(1.0, 0.0))
    assert not plain.model.above_floor and not plain.model.lasts
    assert (selected(monkeypatch, plain, plain, ended) is ended) is again


@pytest.mark.parametrize("dropped", [False, True])
def test_what_elimination_changed_is_selected_on_from(monkeypatch: pytest.MonkeyPatch, dropped: bool) -> None:
    """A limit and a load step stood in for a coasting bridge and a friction: in their place one, then the other."""
    before = stub_model(4.0)
    found = [step_of(stub_test(effect, before, 1.0, 100.0)) for effect in ("voltage_limit", "coast_drive", "dead_zone")]
    limit, coast, both = (
        selection_of(stub_model(gap), *steps) for gap, steps in ((3.0, found[:1]), (2.0, found[1:2]), (1.0, found[1:]))
    )
    effects = {
        id(limit.model): ("voltage_limit",),
        id(coast.model): ("coast_drive",),
        id(both.model): ("coast_drive", "dead_zone"),
    }
    monkeypatch.setattr(StubModel, "effects", property(lambda model: effects.get(id(model), ())))
    further = {id(coast): both, id(both): both}
    left = {id(limit): coast if dropped else limit, id(both): both}
    monkeypatch.setattr(module, "select_forward", lambda selection, reporter: further[id(selection)])
    monkeypatch.setattr(module, "eliminate_backward", lambda selection, reporter: left[id(selection)])
    assert module._select_both_ways(limit, SILENT) is (both if dropped else limit)


@pytest.mark.parametrize("circle", [True, False])
def test_a_selection_that_swings_ends(monkeypatch: pytest.MonkeyPatch, circle: bool) -> None:
    """What was added to a load goes again, and the load stays as it was found, with its rivals; else it ends, too."""
    names = (
        "load_step",
        "load_bias",
        "dead_zone",
        "load_bias" if circle else "coast_drive",
        "warm_up",
        "static_friction",
    )
    several = [selection_of(stub_model(2.0)) for _ in names]
    effects = {id(one.model): (name,) for one, name in zip(several, names, strict=True)}
    monkeypatch.setattr(StubModel, "effects", property(lambda model: effects.get(id(model), ())))
    steps = iter(several)
    monkeypatch.setattr(module, "select_forward", lambda selection, reporter: next(steps))
    monkeypatch.setattr(module, "eliminate_backward", lambda selection, reporter: next(steps))
    found = module._select_both_ways(next(steps), SILENT)
    assert found is several[1 if circle else 2 * thresholds.ROUNDS + 1]


@pytest.mark.parametrize(("gaps", "chosen"), [((0.999, 1.001), 1), ((1.001, 1.5), 0), ((0.999, 0.998), 0)])
def test_a_torque_that_leaves_less_than_it_should_is_taken_where_the_beginning_leads_nowhere(
    monkeypatch: pytest.MonkeyPatch, gaps: tuple[float, float], chosen: int
) -> None:
    """An eccentricity beside such a torque stood in for a ripple, which is found from the beginning."""
    step = step_of(stub_test("dead_zone", stub_model(9.0), 5.0, 100.0))
    plain, start = selection_of(stub_model(5.0), step), selection_of(stub_model(9.0))
    ended = [selection_of(stub_model(2.0 * gap)) for gap in gaps]
    monkeypatch.setattr(Model, "complete", True)
    monkeypatch.setattr(StubModel, "noise_floor", 2.0 / thresholds.RANDOM_GAP[0])
    monkeypatch.setattr(module, "begin_beside_torque", lambda model, *rest: plain if model is plain.model else start)
    monkeypatch.setattr(module, "select_forward", lambda selection, *_, **__: selection)
    monkeypatch.setattr(module, "eliminate_backward", lambda selection, reporter: ended[selection is start])
    assert module.select_beside_torque(start, plain, SILENT) is ended[chosen]


@pytest.mark.parametrize(
    ("comes", "before", "now", "chosen"),
    [
        ("dead_zone", True, True, 0),
        ("coulomb_friction", True, True, 1),
        ("dead_zone", False, True, 1),  # by another torque, beside which nothing is left that can be predicted
        ("dead_zone", False, False, None),
    ],
)
def test_a_beginning_that_comes_to_what_was_found_is_gone_on_from_again_where_that_left_structure_alone(
    monkeypatch: pytest.MonkeyPatch, comes: str, before: bool, now: bool, chosen: int | None
) -> None:
    """Two thirds of the time that a slow sine of a real motor took, for the same friction."""
    found = stub_test("dead_zone", stub_model(9.0), 5.0, 100.0)
    plain, start = (
        selection_of(with_effects(stub_model(5.0), "dead_zone"), step_of(found)),
        selection_of(stub_model(9.0)),
    )
    ended = [selection_of(stub_model(2.0)), selection_of(stub_model(2.0))]
    begun = selection_of(with_effects(stub_model(5.0), comes))
    sought: list[frozenset[str]] = []

    def select(selection: Selection, _: ProgressReporter, known: frozenset[str] = frozenset()) -> Selection:
        sought.append(known)
        return begun if known else selection

    complete = {id(ended[0].model): before, id(begun.model): now, id(ended[1].model): now}
    monkeypatch.setattr(module, "is_of_no_motor", lambda model: False)
    monkeypatch.setattr(Model, "complete", property(lambda model: complete.get(id(model), True)))
    monkeypatch.setattr(StubModel, "noise_floor", 2.5 / thresholds.RANDOM_GAP[0])
    monkeypatch.setattr(module, "begin_beside_torque", lambda model, *rest: plain if model is plain.model else start)
    monkeypatch.setattr(module, "select_forward", select)
    monkeypatch.setattr(module, "_select_both_ways", lambda selection, _: ended[selection is begun])
    monkeypatch.setattr(module, "_choose_more", lambda selection, *_: selection)
    monkeypatch.setattr(Model, "fills_floor", property(lambda model: model is ended[1].model))
    wanted = None if chosen is None else ended[chosen]
    assert module.select_beside_torque(start, plain, SILENT) is wanted
    assert sought == [frozenset(), frozenset(plain.model.effects)]


@pytest.mark.parametrize(
    ("certain", "by_fit", "left", "kept"),
    [(False, False, 0.99, True), (False, False, 1.01, False), (True, False, 0.99, False), (False, True, 0.99, False)],
)
def test_what_halves_the_gap_is_kept_where_nothing_else_is_certain(
    certain: bool, by_fit: bool, left: float, kept: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A friction under a coasting bridge, neither of which shows alone, of a motor that turns back faster than both."""
    plain = selection_of(seen(stub_model(8.0), by_fit))
    stays = selection_of(plain.model, step_of(stub_test("voltage_limit", plain.model, 4.0, 100.0)))
    ended = selection_of(seen(stub_model(left * thresholds.HALVED_GAP * 8.0), by_fit))
    monkeypatch.setattr(Model, "complete", False)
    monkeypatch.setattr(module, "is_of_no_motor", lambda model: False)
    monkeypatch.setattr(module, "may_be_of_gains", lambda step, hold_out: False)
    monkeypatch.setattr(module, "begin_beside_torque", lambda *rest: plain)
    monkeypatch.setattr(module, "select_forward", lambda selection, *_, **__: selection)
    monkeypatch.setattr(module, "eliminate_backward", lambda selection, reporter: ended)
    monkeypatch.setattr(module, "drop_stand_ins_of_either", lambda *several: stays if certain else plain)
    assert (module.select_beside_torque(plain, plain, SILENT) is ended) is kept


@pytest.mark.parametrize("same", [True, False])
def test_what_depends_on_where_it_was_begun_is_not_kept(same: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    plain, one, other = (selection_of(seen(stub_model(gap), False)) for gap in (8.0, 1.0, 1.1))
    effects = {id(one.model): ("coast_drive",), id(other.model): ("coast_drive" if same else "voltage_limit",)}
    monkeypatch.setattr(StubModel, "effects", property(lambda model: effects.get(id(model), ())))
    monkeypatch.setattr(module, "is_of_no_motor", lambda model: False)
    monkeypatch.setattr(module, "drop_stand_ins_of_either", lambda *several: plain)
    assert (module._choose_incomplete([one, other], plain) is one) is same


@pytest.mark.parametrize(
    ("no_motor", "beside_neither", "kept"), [(True, False, True), (True, True, False), (False, False, False)]
)
def test_what_makes_a_motor_of_it_is_kept_though_structure_is_left(
    no_motor: bool, beside_neither: bool, kept: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    plain, found = (selection_of(seen(stub_model(gap), True)) for gap in (8.0, 1.0))
    unlike = {id(plain.model): no_motor, id(found.model): beside_neither}
    monkeypatch.setattr(module, "is_of_no_motor", lambda model: unlike[id(model)])
    assert (module._choose_incomplete([found], plain) is found) is kept


@pytest.mark.parametrize("differ", [True, False])
def test_what_runs_may_differ_in_is_judged_again(differ: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """An asymmetry of runs at the sensor's floor may be of their supplies."""
    before = replace(stub_model(1.2), noise=replace(stub_model(1.2).noise, drift=1.0 if differ else 0.0))
    plain = selection_of(stub_model(1.0), step_of(stub_test("direction_asymmetry", before, 1.0, 100.0)))
    ended = selection_of(stub_model(1.2))
    assert (selected(monkeypatch, plain, plain, ended) is ended) is differ


@pytest.mark.parametrize(
    ("share", "by_fit", "found", "hidden"),
    [
        (0.21, True, 1, True),
        (0.19, True, 1, False),
        (0.0251, True, 1, False),
        (0.0249, True, 1, True),  # of the 40 intervals one takes 0.025
        (0.21, False, 1, False),
        (0.21, True, 2, False),
    ],
)
def test_a_torque_as_slow_as_the_recording_or_faster_than_rows_hides_what_was_found(
    share: float, by_fit: bool, found: int, hidden: bool
) -> None:
    """A friction gives way to a torque that no motion which the fits have seen can tell from it."""
    before = seen(stub_model(2.0, 0.0), by_fit)
    friction = stub_test("coulomb_friction", before, 1.2, 100.0)
    step = replace(step_of(friction), rivals=("load_bias",))
    plain = selection_of(seen(stub_model(1.2, 0.0), by_fit), *[step] * found)
    time = float(np.ptp(plain.model.held.intervals[0].time))
    assert thresholds.FEW_COURSES == 5.0 and plain.model.complete
    beside = selection_of(replace(plain.model, learned=ErrorModel(0.0, 0.0, 0.1, share * time)))
    names = module.list_hidden_by_torque(plain, beside)
    assert names == (("coulomb_friction", "load_bias") if hidden else ())
    assert module.list_hidden_by_torque(plain, replace(beside, steps=(step,))) == ()


@pytest.mark.parametrize(
    ("gain", "by_fit", "found", "hidden"),
    [
        (0.05, True, 1, True),
        (0.05, True, 2, True),
        (0.05, True, 0, False),
        (0.05, False, 1, False),
        (0.0, True, 1, False),
    ],
)
def test_gains_of_runs_hide_what_was_found(gain: float, by_fit: bool, found: int, hidden: bool) -> None:
    """A friction makes six runs at levels of their own scatter by 6 %; nothing was missing, it was said."""
    before = seen(stub_model(2.0, 0.0), by_fit)
    step = replace(step_of(stub_test("coulomb_friction", before, 1.2, 100.0)), rivals=("dead_zone",))
    plain = selection_of(seen(stub_model(1.2, 0.0), by_fit), *[step] * found)
    time = float(np.ptp(plain.model.held.intervals[0].time))
    beside = selection_of(replace(plain.model, learned=ErrorModel(0.0, 0.0, 0.1, 0.1 * time, gain=gain)))
    names = module.list_hidden_by_torque(plain, beside)
    assert names == (("coulomb_friction", "dead_zone") if hidden else ())
    assert module.list_hidden_by_torque(plain, replace(beside, steps=(step,))) == ()


def test_gains_of_runs_hide_curves_though_they_left_more_and_no_lag() -> None:
    """A friction and an asymmetry of six runs, whose gains left some of it without them: nothing was said."""
    before = seen(stub_model(9.0), True)
    names = ("direction_asymmetry", "transport_delay", "coulomb_friction")
    steps = [step_of(stub_test(name, before, 5.0, 100.0)) for name in names]
    plain = selection_of(seen(stub_model(4.0), True), *steps)
    assert not plain.model.complete
    for gain, hidden in ((0.05, ("coulomb_friction", "direction_asymmetry")), (0.0, ())):
        beside = selection_of(replace(plain.model, learned=ErrorModel(0.0, 0.0, 0.1, 0.1, gain=gain)))
        assert module.list_hidden_by_torque(plain, beside) == hidden


@pytest.mark.parametrize(
    ("plain_gap", "left", "kept", "too_much"),
    [
        (1.0, 0.74, ("voltage_limit",), True),
        (1.0, 0.76, ("voltage_limit",), False),
        (9.0, 0.74, ("voltage_limit",), False),  # more was left than the sensor leaves
        (1.0, 0.74, ("voltage_limit", "load_step"), False),  # it is no less than was found
    ],
)
def test_a_torque_that_would_leave_more_than_is_left_stands_for_nothing(
    plain_gap: float, left: float, kept: tuple[str, ...], too_much: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Beside edges that were missed, for a drag that the sensor's floor had been reached with."""
    plain = with_effects(stub_model(plain_gap), "voltage_limit", "quadratic_drag")
    monkeypatch.setattr(Model, "noise_floor", 1.0)
    assert thresholds.RANDOM_GAP[0] == 0.75
    assert module._is_too_much(with_effects(stub_model(left), *kept), plain) is too_much


@pytest.mark.parametrize(
    ("gain", "gap", "disturbed", "taken"),
    [
        (1.01, 0.9, False, True),
        (0.99, 0.9, False, False),  # by no more than chance gives two effects of a table
        (1.01, 1.0, False, False),  # it leaves as much
        (-1.0, 1.5, True, True),  # where a torque is, what is beside it is the result anyway
    ],
)
def test_what_is_far_likelier_beside_a_torque_takes_the_place_of_what_was_found(
    monkeypatch: pytest.MonkeyPatch, gain: float, gap: float, disturbed: bool, taken: bool
) -> None:
    """A limit of the voltage was found for a friction and a drag, which hid each other, and kv was 26 % large."""
    start = stub_model(2.0)
    plain = selection_of(
        with_effects(stub_model(1.0), "voltage_limit"), step_of(stub_test("voltage_limit", start, 1.0, 50.0))
    )
    step = step_of(stub_test("quadratic_drag", start, gap, 50.0))
    model = with_effects(stub_model(gap, 0.0, likelihood=gain * pair_threshold()), "coulomb_friction", "quadratic_drag")
    beside = selection_of(model, step)
    alike = selection_of(with_effects(stub_model(1.0), "voltage_limit"))
    monkeypatch.setattr(module, "begin_beside_torque", lambda *rest: alike)
    assert module._choose_more(beside, plain, disturbed) is (beside if taken else None)
