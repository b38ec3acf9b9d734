"""Commands as ros2_control's topic-based hardware sends them: its QoS, all joints of the system, ours among them."""

from collections.abc import Iterator
from itertools import count
from math import nan

import pytest
from controller_bench import FakePlant
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64
from workbench import end, start

from motor_model.sample import Info
from motor_ros import qos

JOINTS = ["left", "wheel"]  # ours is the second


Wheel = tuple[FakePlant, Publisher]


@pytest.fixture
def wheel() -> Iterator[Wheel]:
    """A controller of a wheel that is patient, its plant, and who commands the joints of the system."""
    plant = FakePlant()
    patient = ("-p", "sample_timeout:=5.0", "-p", "latency_limit:=10.0", "-p", "joint_command_timeout:=20.0")
    process = start("motor_control", "motor_control", "--ros-args", *patient)
    try:
        commands = plant.publisher(JointState, "motor/joint_command", QoSProfile(depth=1))
        plant.meet()
        plant.tell(Info(name="wheel", single_channel=False))
        plant.heard(commands)
        yield plant, commands
    finally:
        end(process)
        plant.close()
    assert process.returncode == 0


def test_a_system_of_two_joints_drives_ours_and_stops_it(wheel: Wheel) -> None:
    plant, commands = wheel

    def send(*velocity: float, names: list[str] = JOINTS) -> None:
        commands.publish(JointState(name=names, velocity=velocity))

    def wait(state: str, reference: float, *velocity: float) -> None:
        def reached() -> bool:
            send(*velocity)
            shown = plant.answer(0.0)
            return shown.state == state and (shown.reference == reference or state == "disabled")

        plant.wait(reached, f"{state} at {reference}")

    wait("disabled", nan, 5.0, 30.0)  # was there before the controller knew: it has to begin
    wait("running", 0.0, 5.0, 0.0)
    wait("running", 30.0, 5.0, 30.0)
    assert plant.answer(0.0).voltage > 0.0
    send(50.0, names=["left"])  # not ours
    assert [plant.answer(0.0).reference for _ in range(5)] == [30.0] * 5
    send(5.0, nan)
    plant.wait(lambda: plant.answer(0.0).state == "disabled", "a stop")
    assert "asks for nan" in plant.states[-1].reason and plant.voltages[-1].voltage == 0.0
    wait("disabled", nan, 5.0, 30.0)


def test_a_stop_waits_for_nobody_to_be_known(wheel: Wheel) -> None:
    """Beside nodes that come and go its own sender's commands wait; a velocity of 0 did, too, and was refused."""
    plant, commands = wheel

    def send(velocity: float) -> float:
        commands.publish(JointState(name=["wheel"], velocity=[velocity]))
        return plant.answer(0.0).reference

    plant.wait(lambda: send(0.0) == 0.0, "a beginning")
    plant.wait(lambda: send(30.0) == 30.0, "a motion")
    others = count(31.0)
    for stop in (0.0, nan):
        newcomer = plant.node.create_publisher(Float64, "motor/reference", qos.REFERENCE)
        plant.wait(lambda: (other := next(others)) != send(other), "commands that wait")
        send(stop)
        told = [plant.answer(0.0).reference for _ in range(4)]  # 20 ms, where it takes 0.2 s to be known
        assert told[-1] == 0.0 or stop != stop and plant.states[-1].state == "disabled"
        plant.node.destroy_publisher(newcomer)
        plant.wait(lambda: send(0.0) == 0.0, "a beginning")
        plant.wait(lambda: send(30.0) == 30.0, "a motion")
