"""What was just heard, kept like a bag: the last seconds, and what held before them."""

from motor_identification.monitoring.heard import Heard

SECOND = 10**9
COMMANDS, STATES = "/commands", "/states"


def heard(length: float = 10.0) -> tuple[Heard, int, int]:
    kept = Heard(length)
    return kept, kept.topic(COMMANDS, "std_msgs/msg/Float64"), kept.topic(STATES, "std_msgs/msg/Float64")


def received(kept: Heard, name: str) -> list[float]:
    return [at / SECOND for topic, at, _ in kept.messages() if topic.name == name]


def test_the_last_seconds_stay_and_of_every_topic_what_held_before_them() -> None:
    kept, commands, states = heard()
    kept.write(commands, 1 * SECOND, b"held")
    for second in range(2, 31):
        kept.write(states, second * SECOND, b"")
    assert received(kept, COMMANDS) == [1.0]
    assert received(kept, STATES) == [19.0, *range(20, 31)], "10 s, and one before"
    assert kept.counts == {COMMANDS: 1, STATES: 29}
    assert kept.latest(STATES) == 30 * SECOND and kept.latest("/other") is None


def test_messages_come_in_the_order_in_which_they_were_received() -> None:
    kept, commands, states = heard()
    for at, channel in ((1, states), (3, states), (2, commands), (4, commands)):
        kept.write(channel, at * SECOND, b"")
    assert [topic.name for topic, _, _ in kept.messages()] == [STATES, COMMANDS, STATES, COMMANDS]
    assert [topic.name for topic, _, _ in kept.messages({COMMANDS})] == [COMMANDS, COMMANDS]


def test_a_clock_that_was_set_back_begins_anew() -> None:
    kept, commands, _ = heard()
    kept.write(commands, 1000 * SECOND, b"")
    kept.write(commands, 995 * SECOND, b"")
    assert received(kept, COMMANDS) == [1000.0, 995.0], "a message that was late"
    kept.write(commands, 984 * SECOND, b"")
    assert received(kept, COMMANDS) == [984.0]


def test_a_copy_stays_as_it_is() -> None:
    kept, commands, _ = heard()
    kept.write(commands, SECOND, b"")
    copy = kept.copy()
    kept.write(commands, 2 * SECOND, b"")
    assert received(copy, COMMANDS) == [1.0] and copy.topics == kept.topics
