"""When the controller as a process gives 0 V, what it says then, and what it takes to drive again."""

import os
import signal
import subprocess
import time

import pytest
import rclpy
from controller_bench import PATIENT, FakePlant
from diagnostic_msgs.msg import DiagnosticStatus
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64
from std_srvs.srv import Trigger
from workbench import end, start

from motor_model.sample import Info
from motor_ros import qos
from motor_ros.graph.acquaintances import SETTLED


@pytest.mark.on_time
@pytest.mark.usefixtures("process")
def test_silence_is_zero_volts_and_said(plant: FakePlant) -> None:
    assert plant.set("motor_control", "sample_timeout", 0.1) == (True, "")
    plant.refer(100.0)
    assert plant.answer(97.0).voltage > 0.0
    begin, voltages, states = time.monotonic(), len(plant.voltages), len(plant.states)
    plant.wait(lambda: len(plant.states) >= states + 4, "no_samples, four times")
    assert 0.4 < time.monotonic() - begin < 3.0
    assert [message.voltage for message in plant.voltages[voltages:]] == [0.0]
    for state in plant.states[states:]:
        assert (state.state, state.voltage) == ("no_samples", 0.0)
        assert "motor/speed" in state.reason
    resumed = plant.answer(97.0)
    assert (resumed.state, resumed.reference, resumed.integral) == ("running", 100.0, 0.0)


@pytest.mark.usefixtures("process")
def test_numbers_that_are_none(plant: FakePlant) -> None:
    plant.refer(100.0)
    plant.refer(float("nan"))
    state = plant.answer(50.0)
    assert (state.state, state.voltage) == ("stopped", 0.0)
    assert "nan" in state.reason and "motor/reference" in state.reason
    plant.refer(100.0)
    assert plant.answer(50.0).voltage >= 10.0
    state = plant.answer(float("inf"))
    assert (state.state, state.voltage) == ("stopped", 0.0)
    assert "speed = inf" in state.reason
    assert plant.answer(50.0).state == "running"


@pytest.mark.usefixtures("process")
def test_a_parameter_that_is_set_to_and_fro_is_a_stop(plant: FakePlant) -> None:
    """The checks that read it would begin anew each time, or look away."""
    plant.refer(100.0)
    for k in range(40):
        assert plant.set("motor_control", "stall_time", 0.5 * (k % 2)) == (True, "")
        state = plant.answer(97.0)
        if state.state == "stopped":
            break
        assert state.state == "running"
    assert k >= 3 and state.voltage == 0.0 and "stall_time was set to and fro 3 times" in state.reason


@pytest.mark.usefixtures("process")
def test_references_of_a_recording_are_not_obeyed(plant: FakePlant) -> None:
    """The motor ran as it had run then, and at the recording's last speed for ever after its end."""
    plant.refer(50.0)
    assert plant.answer(40.0).state == "running"
    player = rclpy.create_node("rosbag2_player", context=plant._context)
    recorded = player.create_publisher(Float64, "motor/reference", qos.REFERENCE)

    def play() -> str:
        recorded.publish(Float64(data=100.0))
        state = plant.answer(40.0)
        return state.reason if state.voltage == 0.0 else ""

    plant.wait(lambda: "A recording is played that asks for a motion (/rosbag2_player)" in play(), "0 V")
    for _ in range(20):
        assert play()
    player.destroy_node()
    plant.wait(lambda: "recording" in plant.answer(40.0).reason, "what ended it")

    def ask() -> bool:
        plant._reference.publish(Float64(data=0.0))
        plant._reference.publish(Float64(data=30.0))
        return plant.answer(40.0).reference == 30.0

    plant.wait(ask, "a fresh reference to be obeyed")


@pytest.mark.usefixtures("process")
def test_a_motor_that_goes_on_when_the_sender_of_a_stream_has_gone_is_said(plant: FakePlant) -> None:
    """One reference is meant to hold, so that this does; a joystick's, or a played recording's, may not be."""
    plant.refer(50.0)
    for _ in range(40):
        plant._reference.publish(Float64(data=50.0))
        assert plant.answer(40.0).state == "running"
    plant.node.destroy_publisher(plant._reference)

    def told() -> bool:
        assert plant.answer(40.0).reference == 50.0
        statuses = [array.status[0] for array in plant.diagnostics[-2:]]
        return any("goes on at the last of them, 50 rad/s" in one.message for one in statuses)

    plant.wait(told, "that to be said")
    assert plant.diagnostics[-1].status[0].level == DiagnosticStatus.WARN


@pytest.mark.parametrize("topic", ["motor/reference", "motor/joint_command"])
def test_what_was_asked_for_while_the_controller_stood_still_is_not_obeyed(
    plant: FakePlant, process: subprocess.Popen[str], topic: str
) -> None:
    """Nothing happened, so somebody looks at the motor; and then it would turn."""
    joint = plant.publisher(JointState, "motor/joint_command", qos.REFERENCE)
    plant.heard(joint)
    plant.known_to("motor_control")  # it hears who publishes, and has looked at its clock: ten times in a diagnosis
    plant.wait(lambda: bool(plant.diagnostics), "diagnostics")
    os.kill(process.pid, signal.SIGSTOP)
    try:
        if topic == "motor/reference":
            plant._reference.publish(Float64(data=100.0))
        else:
            joint.publish(JointState(name=["wheel"], velocity=[100.0]))
        time.sleep(1.5)
    finally:
        os.kill(process.pid, signal.SIGCONT)
    count, states = len(plant.voltages), len(plant.states)

    def refused() -> bool:
        plant.say(0.0)
        return any("stood still" in state.reason for state in plant.states[states:])

    plant.wait(refused, "the refusal")
    assert all(message.voltage == 0.0 for message in plant.voltages[count:])
    if topic == "motor/reference":
        plant._reference.publish(Float64(data=0.0))  # to stop is always allowed
        plant.wait(lambda: plant.answer(0.0).state == "running", "a reference of 0")


def test_ctrl_c_leaves_zero_volts(plant: FakePlant, process: subprocess.Popen[str]) -> None:
    plant.refer(100.0)
    assert plant.answer(50.0).voltage > 0.0
    count = len(plant.voltages)
    out, err = end(process)
    plant.wait(lambda: len(plant.voltages) > count, "the last voltage")
    assert [message.voltage for message in plant.voltages[count:]] == [0.0]
    assert (process.returncode, out) == (0, "") and "Traceback" not in err
    started, reference = err.splitlines()  # a line a change, none a sample
    assert "kp 0.2 V/(rad/s), ki 2.5 V/rad, speed source measured, feed-forward off, at most 12 V" in started
    assert "Reference 100 rad/s." in reference and "motor/release" in reference


@pytest.mark.usefixtures("process")
def test_reset_answers(plant: FakePlant) -> None:
    response = plant.call(Trigger, "motor/reset", Trigger.Request())
    assert response.success and response.message  # type: ignore[attr-defined]


@pytest.mark.usefixtures("process")
def test_a_stall_is_latched_until_reset_and_said(plant: FakePlant) -> None:
    plant.refer(100.0)
    plant.wait(lambda: plant.answer(0.0).state == "stopped", "the stop")
    state = plant.answer(0.0)
    assert "no edge came" in state.reason and "motor/reset" in state.reason and state.voltage == 0.0
    count = len(plant.diagnostics)
    plant.wait(lambda: plant.answer(0.0).state == "stopped" and len(plant.diagnostics) > count, "diagnostics")
    status = plant.diagnostics[-1].status[0]
    assert status.level == DiagnosticStatus.ERROR and "no edge came" in status.message
    response = plant.call(Trigger, "motor/reset", Trigger.Request())
    assert "no edge came" in response.message
    state = plant.answer(0.0)
    assert state.state == "disabled" and "fresh reference" in state.reason
    plant.refer(100.0)
    assert plant.answer(50.0).state == "running"


@pytest.mark.usefixtures("process")
def test_release_leaves_the_motor_to_others(plant: FakePlant) -> None:
    plant.refer(100.0)
    assert plant.answer(50.0).voltage > 0.0
    response = plant.call(Trigger, "motor/release", Trigger.Request())
    assert response.message == "The motor was released."
    state = plant.answer(50.0)
    assert state.state == "disabled" and plant.voltages[-1].voltage == 0.0
    count = len(plant.voltages)
    for _ in range(5):
        plant.answer(50.0)
    assert len(plant.voltages) == count


@pytest.mark.usefixtures("process")
@pytest.mark.parametrize("how", ["release", "0"])
def test_what_waits_for_its_sender_to_be_known_does_not_act_after_a_stop(plant: FakePlant, how: str) -> None:
    """A new node's reference of just before set the motor going 0.2 s after it was let go of; so did a 0's an angle."""
    plant.refer(0.0)
    other = rclpy.create_node("other", context=plant._context)
    topic = "motor/reference" if how == "release" else "motor/position_reference"
    asked = other.create_publisher(Float64, topic, qos.REFERENCE)
    plant.heard(asked)
    asked.publish(Float64(data=60.0))
    plant.answer(0.0)
    if how == "release":
        assert plant.call(Trigger, "motor/release", Trigger.Request()).success
    else:
        plant.refer(0.0)
    over = time.monotonic() + 2e-9 * SETTLED
    while time.monotonic() < over:
        state = plant.answer(0.0)
        assert (state.state, state.voltage) == ("disabled" if how == "release" else "running", 0.0)
    asked.publish(Float64(data=0.0))
    asked.publish(Float64(data=60.0))
    plant.wait(lambda: plant.answer(0.0).voltage > 0.0 or how == "0", "what is asked for afterwards")


@pytest.mark.usefixtures("process")
def test_a_plant_that_was_restarted_waits_for_a_fresh_reference(plant: FakePlant) -> None:
    plant.refer(100.0)
    assert plant.answer(50.0).voltage > 0.0
    plant.time = 0
    state = plant.answer(0.0)
    assert state.state == "disabled" and "restarted" in state.reason
    plant.refer_anew(20.0)
    assert plant.answer(0.0).voltage > 0.0


@pytest.mark.usefixtures("process")
def test_an_info_that_cannot_be_is_a_sentence_and_zero_volts(plant: FakePlant) -> None:
    plant.refer(100.0)
    plant.tell(Info(name="wheel", edges_per_revolution=0))
    plant.wait(lambda: plant.ask(50.0).state == "stopped", "the stop")
    assert "motor/info says edges_per_revolution = 0, which cannot be" in plant.states[-1].reason
    plant.tell(Info(name="wheel", sample_period=0.0))
    plant.wait(lambda: "sample_period 0: it must be from" in plant.ask(50.0).reason, "the next one")
    assert plant.states[-1].voltage == 0.0
    plant.tell(Info(name="wheel"))
    plant.wait(lambda: plant.answer(50.0).state == "disabled", "a good one")
    plant.refer_anew(100.0)
    assert plant.answer(50.0).state == "running"


@pytest.mark.usefixtures("process")
def test_an_output_that_is_off_is_said_and_winds_nothing_up(plant: FakePlant) -> None:
    plant.refer(20.0)
    plant.enabled = False
    plant.wait(lambda: "motor/enable" in plant.answer(10.0).reason, "the reason")
    first, last = plant.states[-1].integral, [plant.answer(10.0) for _ in range(20)][-1]
    assert last.integral == first and last.state == "running"
    plant.enabled = True
    plant.answer(10.0)
    assert plant.answer(10.0).reason == "" and plant.answer(10.0).integral > first


def test_a_limit_that_is_misspelt_is_a_stop_until_it_is_reset(plant: FakePlant) -> None:
    process = start("motor_control", "motor_control", *PATIENT, "-p", "voltage_limt:=3.0")
    try:
        plant.tell(Info(name="wheel"), measurement="speed")
        plant.await_controller()
        state = plant.ask(0.0)
        assert state.state == "stopped"
        assert state.reason.startswith(
            "There is no parameter voltage_limt, and voltage_limit may be meant. Call motor/re"
        )
        assert plant.call(Trigger, "motor/reset", Trigger.Request()).success
        assert plant.ask(0.0).state == "disabled"
    finally:
        end(process)
