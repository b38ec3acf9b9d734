"""What a plant lets through: the newest command of one sender, on if it began at 0 V, 0 V in every other case."""

from dataclasses import replace
from itertools import count
from math import inf, nan
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motor_ros.gate import APART, CONFLICT, HOLD, PAUSE, QUIET, Gate

Steps = list[tuple[str, float, int]]
MS = 1_000_000  # [ns]
T0 = 5_000_000_000_000  # [ns]


def gate(enabled: bool = True, timeout: float = 0.1) -> Gate:
    return Gate(enabled, timeout).come_up(T0)


def stream(plant: Gate, voltage: float, times: range, first: int, name: str = "") -> Gate:
    """A sender that goes on; times in ms since T0."""
    for number, at in zip(count(first), times, strict=False):
        plant = plant.take(voltage, T0 + at * MS, name, number)
    return plant


@pytest.mark.parametrize(("waited", "acts"), [(0, True), (59, True), (61, False), (200, False)])
def test_a_command_is_as_old_as_it_is_when_it_is_taken(waited: int, acts: bool) -> None:
    """A plant that was held up found the last words of a controller that had died, and obeyed them for 0.1 s more."""
    plant = gate().take(0.0, T0, "", 1).take(6.0, T0 + 10 * MS, "", 2, waited * MS)
    assert plant.voltage(T0 + 50 * MS) == (6.0 if acts else 0.0)
    other = plant.take(-6.0, T0 + 20 * MS, "another", 900, 90 * MS)  # left aside: it makes the first no older
    assert other.voltage(T0 + 50 * MS) == (6.0 if acts else 0.0)


@pytest.mark.parametrize("numbered", [True, False])
def test_voltages_that_flowed_before_the_plant_came_up_wait_for_0_volt_or_enable(numbered: bool) -> None:
    plant, at = gate(), 0
    for at in range(0, 4000, 50):  # for longer than QUIET
        plant = plant.take(6.0, T0 + at * MS, "", 500 + at // 50 if numbered else None)
        assert plant.voltage(T0 + at * MS) == 0.0
    assert plant.problem(T0 + at * MS).startswith("6 V was already being sent on motor/voltage when the plant came up")
    now = T0 + at * MS
    assert plant.enable(True).take(6.0, now + 50 * MS, "", 580 if numbered else None).voltage(now + 50 * MS) == 6.0
    begun = plant.take(0.0, now + 50 * MS, "", 580 if numbered else None)
    begun = begun.take(6.0, now + 100 * MS, "", 581 if numbered else None)
    assert begun.voltage(now + 100 * MS) == 6.0 and begun.problem(now + 100 * MS) == ""


@pytest.mark.parametrize("period", [1, 5, 50])
@pytest.mark.parametrize(("start", "acts"), [(0, True), (5, True), (300, True), (-50, True), (-4000, False)])
def test_a_sender_that_begins_while_the_plant_listens_acts(period: int, start: int, acts: bool) -> None:
    """It begins so many ms after the plant has come up; its first ten commands are lost until it is found."""
    lost = max(0, -start) // period + 10
    heard = start + lost * period
    for listened in (51, 600):
        plant = stream(gate(), 6.0, range(heard, heard + listened, period), lost + 1)
        assert plant.voltage(T0 + (heard + listened - 1) * MS) == (6.0 if acts else 0.0)
    assert stream(gate(), 6.0, range(max(start, 0), 600, period), 1).voltage(T0 + 599 * MS) == 6.0  # none is lost


@pytest.mark.parametrize(("after", "acts"), [(QUIET, True), (QUIET - 1, False)])
def test_where_nobody_counts_it_takes_a_silence(after: int, acts: bool) -> None:
    assert gate().take(6.0, T0 + after).voltage(T0 + after) == (6.0 if acts else 0.0)


def test_a_board_that_comes_back_asks_for_a_beginning_again() -> None:
    plant = stream(gate(), 6.0, range(0, 500, 5), 1)
    assert plant.voltage(T0 + 495 * MS) == 6.0
    plant = stream(plant.come_up(T0 + 500 * MS), 6.0, range(500, 4000, 5), 101)
    assert plant.voltage(T0 + 3995 * MS) == 0.0


def test_a_stop_ends_only_by_enable() -> None:
    plant = stream(gate(), 6.0, range(0, 500, 5), 1).stop("the board was reset")
    for voltage in (0.0, 6.0, nan, 0.0, 6.0):
        plant = plant.take(voltage, T0 + 500 * MS, "", None)
        assert plant.voltage(T0 + 500 * MS) == 0.0
    now = T0 + 500 * MS
    assert plant.problem(now) == "The output is off (the board was reset): call motor/enable with data: true."
    assert plant.come_up(now).take(0.0, now).take(6.0, now).voltage(now) == 0.0  # a new board neither
    on = plant.enable(True)
    assert on.voltage(now) == 0.0 and on.take(6.0, now).voltage(now) == 6.0 and on.problem(now) == ""


def test_off_at_the_start_is_off_until_enable() -> None:
    plant = gate(enabled=False).take(0.0, T0).take(6.0, T0)
    assert plant.voltage(T0) == 0.0 and plant.state(T0).startswith("The output is off")


@pytest.mark.parametrize("name", ["", "experiment"])
def test_the_first_of_two_senders_is_obeyed_until_it_is_silent(name: str) -> None:
    """200 Hz and 20 Hz; the same frame_id, and numbers far apart, or another one."""
    plant, other = stream(gate(), 2.0, range(0, 500, 5), 1), 7 if name else 7 + 2 * APART
    for at in range(500, 1000, 5):
        plant = plant.take(2.0, T0 + at * MS, "", 101 + (at - 500) // 5)
        if at % 50 == 0:
            plant, other = plant.take(-9.0, T0 + at * MS + 1, name, other), other + 1
        assert plant.voltage(T0 + at * MS + 1) == 2.0
    now = T0 + 995 * MS
    told = plant.problem(now, "/left, /right")
    assert "More than one node sends motor/voltage (/left, /right)" in told
    assert ("frame_id ''" in told) == bool(name)
    assert plant.problem(now + CONFLICT) == ""
    assert plant.take(-9.0, now + HOLD, name, other).received == now
    later = plant.take(-9.0, now + HOLD + 1, name, other)
    assert later.sender is not None and later.sender.name == name and later.received == now + HOLD + 1


@pytest.mark.parametrize("name", ["", "experiment"])
@pytest.mark.parametrize(("at_once", "zero", "enable"), [(-9.0, True, False), (-9.0, False, True), (0.0, False, False)])
def test_who_was_left_aside_begins_at_0_volt_once_the_first_has_ended(
    name: str, at_once: float, zero: bool, enable: bool
) -> None:
    """Ctrl-C for the one that drives, and the forgotten one turns the motor: it does not, whatever its age."""
    plant = stream(gate(), 2.0, range(0, 500, 5), 1)
    for k in range(100):
        plant = plant.take(2.0, T0 + (500 + 5 * k) * MS, "", 101 + k)
        plant = plant.take(at_once, T0 + (501 + 5 * k) * MS, name, 1001 + k)
    now = T0 + 1000 * MS + HOLD
    for k in range(400):
        plant, now = plant.take(at_once, now, name, 1201 + k), now + 5 * MS
        assert plant.voltage(now) == 0.0
    assert ("beside another node that drove the motor" in plant.problem(now)) is (at_once != 0.0)
    assert plant.come_up(now).take(-9.0, now + MS, name, 1601).problem(now + MS).endswith("data: true.")
    plant = plant.take(0.0, now, name, 1601) if zero else plant
    plant = plant.enable(True) if enable else plant
    plant = plant.take(-9.0, now + MS, name, 1602)
    assert plant.voltage(now + MS) == -9.0 and plant.problem(now + MS) == ""


@pytest.mark.parametrize("ahead", [-70, -30, -2, 2, 7, 40, 150, 1 - APART, APART - 1, -APART, APART + 1])
def test_of_two_with_one_name_the_other_does_not_go_on_in_the_place_of_the_first(ahead: int) -> None:
    """Two controllers of one motor: the numbers of the other one pass those that the first would have now.

    Where they are far apart the first is obeyed. Closer ones were told apart by their pace, until one came 4 ms late.
    """
    first = 2 * APART
    plant = stream(gate(), 2.0, range(0, 1000, 5), first + 1).enable(True)
    for k in range(100):
        now = T0 + (1000 + 5 * k) * MS
        plant = plant.take(2.0, now, "", first + 201 + k)
        assert plant.voltage(now) == (2.0 if k == 0 or abs(ahead) >= APART else 0.0)
        plant = plant.take(-9.0, T0 + (1001 + 5 * k) * MS, "", first + 201 + k + ahead)
        assert plant.voltage(now) == (2.0 if k == 0 or abs(ahead) >= APART else 0.0)
    for k in range(100, 500):
        now = T0 + (1001 + 5 * k) * MS
        plant = plant.take(-9.0, now, "", first + 201 + k + ahead)
        assert plant.voltage(now) == (2.0 if now <= T0 + 1595 * MS and abs(ahead) >= APART else 0.0)


def test_of_two_with_one_name_none_drives_once_a_command_of_the_first_is_late() -> None:
    """The other's 6 V acted from then on, and the first was heard all the time: its no. 89 came 4 ms late of 20."""
    sent = [(20 * n - 6 * (n == 40) + 4 * (n == 89), 1.0, n) for n in range(1, 400)]
    sent += [(20 * n + 30, 6.0, n) for n in range(85, 399)]
    plant = gate().enable(True)
    for at, voltage, number in sorted(sent):
        plant = plant.take(voltage, T0 + at * MS, "", number)
        assert plant.voltage(T0 + at * MS) == (1.0 if at < 20 * 87 else 0.0)
    assert "whose command is whose cannot be told" in plant.problem(T0 + 8_000 * MS)


@pytest.mark.parametrize("rate", [10, 20, 50, 100, 200, 1000])
@pytest.mark.parametrize("held", [0.0, 6.0])
@pytest.mark.parametrize("seed", range(8_870_000, 8_870_004))
def test_who_starts_soon_after_the_first_under_its_name_never_drives(rate: int, held: float, seed: int) -> None:
    """Two nodes of one script, of which the second is late; held up by exponential delays, and by up to 3 periods.

    Neither beside the first nor once it has ended, whether the first held 0 V, which lets none go on, or 6 V.
    """
    chance, sent = Random(seed), []
    late = chance.randint(1, 8)
    for volts, begin, end in ((held, 0, 400), (-6.0, late, 600 + late)):
        last = 0.0
        for k in range(begin, end):
            due = k + chance.expovariate(10.0) + (chance.uniform(0.5, 3.0) if chance.random() < 0.03 else 0.0)
            last = max(last + 1e-3, due)
            sent.append((T0 + round(last * 1_000_000_000 / rate), volts, k - begin + 1))
    plant = gate().enable(True)
    for now, voltage, number in sorted(sent):
        plant = plant.take(voltage, now, "", number)
        assert plant.voltage(now) != -6.0


def test_one_that_is_close_is_known_among_others_that_are_far() -> None:
    """Three of one name: of what was left aside since the first was heard, what may be taken for its own counts."""
    plant = stream(gate(), 2.0, range(0, 500, 5), 1).take(-9.0, T0 + 496 * MS, "", 5 * APART)
    plant = plant.take(-6.0, T0 + 497 * MS, "", 60).take(-9.0, T0 + 498 * MS, "", 5 * APART + 1)
    assert plant.take(2.0, T0 + 500 * MS, "", 101).voltage(T0 + 500 * MS) == 0.0


def test_what_one_sends_in_a_hurry_does_not_mix_it_with_another_that_has_its_own_name() -> None:
    plant = stream(gate(), 2.0, range(0, 500, 5), 1).take(-9.0, T0 + 496 * MS, "other", 7)
    plant = plant.take(2.0, T0 + 497 * MS, "", 140).take(2.0, T0 + 498 * MS, "", 141)  # it had been held up
    now = T0 + 800 * MS
    plant = plant.take(3.0, now, "", 142)
    assert plant.voltage(now) == 3.0 and plant.conflict(now) and not plant.mixed


@pytest.mark.parametrize("period", [5, 490, 990, 1_900])
@pytest.mark.parametrize("name", ["", "other"])
def test_who_was_left_aside_begins_at_0_volt_however_seldom_it_sends(name: str, period: int) -> None:
    """A forgotten 6 V acted 0.1 s long each time it came, once the first had ended between two of its messages."""
    plant, number = gate(), 3 * APART
    for at in range(0, 4_000, 5):
        plant = plant.take(0.0, T0 + at * MS, "", 1 + at // 5)
        if at % period == 0:
            plant, number = plant.take(6.0, T0 + at * MS + 1, name, number + 1), number + 1
    for at in range(-(-4_000 // period) * period, 20_000, period):
        plant, number = plant.take(6.0, T0 + at * MS + 1, name, number + 1), number + 1
        assert plant.voltage(T0 + at * MS + 1) == 0.0
    assert "beside another node that drove the motor" in plant.problem(T0 + at * MS + 1)


@pytest.mark.parametrize(("again", "acts"), [(None, True), (CONFLICT // MS + 5, True), (CONFLICT // MS - 5, False)])
def test_a_single_0_volt_beside_another_stops_nobody(again: int | None, acts: bool) -> None:
    """The last word of a controller that was idle, under the motor's name as the one that drives; [ms] to the next."""
    plant = stream(gate(), 6.0, range(0, 500, 5), 1)
    for k in range(400):
        now = T0 + (500 + 5 * k) * MS
        plant = plant.take(6.0, now, "", 101 + k)
        assert plant.voltage(now) == (6.0 if acts or again is None or 5 * k <= again else 0.0)
        if k == 0 or again is not None and 5 * k == again:
            plant = plant.take(0.0, now + MS, "", 1 + k)
        assert plant.conflict(now) or k == 0 or 5 * k > CONFLICT // MS


def test_who_comes_ahead_of_one_that_holds_0_volt_does_not_take_over() -> None:
    """Two of its messages acted at most, as they were such as the first would have sent next."""
    plant = stream(gate(), 0.0, range(0, 500, 10), 1)
    plant = plant.take(6.0, T0 + 495 * MS, "", 51)
    for k in range(200):
        now = T0 + (500 + 10 * k) * MS
        plant = plant.take(0.0, now, "", 51 + k).take(6.0, now + 5 * MS, "", 52 + k)
        assert plant.voltage(now + 5 * MS) == (6.0 if k < 1 else 0.0)


@pytest.mark.parametrize("ahead", [APART + 1, APART + 50, APART + 300])
@pytest.mark.parametrize("period", [1, 5, 80])
def test_who_is_far_ahead_is_not_the_first_that_has_paused(ahead: int, period: int) -> None:
    """Its numbers are such as the first, at 1 kHz, may have reached once it has been waited for."""
    plant, other = stream(gate(), 2.0, range(0, 500, 1), 1), 1_001 + ahead
    for at in range(500, 1_000):
        plant = plant.take(2.0, T0 + at * MS, "", 1 + at)
        if at % period == 0:
            plant, other = plant.take(-9.0, T0 + at * MS + 1, "", other), other + 1
        assert plant.voltage(T0 + at * MS + 1) == 2.0
    for at in range(-(-1_000 // period) * period, 6_000, period):
        plant, other = plant.take(-9.0, T0 + at * MS + 1, "", other), other + 1
        assert plant.voltage(T0 + at * MS + 1) != -9.0
    assert "beside another node that drove the motor" in plant.problem(T0 + at * MS + 1)


def test_no_0_volt_lets_anybody_go_on_while_two_cannot_be_told_apart() -> None:
    """The first holds 0 V and ends; the other, of its name, has 6 V to go on with."""
    plant = stream(gate(), 0.0, range(0, 500, 5), 1)
    for k in range(100):
        plant = plant.take(0.0, T0 + (500 + 5 * k) * MS, "", 101 + k).take(6.0, T0 + (501 + 5 * k) * MS, "", 96 + k)
    plant = plant.take(0.0, T0 + 1_000 * MS, "", 201)  # the latest word of all is 0 V
    for k in range(800):
        now = T0 + (1_001 + 5 * k) * MS
        plant = plant.take(6.0, now, "", 196 + k)
        assert plant.voltage(now) == 0.0
    assert not plant.tell_mixed(now) and "beside another node that drove the motor" in plant.problem(now)
    assert plant.enable(True, now).take(6.0, now + 5 * MS, "", 996).voltage(now + 5 * MS) == 6.0


def test_who_begins_as_the_first_one_ends_takes_over_at_once() -> None:
    """An experiment after a controller: its 0 V came while the first one still counted as there."""
    plant = stream(replace(gate(), sample_period=0.005), 2.0, range(0, 500, 5), 1)
    for k in range(120):
        plant = plant.take(-9.0, T0 + (500 + 5 * k) * MS, "experiment", 1 + k)
    assert plant.voltage(T0 + 1095 * MS) == -9.0


@pytest.mark.parametrize(("late", "acts"), [(900, True), (1_100, False)])
@pytest.mark.parametrize("before", [0, 40])
def test_who_went_on_sending_while_the_plant_stood_still_begins_at_0_volt(before: int, late: int, acts: bool) -> None:
    """What the middleware had kept came one by one when it went on, as if nothing had been missed."""
    plant = stream(gate(), 6.0, range(0, before * 20, 20), 1)
    woke = before * 20 + late
    for number, sent in enumerate(range(before * 20, woke, 20), before + 1):
        plant = plant.take(6.0, T0 + woke * MS, "", number, (woke - sent) * MS)
    plant = stream(plant, 6.0, range(woke + 20, woke + 1_000, 20), before + late // 20 + 1)
    at, number = T0 + (woke + 1_000) * MS, before + late // 20 + 50
    assert plant.voltage(at) == (6.0 if acts else 0.0)
    assert acts or "went on being sent" in plant.problem(at)
    assert plant.take(0.0, at, "", number).take(6.0, at + 20 * MS, "", number + 1).voltage(at + 20 * MS) == 6.0


@pytest.mark.parametrize("period", [5, 20, 50])
@pytest.mark.parametrize("before", [20, 60])
@pytest.mark.parametrize("away", [1_100, 3_000])
def test_what_was_kept_of_a_stream_comes_at_once_and_makes_it_no_younger(before: int, period: int, away: int) -> None:
    """The latest ten, in which it seemed to have sent all that went before as quickly, since the plant stood still."""
    plant = stream(gate(), 6.0, range(0, before * period, period), 1)
    back, number = before * period + away, before + away // period
    for k in range(-9, 1):
        plant = plant.take(6.0, T0 + back * MS + k, "", number + k)
    for k in range(1, 100):
        now = T0 + (back + k * period) * MS
        plant = plant.take(6.0, now, "", number + k)
        assert plant.voltage(now) == 0.0
    assert "went on being sent" in plant.problem(now)


@pytest.mark.parametrize("name", ["", "other"])
@pytest.mark.parametrize(
    ("away", "period", "number", "acts"),
    [
        (990, 5, 299, True),  # shorter than a second: a hiccup
        (1100, 5, 321, False),
        (60_000, 50, 1301, False),
        (60_000, 5, 110, True),  # it was silent, and a plant that looks every 10 ms misses some of its new ones
        (60_000, 5, 321, False),
    ],
)
def test_who_went_on_sending_while_its_link_was_away_begins_at_0_volt(
    name: str, away: int, period: int, number: int, acts: bool
) -> None:
    """The motor has stood meanwhile; it does not go on by itself because a network is back."""
    plant = stream(gate(), 6.0, range(0, 500, period), 101 - 500 // period)
    back = 495 + away
    assert plant.voltage(T0 + back * MS) == 0.0
    number -= 0 if name == "" or not acts else number - 10
    plant = stream(plant, 6.0, range(back, back + 700, period), number, name)
    now = T0 + (back + 699) * MS
    assert (plant.voltage(now) == 6.0) is acts
    assert ("while the plant heard none of it" in plant.problem(now)) is not acts
    after = number + 700 // period
    assert plant.enable(True).take(6.0, now, name, after).voltage(now) == 6.0
    plant = plant.take(0.0, now, name, after).take(6.0, now + period * MS, name, after + 1)
    assert plant.voltage(now + period * MS) == 6.0 and plant.problem(now + period * MS) == ""


def test_messages_that_were_missed_are_no_second_sender() -> None:
    plant = stream(gate(), 2.0, range(0, 500, 5), 1)
    for at, number in ((505, 101), (550, 110), (551, 111), (600, 120), (650, 130)):
        plant = plant.take(3.0, T0 + at * MS, "", number)
        assert plant.voltage(T0 + at * MS) == 3.0
    assert plant.problem(T0 + 650 * MS) == ""


@pytest.mark.parametrize(("number", "told"), [(101, True), (150, True), (151, False)])
def test_a_number_that_runs_ahead_is_left_aside_and_anothers_once_the_first_goes_on_behind_it(
    number: int, told: bool
) -> None:
    plant = stream(gate(), 2.0, range(0, 500, 5), 1).take(-9.0, T0 + 501 * MS, "", 150)
    assert plant.voltage(T0 + 501 * MS) == 2.0 and plant.problem(T0 + 501 * MS) == ""
    now = T0 + 750 * MS  # late enough for any of them
    plant = plant.take(3.0, now, "", number)
    assert plant.voltage(now) == (0.0 if told else 3.0) and plant.problem(now).startswith("More than one node") is told


@pytest.mark.parametrize("period", [1, 5, 20])
@pytest.mark.parametrize("held_up", [50, 100, 300])
def test_one_sender_that_was_held_up_and_answers_all_it_missed_at_once_is_not_two(period: int, held_up: int) -> None:
    """The plant looks every period and finds the ten latest commands: those before are lost to it."""
    plant, missed = stream(gate(), 2.0, range(0, 500, period), 1), held_up // period
    begin, now = 500 // period + 1, T0 + (500 + held_up) * MS
    for came in (range(begin, begin + missed // 2), range(begin + missed // 2, begin + missed)):
        for number in came[-10:]:
            plant = plant.take(2.0, now, "", number)
            assert plant.problem(now) == ""
        now += period * MS
    for number in range(begin + missed, begin + 2 * missed):  # on as before
        plant = plant.take(4.0, now, "", number)
        assert plant.problem(now) == ""
        assert plant.command == 4.0 or number < begin + 1.5 * missed  # it is obeyed again after half the pause
        now += period * MS


@settings(deadline=None, max_examples=300)
@given(st.lists(st.tuples(st.integers(1, 300), st.integers(0, 700) | st.integers(0, 5)), max_size=60))
def test_one_sender_is_never_two_however_late_and_lossy(messages: list[tuple[int, int]]) -> None:
    """So many further on its numbers are, after so many ms."""
    plant, number, now = gate(), 0, T0
    for steps, wait in messages:
        number, now = number + steps, now + wait * MS
        plant = plant.take(2.0, now, "", number)
        assert not plant.conflict(now)


@settings(deadline=None, max_examples=300)
@given(st.integers(1, 50), st.integers(1, 50), st.integers(0, 400), st.integers(-300, 300), st.booleans())
def test_two_senders_are_told_at_once(first: int, second: int, after: int, ahead: int, named: bool) -> None:
    """Each at its pace [ms], the second later than the first; before either has sent twice more, it is said."""
    end = after + 6 * max(first, second)  # each has sent twice as often as it takes, and it is still said
    sent = [(T0 + at * MS, 2.0, "", 301 + k) for k, at in enumerate(range(0, end, first))]
    name, begin = "other" if named else "", 301 + max(-300, after // first + ahead)
    sent += [(T0 + at * MS + 1, -9.0, name, begin + k) for k, at in enumerate(range(after, end, second))]
    plant, heard = gate(), {2.0: 0, -9.0: 0}
    for now, voltage, who, number in sorted(sent):
        plant = plant.take(voltage, now, who, number)
        if heard[-9.0] or voltage == -9.0:
            heard[voltage] += 1
        assert plant.conflict(now) or min(heard.values()) < 3


@pytest.mark.parametrize(("later", "told"), [(HOLD, True), (HOLD + 1, False)])
def test_two_that_send_one_after_the_other_are_no_conflict(later: int, told: bool) -> None:
    """The second has sent once, and the first again so many ns after it."""
    plant, now = stream(gate(), 2.0, range(0, 500, 5), 1), T0 + 500 * MS
    plant = plant.take(-9.0, now, "other", 7).take(2.0, now + later, "", 101)
    assert plant.voltage(now + later) == 2.0 and plant.conflict(now + later) is told


@pytest.mark.parametrize("silence", [HOLD, 20 * HOLD])
def test_who_takes_over_from_one_that_has_ended_is_no_second_sender(silence: int) -> None:
    plant = stream(gate(), 2.0, range(0, 500, 5), 1)
    for number, at in enumerate(range(500, 1500, 5), start=7):
        plant = plant.take(-9.0, T0 + at * MS, "other", number)
        assert not plant.conflict(T0 + at * MS)
    assert plant.voltage(T0 + 1495 * MS) == -9.0
    back = T0 + 1495 * MS + silence
    plant = plant.take(1.0, back, "", 101).take(-9.0, back + MS, "other", 208)
    assert plant.conflict(back + MS) is (silence == HOLD)


@pytest.mark.parametrize("number", [nan, inf, -inf])
def test_what_is_not_a_number_is_0_volt_until_the_next_number(number: float) -> None:
    plant = stream(gate(), 2.0, range(0, 50, 5), 1).take(number, T0 + 50 * MS, "", 11)
    assert plant.voltage(T0 + 50 * MS) == 0.0 and plant.refused == 1
    assert plant.take(2.0, T0 + 55 * MS, "", 12).voltage(T0 + 55 * MS) == 2.0


@pytest.mark.parametrize(
    ("name", "number", "stops"),
    [
        ("hand", 500, False),  # another, by what it calls itself
        ("", 10, False),  # or by its number: the obeyed one has sent that already
        ("", 11, True),  # its own
        ("", 5000, True),  # too soon to be its own, and in doubt 0 V
        ("", None, True),
    ],
)
def test_what_is_not_a_number_stops_its_own_sender_alone(name: str, number: int | None, stops: bool) -> None:
    """Of another sender it took the voltage from the one that was obeyed, a sample long each time."""
    plant, now = stream(gate(), 2.0, range(0, 50, 5), 1), T0 + 46 * MS
    assert plant.problem(now) == ""
    plant = plant.take(nan, now, name, number)
    assert plant.voltage(now) == (0.0 if stops else 2.0) and plant.refused == 1
    said = f"nan on motor/voltage is not a number (frame_id '{name}'; /one, /two): "
    said += "the motor gets 0 V until the next" if stops else "it is left aside"
    assert plant.problem(now + CONFLICT, "/one, /two").startswith(said)
    assert plant.problem(now + CONFLICT + 1, "/one, /two") == ""


def test_another_sender_that_sends_no_numbers_is_said_to_be_there_and_obeyed_only_from_0_volt_on() -> None:
    plant = stream(gate(), 2.0, range(0, 50, 5), 1).take(inf, T0 + 46 * MS, "hand", 70)
    plant = plant.take(2.0, T0 + 50 * MS, "", 11).take(inf, T0 + 51 * MS, "hand", 71)
    assert "More than one node sends motor/voltage" in plant.problem(T0 + 52 * MS)
    later = T0 + 50 * MS + HOLD + MS
    plant = plant.take(5.0, later, "hand", 90)
    assert plant.voltage(later) == 0.0 and plant.take(inf, later + MS, "hand", 91).voltage(later + MS) == 0.0


@pytest.mark.parametrize(
    ("timeout", "told"),
    [(0.1, "driven"), (0.5, "driven"), (0.51, "driven, and for 0.51 s more once who sends has died")],
)
def test_a_voltage_that_acts_for_longer_than_a_sender_is_held_up_is_told(timeout: float, told: str) -> None:
    """With 10 s for 10 ms the motor ran on for 10 s at 12 V once its sender had died, and nobody said so."""
    plant = gate(timeout=timeout).take(0.0, T0).take(4.0, T0)
    assert plant.state(T0) == told and plant.outlasts is (told != "driven")


@pytest.mark.parametrize(("age", "acts"), [(100 * MS, True), (100 * MS + 1, False)])
def test_a_command_is_stale_after_the_time_out(age: int, acts: bool) -> None:
    plant = gate().take(0.0, T0).take(4.0, T0)
    assert plant.voltage(T0 + age) == (4.0 if acts else 0.0)


STEPS = st.lists(
    st.tuples(
        st.sampled_from(["send", "rival", "enable", "disable", "stop", "come up", "wait"]),
        st.floats(-20.0, 20.0) | st.sampled_from([0.0, nan, inf]),
        st.integers(0, 300) | st.integers(0, 3000),  # [ms] that pass before it
    ),
    max_size=60,
)


@settings(deadline=None, max_examples=300)
@given(st.booleans(), STEPS)
def test_whatever_happens_the_motor_gets_a_fresh_number_that_began_or_0_volt(on: bool, steps: Steps) -> None:
    """What may act: sent in the last 0.1 s, since the last switch, after a beginning, while the output is on."""
    plant, now, since, begun = gate(on), T0, T0, False
    newest: dict[str, tuple[int, float]] = {}
    for what, value, wait in steps:
        now += wait * MS
        if what in ("send", "rival"):
            begun = begun or value == 0.0 or now - since >= QUIET
            plant, newest[what] = plant.take(value, now, what), (now, value)
        elif what == "come up":
            plant, since, begun, newest = plant.come_up(now), now, False, {}
        elif what != "wait":
            on = begun = what == "enable"
            plant, newest = plant.stop("a fault") if what == "stop" else plant.enable(on), {}
        voltage = plant.voltage(now)
        assert voltage == 0.0 or (on and begun)
        assert voltage == 0.0 or voltage in [volts for at, volts in newest.values() if now - at <= 100 * MS]


@pytest.mark.parametrize(("sent", "period", "begun"), [(18, 5, True), (25, 5, False), (190, 5, False), (15, 50, True)])
def test_who_may_be_answering_samples_is_new_only_with_its_first_commands(sent: int, period: int, begun: bool) -> None:
    """A loop of 0.95 s before the plant was started again drove on; a pace of its own, as of `pub --rate 20`, may."""
    plant = replace(gate(), sample_period=0.005)
    plant = stream(plant, 6.0, range(3000, 3000 + 20 * period, period), sent)
    assert (plant.voltage(T0 + (3000 + 19 * period) * MS) == 6.0) is begun


@pytest.mark.parametrize("rate", [200, 1000])
@pytest.mark.parametrize("ahead", [-30, -1, 0, 1, 2, 7, 40])
def test_of_two_controllers_with_one_frame_id_one_is_obeyed_and_both_are_told(ahead: int, rate: int) -> None:
    """Both answer every sample, a moment apart; their messages say the motor's name, only their numbers differ."""
    plant, acted = stream(gate(), 2.0, range(0, 500, 5), 101), []
    for k in range(rate):
        now = T0 + 500 * MS + k * 1_000_000_000 // rate
        plant = plant.take(2.0, now, "", 201 + k)
        plant = plant.take(-9.0, now + 200_000, "", 201 + k + ahead)
        acted.append(plant.voltage(now + 300_000))
    assert plant.conflict(now + MS) and plant.problem(now + MS).startswith("More than one node")
    assert len(set(acted[1:])) == 1


def uneven(voltage: float, ahead: int, chance: Random, seconds: int = 4) -> list[tuple[int, float, int]]:
    """100 commands a second, each up to 6 ms early or late, in order: time [ns], voltage, number."""
    times = [T0 + int((10 * (k + 1) + chance.uniform(-6.0, 6.0)) * MS) for k in range(100 * seconds)]
    return [(max(times[: k + 1]) + k, voltage, 1 + k + ahead) for k in range(len(times))]


@pytest.mark.parametrize("ahead", [0, 1, 2, 5, 20])
@pytest.mark.parametrize("seed", range(4))
def test_of_two_with_one_name_that_cannot_be_told_apart_none_drives(ahead: int, seed: int) -> None:
    """Two `ros2 topic pub`, started at once, jolted the motor from 6 V to -6 V and back up to 50 times a second.

    The one that is left begins at 0 V, or by motor/enable; an enable while both send changes nothing.
    """
    chance = Random(seed)
    plant, applied, now = gate(), [], T0
    for now, voltage, number in sorted(uneven(6.0, 0, chance) + uneven(-6.0, ahead, chance)):
        plant = plant.take(voltage, now, "", number)
        plant = plant.enable(True, now) if now == T0 + 2_000 * MS else plant
        applied.append((now, plant.voltage(now)))
    driven = [voltage for _, voltage in applied if voltage]
    assert sum(a != b for a, b in zip(driven, driven[1:], strict=False)) <= 2
    late = {voltage for at, voltage in applied if at > T0 + 1_000 * MS}
    assert late == {0.0} or (ahead == 20 and len(late) == 1)  # far ahead they may well be told apart
    if late == {0.0}:
        problem = plant.problem(now, "/left, /right")
        assert problem.startswith("More than one node sends motor/voltage (/left, /right), all with frame_id ''")
        end, number = now + 2 * CONFLICT, 600
        for k in range(400):
            plant = plant.take(6.0, now + 10 * k * MS, "", number + k)
            assert plant.voltage(now + 10 * k * MS) == 0.0
        end, number = now + 4_000 * MS, number + 400
        assert plant.enable(True, end).take(6.0, end, "", number).voltage(end) == 6.0
        assert plant.take(0.0, end, "", number).take(6.0, end + 10 * MS, "", number + 1).voltage(end + 10 * MS) == 6.0


@pytest.mark.parametrize("ahead", [1, 8])
@pytest.mark.parametrize("every", [3, 5, 15])
def test_a_third_sender_does_not_hide_that_two_have_one_name(ahead: int, every: int) -> None:
    """Beside it the first drove on, or for a command the second, and it was the third one's name that was said."""
    first = [(T0 + 20 * k * MS, 6.0, 1 + k, "") for k in range(200)]
    third = [(T0 + (200 + every * k) * MS + 7, 3.0, 1 + k, "other") for k in range(3_800 // every)]
    second = [(at + 4 * MS, -6.0, number + ahead, "") for at, _, number, _ in first[25:]]
    plant, late, now = gate(), set(), T0
    for now, voltage, number, name in sorted(first + third + second):
        plant = plant.take(voltage, now, name, number)
        late |= {plant.voltage(now)} if now > T0 + 600 * MS else set()
    assert late == {0.0} and "all with frame_id ''" in plant.problem(now)


@pytest.mark.parametrize("ahead", [2, 5])
def test_who_comes_a_little_ahead_under_the_first_ones_name_does_not_take_over(ahead: int) -> None:
    """At an even pace: the first one's next numbers are those that were missing before it."""
    plant, applied = stream(gate(), 6.0, range(0, 500, 10), 1), []
    late = 500 + 5 * ahead
    plant = stream(plant, 6.0, range(500, late - 5, 10), 51)
    for k in range(100):
        now = T0 + (late + 10 * k) * MS
        plant = plant.take(-6.0, now, "", 51 + k + ahead + late // 10 - 50)
        plant = plant.take(6.0, now + 3 * MS, "", 51 + k + (late - 500) // 10)
        applied.append(plant.voltage(now + 4 * MS))
    assert set(applied[2:]) in ({0.0}, {6.0})


def test_one_that_is_ended_and_started_again_beside_nobody_is_not_two() -> None:
    """Its numbers begin again, with 0 V; the one of before is heard no more."""
    plant = stream(gate(), 6.0, range(0, 500, 10), 1)
    plant = stream(plant, 0.0, range(600, 650, 10), 1)
    plant = stream(plant, 6.0, range(650, 1_700, 10), 6)
    assert plant.voltage(T0 + 1_690 * MS) == 6.0 and not plant.problem(T0 + 1_690 * MS)


@pytest.mark.parametrize(("sent", "begun"), [(190, True), (210, False)])
def test_who_has_sent_for_a_second_is_no_new_sender_however_late_it_is_heard(sent: int, begun: bool) -> None:
    """A sender that answers samples stands still while there is no plant, and may be discovered seconds after it."""
    plant = stream(gate(), 6.0, range(3000, 3100, 5), sent)
    assert (plant.voltage(T0 + 3095 * MS) == 6.0) is begun


def called(plant: Gate, times: range) -> tuple[list[bool], Gate]:
    """Which calls to switch on are answered; times in ms since T0."""
    answers = []
    for at in times:
        now = T0 + at * MS
        answers.append(not plant.refusal(now))
        plant = plant.call(now)
        plant = plant.enable(True) if answers[-1] else plant
    return answers, plant


@pytest.mark.parametrize("period", [1, 100, 490])
def test_calls_that_go_on_do_not_switch_on_what_somebody_has_switched_off(period: int) -> None:
    """A node that called motor/enable again and again had the motor turning 1 ms after motor/enable false."""
    answers, plant = called(gate(), range(0, 20 * period, period))
    assert all(answers)
    for off in (plant.enable(False), plant.stop("The board was reset.")):
        answers, after = called(off, range(20 * period, 60 * period, period))
        assert not any(answers)
        assert "again and again" in after.refusal(T0 + 60 * period * MS)
        late = T0 + 59 * period * MS + PAUSE
        assert after.refusal(late) and not after.refusal(late + 1)
        assert called(after, range(60 * period + 501, 60 * period + 502))[0] == [True]


@pytest.mark.parametrize(("calls", "period"), [(2, 10), (20, 510)])
def test_a_hand_may_switch_on_as_often_as_it_likes(calls: int, period: int) -> None:
    _, plant = called(gate(), range(0, calls * period, period))
    assert not plant.enable(False).refusal(T0 + calls * period * MS)


def test_who_calls_until_he_is_heard_is_heard() -> None:
    """The output is off, and a board does not answer yet."""
    plant = gate().enable(False)
    for at in range(50):
        plant = plant.call(T0 + at * MS)
    assert not plant.refusal(T0 + 50 * MS)


def test_calls_that_a_hand_makes_far_apart_are_no_insistence() -> None:
    """Whoever switched on what was on, now and then through the day, may switch on again at once."""
    plant, at = gate(), T0
    for at in range(T0, T0 + 5 * (PAUSE + 1), PAUSE + 1):
        plant = plant.call(at)
    assert not plant.enable(False, at + MS).refusal(at + 2 * MS)


def test_what_a_motor_does_while_the_output_is_off_is_no_further_stop() -> None:
    """One that is turned by hand after a stop, say: who has seen to it need not wait."""
    plant = gate().stop_motor("it was blocked", T0)
    for after in range(1, 10):
        plant = plant.stop_motor("it was blocked", T0 + after * MS)
    assert plant.faults.count == 1 and not plant.refusal(T0 + 20 * MS)
    assert plant.enable(True, T0 + 20 * MS).stop_motor("it was blocked", T0 + 30 * MS).refusal(T0 + 40 * MS)


def test_what_is_not_a_number_stops_beside_a_sender_that_has_long_been_silent() -> None:
    """Its last voltage still acts where command_timeout is long: nobody can tell any more whose the next message is."""
    plant = stream(gate(timeout=10.0), 6.0, range(0, 100, 5), 1, "one")
    heard = T0 + 95 * MS
    assert plant.take(nan, heard + HOLD, "another", 1).voltage(heard + HOLD) == 6.0
    assert plant.take(nan, heard + HOLD + 1, "another", 1).voltage(heard + HOLD + 1) == 0.0
