"""What `./test.sh` leaves out: the mark `slow` alone, of no rule the only test, and of nothing that stops a motor."""

import ast
import subprocess
from functools import cache
from pathlib import Path

import pytest
from tiers import keep_fast

ROOT = Path(__file__).resolve().parents[1]
MARK = "pytest.mark.slow"
# What stops a motor, refuses a command or keeps ROS on this machine: further cases of a table may be slow, no test is.
SAFETY = (
    *("tests/driver", "tests/control/controller/faults", "tests/ros/clocks", "tests/ros/graph"),
    *("tests/board/test_core_guard.py", "tests/board/test_firmware.py", "tests/board/test_firmware_current.py"),
    *("tests/control/controller/timing", "tests/control/controller/test_lost_line.py"),
    *("tests/ros/test_gate.py", "tests/ros/test_killed.py", "tests/ros/test_loopback.py", "tests/ros/test_sender.py"),
    *("tests/ros/test_motor_control_stops.py", "tests/ros/test_reference_senders.py", "tests/ros/test_signals.py"),
    *("tests/system/test_faults.py", "tests/system/test_stranger.py"),
)
STUB = '#!/usr/bin/env bash\n[[ "$*" != *pytest* ]] || printf "%s\\n" "$*" >> "$(dirname "$0")/../../asked"\n'


@cache
def list_slow() -> dict[str, dict[str, bool]]:
    """Of every test file with the mark its functions, and whether each is slow altogether."""
    texts = {path: path.read_text(encoding="utf-8") for path in sorted((ROOT / "tests").rglob("test_*.py"))}
    return {
        path.relative_to(ROOT).as_posix(): {
            node.name: MARK in map(ast.unparse, node.decorator_list)
            for node in ast.walk(ast.parse(text))
            if isinstance(node, ast.FunctionDef) and node.name.startswith("test_")
        }
        for path, text in texts.items()
        if f"@{MARK}\n" in text and path != Path(__file__)
    }


def test_a_slow_test_has_fast_ones_beside_it() -> None:
    found = list_slow()
    assert len(found) > 20 and all(any(names.values()) for names in found.values())
    assert [path for path, names in found.items() if all(names.values())] == []


def test_no_test_of_safety_is_slow() -> None:
    assert all((ROOT / name).exists() for name in SAFETY)
    assert [path for path in list_slow() if path.startswith(SAFETY)] == []


def asked_for(tmp_path: Path, *arguments: str) -> list[str]:
    """What `test.sh` asks of pytest, in a tree where nothing runs."""
    (tmp_path / ".venv" / "bin").mkdir(parents=True)
    (tmp_path / "tests").mkdir()
    (tmp_path / "tests" / "test_one.py").write_text("@pytest.mark." + "on_time\n")
    for name, text in {"setup.sh": "#!/bin/sh\n", "env.sh": "", ".venv/bin/python": STUB}.items():
        (tmp_path / name).write_text(text)
        (tmp_path / name).chmod(0o755)
    (tmp_path / "test.sh").write_text((ROOT / "test.sh").read_text(encoding="utf-8"))
    subprocess.run(["bash", str(tmp_path / "test.sh"), *arguments], check=True, timeout=60.0)
    return (tmp_path / "asked").read_text().splitlines()


@pytest.mark.parametrize(
    ("arguments", "tiers"),
    [([], ["not on_time and not slow", "on_time and not slow"]), (["--all"], ["not on_time", "on_time"])],
)
def test_slow_tests_alone_are_left_out_unless_all_are_asked_for(
    tmp_path: Path, arguments: list[str], tiers: list[str]
) -> None:
    first, second = asked_for(tmp_path, *arguments)
    assert first.endswith(f" -m {tiers[0]}") and second.endswith(f" -m {tiers[1]} tests/test_one.py")


@pytest.mark.parametrize("arguments", [["-k", "swarm"], ["--all", "-k", "swarm"]])
def test_arguments_go_to_pytest_which_leaves_out_nothing(tmp_path: Path, arguments: list[str]) -> None:
    assert asked_for(tmp_path, *arguments) == ["-m pytest -k swarm"]


def test_a_table_keeps_a_fast_case() -> None:
    first, second = keep_fast([(1, 2), (3, 4)], (3, 4))
    assert (first.values, [mark.name for mark in first.marks], second) == ((1, 2), ["slow"], (3, 4))
    for fast in ((), (5,)):
        with pytest.raises(ValueError, match="are to stay fast: name one or more of"):
            keep_fast([1, 2], *fast)
