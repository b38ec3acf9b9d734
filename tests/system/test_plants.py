"""Simulated and real motor swap: the same checks over motor_sim, and over motor_driver on the emulated board."""

from collections.abc import Callable
from itertools import pairwise
from math import tau
from pathlib import Path
from subprocess import Popen

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from plant_user import User, count_stop
from sensor_msgs.msg import JointState
from std_srvs.srv import SetBool
from workbench import PATIENCE, Bench, end

from motor_identification.bag import read_recording
from motor_identification.identify import Request, identify
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_msgs.msg import MotorInfo
from motor_ros import qos

Start = Callable[..., "Popen[str]"]


@pytest.fixture
def user(bench: Bench) -> User:
    return User(bench)


@pytest.mark.on_time
def test_reaches_the_speed_of_its_model_and_stamps_every_edge(bench: Bench, start_plant: Start, user: User) -> None:
    motor = Parameters({"kv": PAPER_KV, "ka": PAPER_KA}, max_voltage=6.0)
    process = start_plant(motor, "name:=wheel", "max_voltage:=6.0", "supply_voltage:=6.0")
    info = bench.hear(MotorInfo, "motor/info", qos.INFO)
    joints = bench.hear(JointState, "joint_states", qos.JOINT_STATES)
    status = bench.hear(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
    user.voltage = 8.0  # more than there is
    user.until_on(lambda sample: sample.speed > 0.999 * 6.0 / PAPER_KV, "full speed")
    steady = user.steady(6.0, 250)
    assert (info[-1].name, info[-1].measurement, info[-1].single_channel) == ("wheel", "edges", True)
    assert (info[-1].edges_per_revolution, info[-1].max_voltage, info[-1].decay) == (96, 6.0, "brake")
    assert info[-1].sample_period == 0.005
    assert {sample.header.frame_id for sample in steady} == {"wheel"}
    assert {b.sample_time - a.sample_time for a, b in pairwise(steady)} == {5_000_000}
    tick = round(info[-1].edge_resolution * 1e9)
    assert all((sample.edge_time - 1_000_000_000) % tick == 0 for sample in steady)  # from power-up
    first, last = steady[150], steady[-1]
    turned = (last.edge_count - first.edge_count) * tau / 96
    assert turned / ((last.edge_time - first.edge_time) * 1e-9) == pytest.approx(6.0 / PAPER_KV, rel=1e-4)
    assert last.speed == pytest.approx(6.0 / PAPER_KV, rel=0.01)
    stamps = [sample.header.stamp.sec * 10**9 + sample.header.stamp.nanosec for sample in steady]
    assert stamps[-1] - stamps[0] == pytest.approx(steady[-1].sample_time - steady[0].sample_time, abs=20e6)
    assert joints[-1].name == ["wheel"] and joints[-1].position[0] > joints[-5].position[0]

    def say() -> list[tuple[bytes, str]]:
        return [(one.level, one.message) for array in status for one in array.status if one.hardware_id == "wheel"]

    user.until_on(lambda _: say()[-1:] == [(b"\x00", "driven")], "the plant that is driven")
    assert not any("More than one node" in message for _, message in say())
    end(process)
    assert process.returncode == 0


@pytest.mark.on_time
def test_stops_without_commands_and_while_disabled(bench: Bench, start_plant: Start, user: User) -> None:
    start_plant()
    user.voltage = 4.5
    user.until_on(lambda sample: sample.speed > 30.0, "motion")
    user.sending = False
    silent = user.until(lambda sample: sample.voltage == 0.0, "0 V after the time-out")
    last = max(sample.sample_time for sample in user.samples if sample.voltage == 4.5)
    assert 0.0 < (silent.sample_time - last) * 1e-9 < 0.15
    user.sending = True
    user.until_on(lambda sample: sample.voltage == 4.5, "commands again")
    assert bench.call(SetBool, "motor/enable", SetBool.Request(data=False)).success
    user.until(lambda sample: sample.voltage == 0.0, "the output off")
    user.until(lambda sample: sample.speed == 0.0, "a true zero")
    assert all(sample.voltage == 0.0 for sample in user.samples[-20:])
    assert bench.call(SetBool, "motor/enable", SetBool.Request(data=True)).success
    user.until_on(lambda sample: sample.voltage == 4.5, "the output on")
    user.voltage = float("nan")
    user.until(lambda sample: sample.voltage == 0.0, "0 V instead of what is no number")
    assert all(sample.voltage in (0.0, 4.5) for sample in user.samples)


def test_stays_off_at_the_start_where_the_user_wants_that(bench: Bench, start_plant: Start, user: User) -> None:
    start_plant(None, "enabled_at_start:=false")
    user.voltage = 4.5
    assert {sample.voltage for sample in user.more(60)} == {0.0}
    assert bench.call(SetBool, "motor/enable", SetBool.Request(data=True)).success
    user.until_on(lambda sample: sample.voltage == 4.5, "the output on")


def test_a_value_out_of_range_is_one_sentence(start_plant: Start) -> None:
    process = start_plant(None, "sample_rate:=5000.0")
    out, err = process.communicate(timeout=PATIENCE)
    assert (process.returncode, out) == (1, "")
    assert "sample_rate" in err and "10 to 1000 Hz" in err and err.count("\n") == 1


def switched_on(bench: Bench) -> bool:
    return bool(bench.call(SetBool, "motor/enable", SetBool.Request(data=True)).success)


def recorded(bench: Bench, start: Start, directory: Path) -> Path:
    """The bag of an experiment, begun anew after a stop: each is counted, and there may be few."""
    stops = 0
    while True:
        bag = directory / f"bag_{stops}"
        process = start("motor_identification", "experiment", "ramps", "--output", bag)
        _, err = process.communicate(timeout=120.0)
        if process.returncode == 0:
            return bag
        assert "output is off" in err, err
        stops += 1
        count_stop(stops, "experiment")
        bench.wait(lambda: switched_on(bench), "a board whose telemetry has come back")


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("start_plant", ["motor_driver"], indirect=True)  # for motor_sim others show it
def test_experiment_and_identification_find_the_motor(
    bench: Bench, start_plant: Start, start: Start, tmp_path: Path
) -> None:
    """A motor whose friction nobody told of, on the pins of the emulated board."""
    hidden = {"kv": 0.071, "ka": 0.0052, "ks": 0.4, "breakaway_voltage": 0.7, "stribeck_speed": 8.0}
    start_plant(Parameters(hidden, ("static_friction",)))
    bag = recorded(bench, start, tmp_path)
    fit = identify([read_recording(str(bag))], Request(effects=("static_friction",)))
    for name, share in {"kv": 1e-4, "ka": 1e-3, "ks": 1e-3, "breakaway_voltage": 1e-3}.items():
        assert fit.parameters.value(name) == pytest.approx(hidden[name], rel=share), name
    assert fit.residual_rms < 3.0 * fit.noise_floor  # so nothing else of the firmware is in the recording
