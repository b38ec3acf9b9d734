"""What comes with its number, and how long it has waited to be taken."""

import time

import pytest
from ros_fixtures import bench  # noqa: F401  (a fixture)
from workbench import Bench

from motor_msgs.msg import MotorVoltage
from motor_ros import qos
from motor_ros.clocks.hold_ups import HoldUps
from motor_ros.numbered_input import Arrival, NumberedInput, _wait_of

WAIT = 0.2  # [s]


def test_a_message_that_is_taken_late_says_how_late(bench: Bench) -> None:  # noqa: F811
    taken: list[tuple[MotorVoltage, Arrival]] = []
    arrives = MotorVoltage, "motor/voltage", qos.COMMANDS
    voltages = NumberedInput(bench.node, *arrives, lambda *one: taken.append(one))
    publisher = bench.publisher(MotorVoltage, "motor/voltage", qos.VOLTAGE)
    bench.heard(publisher)

    def arrived() -> bool:
        voltages.poll()
        return bool(taken)

    publisher.publish(MotorVoltage(voltage=1.0))
    bench.wait(arrived, "a message")
    publisher.publish(MotorVoltage(voltage=2.0))
    published = time.monotonic()
    time.sleep(WAIT)  # a plant that is held up
    bench.wait(lambda: arrived() and len(taken) == 2, "the next one")
    message, arrival = taken[1]
    assert (message.voltage, arrival.number) == (2.0, 2)
    assert 0.5 * WAIT < arrival.waited * 1e-9 <= time.monotonic() - published


@pytest.mark.parametrize(
    ("received", "source", "doubt", "waited"),
    [
        (1_000, 500, False, 2_000),  # a sender's clock does not count
        (1_000, 500, True, 2_500),  # after this process stood still alone
        (2_990, 500, True, 2_500),
        (3_000, 3_500, True, 0),
        (4_000, 4_000, False, 0),  # our clock was set back
        (1_000 - 3_600 * 10**9, 500, False, 10**9),  # and forward: an old voltage, but none of somebody who went on
        (0, 0, True, 0),  # nobody stamps
        (None, None, True, 0),
    ],
)
def test_a_message_is_as_old_as_its_stamps_say(
    received: int | None, source: int | None, doubt: bool, waited: int
) -> None:
    assert _wait_of({"received_timestamp": received, "source_timestamp": source}, 3_000, doubt) == waited


def test_a_voltage_that_was_sent_while_the_plant_stood_still_is_an_old_one(bench: Bench) -> None:  # noqa: F811
    """Who is stopped receives nothing: what was sent meanwhile seemed to have come just now, and drove for 0.1 s."""
    taken: list[int] = []
    now = [0.0]
    arrives = MotorVoltage, "motor/voltage", qos.COMMANDS, lambda *one: taken.append(one[1].waited)
    voltages = NumberedInput(bench.node, *arrives, hold_ups=HoldUps(bench.node, lambda: now[0]))
    sent = {"source_timestamp": time.time_ns() - 4 * 10**9, "publication_sequence_number": 1}
    for now[0] in (0.0, 4.0):
        voltages._on_message(MotorVoltage(), {**sent, "received_timestamp": time.time_ns()})
    assert taken[0] < 10**9 and 4 * 10**9 <= taken[1] < 5 * 10**9
