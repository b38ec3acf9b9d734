"""`board_emulator` as a program: its port, its faults as parameters, its buttons as services."""

import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import workbench
from diagnostic_msgs.msg import DiagnosticArray
from emulated_board import Client, need_emulator
from std_srvs.srv import Trigger

from motor_driver.frames.codes import ResetCause
from motor_driver.frames.from_board import Hello, Telemetry
from motor_driver.frames.from_host import Identify
from motor_ros import qos


def start(*arguments: object) -> "subprocess.Popen[str]":
    return workbench.start("motor_board", "board_emulator", "--ros-args", *arguments)


@pytest.fixture
def process(tmp_path: Path) -> Iterator["subprocess.Popen[str]"]:
    need_emulator()
    running = start("-p", f"link:={tmp_path}/port", "-p", "supply_voltage:=12.0", "-p", "delay:=0.002")
    yield running
    running.kill()
    running.wait()


@pytest.fixture
def bench() -> Iterator[workbench.Bench]:
    bench = workbench.Bench()
    yield bench
    bench.close()


def test_port_faults_and_buttons(process: Any, bench: workbench.Bench, tmp_path: Path) -> None:
    port = tmp_path / "port"
    truths = bench.hear(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
    bench.wait(port.exists, "the port")
    client = Client(port)
    hello = client.ask(Identify(), Hello)
    assert hello.edges_per_revolution == 96 and hello.channels == 1
    assert 11_900 < client.wait_for(Telemetry, 10).supply < 12_100
    assert bench.call(Trigger, "board_emulator/reset", Trigger.Request()).success
    client.wait(lambda: client.all(Hello)[-1].reset_cause == ResetCause.EXTERNAL)
    assert bench.call(Trigger, "board_emulator/hang", Trigger.Request()).success
    client.wait(lambda: client.all(Hello)[-1].reset_cause == ResetCause.WATCHDOG)
    bench.wait(lambda: any(pair.value == "2" for pair in truths[-1].status[0].values) if truths else False, "the truth")
    values = {pair.key: pair.value for pair in truths[-1].status[0].values}
    assert values["resets"] == "2" and float(values["clock rate"]) == 1.0 and float(values["true angle [rad]"]) == 0.0
    assert bench.set("board_emulator", "clock_error", 150.0)[0]
    assert not bench.set("board_emulator", "bit_error_rate", 0.7)[0]
    client.close()
    out, err = workbench.end(process)
    assert f"The board's serial port is {port}" in out + err and process.returncode == 0
    assert not port.is_symlink()


def test_what_is_wrong_is_one_sentence(tmp_path: Path) -> None:
    need_emulator()
    cases = {
        f"link:={tmp_path}/no/port": "set the parameter link to another path.",
        "bridge:=h": "there is no bridge 'h': choose one of l298n, tb6612, drv8871.",
    }
    started = {start("-p", f"link:={tmp_path}/port", "-p", argument): said for argument, said in cases.items()}
    for process, said in started.items():
        _, err = process.communicate(timeout=workbench.PATIENCE)
        assert process.returncode == 1 and err.strip().endswith(said) and "Traceback" not in err, err
