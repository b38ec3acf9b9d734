"""Whoever dies, the motor stops: real processes, real firmware; times are those of the emulated board's clock."""

import signal
import time
from collections.abc import Callable
from dataclasses import replace
from itertools import count
from pathlib import Path
from subprocess import Popen
from typing import NamedTuple

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from plant_user import User, count_stop
from std_msgs.msg import Float64
from std_srvs.srv import SetBool
from workbench import PATIENCE, Bench

from motor_board.emulation.chip import FREQUENCY
from motor_board.emulation.live import LiveBoard
from motor_ros import qos

Start = Callable[..., "Popen[str]"]
MOST = 0.150  # [s] to 0 V at the pins
LATE = ("--ros-args", "-p", "latency_limit:=10.0")  # on a busy machine a sample is late, which is no fault here


@pytest.fixture
def driver(start: Start, live: LiveBoard, tmp_path: Path) -> "Popen[str]":
    return start("motor_driver", "motor_driver", "--ros-args", "-p", f"port:={tmp_path / 'port'}")


@pytest.fixture
def user(bench: Bench) -> User:
    return User(bench)


def seconds(board: LiveBoard) -> float:
    return board.truth().cycle / FREQUENCY


class Rest(NamedTuple):
    """How long it took until the pins were at 0 V, on the board's clock."""

    seconds: float  # as it was
    least: float  # [s] a real board, which no computer holds up, takes as long


def due(board: LiveBoard) -> float:
    """[s] on the board's clock that it is now: a busy computer holds the emulation up, and its clock with it."""
    return (time.monotonic_ns() - board.truth().start) * 1e-9


def rest(board: LiveBoard) -> Rest:
    """Wait until the pins are at 0 V.

    What was sent to an emulated board while it was held up reaches it when it runs again, and a real one at once: the
    last command is as much older.
    """
    begin, late, patience = due(board), 0.0, time.monotonic() + PATIENCE
    while board.truth().voltage != 0.0:
        assert time.monotonic() < patience, "the pins are not at 0 V"
        late = max(late, due(board) - seconds(board))
        time.sleep(0.001)
    took = seconds(board) - begin
    return Rest(took, took - late)


def test_a_killed_controller(driver: "Popen[str]", live: LiveBoard, user: User, start: Start) -> None:
    user.sending = False  # the controller does
    reference = user.bench.publisher(Float64, "motor/reference", qos.REFERENCE)
    controller = start("motor_control", "motor_control", *LATE)
    user.bench.heard(reference)
    user.until_moving(reference, "motion")
    controller.kill()
    assert rest(live).least < MOST


def test_driver_and_controller_are_killed_at_full_voltage(
    driver: "Popen[str]", live: LiveBoard, user: User, start: Start
) -> None:
    """As the kernel does for want of memory (`benchmarks/faults_kill.py`): nobody is left who could say 0 V."""
    user.sending = False  # the controller does
    reference = user.bench.publisher(Float64, "motor/reference", qos.REFERENCE)
    controller = start("motor_control", "motor_control", *LATE)
    user.bench.heard(reference)
    user.until_moving(reference, "motion")
    reference.publish(Float64(data=400.0))  # faster than it can
    user.until_on(lambda sample: sample.voltage == 12.0, "full voltage")
    driver.kill()
    controller.kill()
    took = rest(live)
    assert took.seconds > 0.05 and took.least < MOST
    for _ in range(300):  # and for good
        assert live.truth().voltage == 0.0
        time.sleep(0.001)


def test_a_killed_driver_and_its_successor(driver: "Popen[str]", live: LiveBoard, user: User, start: Start) -> None:
    user.voltage = 6.0
    user.until_on(lambda sample: sample.speed > 50.0, "motion")
    driver.kill()
    took = rest(live)
    assert took.seconds > 0.05 and took.least < MOST
    status = user.bench.hear(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
    start("motor_driver", "motor_driver", "--ros-args", "-p", f"port:={live._port._link}")
    said = ("6 V was already being sent", "The output is off")  # the latter where a busy machine holds the board up
    user.bench.wait(
        lambda: bool(status) and any(words in status[-1].status[0].message for words in said), "what it waits for"
    )
    assert live.truth().voltage == 0.0 and {sample.voltage for sample in user.more(60)} == {0.0}
    user.switch_on()
    user.until_on(lambda sample: sample.speed > 50.0, "motion by the next driver")


def test_a_latched_stop_does_not_end_by_starting_the_driver_again(
    driver: "Popen[str]", live: LiveBoard, user: User, start: Start
) -> None:
    """The telemetry sticks, which is a stop; the driver starts again, and somebody goes on sending a reference."""
    user.sending = False  # the controller does
    reference = user.bench.publisher(Float64, "motor/reference", qos.REFERENCE)
    start("motor_control", "motor_control", *LATE)
    user.bench.heard(reference)
    user.until_moving(reference, "motion")
    stream = user.bench.node.create_timer(0.05, lambda: reference.publish(Float64(data=60.0)))
    live.faults = replace(live.faults, stuck_telemetry=True)
    assert rest(live).least < MOST
    driver.kill()
    live.faults = replace(live.faults, stuck_telemetry=False)
    gone = time.monotonic() + 0.5
    user.bench.wait(lambda: time.monotonic() > gone, "what was still under way")
    count = len(user.samples)
    start("motor_driver", "motor_driver", "--ros-args", "-p", f"port:={live._port._link}")
    user.bench.wait(lambda: len(user.samples) > count + 400, "samples of the next driver")
    assert {sample.voltage for sample in user.samples[count:]} == {0.0} and live.truth().voltage == 0.0
    stream.cancel()
    user.switch_on()
    user.until_moving(reference, "motion after an enable and a fresh reference")


def test_a_driver_that_is_ended_leaves_0_volt(driver: "Popen[str]", live: LiveBoard, user: User) -> None:
    user.voltage = 6.0
    user.until_on(lambda sample: sample.speed > 50.0, "motion")
    driver.send_signal(signal.SIGINT)
    assert rest(live).least < MOST
    _, err = driver.communicate(timeout=PATIENCE)
    assert driver.returncode == 0 and "Traceback" not in err


@pytest.mark.on_time
def test_unplugged_and_plugged_in_again(bench: Bench, driver: "Popen[str]", live: LiveBoard, user: User) -> None:
    status = bench.hear(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
    user.voltage = 6.0
    user.until_on(lambda sample: sample.speed > 50.0, "motion")
    live.faults = replace(live.faults, plugged=False)
    assert rest(live).least < MOST
    bench.wait(lambda: bool(status) and "plug the board in" in status[-1].status[0].message, "the cure")
    refused = bench.call(SetBool, "motor/enable", SetBool.Request(data=True))
    assert not refused.success and "The output stays off. Cannot open serial port" in refused.message
    begin, count = seconds(live), len(user.samples)
    live.faults = replace(live.faults, plugged=True)
    bench.wait(lambda: len(user.samples) > count, "samples")
    assert seconds(live) - begin < 1.0
    assert {sample.voltage for sample in user.more(60)} == {0.0} and live.truth().voltage == 0.0
    bench.wait(lambda: "call motor/enable" in status[-1].status[0].message, "what to do")
    user.switch_on()
    user.until_on(lambda sample: sample.voltage == 6.0, "the output on")
    times = [sample.sample_time for sample in user.samples]
    assert times == sorted(set(times))


def test_damaged_bytes_are_counted_in_the_diagnostics(bench: Bench, driver: "Popen[str]", live: LiveBoard) -> None:
    status = bench.hear(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
    live.faults = replace(live.faults, bit_error_rate=1e-3)

    def value(key: str) -> float:
        values = [pair for pair in (status[-1].status[0].values if status else []) if pair.key == key]
        return float(values[0].value) if values else 0.0

    bench.wait(lambda: value("CRC errors") > 20.0, "CRC errors")
    bench.wait(lambda: value("frames damaged on the way to the board") > 0.0, "the board's count")
    bench.wait(lambda: 100.0 < value("achieved rate [Hz]") < 190.0, "the rate that is left")
    assert value("requested rate [Hz]") == 200.0 and value("lost frames") > 20.0
    for stops in count(1):
        if status[-1].status[0].level == b"\x01":  # a warning and no more
            break
        count_stop(stops, status[-1].status[0].message)
        bench.wait(lambda: bench.call(SetBool, "motor/enable", SetBool.Request(data=True)).success, "the output on")
        seen = len(status)
        bench.wait(lambda: len(status) > seen + 1, "the next diagnostics")  # noqa: B023
