"""Nodes on the command line: `--help` and `--version` are answered without starting, other words are one sentence."""

import re
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import pytest
import workbench
from workbench import Bench

import motor_board.node
import motor_control.node
import motor_driver.node
import motor_examples.diff_drive.node
import motor_identification.service.node
import motor_sim.node
from motor_board.parameters import PROGRAM as EMULATOR
from motor_control.parameters import PROGRAM as CONTROL
from motor_driver.parameters import PROGRAM as DRIVER
from motor_examples.diff_drive.parameters import PROGRAM as DIFF_DRIVE
from motor_identification.service.parameters import PROGRAM as IDENTIFICATION
from motor_msgs.msg import MotorSpeed
from motor_ros import qos
from motor_ros.program import Program, refuse_namespace
from motor_sim.parameters import PROGRAM as SIM

ROOT = Path(__file__).resolve().parents[2]
NODES = {  # what the executable of each calls
    SIM: motor_sim.node.main,
    DRIVER: motor_driver.node.main,
    CONTROL: motor_control.node.main,
    IDENTIFICATION: motor_identification.service.node.main,
    EMULATOR: motor_board.node.main,
    DIFF_DRIVE: motor_examples.diff_drive.node.main,
}
Start = Callable[..., "subprocess.Popen[str]"]


def run(program: Program, *words: str) -> "subprocess.CompletedProcess[str]":
    command = [workbench.program(program.package, program.name), *words]
    return subprocess.run(command, env=workbench.ENVIRONMENT, capture_output=True, text=True, timeout=120.0)


@pytest.mark.parametrize("program", NODES, ids=lambda program: program.name)
def test_help_says_what_it_is_and_every_parameter_with_its_default(
    program: Program, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        NODES[program](["--help"])
    printed, errors = capsys.readouterr()
    assert (ended.value.code, errors) == (0, "")
    assert printed.startswith(f"usage: ros2 run {program.package} {program.name} [--help]")
    assert program.about in printed and f"example:\n  ros2 run {program.package} {program.name} " in printed
    lines = {line.split()[0]: line for line in printed.splitlines() if line.startswith("  ")}
    for row in program.rows:
        line = lines[row.name]
        default = str(row.default).lower() if isinstance(row.default, bool) else repr(row.default)
        assert re.match(rf"  {row.name} +{re.escape(default)} +", line), line
        assert row.description in line and (not row.unit or f"[{row.unit}]" in line)
        assert row.read_only == ("fixed at the start" in line or "parameters, fixed at the start," in printed)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--nope",), "unrecognized arguments: --nope"),
        (("model.yaml",), "unrecognized arguments: model.yaml"),
        (("-p", "model:=model.yaml"), "unrecognized arguments: -p model:=model.yaml"),
        (("--ros-args", "-p", "model=model.yaml"), "Couldn't parse parameter override rule: '-p model=model.yaml'"),
        (("--ros-args", "--params-file", "none.yaml"), "Couldn't parse params file: '--params-file none.yaml'"),
        (("--ros-args", "--nope"), "unknown ROS arguments: '--nope'"),
    ],
)
def test_what_is_no_argument_of_ros_is_one_sentence(start: Start, words: tuple[str, ...], said: str) -> None:
    process = start(SIM.package, SIM.name, *words)
    out, err = process.communicate(timeout=workbench.PATIENCE)
    assert (process.returncode, out) == (2, "")
    said_last = err.splitlines()[-1]
    assert said_last.startswith(f"motor_sim: {said}. Parameters stand behind --ros-args, such as --ros-args -p model:=")


def test_a_parameter_that_does_not_exist_is_named(start: Start) -> None:
    process = start("motor_sim", "motor_sim", "--ros-args", "-p", "modle:=hidden.yaml")
    assert process.stderr is not None
    lines: list[str] = []
    end = time.monotonic() + workbench.PATIENCE
    while not any("modle" in line for line in lines):
        assert time.monotonic() < end and (lines.append(process.stderr.readline()) or lines[-1]), lines
    said = next(line for line in lines if "modle" in line)
    assert "there is no parameter modle here, and it has no effect: did you mean model?" in said and "WARN" in said


@pytest.mark.parametrize("program", [SIM, CONTROL, IDENTIFICATION], ids=lambda program: program.name)
def test_help_names_the_topics_and_services_that_the_node_has(program: Program, bench: Bench, start: Start) -> None:
    start(program.package, program.name)
    node = bench.node
    bench.wait(lambda: program.name in node.get_node_names(), "the node")
    others = []  # a plant listens to its own topic while another publishes there
    if set(program.publishes) & set(program.subscribes):
        others.append(node.create_publisher(MotorSpeed, "motor/speed", qos.SPEED))

    def names(found: list[tuple[str, list[str]]]) -> set[str]:
        ours = {name for name, _ in found if name.startswith("/motor/") or name in ("/joint_states", "/diagnostics")}
        return {name for name in ours if "/_action" not in name}

    def absolute(relative: tuple[str, ...]) -> set[str]:
        return {"/" + name.lstrip("/") for name in relative} - {"/motor/diagnose"}  # an action is made of others

    def agrees() -> bool:
        found = [
            names(node.get_publisher_names_and_types_by_node(program.name, "/")),
            names(node.get_subscriber_names_and_types_by_node(program.name, "/")),
            names(node.get_service_names_and_types_by_node(program.name, "/")),
        ]
        return found == [absolute(part) for part in (program.publishes, program.subscribes, program.services)]

    bench.wait(agrees, "the topics and services that --help names, and no others")
    for other in others:
        node.destroy_publisher(other)


@pytest.mark.parametrize("namespace", ["/", "/left", "/robot_1/left", "/_x"])
def test_namespaces_that_are_some_are_let_be(namespace: str) -> None:
    assert refuse_namespace(["--ros-args", "-r", f"__ns:={namespace}", "-p", "model:=__ns:=/x/"]) == ""
