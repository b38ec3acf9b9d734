"""`ros2 run` and `ros2 pkg`, with packages of the tests' own."""

import os
import signal
import subprocess
import time
from pathlib import Path

import pytest
from patience import PATIENCE

SHOW = '#!/bin/sh\necho "$$ $ROS_AUTOMATIC_DISCOVERY_RANGE"\nfor word in "$@"; do echo "<$word>"; done\nexit 7\n'
WAIT = "#!/bin/sh\ntrap 'echo caught; exit 3' INT\necho waiting\nwhile :; do sleep 0.01; done\n"


def make_executable(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(0o755)


def make_package(prefix: Path, name: str, **programs: str) -> None:
    marker = prefix / "share/ament_index/resource_index/packages" / name
    marker.parent.mkdir(parents=True, exist_ok=True)
    marker.touch()
    for program, text in programs.items():
        make_executable(prefix / "lib" / name / program, text)


@pytest.fixture
def prefixed(ros2, tmp_path):
    """`ros2` with two prefixes: the first has toy_tools, the second one that it hides, and toy_data."""
    make_package(tmp_path / "first", "toy_tools", show=SHOW, wait=WAIT)
    make_package(tmp_path / "second", "toy_tools", old="#!/bin/sh\n")
    make_package(tmp_path / "second", "toy_data")
    (tmp_path / "first/lib/toy_tools/readme.txt").write_text("not a program")
    make_executable(tmp_path / "first/lib/toy_tools/.cache/hidden", "#!/bin/sh\n")
    ros2.env["AMENT_PREFIX_PATH"] = f"{tmp_path / 'first'}{os.pathsep}{tmp_path / 'second'}"
    return ros2


def test_arguments_and_status_pass_through(prefixed):
    words = ("--ros-args", "-p", "kp:=0.5", "--help", "two words", "-r", "__ns:=/b")
    out = prefixed("run", "toy_tools", "show", *words, status=7).out
    assert out.splitlines()[1:] == [f"<{word}>" for word in words]


def test_it_stays_on_this_machine_unless_told(prefixed):
    prefixed.env.pop("ROS_AUTOMATIC_DISCOVERY_RANGE")
    assert prefixed("run", "toy_tools", "show", status=7).out.split()[1] == "LOCALHOST"
    assert (
        prefixed("run", "toy_tools", "show", status=7, ROS_AUTOMATIC_DISCOVERY_RANGE="SUBNET").out.split()[1]
        == "SUBNET"
    )


@pytest.mark.on_time
def test_the_process_becomes_the_executable_and_gets_the_signals(prefixed):
    process = prefixed.start("run", "toy_tools", "wait")
    process.wait_for("waiting")
    assert Path(f"/proc/{process.pid}/cmdline").read_bytes().split(b"\0")[1].endswith(b"/lib/toy_tools/wait")
    output, took = process.end(signal.SIGINT)
    assert (output.status, output.out, output.err) == (3, "waiting\ncaught\n", "")
    assert took < 1.0


@pytest.mark.on_time
def test_an_interrupt_while_a_program_of_the_workbench_starts_is_silent(ros2):
    process = ros2.start("run", "motor_sim", "motor_sim")
    cmdline, end = Path(f"/proc/{process.pid}/cmdline"), time.monotonic() + PATIENCE
    while b"lib/motor_sim/motor_sim" not in cmdline.read_bytes() and time.monotonic() < end:
        time.sleep(0.001)
    output, _ = process.end(signal.SIGINT)
    assert (output.status, output.out, output.err) == (-signal.SIGINT, "", "")


def test_an_interrupt_before_python_can_hear_one_is_silent(ros2, tmp_path):
    """While Python itself starts; it showed where in its own start it was."""
    (tmp_path / "sitecustomize.py").write_text("import os, signal\nos.kill(os.getpid(), signal.SIGINT)\n")
    launcher = Path(__file__).resolve().parents[2] / "ros2_stand_in/ros2"
    command = [str(launcher), "run", "motor_sim", "motor_sim"]
    environment = {**os.environ, "PYTHONPATH": f"{tmp_path}:{os.environ.get('PYTHONPATH', '')}"}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=PATIENCE)
    assert (done.returncode, done.stdout, done.stderr) == (-signal.SIGINT, "", "")


def test_prefix_goes_before_the_executable(prefixed):
    out = prefixed("run", "--prefix", "env TOY=1 sh -c 'echo $TOY $0'", "toy_tools", "show").out
    assert out.split()[0] == "1"
    assert out.split()[1].endswith("/lib/toy_tools/show")


def test_unknown_names_are_a_sentence(prefixed):
    assert (
        prefixed("run", "tool_data", "show", status=1).err == "Package 'tool_data' not found; did you mean toy_data?\n"
    )
    assert prefixed("run", "xyz", "show", status=1).err == "Package 'xyz' not found.\n"
    assert prefixed("run", "toy_tools", "old", status=1).err == (
        "Package 'toy_tools' has no executable 'old'; it has: show, wait.\n"
    )
    assert (
        prefixed("run", "toy_data", "show", status=1).err
        == "Package 'toy_data' has no executable 'show'; it has none.\n"
    )
    make_executable(Path(prefixed.env["AMENT_PREFIX_PATH"].split(os.pathsep)[0]) / "lib/toy_tools/torn", "#!/no/such\n")
    assert prefixed("run", "toy_tools", "torn", status=1).err.endswith(
        "/torn cannot be started: No such file or directory.\n"
    )


def test_packages_and_executables_are_listed(prefixed):
    assert prefixed("pkg", "list").out == "toy_data\ntoy_tools\n"
    assert prefixed("pkg", "executables").out == "toy_tools show\ntoy_tools wait\n"
    assert prefixed("pkg", "executables", "toy_data").out == ""
    first = prefixed.env["AMENT_PREFIX_PATH"].split(os.pathsep)[0]
    assert prefixed("pkg", "executables", "--full-path", "toy_tools").out == (
        f"{first}/lib/toy_tools/show\n{first}/lib/toy_tools/wait\n"
    )
    assert prefixed("pkg", "executables", "nope", status=1).err == "Package 'nope' not found.\n"


def test_the_workspaces_own_executables_are_found(ros2):
    assert ros2("pkg", "executables", "motor_sim").out == "motor_sim motor_sim\n"
