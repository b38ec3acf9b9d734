"""Several senders of one motor, however seldom each of them sends: one of them drives, or none, and it is said."""

from collections.abc import Iterator
from itertools import pairwise
from random import Random

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from motor_ros.gate import APART, CONFLICT, HOLD, UNHEARD, Gate

MS = 1_000_000  # [ns]
T0 = 5_000_000_000_000  # [ns]
VOLTS = 6.0, -6.0, 3.0  # [V] each sender its own, so that its voltage tells whose it is
Message = tuple[int, int, float, int]  # [ns], which sender, [V], number


def gate(timeout: float = 0.1) -> Gate:
    return Gate(True, timeout, 0.005).come_up(T0 - 3_000 * MS)


@st.composite
def senders(draw: st.DrawFn) -> list[list[Message]]:
    """Two or three that send at any pace from 5 ms to 12 s, evenly or not, over a lossy link."""
    streams = []
    for who in range(draw(st.integers(2, 3))):
        period = 5.0 * 2400.0 ** draw(st.floats(0.0, 1.0))  # [ms]
        start, first = draw(st.floats(0.0, 3.0)) * period, draw(st.just(1) | st.integers(2, 5_000))
        uneven, loss = draw(st.sampled_from([0.0, 0.1, 0.4])), draw(st.sampled_from([0.0, 0.05, 0.3]))
        volts, begins = draw(st.sampled_from([VOLTS[who], VOLTS[who], 0.0])), draw(st.booleans())
        chance = Random(draw(st.integers(0, 10**6)))
        stream = []
        for k in range(60 if period > 100.0 else 400):
            at = T0 + int((start + k * period + chance.uniform(0.0, uneven) * period) * MS)
            if chance.random() >= loss:
                stream.append((at, who, 0.0 if begins and k == 0 else volts, first + k))
        assume(stream)
        streams.append(stream)
    return streams


def played(plant: Gate, streams: list[list[Message]], names: str) -> Iterator[tuple[Message, Gate]]:
    """What each message makes of the plant, while all of them still send."""
    end = min(stream[-1][0] for stream in streams)
    for message in sorted(message for stream in streams for message in stream if message[0] <= end):
        at, who, volts, number = message
        plant = plant.take(volts, at, names[who], number)
        yield message, plant


@settings(deadline=None, max_examples=150)
@given(senders(), st.sampled_from([0.1, 0.5, 1.0, 2.0, 10.0]), st.sampled_from(["abc", "aaa"]))
def test_of_several_that_go_on_at_whatever_rates_one_drives_or_none(
    streams: list[list[Message]], timeout: float, names: str
) -> None:
    """From when each has been heard three times, whatever the paces and losses; of one frame_id with numbers apart.

    Of two that call themselves the same, send seldom and count alike, no plant can tell one that lost a message.
    """
    numbers = sorted(stream[0][3] for stream in streams)
    assume(names == "abc" or all(more - one > APART for one, more in pairwise(numbers)))
    heard, drove = [0] * len(streams), set()
    for message, plant in played(gate(timeout), streams, names):
        heard[message[1]] += 1
        if min(heard) >= 3:
            drove |= {plant.voltage(message[0])} - {0.0}
    assert len(drove) <= 1


@settings(deadline=None, max_examples=150)
@given(senders(), st.sampled_from([0.1, 0.5, 1.0, 2.0, 10.0]))
def test_no_voltage_follows_another_senders_before_half_a_second(streams: list[list[Message]], timeout: float) -> None:
    """From the first command on: one drives after another only once that one has been silent, whatever still acts."""
    driver, until = 0.0, 0
    for message, plant in played(gate(timeout), streams, "abc"):
        voltage = plant.voltage(message[0])
        if voltage not in (0.0, driver):
            assert message[0] > until
        if voltage and plant.received is not None:
            driver, until = voltage, plant.received + HOLD


def in_turn(period: int, names: str, zeros: int, shift: int = 0) -> list[list[Message]]:
    """Two that send every `period` ms, half of it apart, so many times 0 V first; the second so many numbers ahead."""
    streams: list[list[Message]] = []
    for who in range(2):
        times = [T0 + (300 + k * period + who * (period // 2 + 13)) * MS for k in range(25)]
        streams.append([(at, who, VOLTS[who] * (k >= zeros), 1 + k + who * shift) for k, at in enumerate(times)])
    return streams


@pytest.mark.parametrize("timeout", [0.1, 1.0, 2.0, 10.0])
@pytest.mark.parametrize("period", [550, 700, 1_000, 1_200, 2_000, 5_000])
@pytest.mark.parametrize("names", ["ab", "aa"])
@pytest.mark.parametrize("zeros", [0, 1])
def test_two_that_send_seldom_do_not_drive_by_turns_and_it_is_said(
    period: int, names: str, zeros: int, timeout: float
) -> None:
    """6 V and -6 V, each every 1.2 s, drove by turns where `command_timeout` was 1 s: 47 reversals in 28 s, all OK."""
    turns, last, said = 0, 0.0, 0
    for message, plant in played(gate(timeout), in_turn(period, names, zeros), names):
        voltage = plant.voltage(message[0])
        turns, last = turns + (voltage * last < 0.0), voltage or last
        said = said + 1 if "More than one node" in plant.problem(message[0]) else 0
    assert turns <= (1 if names == "ab" else 2)  # what comes first may have ended, until it is heard again
    assert said > 25


@pytest.mark.parametrize("shift", [0, 1, 3, 40, 500])
@pytest.mark.parametrize("period", [700, 1_200, 4_000])
def test_the_0_volt_of_one_lets_no_other_of_its_name_go_on_however_seldom_they_send(period: int, shift: int) -> None:
    streams = in_turn(period, "aa", 0, shift)
    streams[0] = [(at, who, 0.0, number) for at, who, _, number in streams[0]]
    drove = [plant.voltage(message[0]) for message, plant in played(gate(), streams, "aa")]
    assert set(drove[6:]) == {0.0}


@pytest.mark.parametrize("gap", [400, 450, 510, 600, 800, 950, 1_010, 2_000, 30_000])
@pytest.mark.parametrize("number", [60, 1_000])
@pytest.mark.parametrize("name", ["a", "b"])
def test_who_was_not_seen_to_begin_begins_at_0_volt_in_the_place_of_another(name: str, number: int, gap: int) -> None:
    """At 50 Hz, from long before, it drove at once where it was first heard 0.5 to 1 s after the one before."""
    plant, numbers = gate(), 3_000 if name == "a" else 1
    for k in range(20):
        plant = plant.take(6.0 * (k > 0), T0 + 20 * k * MS, "a", numbers + k)
    begin, at = T0 + (380 + gap) * MS, 0
    for k in range(200):
        at = begin + 20 * k * MS
        plant = plant.take(-6.0, at, name, number + k)
        assert plant.voltage(at) != -6.0
    assert plant.problem(at).startswith("-6 V w")
    plant = plant.take(0.0, at + 20 * MS, name, number + 200).take(-6.0, at + 40 * MS, name, number + 201)
    assert plant.voltage(at + 40 * MS) == -6.0


@pytest.mark.parametrize("lost", [0, 1, 4])
@pytest.mark.parametrize("period", [5, 20, 50])
@pytest.mark.parametrize("gap", [100, 600, 5_000])
@pytest.mark.parametrize("name", ["", "b"])
def test_who_is_seen_to_begin_drives_in_the_place_of_one_that_has_ended(
    name: str, gap: int, period: int, lost: int
) -> None:
    """A program that is ended and started again with 6 V, or another one; its first commands may be lost."""
    plant, acts = gate(), None
    for k in range(500):
        plant = plant.take(6.0 * (k > 0), T0 + period * k * MS, "", 1 + k)
    ended = T0 + 499 * period * MS
    for k in range(lost, 400):
        at = ended + (gap + period * k) * MS
        plant = plant.take(-6.0, at, name, 1 + k)
        assert "More than one" not in plant.problem(at)
        acts = at if acts is None and plant.voltage(at) == -6.0 else acts
    assert acts is not None and acts - ended <= max(HOLD, gap * MS) + (60 + (lost + 2) * period) * MS


@settings(deadline=None, max_examples=200)
@given(
    st.floats(0.05, 10.0),
    st.floats(0.0, 1.0),
    st.integers(1, 30) | st.integers(1, 500),
    st.integers(1, 3_000) | st.integers(1, 20_000),
    st.sampled_from([None, 1, 2]),
    st.sampled_from(["", "b"]),
    st.booleans(),
)
def test_one_that_is_ended_and_another_started_drives_within_the_wait(
    timeout: float, pace: float, sent: int, gap: int, lost: int | None, name: str, zero: bool
) -> None:
    """The same program again, or one with another frame_id, from 0.5 to 1000 Hz; one of its first commands is lost."""
    period, plant, ended, acts = round(2_000.0 * 0.0005**pace * MS), gate(timeout), T0, None
    for k in range(sent):
        ended = T0 + k * period
        plant = plant.take(6.0 * (k > 0 or not zero), ended, "", 1 + k)
    wait, begin = ended + HOLD, ended + gap * MS
    due = max(wait, begin) + 60 * MS + 3 * period
    for k in range((due - begin) // period + 1):
        at = begin + k * period
        if 1 + k != lost:
            plant = plant.take(-6.0, at, name, 1 + k)
            assert "More than one" not in plant.problem(at) and "heard none of it" not in plant.problem(at)
            acts = at if acts is None and plant.voltage(at) == -6.0 else acts
    assert acts is not None and (acts > wait or (name == "" and sent == 1 == lost))  # whose number 2 goes on from 1


@pytest.mark.parametrize("timeout", [0.7, 2.0])
@pytest.mark.parametrize("lost", [1, 2, 5])
@pytest.mark.parametrize("name", ["", "b"])
def test_who_waits_is_judged_by_what_was_heard_of_it_meanwhile(name: str, lost: int, timeout: float) -> None:
    """Its first commands were lost, and it was refused for good, as if a link had been away."""
    plant = gate(timeout)
    for k in range(200):
        plant = plant.take(6.0, T0 + 20 * k * MS, "", 1 + k)
    begin = T0 + (199 * 20 + 100) * MS
    for k in range(lost, 200):
        at = begin + 20 * k * MS
        plant = plant.take(-6.0, at, name, 1 + k)
        assert (plant.voltage(at) == -6.0) is (at > begin + HOLD - 100 * MS)
        assert "heard none of it" not in plant.problem(at)


@pytest.mark.parametrize("number", [30, 1_000])
@pytest.mark.parametrize("timeout", [0.7, 2.0])
def test_who_waits_and_began_long_before_begins_at_0_volt(number: int, timeout: float) -> None:
    """At 20 Hz: it is older than the one whose place it would take has been silent."""
    plant, at = gate(timeout), T0
    for k in range(200):
        plant = plant.take(6.0, T0 + 20 * k * MS, "", 1 + k)
    for k in range(200):
        at = T0 + (199 * 20 + 100 + 50 * k) * MS
        plant = plant.take(-6.0, at, "b", number + k)
        assert plant.voltage(at) != -6.0
    assert plant.problem(at).startswith("-6 V was already being sent on motor/voltage beside another node")


@pytest.mark.parametrize("timeout", [0.1, 1.0, 10.0])
@pytest.mark.parametrize("behind", [1, 2, 5, 40])
def test_where_the_first_of_one_name_comes_late_beside_another_behind_it_none_drives(
    behind: int, timeout: float
) -> None:
    """For a command, of which nobody knows whose it is, the motor gets 0 V, and it is known with the next one."""
    late = 40 + behind + 10
    first = [(T0 + (20 * k + 35 * (k == late)) * MS, 0, 6.0, 1 + k) for k in range(200)]
    second = [(T0 + (20 * (k + behind) + 9) * MS, 1, -6.0, 1 + k) for k in range(late - 2, 150)]
    for message, plant in played(gate(timeout), [first, second], "aa"):
        assert plant.voltage(message[0]) != -6.0
        if message[0] >= T0 + (20 * (late + 3)) * MS:
            assert plant.voltage(message[0]) == 0.0 and plant.mixed


@pytest.mark.parametrize("period", [5, 50, 400])
@pytest.mark.parametrize("timeout", [0.1, 10.0])
def test_a_single_0_volt_of_an_old_one_with_its_name_keeps_no_sender_from_being_heard(
    timeout: float, period: int
) -> None:
    """The last word of a controller, before a command that comes late."""
    plant, at = gate(timeout), T0
    for k in range(60):
        plant, at = plant.take(1.0 * k, at, "a", 101 + k), at + period * MS
    plant = plant.take(0.0, at, "a", 7)
    for k in range(60, 80):
        at += 2 * period * MS
        plant = plant.take(1.0 * k, at, "a", 101 + k)
        assert plant.voltage(at) == 1.0 * k


@settings(deadline=None, max_examples=200)
@given(
    st.floats(0.0, 1.0),
    st.sampled_from([0.0, 0.1, 0.4]),
    st.floats(0.0, 0.6),
    st.integers(0, 10**6),
    st.sampled_from([0.1, 1.0, 10.0]),
)
def test_one_alone_is_obeyed_at_any_rate_however_many_of_its_messages_are_lost(
    pace: float, uneven: float, loss: float, seed: int, timeout: float
) -> None:
    """From 1 ms to 12 s; a link that was away for a second and more than ten messages is another matter."""
    period = 12_000.0**pace  # [ms]
    plant, last, chance = gate(timeout), 0, Random(seed)
    for k in range(300):
        at = T0 + int((k + uneven * chance.random()) * period * MS)
        full = k - last >= UNHEARD
        if k and chance.random() < loss and not full:
            continue
        plant, last = plant.take(6.0, at, "", 1 + k), k
        late = k and plant.sender is not None and plant.sender.number != 1 + k  # quicker than it has ever come
        assert plant.voltage(at) == 6.0 or late
        assert not plant.conflict(at) and not plant.mixed and not plant.barred


@pytest.mark.parametrize("timeout", [0.1, 2.0, 10.0])
def test_anothers_0_volt_stops_after_half_a_second_though_the_latest_voltage_still_acts(timeout: float) -> None:
    """Whoever ends a sender and sends 0 V waits no longer than ever; to go on with a voltage the other one begins."""
    plant = gate(timeout).take(0.0, T0, "a", 1).take(6.0, T0 + 5 * MS, "a", 2)
    for after, acts in ((HOLD, True), (HOLD + 1, False)):
        at = T0 + 5 * MS + after
        stopped = plant.take(0.0, at, "b", 700)
        assert (stopped.voltage(at) == 6.0) is (acts and timeout > 0.5)
        gone_on = stopped.take(-6.0, at + MS, "b", 701)
        assert (gone_on.voltage(at + MS) == -6.0) is not acts


def test_of_two_that_take_turns_at_0_volt_none_is_said_to_send_beside_the_other() -> None:
    """A controller that is idle while an experiment drives, and drives again: each begins at 0 V."""
    plant, now, numbers = gate(), T0, {"a": 1, "b": 1}
    for turn in range(6):
        name, now = "ab"[turn % 2], now + 2 * CONFLICT
        for k in range(100):
            plant, now = plant.take(6.0 * (k > 0), now, name, numbers[name]), now + 5 * MS
            numbers[name] += 1
            assert plant.voltage(now) == 6.0 * (k > 0) and not plant.problem(now)
