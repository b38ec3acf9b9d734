"""The launch files in the genuine launch system, where that is installed: they load, start, pass data, and end."""

import ast
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import yaml
from bringup_tables import SESSIONS
from domains import free_domain
from patience import PATIENCE

from motor_identification.bag import messages, read_recording

LAUNCH = Path(__file__).resolve().parents[2] / "motor_bringup" / "launch"
BAGS = Path(__file__).resolve().parents[2] / "bags"
RUN = """
import sys
from launch import LaunchDescription, LaunchService
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
told = [tuple(word.split(":=", 1)) for word in sys.argv[2:]]
service = LaunchService(noninteractive=True)
source = PythonLaunchDescriptionSource(sys.argv[1])
service.include_launch_description(LaunchDescription([IncludeLaunchDescription(source, launch_arguments=told)]))
sys.exit(service.run())
"""


def test_each_file_passes_on_its_own_table() -> None:
    """Without the launch system: the file's syntax, and which session it names."""
    assert {path.name for path in LAUNCH.iterdir() if path.is_file()} == {f"{name}.launch.py" for name in SESSIONS}
    for name in SESSIONS:
        tree = ast.parse((LAUNCH / f"{name}.launch.py").read_text(encoding="utf-8"))
        imported = {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
        functions = [node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]
        assert imported == {"launch", "motor_bringup.actions", f"motor_bringup.{name}"}
        assert functions == ["generate_launch_description"]


def started(name: str, folder: Path, *told: str) -> "subprocess.Popen[str]":
    pytest.importorskip("launch_ros", reason="ROS 2's launch system is not installed here (it is not on PyPI)")
    environment = {**os.environ, "ROS_DOMAIN_ID": str(free_domain()), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    environment["ROS_LOG_DIR"] = str(folder / "log")
    return subprocess.Popen(
        [sys.executable, "-c", RUN, str(LAUNCH / f"{name}.launch.py"), *told],
        cwd=folder,
        env=environment,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )


def test_from_a_motor_to_its_model(tmp_path: Path) -> None:
    model = f"model:={BAGS / 'closed_loop.yaml'}"
    process = started("identify", tmp_path, model, "profile:=step", "bag:=bag", "namespace:=left")
    out, _ = process.communicate(timeout=120.0)
    assert process.returncode == 0 and "Traceback" not in out, out
    assert read_recording(tmp_path / "bag", "left").info.name == "left"
    assert set(yaml.safe_load((tmp_path / "model.yaml").read_text(encoding="utf-8"))["parameters"]) == {"kv", "ka"}


def test_a_step_that_fails_ends_all_and_says_so(tmp_path: Path) -> None:
    (tmp_path / "bag").mkdir()
    process = started("identify", tmp_path, "bag:=bag", "profile:=step")
    out, _ = process.communicate(timeout=120.0)
    assert process.returncode == 1 and "experiment ended with exit status 1" in out
    assert not (tmp_path / "model.yaml").exists()


def test_ctrl_c_ends_everything_and_the_bag_is_whole(tmp_path: Path) -> None:
    process = started("motor", tmp_path, "record:=bag")
    assert process.stdout is not None
    while "Simulating" not in process.stdout.readline():
        assert process.poll() is None
    samples = 0
    while samples < 200:
        assert process.poll() is None
        time.sleep(0.1)
        written = messages(tmp_path / "bag", {"/motor/speed"}) if list(tmp_path.glob("bag/*.mcap")) else ()
        samples = sum(1 for _ in written)
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=PATIENCE)
    assert process.returncode == 0 and out.count("process has finished cleanly") == 3, out
    assert sum(1 for _ in messages(tmp_path / "bag", {"/motor/speed"})) >= samples
    assert (tmp_path / "bag" / "metadata.yaml").is_file()


def test_a_word_that_is_no_choice_ends_it(tmp_path: Path) -> None:
    process = started("motor", tmp_path, "plant:=toaster")
    out, _ = process.communicate(timeout=120.0)
    assert process.returncode == 1 and "toaster" in out and "emulated" in out


def test_whatever_a_launch_starts_ends_with_it() -> None:
    """Without the launch system: each action that starts a process names the launch to it."""
    source = (LAUNCH.parent / "motor_bringup" / "actions.py").read_text(encoding="utf-8")
    calls = [node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Call)]
    starting = [
        call for call in calls if isinstance(call.func, ast.Name) and call.func.id in ("ExecuteProcess", "Node")
    ]
    told = [{word.arg: ast.unparse(word.value) for word in call.keywords} for call in starting]
    assert len(told) == 2 and all(words["additional_env"] == "ends_with" for words in told)
    assert "ends_with = {STARTER: str(os.getpid())}" in source


@pytest.mark.parametrize("kind", [signal.SIGKILL, signal.SIGTERM, signal.SIGHUP])
def test_the_end_of_a_launch_alone_ends_its_nodes(tmp_path: Path, kind: int) -> None:
    process = started("motor", tmp_path, "plant:=sim")
    assert process.stdout is not None
    heard = ""
    begun = time.monotonic()
    while "motor_control" not in heard and time.monotonic() < begun + PATIENCE:
        heard += process.stdout.readline()
    children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text(encoding="ascii").split()
    assert len(children) == 2
    os.kill(process.pid, kind)
    process.wait(PATIENCE)
    while any(Path(f"/proc/{child}").exists() for child in children):
        assert time.monotonic() < begun + 2.0 * PATIENCE
        time.sleep(0.05)


@pytest.mark.parametrize("name", sorted(SESSIONS))
def test_a_misspelt_argument_is_refused_before_anything_starts(tmp_path: Path, name: str) -> None:
    process = started(name, tmp_path, "namespce:=left")
    out, _ = process.communicate(timeout=60.0)
    assert (
        process.returncode == 1 and "namespce:= is no argument of this launch file" in out and "started with" not in out
    )


PARENT = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import PushROSNamespace


def generate_launch_description():
    source = PythonLaunchDescriptionSource({file!r})
    theirs = [DeclareLaunchArgument(name, default_value="x") for name in ("ports", "robot_model", "max_voltage")]
    told = {{"port": LaunchConfiguration("ports"), "plant": "sim", **{told!r}}}
    return LaunchDescription(
        [*theirs, PushROSNamespace("robot"), IncludeLaunchDescription(source, launch_arguments=told.items())]
    )
"""


@pytest.mark.parametrize(("told", "refused"), [({}, False), ({"parameter": "mine.yaml"}, True)])
def test_a_launch_file_that_includes_one_has_arguments_of_its_own(
    tmp_path: Path, told: dict[str, str], refused: bool
) -> None:
    """They are in the same context; only what is nearly an argument of ours is refused."""
    file = str(LAUNCH / "motor.launch.py")
    (tmp_path / "robot.launch.py").write_text(PARENT.format(file=file, told=told), encoding="utf-8")
    process = started(str(tmp_path / "robot"), tmp_path, "max_voltage:=9", "ports:=mine")
    assert process.stdout is not None
    lines: list[str] = []
    while process.poll() is None and "Simulating" not in "".join(lines[-1:]):
        lines.append(process.stdout.readline())
    process.send_signal(signal.SIGINT)
    rest, _ = process.communicate(timeout=PATIENCE)
    out = "".join(lines) + rest
    assert ("parameter:= is no argument of the launch file that is included" in out) == refused, out
    assert ("Simulating" in out) != refused and ("started with" in out) != refused
