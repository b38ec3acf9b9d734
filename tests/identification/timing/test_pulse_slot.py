"""Speeds over the times between edges are told by how long they stay, or by how late they are the slower they are."""

from dataclasses import replace
from functools import cache
from math import tau
from types import SimpleNamespace

import numpy as np
import pytest
from recorded import as_period_speed, as_speed, without_count
from scipy.signal import lfilter
from swinging import held_late, noisy, recorded
from tiers import keep_fast

from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.request import SearchConfig
from motor_identification.estimation.search.global_search import search_globally
from motor_identification.identify import Request, identify
from motor_identification.recording import Recording, check
from motor_identification.sensor.description import tells_of_speeds
from motor_identification.timing import pulse_slot, speed_timing
from motor_identification.timing.pulse_slot import (
    SlotGain,
    are_coarse,
    find_decay_slot,
    find_likeliest_slot,
    find_stays_slot,
    judge_slot,
    measure_gain_over_lag,
    measure_usual_travel,
)
from motor_identification.timing.shaped_fit import Shaper
from motor_identification.timing.smoothing import Likelihood
from motor_identification.timing.speed_filter import SpeedFilter
from motor_identification.timing.speed_timing import find_timing
from motor_identification.timing.timing import ASSUMED, INSTANT, OTHERS, Timing
from motor_model.parameters import PAPER_KV


def timing_of(recording: Recording) -> Timing:
    estimate, _ = search_globally(make_problem([recording], ()), SearchConfig())
    return find_timing([recording], estimate) or ASSUMED


def shaper_of(recording: Recording) -> Shaper:
    estimate, _ = search_globally(make_problem([recording], ()), SearchConfig())
    return Shaper([recording], estimate, None)


def logged(edges: int, rate: float = 50.0) -> Recording:
    return check(as_period_speed(recorded(edges=edges, sample_rate=rate)))


@cache
def slot_found(edges: int) -> Timing:
    """The timing of such a log, under the limits as they are."""
    return timing_of(logged(edges))


@pytest.fixture
def without_ticks(monkeypatch: pytest.MonkeyPatch) -> None:
    """As of a timer whose ticks the log's digits hide."""
    for where in (pulse_slot, speed_timing):
        monkeypatch.setattr(where, "list_tick_slots", lambda recordings: ())


@pytest.mark.parametrize(("edges", "rate"), keep_fast([(400, 50.0), (200, 200.0), (44, 100.0)], (200, 200.0)))
def test_whole_ticks_of_a_timer_tell_the_slot(edges: int, rate: float) -> None:
    """Where so many edges come in a row that the motion alone tells none, or one that is 13 % off."""
    assert timing_of(logged(edges, rate)).slot == pytest.approx(tau / edges, rel=1e-4)


def test_a_slow_motor_shows_the_slot_by_its_stays() -> None:
    recording = logged(12)
    assert find_stays_slot([recording]) == pytest.approx(2.0 * np.pi / 12, rel=0.05)
    found = slot_found(12)
    assert (found.window, found.lag, found.slot) == (INSTANT, 0.0, find_stays_slot([recording]))


@pytest.mark.parametrize("step", [0.0, 0.09])
def test_counts_that_stay_show_none(monkeypatch: pytest.MonkeyPatch, without_ticks: None, step: float) -> None:
    """Of counts of single rows, 1,960 a turn, it was 0.1 rad, and an inductance was named that the motor has not."""
    monkeypatch.setattr(pulse_slot, "find_speed_sensor", lambda _: SimpleNamespace(step=step))
    assert (find_stays_slot([logged(12)]) > 0.0) is (step == 0.0)


def test_a_fast_motor_shows_it_by_what_comes_late() -> None:
    recording = logged(48)
    assert find_stays_slot([recording]) == 0.0
    assert slot_found(48).slot == pytest.approx(2.0 * np.pi / 48, rel=0.06)


@pytest.fixture
def unlike_lag(monkeypatch: pytest.MonkeyPatch) -> None:
    """Any slot is likelier than a lag."""
    monkeypatch.setattr(speed_timing, "measure_gain_over_lag", lambda *_: np.inf)


def judge(shaper: Shaper, slot: float) -> SlotGain:
    return judge_slot(shaper, replace(OTHERS[0], slot=slot), OTHERS[0], shaper.fit(OTHERS[0]))


def test_the_true_slot_is_likelier_than_others() -> None:
    shaper, slot = shaper_of(logged(48)), 2.0 * np.pi / 48
    gains = [judge(shaper, factor * slot) for factor in (0.1, 1.0, 10.0)]
    assert gains[1].gain > max(gains[0].gain, gains[2].gain, 100.0)
    assert gains[1].rows > 500
    assert judge(shaper, 1e6).gain == -np.inf  # by which no row would bring a value


@pytest.mark.usefixtures("without_ticks")
def test_a_slot_that_values_do_not_stay_for_is_none() -> None:
    """A quarter of a slot is likely, too, but values stay for longer; four of them do not pass between two values."""
    shaper, slot = shaper_of(logged(12)), 2.0 * np.pi / 12
    assert [np.isfinite(judge(shaper, factor * slot).gain) for factor in (0.25, 1.0, 4.0)] == [False, True, False]


@pytest.mark.parametrize(("share", "told"), [(1.01, True), (0.99, False)])
def test_a_slot_of_more_than_a_turn_is_none(share: float, told: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    shaper, slot = shaper_of(logged(48)), 2.0 * np.pi / 48
    monkeypatch.setattr(pulse_slot, "LONGEST_SLOT", share * slot)
    assert np.isfinite(judge(shaper, slot).gain) is np.bool_(told)


@pytest.mark.usefixtures("without_ticks")
@pytest.mark.parametrize(("gain", "told"), [(0.1, True), (-0.1, False)])
def test_a_lag_that_is_as_likely_is_no_slot(gain: float, told: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """Smoothed speeds had a slot that was a little likelier than no lag, and far less likely than one."""
    shaper = shaper_of(logged(48))
    monkeypatch.setattr(speed_timing, "find_likeliest_slot", lambda *_: SlotGain(0.1, 100.0, 200))
    monkeypatch.setattr(speed_timing, "measure_gain_over_lag", lambda *_: gain)
    assert (speed_timing._find_periods(shaper, ASSUMED) is not None) is told


def test_true_times_between_edges_are_likelier_than_a_lag() -> None:
    shaper, slot = shaper_of(logged(48)), 2.0 * np.pi / 48
    assert measure_gain_over_lag(shaper, replace(OTHERS[0], slot=slot), OTHERS[0]) > 100.0
    late = check(noisy(0.05, instant=True, electrical_time_constant=0.02))
    made_up = replace(OTHERS[0], slot=measure_usual_travel([late]))
    assert measure_gain_over_lag(shaper_of(late), made_up, OTHERS[0]) < 0.0


def test_values_of_instants_and_means_show_none() -> None:
    for timing in (OTHERS[0], ASSUMED):
        shaper = shaper_of(check(noisy(0.05, instant=timing is OTHERS[0])))
        assert find_likeliest_slot(shaper, OTHERS[0], timing).gain < 0.0


@pytest.mark.slow
def test_smoothed_speeds_come_late_too_and_show_none() -> None:
    recording = check(noisy(0.05))
    speed = np.asarray(lfilter([0.3], [1.0, -0.7], recording.speed))
    found = timing_of(check(replace(recording, speed=speed)))
    assert found.slot == 0.0 and found.filter is not None


@pytest.mark.usefixtures("unlike_lag")
@pytest.mark.slow
def test_counts_and_what_is_held_are_explained_already(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(speed_timing, "LEAST_GAIN", -np.inf)
    monkeypatch.setattr(speed_timing, "LEAST_PULSE_GAIN_OF_ROW", -np.inf)
    monkeypatch.setattr(speed_timing, "LEAST_SLOT", 0.0)
    monkeypatch.setattr(pulse_slot, "contradicts", lambda *_: False)
    plain = check(noisy(0.05))
    assert timing_of(plain).slot > 0.0
    assert timing_of(check(without_count(as_speed(recorded(edges=96))))).slot == 0.0
    held = check(held_late(plain, 4, 0))
    assert timing_of(held).slot == 0.0


@pytest.mark.parametrize(("step", "coarse"), [(0.0, False), (0.01, False), (1.0, True)])
def test_speeds_of_a_few_steps_tell_no_slot(step: float, coarse: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """A cart that logged 0, 1 and 2 had a slot of 0.000162 rad made up, and 17 times its noise floor left."""
    plain = check(noisy(0.05))
    slow = plain.speed / 10.0
    log = check(replace(plain, speed=step * np.rint(slow / step) if step else slow))
    looked: list[float] = []
    found = pulse_slot.SlotGain(0.01, -np.inf, 0)
    monkeypatch.setattr(speed_timing, "find_likeliest_slot", lambda *_: looked.append(0.0) or found)
    assert are_coarse([log]) == coarse
    assert timing_of(log).slot == 0.0 and bool(looked) != coarse


@pytest.mark.usefixtures("without_ticks")
@pytest.mark.parametrize("converted", [True, False])
def test_a_converters_steps_are_no_times_between_edges(converted: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """A tachogenerator behind ten bits was said to be a slot of 0.0506 rad over the time between two edges."""
    shaper = shaper_of(logged(48))
    monkeypatch.setattr(speed_timing, "is_converted", lambda _: converted)
    monkeypatch.setattr(speed_timing, "find_likeliest_slot", lambda *_: SlotGain(0.1, 100.0, 200))
    monkeypatch.setattr(speed_timing, "measure_gain_over_lag", lambda *_: 1.0)
    assert (speed_timing._find_periods(shaper, ASSUMED) is None) is converted


@pytest.mark.usefixtures("without_ticks")
@pytest.mark.parametrize("stepped", [True, False])
def test_multiples_of_a_step_are_no_times_between_edges(stepped: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """Exact multiples of a count of 175 a turn were said to be a slot of 0.932 rad over the time between two edges."""
    shaper = shaper_of(logged(48))
    monkeypatch.setattr(speed_timing, "lies_on_steps", lambda _: stepped)
    monkeypatch.setattr(speed_timing, "find_likeliest_slot", lambda *_: SlotGain(0.1, 100.0, 200))
    monkeypatch.setattr(speed_timing, "measure_gain_over_lag", lambda *_: 1.0)
    assert (speed_timing._find_periods(shaper, ASSUMED) is None) is stepped


@pytest.mark.usefixtures("unlike_lag")
def test_a_slot_that_passes_many_times_in_a_row_is_an_instant(monkeypatch: pytest.MonkeyPatch) -> None:
    """A tachogenerator at 1 kHz had a slot of a thousandth of a row, and no noise then: its friction was not named."""
    shaper = shaper_of(check(noisy(0.05, instant=True)))
    least = speed_timing.LEAST_SLOT * measure_usual_travel(shaper.recordings)

    def found(share: float, gain: float) -> Timing | None:
        monkeypatch.setattr(speed_timing, "find_likeliest_slot", lambda *rest: SlotGain(share * least, gain, 1000))
        return speed_timing._find_periods(shaper, ASSUMED)

    assert found(0.99, 100.0) == OTHERS[0] and found(0.99, 9.0) is None and found(1.01, 9.0) is None
    told = found(1.01, 100.0)
    assert told is not None and told.slot == 1.01 * least
    # Counts at 100 Hz of a motor that coasts were called instants, which by all rows were less likely by 113.
    monkeypatch.setattr(speed_timing, "find_likeliest_slot", lambda *rest: SlotGain(0.99 * least, 100.0, 1000))
    assert speed_timing._find_periods(shaper_of(check(noisy(0.05))), ASSUMED) is None
    # Whole ticks prove it: values at turns are of no instant, and "of the rest 76 % can be predicted from the speed".
    monkeypatch.setattr(speed_timing, "list_tick_slots", lambda recordings: (0.5 * least, least))
    told = found(0.5, 100.0)
    assert told is not None and told.slot == 0.5 * least


@pytest.mark.parametrize(("behind", "taken"), [(4.9, 0.2), (5.1, 0.1)])
def test_of_ticks_slots_that_are_as_likely_the_longest_is_taken(
    behind: float, taken: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By half of one values after a turn, of a time that began before it, counted as new: an inductance was lost."""
    gains = {0.1: 41.5, 0.2: 41.5 - behind, 0.4: -80.0}
    monkeypatch.setattr(pulse_slot, "list_tick_slots", lambda recordings: tuple(gains))
    monkeypatch.setattr(
        pulse_slot, "judge_slot", lambda shaper, timing, *rest: SlotGain(timing.slot, gains[timing.slot], 350)
    )
    assert find_likeliest_slot(shaper_of(check(noisy(0.05))), OTHERS[0], ASSUMED).slot == taken


@pytest.mark.usefixtures("without_ticks")
@pytest.mark.parametrize("name", ["LEAST_GAIN", "LEAST_PULSE_GAIN_OF_ROW"])
def test_what_stays_do_not_show_has_to_be_much_likelier(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert slot_found(48).slot > 0.0
    monkeypatch.setattr(speed_timing, name, 1e6)
    assert timing_of(logged(48)).slot == 0.0
    assert timing_of(logged(12)).slot > 0.0


@pytest.mark.usefixtures("without_ticks")
def test_a_slot_is_looked_for_more_closely_where_one_is_likely(monkeypatch: pytest.MonkeyPatch) -> None:
    shaper = shaper_of(logged(36))
    close = find_likeliest_slot(shaper, OTHERS[0], OTHERS[0])
    monkeypatch.setattr(pulse_slot, "STEPS", ())
    assert find_likeliest_slot(shaper, OTHERS[0], OTHERS[0]).gain < close.gain


def test_a_voltage_that_held_until_the_row_is_told_beside_it() -> None:
    recording = logged(12)
    found = timing_of(check(replace(recording, voltage=np.append(0.0, recording.voltage[:-1]))))
    assert found.lag == -1.0 and found.slot > 0.0


def test_the_slot_that_falling_values_tell_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    """Any other was up to a half of it, or twice as large, by a likelihood that is as flat; or it was none."""
    recording = check(as_period_speed(recorded(edges=12, sample_rate=200.0), falls=True))
    slot = 2.0 * np.pi / 12
    assert find_decay_slot([recording]) == pytest.approx(slot, rel=1e-4)
    assert find_stays_slot([recording]) != find_decay_slot([recording])
    monkeypatch.setattr(speed_timing, "_find_periods", lambda *_: None)
    assert timing_of(recording).slot == find_decay_slot([recording])
    monkeypatch.setattr(pulse_slot, "find_slot_by_stays", lambda *_: 0.0)
    monkeypatch.setattr(pulse_slot, "find_slot_by_decays", lambda *_: 0.0)
    assert timing_of(recording).slot == 0.0


@pytest.mark.usefixtures("unlike_lag")
@pytest.mark.parametrize(("gain", "told"), [(1.01, True), (0.99, False)])
def test_what_stays_is_no_filter_where_a_slot_is_likelier(
    gain: float, told: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What stays is also what a filter's memory keeps: a log of 17 edges a row had one, and its friction was lost."""
    shaper = shaper_of(check(noisy(0.05, instant=True)))
    filtered = replace(OTHERS[0], filter=SpeedFilter("memory", 0.2))
    likelihood = Likelihood(shaper, filtered)
    lost = likelihood.of(filtered.filter) - likelihood.of(None)  # of what is no filter

    def find(shaper: Shaper, timing: Timing, other: Timing) -> SlotGain:
        assert other == OTHERS[0]  # without a filter
        return SlotGain(0.1, 20.0 * gain, 1000) if lost < 0.0 else SlotGain(0.1, 0.0, 0)

    monkeypatch.setattr(speed_timing, "find_filter", lambda *rest: filtered)
    monkeypatch.setattr(speed_timing, "find_likeliest_slot", find)
    found = speed_timing._find_as_stamped(shaper)
    assert found is not None
    assert (found.slot, found.filter) == ((0.1, None) if told else (0.0, filtered.filter))


def test_the_motor_is_right_and_the_notes_say_how_it_was_read() -> None:
    recording = logged(12, 200.0)
    read = identify([recording], Request(effects=("coulomb_friction",)))
    assert read.parameters.value("kv") == pytest.approx(PAPER_KV, rel=0.002)
    assert read.parameters.value("ks") == pytest.approx(0.5, rel=0.02)
    (said,) = (note for note in read.notes if "latest two edges" in note)
    assert "a slot of 0.524 rad (some 12 a turn)" in said
    assert not any(tells_of_speeds(note) for note in read.notes)  # otherwise


@pytest.mark.usefixtures("unlike_lag")
@pytest.mark.parametrize(
    ("gain", "undoes", "told"), [(2.9, True, False), (3.1, True, True), (19.9, False, False), (20.1, False, True)]
)
def test_a_slot_that_undoes_a_dead_time_needs_to_be_less_likely(
    monkeypatch: pytest.MonkeyPatch, gain: float, undoes: bool, told: bool
) -> None:
    """The age of values was a delay of a fifth of a row to a whole one in six of sixty logs."""
    shaper = shaper_of(check(noisy(0.05, instant=True)))
    monkeypatch.setattr(speed_timing, "find_likeliest_slot", lambda *_: SlotGain(0.1, gain, 200, undoes))
    assert (speed_timing._find_periods(shaper, ASSUMED) is not None) is told


def test_a_slot_undoes_a_dead_time_of_which_little_is_left(monkeypatch: pytest.MonkeyPatch) -> None:
    shaper, slot = shaper_of(logged(48)), 2.0 * np.pi / 48
    late = shaper.fit(OTHERS[0])
    assert late.delay > 0.2 * shaper.recordings[0].sample_period  # as old as the values are
    assert judge(shaper, slot).undoes and not judge(shaper, 0.1 * slot).undoes
    left = shaper.fit(replace(OTHERS[0], slot=0.1 * slot)).delay / late.delay
    monkeypatch.setattr(pulse_slot, "UNDONE", 1.01 * left)
    assert judge(shaper, 0.1 * slot).undoes
    monkeypatch.setattr(pulse_slot, "LEAST_DELAY", np.inf)
    assert not judge(shaper, slot).undoes  # nothing was late


@pytest.mark.usefixtures("without_ticks")
@pytest.mark.parametrize(("stays", "factor"), [(2.0, 1.0), (8.0, 1.7)])
def test_of_slots_that_are_as_likely_the_one_that_values_stay_for_is_taken(
    monkeypatch: pytest.MonkeyPatch, stays: float, factor: float
) -> None:
    """A likelihood that is flat from 0.7 to 1 of a slot left a dead time at 0.8 of it, by which no value stays."""
    shaper = shaper_of(logged(48))
    usual = pulse_slot.GRID[3] * measure_usual_travel(shaper.recordings)

    def judged(_: object, timing: Timing, *__: object) -> SlotGain:
        longer = bool(np.isclose(timing.slot, 1.7 * usual))
        here = 100.0 if np.isclose(timing.slot, usual) else 95.0 if longer else 1.0
        return SlotGain(timing.slot, here, 500, stays=stays if longer else 0.0)

    monkeypatch.setattr(pulse_slot, "judge_slot", judged)
    assert find_likeliest_slot(shaper, OTHERS[0], OTHERS[0]).slot == pytest.approx(factor * usual)


@pytest.mark.usefixtures("unlike_lag")
@pytest.mark.parametrize("other", [OTHERS[1], ASSUMED])
@pytest.mark.parametrize(("later", "early"), [(30.0, 25.0), (25.0, 30.0)])
def test_a_slot_is_looked_for_both_ways_where_the_age_of_values_may_hide_when_voltages_held(
    monkeypatch: pytest.MonkeyPatch, other: Timing, later: float, early: float
) -> None:
    """A mean over the row that is late by most of one is what that looks like."""
    shaper = shaper_of(logged(48))

    def found(_: Shaper, instants: Timing, __: Timing) -> SlotGain:
        return SlotGain(*((0.2, early) if instants.is_early else (0.1, later)), 200)

    monkeypatch.setattr(speed_timing, "find_likeliest_slot", found)
    told = speed_timing._find_periods(shaper, other)
    assert told is not None and told.slot == (0.2 if early > later and other.is_early else 0.1)


@pytest.mark.parametrize(
    ("later", "early", "gain", "rows", "held_until"),
    [
        (0.0, 0.64, 21.0, 100, True),
        (0.0, 0.66, 100.0, 100, False),
        (0.1, 0.4, 100.0, 100, False),
        (0.0, 0.4, 19.0, 100, False),
        (0.0, 0.4, 39.0, 2000, False),
        (0.0, 0.4, 41.0, 2000, True),
    ],
)
def test_voltages_held_until_rows_only_where_the_motion_is_early_for_sure(
    monkeypatch: pytest.MonkeyPatch, later: float, early: float, gain: float, rows: int, held_until: bool
) -> None:
    """Early by chance, a motion had a dead time of nearly the row that had been taken away."""
    shaper = shaper_of(logged(48))
    row = shaper.recordings[0].sample_period
    fits = {False: SimpleNamespace(delay=later * row, residuals=np.zeros(rows)), True: None}
    fits[True] = SimpleNamespace(delay=early * row, residuals=np.ones(rows))
    monkeypatch.setattr(Shaper, "fit", lambda self, timing: fits[timing.is_early])
    monkeypatch.setattr(speed_timing, "measure_gain_of_speeds", lambda _, after: gain if after is fits[True] else 0.0)
    assert speed_timing._choose_instants(shaper, 0.1).is_early is held_until


def test_errors_that_are_no_numbers_make_no_slot_likelier(monkeypatch: pytest.MonkeyPatch) -> None:
    shaper = shaper_of(logged(48))
    fit = shaper.fit(OTHERS[0])
    assert pulse_slot.measure_gain_of_speeds(fit, fit) == 0.0
    monkeypatch.setattr(pulse_slot, "measure_log_likelihood", lambda *_: -np.inf)
    assert pulse_slot.measure_gain_of_speeds(fit, fit) == -np.inf
