"""The simulated motor as a process; what it has in common with the real one is in tests/system/test_plants.py."""

from collections.abc import Callable
from pathlib import Path
from subprocess import Popen

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from plant_user import User
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Float64
from std_srvs.srv import SetBool
from workbench import PATIENCE, Bench, end

from motor_control.controller.timing.latency import PAUSE, track_latency
from motor_model.model_file import save
from motor_model.parameters import PAPER_KV, Parameters
from motor_model.sensing.motion_check import NEVER
from motor_msgs.msg import ControlState, MotorInfo, MotorSpeed
from motor_ros import qos
from motor_ros.gate import APART
from motor_ros.messages import time_message
from motor_sim.node import MOST_BEHIND, STILL, find_due

Start = Callable[..., "Popen[str]"]
PATIENT = ("--ros-args", "-p", "command_timeout:=10.0")  # a user who is held up does not interrupt
LATER = 6_000_000_000  # [ns] on a plant's clock, which begins at 1 s: the next plant is heard within 3.1 s of its start


@pytest.fixture
def user(bench: Bench) -> User:
    return User(bench)


@pytest.mark.parametrize("number", [float("nan"), float("inf")])
def test_a_voltage_that_is_no_number_stops_the_motor(start: Start, user: User, number: float) -> None:
    start("motor_sim", "motor_sim", *PATIENT)
    user.voltage = 5.0
    user.until(lambda sample: sample.voltage == 5.0, "motion")
    user.voltage = number
    user.until(lambda sample: sample.voltage == 0.0, "0 V")
    assert all(sample.voltage in (0.0, 5.0) for sample in user.samples)


def test_a_limit_that_is_misspelt_leaves_the_output_off_until_it_is_enabled(
    bench: Bench, start: Start, user: User
) -> None:
    """`max_voltge: 3` was 12 V on a 3 V motor, with a line in the log."""
    start("motor_sim", "motor_sim", *PATIENT, "-p", "max_voltge:=3.0")
    status = bench.hear(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
    user.voltage = 5.0
    said = "The output is off (there is no parameter max_voltge, and max_voltage may be meant)"
    user.until(lambda _: any(one.status[0].message.startswith(said) for one in status), said)
    assert all(sample.voltage == 0.0 for sample in user.samples)
    assert bench.call(SetBool, "motor/enable", SetBool.Request(data=True)).success
    user.until(lambda sample: sample.voltage == 5.0, "motion")


def test_loads_a_model_and_says_what_it_simulates(bench: Bench, start: Start, user: User, tmp_path: Path) -> None:
    model = Parameters({"kv": 0.1, "ka": 0.005, "ks": 1.0}, ("coulomb_friction",), max_voltage=9.0, name="stiff")
    save(tmp_path / "stiff.yaml", model)
    process = start("motor_sim", "motor_sim", *PATIENT, "-p", f"model:={tmp_path / 'stiff.yaml'}")
    info = bench.hear(MotorInfo, "motor/info", qos.INFO)
    status = bench.hear(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
    user.voltage = 0.9
    user.until(lambda sample: len(user.samples) > 40, "samples")
    assert user.samples[-1].edge_count == 0  # held by its friction
    user.voltage = 5.0
    fast = user.until(lambda sample: sample.speed > 39.0, "motion")
    assert fast.speed < 41.5  # (5 V − 1 V)/0.1, the disc is regular
    assert (info[0].source, info[0].max_voltage) == ("simulation", 9.0)
    bench.wait(lambda: bool(status) and status[-1].status[0].level == b"\x00", "diagnostics without a complaint")
    assert "motor_sim" in status[-1].status[0].name
    _, err = end(process)
    assert "Simulating 'stiff' (coulomb_friction): 200 Hz, 9 V." in err


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("effects: [magic]\nparameters: {kv: 0.07, ka: 0.005}\n", "'magic' is not an effect"),
        ("effects: []\nparameters: {kv: 0.07, ka: -0.005}\n", "ka = -0.005"),
        (None, "cannot read the model file"),
    ],
)
def test_a_bad_model_is_one_sentence(start: Start, tmp_path: Path, text: str | None, words: str) -> None:
    path = tmp_path / "model.yaml"
    if text is not None:
        path.write_text(text)
    process = start("motor_sim", "motor_sim", "--ros-args", "-p", f"model:={path}")
    out, err = process.communicate(timeout=PATIENCE)
    assert (process.returncode, out) == (1, "")
    assert words in err and err.count("\n") == 1 and "Traceback" not in err


def test_a_value_out_of_range_is_one_sentence(start: Start) -> None:
    process = start("motor_sim", "motor_sim", "--ros-args", "-p", "sample_rate:=5000.0")
    out, err = process.communicate(timeout=PATIENCE)
    assert (process.returncode, out) == (1, "")
    assert "sample_rate" in err and "10 to 1000 Hz" in err and err.count("\n") == 1


@pytest.mark.parametrize(
    ("behind", "silent", "wait"),
    [
        (MOST_BEHIND, 0, -MOST_BEHIND),  # it catches up
        (MOST_BEHIND + 1, 1_000_000, STILL - 1_000_000),
        (MOST_BEHIND + 1, STILL + 1, 0),  # held up as a whole, it was silent long enough
    ],
)
def test_a_clock_that_stood_still_is_none_of_old_samples(behind: int, silent: int, wait: int) -> None:
    """A simulation that could not keep up left its loop at 0 V for minutes: its samples seemed to be seconds old."""
    now = 10_000_000_000
    due = find_due(now - behind, now, now - silent)
    assert due == now + wait
    _, state = track_latency(None, 0, 1e-9 * (now - silent))
    age, _ = track_latency(state, 5_000_000, 1e-9 * max(due, now))
    assert age == 0.0 and STILL * 1e-9 > PAUSE


def messages(status: list[DiagnosticArray]) -> str:
    return status[-1].status[0].message if status else ""


@pytest.mark.on_time
def test_a_voltage_that_flowed_before_the_start_waits_for_0_volt(bench: Bench, start: Start, user: User) -> None:
    """The plant is started again under a sender that does not know of it, and has been at it for two seconds."""
    status = bench.hear(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
    first = start("motor_sim", "motor_sim")
    user.voltage = 5.0
    user.until(lambda sample: sample.voltage == 5.0, "motion")
    bench.wait(lambda: len(user.samples) > 400, "two seconds of it")
    first.kill()
    start("motor_sim", "motor_sim")
    bench.wait(lambda: "5 V was already being sent on motor/voltage" in messages(status), "what it waits for")
    assert user.samples[-1].voltage == 0.0
    assert bench.call(SetBool, "motor/enable", SetBool.Request(data=True)).success
    user.until(lambda sample: sample.voltage == 5.0, "the output on")


@pytest.mark.on_time
def test_two_senders_are_named_and_the_first_is_obeyed(bench: Bench, start: Start, user: User) -> None:
    status = bench.hear(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
    start("motor_sim", "motor_sim", *PATIENT)
    user.voltage = 5.0
    bench.wait(lambda: len(user.samples) > 1.2 * APART, "numbers that no newcomer's can be taken for")
    user.until(lambda sample: sample.voltage == 5.0, "motion")
    other = User(bench)  # of the same name and pace
    other.voltage = -9.0
    bench.wait(lambda: len(other.samples) > 300 and "More than one node sends" in messages(status), "the conflict")
    assert "(/bench, /bench): only the first is obeyed, until it has been silent for 0.5 s" in messages(status)
    assert {sample.voltage for sample in other.samples[30:]} == {5.0}
    user.sending = False
    bench.wait(lambda: "beside another node that drove the motor" in messages(status), "what the other one waits for")
    assert {sample.voltage for sample in other.samples[30:]} == {5.0, 0.0}
    assert bench.call(SetBool, "motor/enable", SetBool.Request(data=True)).success
    user.until(lambda sample: sample.voltage == -9.0, "the other one's turn")


@pytest.mark.on_time
def test_of_two_senders_of_one_name_that_start_together_none_is_obeyed(bench: Bench, start: Start, user: User) -> None:
    status = bench.hear(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
    start("motor_sim", "motor_sim", *PATIENT)
    other = User(bench)
    user.voltage, other.voltage = 5.0, -9.0
    bench.wait(lambda: "whose command is whose cannot be told" in messages(status), "the conflict")
    begin = len(other.samples)
    bench.wait(lambda: len(other.samples) > begin + 300, "more of both")
    assert {sample.voltage for sample in other.samples[begin:]} == {0.0}
    refused = bench.call(SetBool, "motor/enable", SetBool.Request(data=True))
    assert not refused.success and "(/bench, /bench), all with frame_id 'user'" in refused.message
    user.sending = False
    bench.wait(lambda: "beside another node that drove the motor" in messages(status), "what the other one waits for")
    assert {sample.voltage for sample in other.samples[begin:]} == {0.0}
    assert bench.call(SetBool, "motor/enable", SetBool.Request(data=True)).success
    user.until(lambda sample: sample.voltage == -9.0, "the other one's turn")


def test_a_blocked_motor_is_stopped(bench: Bench, start: Start, user: User, tmp_path: Path) -> None:
    stiff = Parameters({"kv": PAPER_KV, "ka": 0.0055, "ks": 11.0}, ("coulomb_friction",), name="stiff")
    save(tmp_path / "stiff.yaml", stiff)
    status = bench.hear(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
    start("motor_sim", "motor_sim", *PATIENT, "-p", f"model:={tmp_path / 'stiff.yaml'}")
    user.voltage = 9.0
    user.until(lambda sample: sample.voltage == 9.0, "a voltage")
    user.until(lambda sample: sample.voltage == 0.0, "the stop")
    driven = [sample.sample_time for sample in user.samples if sample.voltage == 9.0]
    assert 0.35 < (driven[-1] - driven[0]) * 1e-9 < 0.45
    bench.wait(lambda: messages(status).startswith(f"The output is off ({NEVER.format(voltage=9.0)}"), "why")
    assert status[-1].status[0].level == b"\x02"
    assert bench.call(SetBool, "motor/enable", SetBool.Request(data=True)).success
    user.until(lambda sample: sample.voltage == 9.0, "another try")


def test_a_motor_gets_its_own_voltage_from_a_higher_supply(bench: Bench, start: Start, user: User) -> None:
    start("motor_sim", "motor_sim", *PATIENT, "-p", "max_voltage:=6.0", "-p", "supply_voltage:=24.0")
    info = bench.hear(MotorInfo, "motor/info", qos.INFO)
    user.voltage = 20.0
    fast = user.until(lambda sample: sample.speed > 0.99 * 6.0 / PAPER_KV, "full speed")
    assert (fast.voltage, info[0].max_voltage) == (6.0, 6.0)


def test_simulated_ros_time_stops_nothing(bench: Bench, start: Start, user: User) -> None:
    """Nobody publishes /clock: ROS time stands at 0, and the motor runs all the same."""
    start("motor_sim", "motor_sim", "--ros-args", "-p", "use_sim_time:=true")
    user.voltage = 5.0
    user.until(lambda sample: sample.speed > 60.0, "motion")
    assert user.samples[-1].header.stamp.sec == 0


@pytest.mark.parametrize("times", [pytest.param((5000.0, 10.0), marks=pytest.mark.slow), (2.0e9, 0.0, 3.0)])
def test_a_clock_that_jumps_to_and_fro_stops_no_loop(
    bench: Bench, start: Start, user: User, times: tuple[float, ...]
) -> None:
    """Plant and controller under /clock: it jumps by an hour, back, decades ahead, to 0; the speed is held."""
    user.sending = False  # the controller does
    start("motor_sim", "motor_sim", *PATIENT, "-p", "use_sim_time:=true")
    patient = ("-p", "latency_limit:=10.0", "-p", "sample_timeout:=5.0")
    start("motor_control", "motor_control", "--ros-args", "-p", "use_sim_time:=true", *patient)
    reference = bench.publisher(Float64, "motor/reference", qos.REFERENCE)
    clock = bench.publisher(Clock, "/clock", 1)
    states = bench.hear(ControlState, "motor/control_state", qos.CONTROL_STATE)
    bench.heard(reference, clock)
    user.until_moving(reference, "motion", enable=False)
    bench.wait(lambda: bool(states) and states[-1].state == "running", "a running loop")
    begun = len(states)
    for time in times:
        clock.publish(Clock(clock=time_message(round(time * 1e9))))
        user.until(lambda sample: abs(sample.header.stamp.sec - time) < 2.0, "the time that it is now")  # noqa: B023
        user.more(60)  # a busy machine may hold the loop up, and the speed swings for a moment
        user.until(lambda sample: 55.0 < sample.speed < 65.0, "the speed that is asked for")
    assert {(state.state, state.reason) for state in states[begun:]} == {("running", "")}


def of_the_latest_plant(user: User) -> list[MotorSpeed]:
    """The samples since the clock was last behind; none while there is but one plant."""
    times = [sample.sample_time for sample in user.samples]
    back = [k for k in range(1, len(times)) if times[k] < times[k - 1]]
    return user.samples[back[-1] :] if back else []


@pytest.mark.on_time
def test_after_a_restart_an_old_reference_waits_and_a_fresh_one_drives(bench: Bench, start: Start, user: User) -> None:
    """Plant and controller each drop what was before; nobody has to call motor/enable."""
    user.sending = False  # the controller does
    reference = bench.publisher(Float64, "motor/reference", qos.REFERENCE)
    first = start("motor_sim", "motor_sim")
    start("motor_control", "motor_control")
    bench.heard(reference)
    user.more(50)  # a reference from more than 1 s before the first sample is an old one
    user.until_moving(reference, "motion", enable=False)
    user.until(lambda sample: sample.sample_time > LATER, "a clock that the next plant's is surely behind")
    first.kill()
    start("motor_sim", "motor_sim")
    bench.wait(lambda: len(of_the_latest_plant(user)) > 300, "samples of the next plant")
    assert {sample.voltage for sample in of_the_latest_plant(user)} == {0.0}
    user.until_moving(reference, "motion by a fresh reference", enable=False)
