"""What TAB completes behind `ros2 run`, and that every executable answers the questions that come before a start."""

import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest
import workbench
from tiers import keep_fast

ROOT = Path(__file__).resolve().parents[2]
EXECUTABLES = {  # by package and name, the module and the function that it calls
    (path.parent.name, name): (module, function)
    for path in sorted(ROOT.glob("motor_*/setup.py"))
    for name, module, function in re.findall(r'"(\w+) = ([\w.]+):(\w+)"', path.read_text(encoding="utf-8"))
}
ASK = """
source "$ROOT/motor_ros/motor_ros/completion.bash"
COMP_LINE=$1
read -ra COMP_WORDS <<<"$COMP_LINE"
[[ "$COMP_LINE" != *" " ]] || COMP_WORDS+=("")
COMP_CWORD=$((${#COMP_WORDS[@]} - 1)) COMP_POINT=${#COMP_LINE} COMP_TYPE=9
_motor_ros2
printf '%s\\n' "${COMPREPLY[@]}"
"""


def complete(line: str) -> list[str]:
    environment = workbench.ENVIRONMENT | {"ROOT": str(ROOT), "MOTOR_COMPLETION_PATIENCE": "100"}
    command = ["bash", "--norc", "-c", ASK, "ask", line]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=120.0)
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


def test_there_are_executables() -> None:
    assert len(EXECUTABLES) >= 14
    assert {("motor_sim", "motor_sim"), ("motor_control", "tune"), ("motor_board", "flash")} <= EXECUTABLES.keys()


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("ros2 run motor_iden", ["motor_identification"]),
        ("ros2 run motor_sim ", ["motor_sim"]),
        ("ros2 run motor_identification experiment st", ["step", "staircase"]),
        ("ros2 run motor_identification identify bag --effects cou", ["coulomb_friction"]),
        (
            "ros2 run motor_identification identify bag --effects coulomb_friction,d",
            ["coulomb_friction,dead_zone", "coulomb_friction,direction_asymmetry"],
        ),
        ("ros2 run motor_identification diagnose bag --known-effects warm", ["warm_up"]),
        ("ros2 run motor_identification identify --e", ["--effects", "--epochs"]),
        ("ros2 run motor_identification import_csv log.csv --unit r", ["rad", "rad/s", "rev", "rev/s", "rpm"]),
        ("ros2 run motor_control tune --speed-source o", ["observer"]),
        ("ros2 run motor_sim motor_sim --ros-args -p mo", ["model:="]),
        ("ros2 run nothing nobody --", []),
    ],
)
def test_tab_knows_what_can_come_next(line: str, expected: list[str]) -> None:
    assert complete(line) == expected


MOVING = [
    (package, name) for package, name in EXECUTABLES if package == name or name in ("check", "experiment", "play")
]


@pytest.mark.parametrize(("package", "name"), keep_fast(EXECUTABLES, *MOVING))
def test_every_executable_is_completed_before_it_starts(package: str, name: str) -> None:
    """A TAB must never start a program, which might move a motor."""
    assert complete(f"ros2 run {package} {name} --ver") == ["--version"]


@pytest.mark.parametrize(("package", "name"), EXECUTABLES)
def test_every_executable_answers_before_it_starts(
    package: str, name: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nor must a look at its help."""
    declared = re.search(r"<version>(.*)</version>", (ROOT / package / "package.xml").read_text(encoding="utf-8"))
    assert declared is not None
    starts = {"--version": f"{name} {declared[1]}\n", "--help": f"usage: ros2 run {package} {name} ["}
    module, function = EXECUTABLES[package, name]
    for word, start in starts.items():
        monkeypatch.setattr(sys, "argv", [name, word])
        with pytest.raises(SystemExit) as ended:
            getattr(import_module(module), function)()
        out, err = capsys.readouterr()
        assert (ended.value.code, err) == (0, "") and out.startswith(start)
    assert f"\n  ros2 run {package} {name} " in out  # an example, to be typed as it stands


def test_the_versions_of_the_packages_agree() -> None:
    files = [path for kind in ("setup.py", "package.xml") for path in ROOT.glob(f"motor_*/{kind}")]
    found = [
        re.findall(r"(?:<version>|^ +version=\")([\d.]+)", path.read_text(encoding="utf-8"), re.MULTILINE)
        for path in files
    ]
    assert len(files) > 15 and {version for versions in found for version in versions} == {"0.1.0"}
