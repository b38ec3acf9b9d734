"""The controller as a process over DDS, against a plant that the test owns: every sample gets its answer."""

import subprocess
import time
from itertools import pairwise
from math import isnan
from pathlib import Path

import pytest
import rclpy
from controller_bench import PATIENT, FakePlant
from diagnostic_msgs.msg import DiagnosticStatus
from rcl_interfaces.srv import DescribeParameters
from rclpy.qos import qos_profile_sensor_data
from std_msgs.msg import Float64
from workbench import PATIENCE, end, start

from motor_model.model_file import save
from motor_model.parameters import Parameters
from motor_model.sample import Info
from motor_msgs.msg import MotorVoltage
from motor_ros import qos
from motor_ros.messages import time_message

KV, KA = 12.0 / 174.097, 0.0055


@pytest.mark.usefixtures("process")
def test_from_no_reference_to_a_held_speed(plant: FakePlant) -> None:
    state = plant.answer(0.0)
    assert (state.state, state.voltage, state.header.frame_id) == ("disabled", 0.0, "wheel")
    assert "motor/reference" in state.reason
    plant.refer(100.0)  # once is enough
    speed, states = 0.0, []
    for _ in range(120):  # 0.6 s of the plant's time
        states.append(plant.answer(speed))
        speed += (states[-1].voltage - KV * speed) / KA * 0.005
    assert all(state.state == "running" and state.reason == "" for state in states)
    assert states[0].voltage == 12.0 and states[0].saturated
    assert speed == pytest.approx(100.0, abs=0.5)
    last = states[-1]
    assert last.voltage == pytest.approx(KV * 100.0, abs=0.1) and not last.saturated
    assert last.voltage == pytest.approx(last.proportional + last.integral + last.feedforward)
    assert last.error == last.reference - last.speed and last.speed_sigma != last.speed_sigma


@pytest.mark.usefixtures("process")
def test_gains_are_live_and_bad_ones_refused(plant: FakePlant) -> None:
    plant.refer(100.0)
    before = plant.answer(90.0)
    assert before.proportional == pytest.approx(2.0)
    assert plant.set("motor_control", "kp", 0.5) == (True, "")
    after = plant.answer(90.0)
    assert after.proportional == pytest.approx(5.0)
    assert after.voltage == pytest.approx(before.voltage + 2.5 * 10.0 * 0.005)  # no jump: the integral takes it up
    for name, value in (("kp", -1.0), ("ki", float("nan")), ("voltage_limit", float("inf")), ("sample_timeout", 0.0)):
        accepted, reason = plant.set("motor_control", name, value)
        assert not accepted and name in reason, reason
    assert plant.answer(90.0).proportional == pytest.approx(5.0)
    assert plant.set("motor_control", "voltage_limit", 2.0) == (True, "")
    assert plant.answer(90.0).voltage == 2.0


@pytest.mark.usefixtures("process")
def test_parameters_are_described_with_unit_and_range(plant: FakePlant) -> None:
    names = ["kp", "ki", "voltage_limit", "sample_timeout", "reference_rate_limit", "reversal_speed", "stall_time"]
    names.append("slot_irregularity")
    request = DescribeParameters.Request(names=names)
    described = plant.call(DescribeParameters, "motor_control/describe_parameters", request).descriptors  # type: ignore[attr-defined]
    assert [row.name for row in described] == names
    for row in described:
        assert row.description.endswith("]") and len(row.floating_point_range) == 1


@pytest.mark.usefixtures("process")
def test_what_the_plant_says_of_itself_counts(plant: FakePlant) -> None:
    plant.refer(40.0)
    assert plant.answer(100.0).voltage == 0.0  # a single channel, until somebody says otherwise
    assert plant.set("motor_control", "plug_limit", 2.0) == (True, "")
    plant.tell(Info(name="wheel", single_channel=False, max_voltage=6.0))
    plant.wait(lambda: "another one than before" in plant.answer(100.0).reason, "what it says")
    plant.refer_anew(40.0)
    plant.wait(lambda: plant.answer(100.0).voltage != 0.0, "the brake")
    assert plant.answer(100.0).voltage == -6.0
    plant.tell(Info(name="wheel", max_voltage=1.0), measurement="tea leaves")
    plant.tell(Info(name="wheel", single_channel=False, max_voltage=5.0))
    plant.wait(lambda: "another one than before" in plant.answer(100.0).reason, "the next info")
    plant.refer_anew(40.0)
    plant.wait(lambda: plant.answer(100.0).voltage == -5.0, "its limit")


@pytest.fixture
def model(tmp_path: Path) -> str:
    """A model file of the paper's motor with friction."""
    path = tmp_path / "motor.yaml"
    save(path, Parameters({"kv": KV, "ka": KA, "ks": 0.4}, ("coulomb_friction",)))
    return str(path)


@pytest.mark.usefixtures("process")
def test_observer_and_feedforward_in_a_running_loop(plant: FakePlant, model: str) -> None:
    """Without a model it says so; with one the speed comes from the edges, and nothing jumps."""
    plant.tell(Info(name="wheel"))
    plant.refer(50.0)
    assert plant.assign("speed_source", "guess")[1].endswith("give measured or observer.")
    assert plant.assign("speed_source", "observer") == (True, "")
    state = plant.answer(50.0)
    assert "No model is loaded" in state.reason and state.state == "running" and isnan(state.speed_sigma)
    plant.wait(lambda: plant.answer(50.0).reason == state.reason and warned(plant, "No model is loaded"), "diagnostics")
    accepted, reason = plant.assign("model", "nowhere.yaml")
    assert not accepted and "cannot read the model file nowhere.yaml" in reason
    assert plant.assign("model", model) == (True, "")
    plant.wait(lambda: not isnan(plant.answer(50.0).speed_sigma), "an observer")
    assert plant.answer(50.0).reason == "" and not isnan(plant.states[-1].innovation)
    assert plant.assign("feedforward", True) == (True, "")
    state = plant.answer(50.0)
    assert state.feedforward > 1.0
    assert state.voltage == pytest.approx(state.proportional + state.integral + state.feedforward)


def warned(plant: FakePlant, words: str) -> bool:
    """Whether /diagnostics warns with these words."""
    statuses = [array.status[0] for array in plant.diagnostics[-2:]]
    return any(words in status.message and status.level == DiagnosticStatus.WARN for status in statuses)


def test_a_model_at_the_start_is_ready_for_the_first_sample(plant: FakePlant, model: str) -> None:
    arguments = ("-p", f"model:={model}", "-p", "speed_source:=observer", "-p", "feedforward:=true")
    process = start("motor_control", "motor_control", *PATIENT, *arguments)
    try:
        plant.tell(Info(name="wheel"))
        plant.meet()
        plant.wait(lambda: "motor/info" not in plant.answer(0.0).reason, "the plant's account of itself")
        plant.refer(40.0)
        plant.wait(lambda: not isnan(plant.answer(0.0).speed_sigma), "the observer")
        assert plant.states[-1].feedforward == pytest.approx(KV * 40.0 + 0.4, abs=0.05)
    finally:
        end(process)


@pytest.mark.parametrize("stream", [True, False])
@pytest.mark.parametrize("another", [True, False])
def test_after_a_silence_only_the_same_plant_goes_on(plant: FakePlant, another: bool, stream: bool) -> None:
    """A driver that was started again goes on with the board's clock; one that was held up is still the same."""
    process = start("motor_control", "motor_control", "--ros-args", "-p", "latency_limit:=10.0")
    try:
        plant.meet()
        plant.refer(50.0)
        again = plant.node.create_timer(0.02, lambda: plant._reference.publish(Float64(data=50.0))) if stream else None
        plant.wait(lambda: plant.states[-1].state == "no_samples", "the silence")
        if another:
            plant.start_again()
        sent = len(plant.voltages)
        state = [plant.answer(20.0) for _ in range(20)][-1]
        assert (state.state, "The plant was restarted" in state.reason) == (
            ("disabled", True) if another else ("running", False)
        )
        assert any(one.voltage for one in plant.voltages[sent:]) is not another
        if again is not None:
            again.cancel()
        plant.refer_anew(50.0)  # a fresh one is obeyed
    finally:
        end(process)


@pytest.mark.on_time
@pytest.mark.usefixtures("process")
def test_diagnostics_once_a_second(plant: FakePlant) -> None:
    plant.refer(100.0)

    def status() -> DiagnosticStatus:
        count = len(plant.diagnostics)
        plant.wait(lambda: plant.answer(50.0).state == "running" and len(plant.diagnostics) > count, "diagnostics")
        return plant.diagnostics[-1].status[0]

    status()
    begin = time.monotonic()
    running = status()
    assert 0.5 < time.monotonic() - begin < 2.0
    assert running.level == DiagnosticStatus.OK and "motor_control" in running.name and "wheel" in running.name
    assert int({pair.key: pair.value for pair in running.values}["samples per second"]) > 10
    rival = plant.node.create_publisher(MotorVoltage, "motor/voltage", qos.VOLTAGE)
    plant.wait(lambda: status().level == DiagnosticStatus.WARN, "a warning about the second publisher")
    plant.node.destroy_publisher(rival)
    plant.wait(lambda: status().level == DiagnosticStatus.OK, "the end of that")
    plant.publisher(Float64, "motor/position_reference")  # of the node that publishes the other kind
    other = rclpy.create_node("forgotten", context=plant.node.context)
    other.create_publisher(Float64, "motor/reference", qos.REFERENCE)
    plant.wait(lambda: status().level == DiagnosticStatus.WARN, "a warning about the second node")
    assert "publish references (/bench, /forgotten)" in plant.diagnostics[-1].status[0].message
    other.destroy_node()
    assert plant.set("motor_control", "sample_timeout", 0.1) == (True, "")
    count = len(plant.diagnostics)
    plant.wait(lambda: len(plant.diagnostics) >= count + 2, "diagnostics in silence")
    assert plant.diagnostics[-1].status[0].level == DiagnosticStatus.ERROR
    assert "motor/speed" in plant.diagnostics[-1].status[0].message


def test_a_namespace_makes_another_motor() -> None:
    plant, process = FakePlant("left"), start("motor_control", "motor_control", *PATIENT, "-r", "__ns:=/left")
    try:
        plant.meet()
        plant.refer(10.0)
        assert plant.answer(5.0).state == "running"
    finally:
        end(process)
        plant.close()


@pytest.mark.on_time
def test_at_1_khz_the_newest_sample_is_answered(plant: FakePlant, process: subprocess.Popen[str]) -> None:
    """In order, and none twice; one that has been overtaken is left out."""
    plant.refer(100.0)
    answers, count = len(plant.states), 1000
    begin = time.monotonic()
    for k in range(count):
        plant.say(99.0)
        while (left := begin + (k + 1) * 1e-3 - time.monotonic()) > 0.0:
            plant.executor.spin_once(timeout_sec=max(left, 1e-4))
    stamp = time_message(plant.time)
    plant.wait(lambda: plant.states[-1].header.stamp == stamp, "the latest answer")
    stamps = [state.header.stamp.sec * 10**9 + state.header.stamp.nanosec for state in plant.states[answers:]]
    assert all(b > a for a, b in pairwise(stamps)) and len(stamps) > 0.3 * count
    assert process.poll() is None


@pytest.mark.parametrize(
    ("assignment", "words"),
    [("kp:=-1.0", "kp"), ("voltage_limit:=1", "number from 0 to 100 V"), ("ki:=lots", "for example 2.5")],
)
def test_a_bad_start_is_one_sentence(assignment: str, words: str) -> None:
    process = start("motor_control", "motor_control", "--ros-args", "-p", assignment)
    out, err = process.communicate(timeout=PATIENCE)
    assert process.returncode == 1 and out == ""
    assert words in err and len(err.strip().splitlines()) == 1


@pytest.mark.usefixtures("process")
def test_a_best_effort_publisher_of_references_is_said(plant: FakePlant) -> None:
    """Its 0 does not stop the motor, either: it never comes."""
    plant.answer(0.0)
    teleop = plant.node.create_publisher(Float64, "motor/reference", qos_profile_sensor_data)
    said = "What /bench sends on /motor/reference is not heard, nor would a 0 be: it is published best effort"
    plant.wait(lambda: plant.answer(0.0).state == "disabled" and warned(plant, said), "a warning")
    plant.node.destroy_publisher(teleop)
