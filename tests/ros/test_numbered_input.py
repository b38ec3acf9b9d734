"""What comes with its number, and how long it has waited to be taken."""

import time

from ros_fixtures import bench  # noqa: F401  (a fixture)
from workbench import Bench

from motor_msgs.msg import MotorVoltage
from motor_ros import qos
from motor_ros.numbered_input import NumberedInput, _wait_of

WAIT = 0.2  # [s]


def test_a_message_that_is_taken_late_says_how_late(bench: Bench) -> None:  # noqa: F811
    taken: list[tuple[MotorVoltage, int | None, int]] = []
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
    message, number, waited = taken[1]
    assert (message.voltage, number) == (2.0, 2)
    assert 0.5 * WAIT < waited * 1e-9 <= time.monotonic() - published


def test_a_clock_that_was_set_back_or_is_not_there_makes_no_message_old() -> None:
    assert _wait_of(1_000, 3_000) == 2_000
    assert _wait_of(3_000, 1_000) == _wait_of(0, 3_000) == _wait_of(None, 3_000) == 0
