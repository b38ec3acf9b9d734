"""What was found is asked for another timing; what is selected beside that is taken where it leaves less."""

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest

from motor_identification.diagnosis.selection import timed_selection
from motor_identification.diagnosis.selection.timed_selection import select_as_timed
from motor_identification.diagnosis.selection.whole_selection import Selected
from motor_identification.estimation.request import Request
from motor_identification.timing.speed_filter import SpeedFilter
from motor_identification.timing.timing import ASSUMED, OTHERS, UNTIL, Timing

ROW = 0.01  # [s]


@pytest.fixture(autouse=True)
def untold_voltages(monkeypatch: pytest.MonkeyPatch) -> None:
    """Rows hold the voltages from them on, wherever a test says nothing else."""
    monkeypatch.setattr(timed_selection, "find_voltages_beside", lambda *_: None)
    monkeypatch.setattr(timed_selection, "find_earlier_voltages_beside", lambda *_: None)


@pytest.mark.parametrize(
    ("gap", "above", "complete", "taken"),
    [
        (4.9, True, True, True),
        (5.1, True, True, False),
        (4.9, False, True, False),
        (4.9, True, False, False),
        (2.6, True, False, False),
        (2.4, True, False, True),  # what is left is far more than a filter hides of noise: there is none
    ],
)
def test_a_filter_behind_which_much_is_left_is_doubted(
    monkeypatch: pytest.MonkeyPatch, gap: float, above: bool, complete: bool, taken: bool
) -> None:
    """Of times between edges a ripple was taken for one: with its true timing a ninth was left."""
    smoothed = replace(ASSUMED, filter=SpeedFilter("twice", 0.3))
    asked: list[bool] = []

    def look(first: Any, selection: Any, filtered: bool = True, **_: Any) -> Timing:
        asked.append(filtered)
        return smoothed if filtered else OTHERS[0]

    gaps = iter([(10.0, above), (gap, True)])

    def select(*_: Any) -> Any:
        left, over = next(gaps)
        model = SimpleNamespace(held=SimpleNamespace(gap=left), above_floor=over, complete=complete)
        return SimpleNamespace(selection=SimpleNamespace(model=model), effects=("torque_ripple",), finished=True)

    def again(first: Any, timing: Timing, *_: Any) -> Any:
        return SimpleNamespace(selection=None, timing=timing)

    monkeypatch.setattr(timed_selection, "find_timing_beside", look)
    monkeypatch.setattr(timed_selection, "select_in_time", select)
    monkeypatch.setattr(timed_selection, "begin_as_timed", again)
    limit = SimpleNamespace(begin_with=lambda _: None, begin_again=lambda: True, best=None)
    reporter = SimpleNamespace(stopped=lambda: False, beyond=lambda _: None)
    first = SimpleNamespace(selection=None)
    start, _ = select_as_timed(first, Request(), reporter, limit)  # type: ignore[arg-type]
    assert start.timing == (OTHERS[0] if taken else smoothed)
    assert asked == ([True, False] if above else [True])


@pytest.mark.parametrize(
    ("above", "complete", "steps", "told", "explained", "taken"),
    [
        (True, False, True, True, True, True),
        (False, False, True, True, True, False),  # nothing is left
        (True, True, True, True, True, False),  # but what is random
        (True, False, False, True, True, False),  # and nothing is near
        (True, False, True, False, True, False),
        (True, False, True, True, False, False),  # by the other timing, too
    ],
)
def test_the_nearest_model_is_asked_for_the_timing_where_something_is_left(
    monkeypatch: pytest.MonkeyPatch, above: bool, complete: bool, steps: bool, told: bool, explained: bool, taken: bool
) -> None:
    """A backlash that nobody knew of hid it, and half a row kept the backlash from explaining what it does."""
    nearest = SimpleNamespace(steps=(1,) if steps else ())
    begun: list[Any] = []
    states = iter([(above, complete), (True, explained)])

    def select(*_: Any) -> Any:
        over, done = next(states)
        model = SimpleNamespace(held=SimpleNamespace(gap=1.0), above_floor=over, complete=done)
        return SimpleNamespace(selection=SimpleNamespace(model=model), effects=("backlash",), finished=True)

    def look(first: Any, selection: Any, lagging: bool = False) -> Timing | None:
        assert lagging is (selection is nearest)
        return OTHERS[0] if selection is nearest and told else None

    monkeypatch.setattr(timed_selection, "find_timing_beside", look)
    monkeypatch.setattr(timed_selection, "select_in_time", select)
    again = SimpleNamespace(selection=None, timing=OTHERS[0])
    first = SimpleNamespace(selection=None, timing=None)
    begin: Callable[..., Any] = lambda one, timing, *_: again if timing else first  # noqa: E731
    monkeypatch.setattr(timed_selection, "begin_as_timed", begin)
    limit = SimpleNamespace(begin_with=begun.append, begin_again=lambda: True, best=nearest)
    reporter = SimpleNamespace(stopped=lambda: False, beyond=lambda _: None)
    start, _ = select_as_timed(first, Request(), reporter, limit)  # type: ignore[arg-type]
    assert start.timing == (OTHERS[0] if taken else None)
    assert (begun[-1] is nearest) is (above and not complete and steps and told and not explained)


@pytest.mark.parametrize(
    ("delay", "effects", "taken"),
    [
        (0.00591, ("backlash", "transport_delay"), False),
        (0.00409, ("backlash", "transport_delay"), False),
        (0.00611, ("backlash", "transport_delay"), True),
        (0.00389, ("backlash", "transport_delay"), True),
        (0.005, ("backlash",), True),
    ],
)
def test_the_nearest_model_shows_no_instants_that_a_dead_time_makes_means_again(
    monkeypatch: pytest.MonkeyPatch, delay: float, effects: tuple[str, ...], taken: bool
) -> None:
    """Of a breakaway under two levels a dead time of 0.985 of half a row was named, and a drag."""
    nearest = SimpleNamespace(steps=(1,))
    states = iter([(False, ("backlash",)), (True, effects)])

    def select(*_: Any) -> Any:
        complete, found = next(states)
        estimate = SimpleNamespace(parameters=SimpleNamespace(value={"delay": delay}.__getitem__))
        model = SimpleNamespace(held=SimpleNamespace(gap=1.0), above_floor=True, complete=complete, estimate=estimate)
        return SimpleNamespace(selection=SimpleNamespace(model=model), effects=found, finished=True)

    def look(_: Any, selection: Any, lagging: bool = False) -> Timing | None:
        return OTHERS[0] if selection is nearest else None

    rows = [SimpleNamespace(info=SimpleNamespace(sample_period=ROW))]
    start, _ = select_from_assumed(monkeypatch, look, select, nearest, recordings=rows)
    assert start.timing == (OTHERS[0] if taken else None)


def select_from_assumed(
    monkeypatch: pytest.MonkeyPatch,
    look: Callable[..., Any],
    select: Callable[..., Any],
    best: Any = None,
    time: bool = True,
    recordings: Any = (),
) -> tuple[Any, Any]:
    """What is selected where the timing is as assumed at first, and instants are all that is found otherwise."""
    first = SimpleNamespace(selection=None, timing=None)
    again = SimpleNamespace(selection=None, timing=OTHERS[0], recordings=recordings)
    monkeypatch.setattr(timed_selection, "find_timing_beside", look)
    monkeypatch.setattr(timed_selection, "select_in_time", select)
    monkeypatch.setattr(timed_selection, "begin_as_timed", lambda one, timing, *_: again if timing else first)
    limit = SimpleNamespace(begin_with=lambda _: None, begin_again=lambda: time, best=best)
    reporter = SimpleNamespace(stopped=lambda: False, beyond=lambda _: None)
    return select_as_timed(first, Request(), reporter, limit)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("effect", "told", "time", "gap", "taken"),
    [
        ("armature_inductance", True, True, 1.09, True),
        ("armature_inductance", True, True, 1.11, False),
        ("armature_inductance", False, True, 1.0, False),
        ("armature_inductance", True, False, 1.0, False),  # the time limit is reached, and said
        ("transport_delay", True, True, 1.0, False),  # which is another word for a timing
    ],
)
def test_an_inductance_that_was_found_is_asked_for_the_timing(
    monkeypatch: pytest.MonkeyPatch, effect: str, told: bool, time: bool, gap: float, taken: bool
) -> None:
    gaps = iter([1.0, gap])

    def select(*_: Any) -> Any:
        held = SimpleNamespace(gap=next(gaps))
        model = SimpleNamespace(held=held, above_floor=False, complete=True, effects=(effect,))
        return Selected(SimpleNamespace(model=model), (), finished=True)  # type: ignore[arg-type]

    look: Callable[..., Any] = lambda *_, lagging=False: OTHERS[0] if lagging and told else None  # noqa: E731
    start, selected = select_from_assumed(monkeypatch, look, select, time=time)
    assert start.timing == (OTHERS[0] if taken else None)
    assert selected.finished is time


@pytest.mark.parametrize(
    ("complete", "told", "time", "gap", "explained", "found", "taken"),
    [
        (True, True, True, 1.09, True, (), True),
        (True, True, True, 1.09, True, ("coast_drive",), True),
        (True, True, True, 1.11, True, (), False),
        (True, True, True, 1.0, False, (), False),
        (True, True, True, 1.0, True, ("coast_drive", "dead_zone"), False),
        (True, True, False, 1.0, True, (), False),
        (True, False, True, 1.0, True, (), False),
        (False, True, True, 1.0, True, (), False),  # what is left may come early
    ],
)
def test_counts_that_answer_voltages_before_their_rows_need_no_effect_for_it(
    monkeypatch: pytest.MonkeyPatch,
    complete: bool,
    told: bool,
    time: bool,
    gap: float,
    explained: bool,
    found: tuple[str, ...],
    taken: bool,
) -> None:
    """Of ramps a load of 1.3 mV was named for a 160th of the time constant, 17 of its standard errors."""
    states = iter([(1.0, complete, ("load_bias",)), (gap, explained, found)])

    def select(*_: Any) -> Any:
        left, whole, effects = next(states)
        held = SimpleNamespace(gap=left)
        model = SimpleNamespace(held=held, above_floor=not whole, complete=whole, effects=effects)
        return Selected(SimpleNamespace(model=model), (), finished=True)  # type: ignore[arg-type]

    first = SimpleNamespace(selection=None, timing=None)
    again = SimpleNamespace(selection=None, timing=UNTIL)
    begin: Callable[..., Any] = lambda one, timing, *_: again if timing else first  # noqa: E731
    monkeypatch.setattr(timed_selection, "find_timing_beside", lambda *_, **__: None)
    monkeypatch.setattr(timed_selection, "find_voltages_beside", lambda *_: UNTIL if told else None)
    monkeypatch.setattr(timed_selection, "select_in_time", select)
    monkeypatch.setattr(timed_selection, "begin_as_timed", begin)
    limit = SimpleNamespace(begin_with=lambda _: None, begin_again=lambda: time, best=None)
    reporter = SimpleNamespace(stopped=lambda: False, beyond=lambda _: None)
    start, selected = select_as_timed(first, Request(), reporter, limit)  # type: ignore[arg-type]
    assert start.timing == (UNTIL if taken else None)
    assert selected.finished is (time or not told or not complete)


@pytest.mark.parametrize(
    ("named", "nearest_gap", "taken"),
    [((), 0.49, True), ((), 0.51, False), (("coulomb_friction",), 0.49, False)],
)
def test_the_nearest_model_is_asked_too_where_it_halves_what_is_said_to_be_a_torque(
    monkeypatch: pytest.MonkeyPatch, named: tuple[str, ...], nearest_gap: float, taken: bool
) -> None:
    """A friction and a drag in speeds over times between edges: all that was left was said to be random."""
    nearest = SimpleNamespace(steps=(1,), model=SimpleNamespace(held=SimpleNamespace(gap=nearest_gap)))

    def select(*_: Any) -> Any:
        model = SimpleNamespace(held=SimpleNamespace(gap=1.0), above_floor=True, complete=True)
        return SimpleNamespace(selection=SimpleNamespace(model=model), effects=named, finished=True)

    look: Callable[..., Any] = lambda first, one, **_: OTHERS[0] if one is nearest else None  # noqa: E731
    start, _ = select_from_assumed(monkeypatch, look, select, best=nearest)
    assert start.timing == (OTHERS[0] if taken else None)


@pytest.mark.parametrize(
    ("above", "complete", "gap", "taken"),
    [(True, False, 1.09, True), (True, False, 1.11, False), (True, True, 1.0, False), (False, False, 1.0, False)],
)
def test_what_was_found_is_asked_for_another_timing_where_something_is_left_that_can_be_predicted(
    monkeypatch: pytest.MonkeyPatch, above: bool, complete: bool, gap: float, taken: bool
) -> None:
    """A drag hid that speeds were of times between edges, and left 38 times the floor."""
    states = iter([(1.0, above, complete), (gap, False, True)])
    slotted = replace(OTHERS[0], slot=2.1)

    def select(*_: Any) -> Any:
        left, over, done = next(states)
        model = SimpleNamespace(held=SimpleNamespace(gap=left), above_floor=over, complete=done)
        return SimpleNamespace(selection=SimpleNamespace(model=model), effects=("quadratic_drag",), finished=True)

    timings = iter([OTHERS[0], slotted])
    monkeypatch.setattr(timed_selection, "find_timing_beside", lambda *_, **__: next(timings))
    monkeypatch.setattr(timed_selection, "select_in_time", select)
    monkeypatch.setattr(
        timed_selection, "begin_as_timed", lambda one, timing, *_: SimpleNamespace(selection=None, timing=timing)
    )
    limit = SimpleNamespace(begin_with=lambda _: None, begin_again=lambda: True, best=None)
    reporter = SimpleNamespace(stopped=lambda: False, beyond=lambda _: None)
    start, _ = select_as_timed(SimpleNamespace(selection=None), Request(), reporter, limit)  # type: ignore[arg-type]
    assert start.timing == (slotted if taken else OTHERS[0])


@pytest.mark.parametrize(
    ("timing", "delay", "left", "gap", "taken"),
    [
        (OTHERS[0], 0.0050, ("coulomb_friction",), 1.09, True),
        (OTHERS[0], 0.0059, ("coulomb_friction",), 1.09, True),
        (OTHERS[0], 0.0061, ("coulomb_friction",), 1.0, False),  # a dead time of its own
        (OTHERS[0], 0.0039, ("coulomb_friction",), 1.0, False),
        (OTHERS[0], 0.0050, ("coulomb_friction",), 1.11, False),
        (OTHERS[0], 0.0050, ("coulomb_friction", "transport_delay"), 1.0, False),
        (replace(OTHERS[0], slot=0.1), 0.0050, ("coulomb_friction",), 1.0, False),
        (ASSUMED, 0.0050, ("coulomb_friction",), 1.0, False),
    ],
)
def test_values_of_instants_that_are_half_a_row_late_are_means(
    monkeypatch: pytest.MonkeyPatch, timing: Timing, delay: float, left: tuple[str, ...], gap: float, taken: bool
) -> None:
    """Of means over rows of 10 ms a dead time of 4.98 ms was named, beside a friction nobody had known of."""
    states = iter([(1.0, ("coulomb_friction", "transport_delay")), (gap, left)])

    def select(*_: Any) -> Any:
        gap_left, effects = next(states)
        parameters = SimpleNamespace(value={"delay": delay}.__getitem__)
        model = SimpleNamespace(
            held=SimpleNamespace(gap=gap_left),
            above_floor=False,
            complete=True,
            estimate=SimpleNamespace(parameters=parameters),
        )
        return SimpleNamespace(selection=SimpleNamespace(model=model), effects=effects, finished=True)

    recordings = [SimpleNamespace(info=SimpleNamespace(sample_period=ROW))]
    monkeypatch.setattr(timed_selection, "find_timing_beside", lambda *_, **__: timing)
    monkeypatch.setattr(timed_selection, "select_in_time", select)
    monkeypatch.setattr(
        timed_selection,
        "begin_as_timed",
        lambda one, timing, *_: SimpleNamespace(selection=None, timing=timing, recordings=recordings),
    )
    limit = SimpleNamespace(begin_with=lambda _: None, begin_again=lambda: True, best=None)
    reporter = SimpleNamespace(stopped=lambda: False, beyond=lambda _: None)
    start, _ = select_as_timed(SimpleNamespace(selection=None), Request(), reporter, limit)  # type: ignore[arg-type]
    assert start.timing == (None if taken else timing)


EARLY = OTHERS[2]


@pytest.mark.parametrize(
    ("before", "after", "effects", "complete", "above", "taken"),
    [
        (EARLY, OTHERS[0], (), True, False, True),
        (EARLY, None, (), True, False, True),
        (EARLY, UNTIL, (), True, False, False),  # which are those before, too
        (OTHERS[0], ASSUMED, (), True, False, False),
        (EARLY, OTHERS[0], ("transport_delay",), True, False, False),
        (EARLY, OTHERS[0], ("dead_zone",), True, False, False),
        (EARLY, OTHERS[0], (), False, False, False),
        (EARLY, OTHERS[0], (), True, True, False),  # more is left than the sensor leaves
    ],
)
def test_a_lag_that_undoes_the_voltages_before_is_none(
    monkeypatch: pytest.MonkeyPatch,
    before: Timing,
    after: Timing | None,
    effects: tuple[str, ...],
    complete: bool,
    above: bool,
    taken: bool,
) -> None:
    """A motor without a dead time was read a row late, and had one of 0.93 of a row."""
    first_gap, other_gap = 0.28, 0.32
    selections = iter([(("transport_delay",), first_gap, True, False), (effects, other_gap, complete, above)])

    def select(*_: Any) -> Any:
        found, gap, done, over = next(selections)
        model = SimpleNamespace(held=SimpleNamespace(gap=gap), above_floor=over, complete=done)
        return SimpleNamespace(selection=SimpleNamespace(model=model), effects=found, finished=True)

    timings = iter([before, after])
    monkeypatch.setattr(timed_selection, "find_timing_beside", lambda *_, **__: next(timings))
    monkeypatch.setattr(timed_selection, "select_in_time", select)
    monkeypatch.setattr(
        timed_selection, "begin_as_timed", lambda one, timing, *_: SimpleNamespace(selection=None, timing=timing)
    )
    limit = SimpleNamespace(begin_with=lambda _: None, begin_again=lambda: True, best=None)
    reporter = SimpleNamespace(stopped=lambda: False, beyond=lambda _: None)
    start, _ = select_as_timed(SimpleNamespace(selection=None), Request(), reporter, limit)  # type: ignore[arg-type]
    assert start.timing == (after if taken else before)


@pytest.mark.parametrize(
    ("complete", "told", "time", "gap", "explained", "near", "taken"),
    [
        (False, True, True, 1.09, True, True, True),
        (False, True, True, 1.09, True, False, True),
        (False, True, True, 1.11, True, True, False),
        (False, True, True, 1.0, False, True, False),
        (False, True, False, 1.0, True, True, False),
        (False, False, True, 1.0, True, True, False),
        (True, True, True, 1.0, True, True, False),  # nothing is left that they would explain
    ],
)
def test_what_a_lag_hides_of_earlier_voltages_is_looked_for_before_the_table_is_left(
    monkeypatch: pytest.MonkeyPatch,
    complete: bool,
    told: bool,
    time: bool,
    gap: float,
    explained: bool,
    near: bool,
    taken: bool,
) -> None:
    """Of a limit and an inductance one row of 1 ms left 64 times the floor: an effect "which is not in the table"."""
    states = iter([(1.0, complete), (gap, explained)])
    asked: list[Any] = []
    kept: list[Any] = []

    def select(*_: Any) -> Any:
        left, whole = next(states)
        model = SimpleNamespace(held=SimpleNamespace(gap=left), above_floor=True, complete=whole)
        return Selected(SimpleNamespace(model=model, complete=whole), (), finished=True)  # type: ignore[arg-type]

    def look(first: Any, selection: Any, timing: Timing | None) -> Timing | None:
        asked.append((selection, timing))
        return UNTIL if told else None

    nearest = SimpleNamespace(steps=("voltage_limit",) if near else ())
    first = SimpleNamespace(selection=None, timing=None)
    again = SimpleNamespace(selection=None, timing=UNTIL)
    monkeypatch.setattr(timed_selection, "_select_beside_timing", lambda *_: (first, select()))
    monkeypatch.setattr(timed_selection, "find_earlier_voltages_beside", look)
    monkeypatch.setattr(timed_selection, "select_in_time", select)
    monkeypatch.setattr(timed_selection, "begin_as_timed", lambda *_: again)
    limit = SimpleNamespace(begin_with=kept.append, begin_again=lambda: time, best=nearest)
    reporter = SimpleNamespace(stopped=lambda: False, beyond=lambda _: None)
    start, selected = select_as_timed(first, Request(), reporter, limit)  # type: ignore[arg-type]
    assert start is (again if taken else first)
    assert selected.finished is (time or not told or complete)
    assert [(one is nearest, timing) for one, timing in asked] == ([] if complete else [(near, None)])
    assert (len(kept) == 1) is (told and time and not complete and not taken)
