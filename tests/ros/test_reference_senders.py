"""References of several nodes, and of one that has seen a controller die: the numbers that DDS gives their messages."""

import subprocess
import time

import rclpy
from controller_bench import PATIENT, FakePlant
from std_msgs.msg import Float64
from workbench import end, start

from motor_model.streams.senders import SLACK, YOUNG
from motor_msgs.msg import ControlState
from motor_ros import qos


def go_on(plant: FakePlant) -> None:
    """Send 60 rad/s from now on, 50 times a second."""
    plant.node.create_timer(0.02, lambda: plant._reference.publish(Float64(data=60.0)))


def hear_out(plant: FakePlant, seconds: float) -> list[ControlState]:
    """The answers to samples of a motor that stands, for so long."""
    answers, end_of_it = [], time.monotonic() + seconds
    while time.monotonic() < end_of_it:
        answers.append(plant.answer(0.0))
    return answers


def test_a_controller_that_is_started_again_does_not_obey_a_running_stream(
    plant: FakePlant, process: subprocess.Popen[str]
) -> None:
    """As systemd or a launch file starts it again: the motor went on at once."""
    go_on(plant)
    old = time.monotonic() + YOUNG + SLACK  # [s] from when on the stream has not begun with the second
    plant.wait(lambda: plant.answer(55.0).state == "running" and time.monotonic() > old, "a running loop")
    end(process)  # who is killed is there for everybody for twenty seconds more
    plant.wait(lambda: plant._reference.get_subscription_count() == 0, "the end of the first")
    plant.states.clear()
    count = len(plant.voltages)
    second = start("motor_control", "motor_control", *PATIENT)
    try:
        plant.heard(plant._reference)
        plant.await_controller()
        answers = hear_out(plant, 2.0)
        assert {answer.state for answer in answers} == {"disabled"}
        assert all(message.voltage == 0.0 for message in plant.voltages[count:])
        assert "began before this controller heard any of them" in answers[-1].reason
        plant._reference.publish(Float64(data=0.0))  # it begins again
        plant.wait(lambda: plant.answer(10.0).voltage > 0.0, "motion")
    finally:
        end(second)


def test_a_0_of_another_node_lets_no_stream_go_on(plant: FakePlant, process: subprocess.Popen[str]) -> None:
    """What ended it stands before the first node, and not before the second."""
    go_on(plant)
    plant.wait(lambda: plant.answer(55.0).state == "running", "a running loop")
    plant.time = 0  # the plant is started again
    assert {answer.state for answer in hear_out(plant, 0.5)} == {"disabled"}
    other = rclpy.create_node("other", context=plant.node.context)
    zero = other.create_publisher(Float64, "motor/reference", qos.REFERENCE)
    plant.wait(lambda: zero.get_subscription_count() > 0, "the controller")
    zero.publish(Float64(data=0.0))
    plant.wait(lambda: plant.answer(0.0).state == "running", "a reference of 0")
    count = len(plant.voltages)
    answers = hear_out(plant, 1.0)
    assert {answer.reference for answer in answers} == {0.0}
    assert all(message.voltage == 0.0 for message in plant.voltages[count:])
    assert "until they begin again" in answers[-1].reason
    other.destroy_node()
