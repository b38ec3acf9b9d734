"""Commands as ros2_control's topic-based hardware sends them: its QoS, all joints of the system, ours among them."""

from math import nan

from controller_bench import FakePlant
from rclpy.qos import QoSProfile
from sensor_msgs.msg import JointState
from workbench import end, start

from motor_model.sample import Info

JOINTS = ["left", "wheel"]  # ours is the second


def test_a_system_of_two_joints_drives_ours_and_stops_it() -> None:
    plant = FakePlant()
    patient = ("-p", "sample_timeout:=5.0", "-p", "latency_limit:=10.0", "-p", "joint_command_timeout:=20.0")
    process = start("motor_control", "motor_control", "--ros-args", *patient)
    try:
        commands = plant.publisher(JointState, "motor/joint_command", QoSProfile(depth=1))
        plant.meet()
        plant.tell(Info(name="wheel", single_channel=False))
        plant.heard(commands)

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
    finally:
        end(process)
        plant.close()
    assert process.returncode == 0
