"""Who goes on sending references beyond what ended one, and who begins: by the numbers of their messages."""

import pytest

from motor_model.streams.senders import Message, Senders
from motor_model.streams.sequence import LONGEST, LONGEST_OF_ONE

LONG_AGO, SPEED = -100.0, "speed"


class Hall:
    """Senders whose messages are heard one after the other, by a controller that obeys those it may."""

    def __init__(self, since: float = 0.0) -> None:
        self.senders, self.since, self.introduced = Senders(), since, since
        self.driven = False

    def says(self, number: int | None, now: float, value: float = 60.0, topic: str = SPEED) -> bool:
        """Whether a message is obeyed."""
        message = Message(topic, number, value, value == 0.0, now)
        self.senders = self.senders.hear(message, self.since, self.introduced)
        if self.senders.bars(self.driven):
            return False
        self.senders, self.driven = self.senders.obey(), True
        return True

    def stream(self, first: int, begin: float, count: int, period: float = 0.02, value: float = 60.0) -> list[bool]:
        return [self.says(first + k, begin + k * period, value) for k in range(count)]

    def end(self) -> None:
        """The reference ends, as where the plant is started again."""
        self.senders, self.driven = self.senders.end(), False


def test_a_0_of_somebody_else_lets_no_stream_go_on() -> None:
    """The motor ran at 60 rad/s again 20 ms after somebody had stopped it."""
    hall = Hall()
    assert all(hall.stream(1, 0.0, 50))
    hall.end()
    assert not any(hall.stream(51, 1.0, 50))
    assert hall.says(1, 2.0, 0.0)
    assert not any(hall.stream(101, 2.01, 50))
    assert hall.says(2, 3.01, 30.0) and not hall.says(151, 3.02)  # nor does a speed of somebody else
    assert hall.says(152, 3.04, 0.0) and all(hall.stream(153, 3.06, 20))  # its own does


def test_a_stream_begins_again_after_its_own_silence() -> None:
    hall = Hall()
    hall.stream(1, 0.0, 50)
    hall.end()
    assert not hall.says(51, 1.0) and not hall.says(52, 1.49)
    assert not hall.says(53, 2.4) and hall.says(54, 4.3)  # 0.91 s between two: twice that


@pytest.mark.parametrize("period", [0.005, 0.02, 1.0, 5.0])
def test_a_stream_that_was_there_before_the_controller_is_not_obeyed(period: float) -> None:
    """A controller that was killed and started again drove the motor on at once."""
    hall = Hall(since=10.0)
    assert not any(hall.stream(1000, 10.5, 40, period))


@pytest.mark.parametrize(("number", "begin"), [(1, 10.02), (1, 60.0), (900, 20.1)])
def test_who_begins_is_obeyed_at_once(number: int, begin: float) -> None:
    """`ros2 topic pub --once` as soon as the controller is up; a slider that has been left alone for 10 s."""
    hall = Hall(since=10.0)
    assert all(hall.stream(number, begin, 40))


def test_a_sender_that_has_said_nothing_for_less_than_10_s_may_be_a_slow_stream() -> None:
    hall = Hall(since=10.0)
    assert not hall.says(900, 19.9) and not hall.says(901, 25.0) and hall.says(902, 25.1, 0.0)


@pytest.mark.parametrize("period", [0.02, 1.0])
def test_a_stream_that_began_while_the_two_were_introduced_is_obeyed_by_its_pace(period: float) -> None:
    """`ros2 topic pub --rate 50` waits for nobody, and its first messages are lost."""
    hall = Hall(since=10.0)
    obeyed = hall.stream(3 if period < 1.0 else 2, 12.0, 40, period)
    late = obeyed.index(True)
    assert 0.2 <= late * period <= max(0.22, period) and all(obeyed[late:])


@pytest.mark.parametrize(("age", "obeyed"), [(0.9, True), (1.2, False)])
def test_a_launch_file_starts_a_sender_up_to_a_second_before(age: float, obeyed: bool) -> None:
    """It takes as long to start a controller again."""
    hall = Hall(since=10.0)
    first = round(age / 0.02) + 1
    assert any(hall.stream(first, 10.0, 100)) is obeyed


def test_youth_is_no_excuse_to_go_on_beyond_an_end() -> None:
    hall = Hall(since=10.0)
    assert not any(hall.stream(3, 12.0, 5))
    hall.end()
    assert not any(hall.stream(8, 12.1, 100))


@pytest.mark.parametrize(("value", "obeyed"), [(60.0, False), (40.0, True)])
def test_a_second_one_5_s_later_that_says_the_same_may_be_a_stream(value: float, obeyed: bool) -> None:
    """Only one had come before the plant was started again, and the next started the motor."""
    hall = Hall()
    assert hall.says(1, 0.0)
    hall.end()
    assert hall.says(2, 5.0, value) is obeyed


def test_a_slow_stream_ends_and_its_third_does_not_begin() -> None:
    hall = Hall()
    assert hall.says(1, 0.0)
    hall.end()
    assert not any(hall.stream(2, 5.0, 20, 5.0))
    assert not any(hall.stream(22, 105.0, 20, 5.0, 61.0))  # nor with another value
    assert hall.says(42, 205.0 + LONGEST_OF_ONE + 0.1)


def test_who_clears_a_stop_may_ask_for_the_same_again() -> None:
    hall = Hall()
    hall.says(1, 0.0)
    hall.end()
    hall.senders = hall.senders.trust_single()
    assert hall.says(2, 1.0)


def test_commands_in_a_shell_are_a_sender_each() -> None:
    """One after the other they are obeyed; after an end a loop of them has to begin again."""
    hall = Hall()
    assert all(hall.says(1, 5.0 + k) for k in range(5))
    hall.end()
    assert not hall.says(1, 10.0) and not hall.says(1, 11.0) and hall.says(1, 13.1)


def test_lost_messages_are_the_same_senders() -> None:
    """The controller was held up for 3 s, and keeps the latest ones of a stream."""
    hall = Hall()
    hall.stream(1, 0.0, 50)
    assert hall.says(201, 4.0)
    hall.end()
    assert not hall.says(202, 4.02)
    assert not hall.says(402, 4.04)  # more than it can have sent: a stream of somebody else's that was not heard


@pytest.mark.parametrize(("count", "heard"), [(200, 50), (200, 199), (1200, 300), (50, 200)])
@pytest.mark.parametrize("lost", [False, True])
def test_a_stream_that_was_ended_does_not_begin_at_the_number_at_which_another_fell_silent(
    count: int, heard: int, lost: bool
) -> None:
    """A motor whose plant was restarted started by itself, minutes later: its sender was taken for one long gone."""
    hall = Hall()
    assert all(hall.stream(1, 0.0, count, 0.05))
    begin = 0.05 * count + 20.0
    assert all(hall.stream(1, begin, heard, 0.05))
    hall.end()
    numbers = [k for k in range(heard + 1, heard + 400) if not (lost and k in (count, heard + 7))]
    assert not any(hall.says(k, begin + 0.05 * (k - 1)) for k in numbers)


def test_who_begins_after_a_silence_is_obeyed_beside_a_stream_that_was_ended() -> None:
    hall = Hall()
    assert all(hall.stream(1, 0.0, 200, 0.05))  # to number 200, and a silence
    assert all(hall.stream(1, 10.0, 50, 0.05))
    hall.end()
    assert not any(hall.stream(51, 12.5, 20, 0.05))
    assert hall.says(201, 13.5, 30.0) and not hall.says(71, 13.51)


def test_what_was_lost_is_no_silence() -> None:
    """A controller that is held up for 3 s keeps the latest message of a stream that went on all the time."""
    hall = Hall()
    hall.stream(1, 0.0, 50)
    hall.end()
    assert not hall.says(201, 4.0) and not hall.says(202, 4.02)
    assert not hall.says(203, 4.04) and hall.says(204, 6.1)  # which this is


def test_topics_are_apart_and_who_is_not_counted_is_one() -> None:
    hall = Hall()
    hall.stream(1, 0.0, 50)
    assert hall.says(1, 1.0, 3.0, "position")
    hall.end()
    assert not hall.says(51, 1.02) and not hall.says(2, 1.2, 3.0, "position")
    other = Hall()
    assert not other.says(None, 1.9) and other.says(None, 2.5) and other.says(None, 2.6)
    other.end()
    assert not other.says(None, 2.7) and other.says(None, 2.8, 0.0) and other.says(None, 2.9)


def test_who_was_silent_for_a_timeout_may_go_on_and_a_barred_stream_may_not() -> None:
    hall = Hall()
    hall.stream(1, 0.0, 50)
    hall.end()
    hall.says(51, 1.0)
    assert hall.says(1, 1.01, 30.0)
    hall.senders = hall.senders.forgive()
    hall.end()
    assert not hall.says(52, 1.02) and hall.says(2, 1.3, 30.0)


@pytest.mark.parametrize("shell", [False, True])  # each command of a loop is a new sender
def test_a_schedule_does_not_survive_what_ends_it(shell: bool) -> None:
    hall = Hall()
    for k in range(3):
        assert hall.says(1 if shell else 1 + k, 15.0 * k)
    hall.end()
    assert not any(hall.says(1 if shell else 4 + k, 45.0 + 15.0 * k) for k in range(5))
    assert hall.says(1 if shell else 9, 112.0)  # a hand


# A loop's commands are a new sender each; and how many messages come before something else ends what they ask for.
@pytest.mark.parametrize(("shell", "again"), [(False, 1), (False, 4), (True, 4)])
def test_a_stream_slower_than_its_own_time_out_goes_on_beyond_that_and_beyond_no_other_end(
    shell: bool, again: int
) -> None:
    """At 1 Hz, with a time-out of 0.5 s, it started the motor 0.1 s after `motor/release`."""
    hall = Hall()
    for k in range(again):
        assert hall.says(1 if shell else 1 + k, 1.0 * k)
        hall.senders = hall.senders.forgive()
        hall.end()  # by the time-out
    hall.end()  # by somebody
    assert not any(hall.says(1 if shell else 1 + again + k, 1.0 * (again + k)) for k in range(20))
    assert hall.says(1 if shell else 21 + again, again + 19.0 + LONGEST_OF_ONE + 0.1)


def test_a_stream_that_was_ended_is_not_forgiven_with_another() -> None:
    """Nor a loop of a shell that was."""
    hall = Hall()
    hall.stream(1, 0.0, 5, 1.0, 60.0)
    hall.end()
    assert hall.says(1, 4.1, 30.0, "position")
    hall.senders = hall.senders.forgive()
    assert hall.senders.forgive().forgives is False
    hall.end()
    assert hall.senders.forgives and not hall.says(6, 5.0) and hall.says(2, 5.1, 30.0, "position")


@pytest.mark.parametrize("offset", [0.04, 0.2, 0.4, 0.7, 0.95])
@pytest.mark.parametrize("period", [1.0, 0.1, 0.02])
@pytest.mark.parametrize("stopper", ["a", "b"])  # the first one of each period, or the second
def test_two_streams_of_one_launch_file_are_at_the_same_number_and_let_each_other_go_on_never(
    stopper: str, period: float, offset: float
) -> None:
    """The 0 of one was taken for the other's, which then drove the motor at once, and never had sent one."""
    hall = Hall(since=-10.0)
    sent = [("a", k, k * period) for k in range(1, 120)] + [("b", k, (k + offset) * period) for k in range(1, 120)]
    ended, obeyed = False, []
    for name, number, now in sorted(sent, key=lambda one: one[2]):
        if not ended and now > 30.2 * period:
            hall.end()
            ended = True
        stops = name == stopper and number in (60, 61)
        if hall.says(number, now, 0.0 if stops else 9.0) and ended:
            obeyed.append((name, stops))
    assert obeyed[:2] == [(stopper, True)] * 2  # a 0 is obeyed, whosever it is
    assert all(name == stopper for name, _ in obeyed)


def test_one_of_two_streams_at_the_same_number_begins_after_a_silence() -> None:
    hall = Hall()
    both = [(k, 0.1 * k + offset) for k in range(1, 60) for offset in (0.0, 0.04)]
    assert all(hall.says(*one) for one in both)
    hall.end()
    assert not any(hall.says(k, 0.1 * k + offset) for k in range(60, 80) for offset in (0.0, 0.04))
    assert not any(hall.says(k, 0.1 * k + 0.04) for k in range(80, 100))  # the other one pauses, for 2 s
    assert hall.says(80, 10.05) and hall.says(81, 10.15)
    assert not hall.says(100, 10.16)


@pytest.mark.parametrize("pause", [0.7, 2.0, 8.0])
@pytest.mark.parametrize("period", [0.02, 0.1, 1.0])
def test_a_stream_of_what_was_asked_for_once_before_is_obeyed_from_its_first_message(
    pause: float, period: float
) -> None:
    """`ros2 topic pub --once`, a release, and the same with a rate: all but one were taken for the first command's."""
    hall = Hall()
    assert hall.says(1, 0.0)
    hall.end()
    assert all(hall.stream(1, LONGEST + pause, 60, period))


@pytest.mark.parametrize("period", [0.1, 1.0])
def test_a_stream_that_is_first_heard_late_is_not_one_that_ended(period: float) -> None:
    """What was lost of a stream comes at its pace: number 60, a minute after its 20th, was its next after a silence."""
    hall = Hall()
    hall.stream(1, 0.0, 20, 0.1)
    hall.end()
    hall.introduced = 62.0
    assert not any(hall.stream(60, 62.0 + period, 20, period))


@pytest.mark.parametrize(("first", "period"), [(1, 0.2), (26, 0.02)])
def test_one_users_stream_is_obeyed_beyond_the_number_at_which_an_earlier_one_ended(first: int, period: float) -> None:
    """A stream of 2 Hz that had ended took its messages for lost ones of its own: none, or half, were obeyed."""
    hall = Hall()
    hall.stream(1, 0.0, 9, 0.5)
    hall.end()
    hall.introduced = 16.0
    obeyed = hall.stream(first, 16.0, 100, period)
    assert all(obeyed[round(0.4 / period) :])


def test_who_has_sent_one_alone_is_no_stream_that_takes_anothers_0() -> None:
    """Two nodes that have sent one each: the 0 of one was in doubt, and what it asked for next was refused."""
    hall = Hall()
    assert hall.says(1, 0.0, 0.0) and hall.says(1, 0.1, 60.0)
    hall.end()
    assert hall.says(2, 0.6, 0.0) and hall.says(3, 0.61, 60.0)


@pytest.mark.parametrize("period", [0.005, 0.02, 0.1])
@pytest.mark.parametrize("offset", [0.02, 0.16, 0.48, 0.9])
def test_of_two_streams_that_are_one_number_apart_the_0_of_one_does_not_let_the_other_go_on(
    period: float, offset: float
) -> None:
    """Each message may be either's next one: the motor ran on at what one went on sending, once the other had ended."""
    hall = Hall()
    for k in range(60):
        hall.says(k + 1, k * period)
        hall.says(k + 2, (k + offset) * period)
    hall.end()
    for k in range(60, 120):
        assert not hall.says(k + 1, k * period)
        assert not hall.says(k + 2, (k + offset) * period)
    assert hall.says(121, 120 * period, 0.0)  # the last that it says
    assert not any(hall.says(k + 2, (k + offset) * period) for k in range(120, 400))


@pytest.mark.parametrize("period", [0.01, 0.02, 0.05])
@pytest.mark.parametrize(("slow", "offset"), [(0.2, 0.3), (0.1, 0.45), (0.1, 0.81)])
def test_who_overtakes_the_number_of_a_barred_stream_is_not_obeyed_then_and_goes_on(
    period: float, slow: float, offset: float
) -> None:
    """A joystick beside a forgotten stream in another shell was not obeyed from there on, until it sent 0."""
    hall = Hall()
    sent = [(k * slow, k + 1, "forgotten") for k in range(200)]
    sent += [(5.0 + offset * slow + k * period, k + 1, "joystick") for k in range(1500)]
    heard: list[tuple[str, bool]] = []
    for now, number, who in sorted(one for one in sent if one[0] < 20.0):
        if heard and not hall.senders.ended and now > 3.0:
            hall.end()
        heard.append((who, hall.says(number, now, 0.0 if number == 1 and who == "joystick" else 60.0 + now)))
    joystick = [obeyed for who, obeyed in heard if who == "joystick"]
    assert joystick.count(False) <= 2 and all(joystick[-50:])
    assert not any(obeyed for who, obeyed in heard[-200:] if who == "forgotten")


@pytest.mark.parametrize(
    ("numbers", "apart", "streams"),
    [
        ((1, 2), 0.1, True),
        ((1, 2), 5.0, True),
        ((None, None), 0.1, True),
        ((None, None), 5.0, False),
        ((1, 1), 5.0, False),
    ],
)
def test_two_commands_in_a_shell_are_no_stream_whether_or_not_the_middleware_counts(
    numbers: tuple[int | None, int | None], apart: float, streams: bool
) -> None:
    """It was said after each second one that whoever had sent them had ended, where they are one sender's."""
    hall = Hall()
    assert hall.says(numbers[0], 10.0, 60.0) and not hall.senders.streams
    assert hall.says(numbers[1], 10.0 + apart, 80.0) and hall.senders.streams is streams
