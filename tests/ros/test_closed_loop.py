"""Sim, controller, experiment and identification together, as a user starts them."""

import time
from collections.abc import Callable
from pathlib import Path
from subprocess import Popen

import numpy as np
import pytest
from std_msgs.msg import Float64
from std_srvs.srv import SetBool
from workbench import PATIENCE, Bench, end

from motor_identification.bag import read_recording
from motor_identification.identify import Request, identify
from motor_model.model_file import save
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_msgs.msg import ControlState, MotorSpeed
from motor_ros import qos

Start = Callable[..., "Popen[str]"]
HIDDEN = Parameters({"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4}, ("coulomb_friction",))


def sim(start: Start, tmp_path: Path, *arguments: str) -> "Popen[str]":
    save(tmp_path / "hidden.yaml", HIDDEN)
    model = f"model:={tmp_path / 'hidden.yaml'}"
    return start("motor_sim", "motor_sim", "--ros-args", "-p", model, "-p", "slot_irregularity:=0.01", *arguments)


@pytest.mark.on_time
def test_holds_a_speed_and_changes_it_without_a_limit_cycle(bench: Bench, start: Start, tmp_path: Path) -> None:
    sim(start, tmp_path)
    controller = start("motor_control", "motor_control", "--ros-args", "-p", "latency_limit:=0.5")
    samples = bench.hear(MotorSpeed, "motor/speed", qos.SPEED)
    states = bench.hear(ControlState, "motor/control_state", qos.CONTROL_STATE)
    reference = bench.publisher(Float64, "motor/reference", qos.REFERENCE)
    bench.heard(reference)
    bench.wait(lambda: bool(states) and states[-1].state == "disabled", "samples at the controller")

    def hold(speed: float, seconds: float) -> tuple[list[MotorSpeed], list[ControlState]]:
        """What happened from a new reference on."""
        first, state = len(samples), len(states)
        reference.publish(Float64(data=speed))
        bench.wait(lambda: len(samples) > first + 200 * seconds, f"{seconds} s of samples")
        return samples[first:], states[state:]

    seen, _ = hold(100.0, 2.0)
    assert np.mean([sample.speed for sample in seen[-200:]]) == pytest.approx(100.0, abs=0.5)
    seen, shown = hold(40.0, 2.0)
    assert np.mean([sample.speed for sample in seen[-200:]]) == pytest.approx(40.0, abs=0.5)
    voltages = np.array([sample.voltage for sample in seen])
    assert voltages.min() >= 0.0 and np.all(np.array([sample.speed for sample in seen]) > 30.0)  # sign never wrong
    assert 0.5 < np.ptp([sample.speed for sample in seen[-200:]]) < 5.0  # 1 % slots show 6.7 % at constant speed
    assert {state.state for state in shown} == {"running"}
    end(controller)
    bench.wait(lambda: samples[-1].voltage == 0.0, "0 V after the controller has gone")


@pytest.mark.on_time
def test_with_its_model_the_loop_holds_slow_speeds_and_says_when_the_output_is_off(
    bench: Bench, start: Start, tmp_path: Path
) -> None:
    sim(start, tmp_path)
    model = f"model:={tmp_path / 'hidden.yaml'}"
    gains = ("-p", f"kp:={PAPER_KA / 0.02}", "-p", f"ki:={PAPER_KV / 0.02}")
    options = ("-p", model, "-p", "speed_source:=observer", "-p", "feedforward:=true", *gains)
    start(
        "motor_control", "motor_control", "--ros-args", *options, "-p", "latency_limit:=0.5"
    )  # others use the processor
    states = bench.hear(ControlState, "motor/control_state", qos.CONTROL_STATE)
    reference = bench.publisher(Float64, "motor/reference", qos.REFERENCE)
    bench.heard(reference)
    bench.wait(lambda: len(states) > 20 and states[-1].state == "disabled", "samples")

    def hold(speed: float, seconds: float) -> list[ControlState]:
        first = len(states)
        reference.publish(Float64(data=speed))
        bench.wait(lambda: len(states) > first + 200 * seconds, f"{seconds} s of states")
        return states[first:]

    for speed, share in ((100.0, 0.01), (-3.0, 0.15)):
        late = hold(speed, 1.0)[-80:]
        assert {state.state for state in late} == {"running"} and {state.reason for state in late} == {""}
        assert np.max(np.abs(np.array([state.speed for state in late]) / speed - 1.0)) < share
        assert 0.0 < np.median([state.speed_sigma for state in late]) < 0.3
        assert 0.0 < np.max(np.abs([state.innovation for state in late])) < 0.02
    assert hold(0.0, 0.5)[-1].speed == 0.0 and states[-1].voltage == 0.0
    hold(20.0, 0.5)
    assert bench.call(SetBool, "motor/enable", SetBool.Request(data=False), keep=True).success
    bench.wait(lambda: "motor/enable" in states[-1].reason, "the reason")
    held = hold(20.0, 0.3)
    assert np.ptp([state.integral for state in held[20:]]) < 1e-3 and held[-1].state == "running"
    assert bench.call(SetBool, "motor/enable", SetBool.Request(data=True), keep=True).success
    assert np.mean([state.speed for state in hold(20.0, 1.0)[-60:]]) == pytest.approx(20.0, abs=0.3)
    assert states[-1].reason == ""


def test_experiment_on_the_live_plant_finds_the_hidden_friction(start: Start, tmp_path: Path) -> None:
    sim(start, tmp_path)
    start("motor_control", "motor_control")  # without a reference it leaves the motor to the experiment
    bag = tmp_path / "staircase"
    process = start("motor_identification", "experiment", "staircase", "--output", bag, "--voltage", "10")
    out, err = process.communicate(timeout=PATIENCE)
    assert process.returncode == 0, err
    assert "s of 'staircase'" in out
    recording = read_recording(str(bag))
    assert 5.5 < recording.duration < 6.5 and recording.voltage.max() == 10.0 and recording.voltage.min() == -10.0
    assert recording.voltage[0] == 0.0 and recording.speed[0] == 0.0
    fit = identify([recording], Request(effects=("coulomb_friction",)))
    for name, true in HIDDEN.values.items():
        assert fit.parameters.value(name) == pytest.approx(true, rel=2e-3)
    assert not fit.not_identifiable and not fit.not_told_apart


def test_experiment_without_a_plant_or_with_a_rival_is_one_sentence(bench: Bench, start: Start, tmp_path: Path) -> None:
    process = start("motor_identification", "experiment", "step", "--output", tmp_path / "bag", "--voltage", "99")
    sim(start, tmp_path)
    _, err = process.communicate(timeout=PATIENCE)
    assert process.returncode == 1 and "--voltage 99 is not between 0 and" in err and not (tmp_path / "bag").exists()
    start("motor_control", "motor_control")
    reference = bench.publisher(Float64, "motor/reference", qos.REFERENCE)
    bench.heard(reference)
    reference.publish(Float64(data=50.0))
    states = bench.hear(ControlState, "motor/control_state", qos.CONTROL_STATE)
    bench.wait(lambda: bool(states) and states[-1].state == "running", "a running controller")
    process = start("motor_identification", "experiment", "step", "--output", tmp_path / "bag")
    _, err = process.communicate(timeout=PATIENCE)
    assert process.returncode == 1 and "Another node publishes motor/voltage: " in err and "Traceback" not in err
    assert ("/motor_control. End it" in err or "not known yet" in err) and "UNKNOWN" not in err


@pytest.mark.on_time
def test_ctrl_c_in_an_experiment_leaves_zero_volts_and_a_readable_bag(
    bench: Bench, start: Start, tmp_path: Path
) -> None:
    sim(start, tmp_path)
    samples = bench.hear(MotorSpeed, "motor/speed", qos.SPEED)
    process = start("motor_identification", "experiment", "rich", "--output", tmp_path / "bag")
    bench.wait(lambda: any(sample.speed > 20.0 for sample in samples), "motion")
    end(process)
    assert process.returncode == 130
    first = len(samples)
    begun = time.monotonic()
    bench.wait(lambda: any(sample.voltage == 0.0 for sample in samples[first:]), "0 V")
    assert time.monotonic() - begun < 1.0
    assert 0.1 < read_recording(str(tmp_path / "bag_incomplete")).duration < 20.0
