"""Every command of the README is run as it stands there, in its order, in one directory."""

import os
import re
import shutil
import signal
import subprocess
from pathlib import Path

import numpy as np
import pytest
from domains import free_domain
from patience import PATIENCE

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```bash\n(.*?)```", README, re.DOTALL)
COMMANDS = [line.split("  #")[0].strip() for block in BLOCKS for line in block.splitlines() if line.strip()]
SCRIPTS = ("./demo.sh", "./test.sh", "source env.sh")  # the demo has a test of its own; this is the third's environment
NODES = re.compile(
    r"ros2 run (motor_sim motor_sim|motor_control motor_control|motor_identification motor_identification"
    r"|motor_board board_emulator .*|motor_driver motor_driver .*)$"
)
NUMBER = re.compile(r"\d+(?:\.\d+)?")
BOARD = re.compile(r"motor_board|motor_driver|/bench/")  # these need a compiler for the board


def write_log(path: Path) -> None:
    """A motor's log as somebody else would have it: 20 ms samples of a first-order motor under a square wave."""
    time = np.arange(0.0, 10.0, 0.02)
    voltage = np.where((time % 1.0) < 0.5, 5.0, 2.0)
    speed, rows = 0.0, ["t,u,y"]
    for t, u in zip(time, voltage, strict=True):
        rows.append(f"{t:.3f},{u},{np.degrees(speed):.3f}")
        speed += (u / 0.07 - speed) * (1.0 - np.exp(-0.02 / 0.08))
    path.write_text("\n".join(rows) + "\n")


def test_the_readme_has_the_commands_that_are_run_here() -> None:
    assert set(SCRIPTS) <= set(COMMANDS)
    assert sum(bool(NODES.match(command)) for command in COMMANDS) == 5
    assert len(COMMANDS) >= 15


def assert_the_diagnosis(printed: str) -> None:
    """Gaps and evidence that the README shows are those that are printed, but for the last digits."""
    shown = README[README.index("effect              gap") :]
    for row in (r"kv, ka", r"\+ coulomb_friction", r"\+ static_friction", r"noise floor"):
        pattern = re.compile(rf"^{row} +([\d.]+) +([\d.]+)", re.MULTILINE)
        ours, theirs = (pattern.search(text) for text in (shown, printed))
        assert ours is not None and theirs is not None, printed
        assert [float(n) for n in theirs.groups()] == pytest.approx([float(n) for n in ours.groups()], rel=0.03)
    said = [line for line in printed.splitlines() if line.startswith("Evidence for ")]
    for ours, theirs in zip(re.findall(r"^Evidence for .*$", shown, re.MULTILINE), said, strict=True):
        assert NUMBER.sub("#", theirs) == NUMBER.sub("#", ours)
        assert list(map(float, NUMBER.findall(theirs))) == pytest.approx(
            list(map(float, NUMBER.findall(ours))), rel=0.05
        )


# Blocks that need no node of another block run on their own: the board's, and what works on files alone.
PARTS = {
    "board": lambda block: bool(BOARD.search(block)),
    "diagnosis": lambda block: "hidden" in block,
    "files": lambda block: bool(re.search(r"--model |import_log", block)),
    "live": lambda block: True,
}


def part_of(block: str) -> str:
    """The first part to which a block of commands belongs."""
    return next(name for name, belongs in PARTS.items() if belongs(block))


def commands_of(part: str) -> list[str]:
    """Those that are run here."""
    lines = [line.split("  #")[0].strip() for block in BLOCKS if part_of(block) == part for line in block.splitlines()]
    return [line for line in lines if line and line not in SCRIPTS]


def run_all(commands: list[str], directory: Path) -> None:
    """Run them one after the other; nodes run on beside what follows, and end with 0."""
    environment = {**os.environ, "ROS_DOMAIN_ID": str(free_domain()), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    nodes = []
    try:
        for command in commands:
            if NODES.match(command):
                nodes.append(subprocess.Popen(command.split(), cwd=directory, env=environment))
                continue
            done = subprocess.run(
                ["bash", "-c", command], cwd=directory, env=environment, capture_output=True, text=True, timeout=120
            )
            assert done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"
            assert "Traceback" not in done.stderr
            if " diagnose " in command:
                assert_the_diagnosis(done.stdout)
            if "service call" in command:
                assert "success=True" in done.stdout
    finally:
        for node in nodes:
            node.send_signal(signal.SIGINT)
        for node in nodes:
            assert node.wait(PATIENCE) == 0


def column_sums(page: str, row: str) -> list[int]:
    """Of the rows of a page's table that a pattern finds, the sums of the numbers that it groups."""
    text = (ROOT / "benchmarks" / "results" / page).read_text("utf-8")
    return [sum(map(int, column)) for column in zip(*re.findall(row, text, re.MULTILINE), strict=True)]


def test_what_the_readme_says_of_simulated_motors_is_what_the_pages_have() -> None:
    number = r" (\d+) \|"
    right, part, silent, wrong = column_sums("any_motor.md", r"^\| [a-z ]+ \|" + 4 * number + "$")
    counts = {"any_motor.md": (right + part + silent + wrong, right, part + silent, wrong)}
    pages = ("foreign_logs.md", "foreign_loggers.md", "foreign_effects.md", "foreign_periods.md", "run_gains.md")
    for page in pages:
        every, right, part, silent, wrong = column_sums(page, r"^\| all \|" + 5 * number)
        counts[page] = (every, right, part + silent, wrong)
    every, named = column_sums("false_names.md", r"^\| all \|" + 2 * number)
    counts["false_names.md"] = (every, every - named, 0, named)
    for page, (every, right, less, wrong) in counts.items():
        row = next(line for line in README.splitlines() if line.startswith("| ") and page in line)
        assert row.endswith(f" | {right} of {every} | {less} | {wrong} |") and sum((right, less, wrong)) == every


def test_what_the_readme_says_of_logs_that_tell_no_more_is_what_the_pages_have() -> None:
    every = told = 0
    for page in ("foreign_logs.md", "foreign_loggers.md", "foreign_effects.md", "foreign_periods.md"):
        number, right, *_, likelier = column_sums(page, r"^\| all \|" + 7 * r" (\d+) \|")
        every, told = every + number - right, told + likelier
    assert f"of the {every} logs of other people that were not named exactly, in {told} what is hidden" in README
    assert told < every


def test_what_the_readme_says_of_loops_on_their_own_counts_is_what_the_page_has() -> None:
    near, every = column_sums("own_counts.md", r"^\| [^|]+ \| as imported \| (\d+) of (\d+) \|")
    speeds, _ = column_sums("own_counts.md", r"^\| [^|]+ \| as speeds \| (\d+) of (\d+) \|")
    assert f"are within 5 % in {near} of {every} logs; taken as speeds, in {speeds}." in README and speeds < near


def test_every_command_belongs_to_a_part() -> None:
    parts = {name: commands_of(name) for name in PARTS}
    assert sorted(sum(parts.values(), [])) == sorted(set(COMMANDS) - set(SCRIPTS)) and min(map(len, parts.values())) > 2


@pytest.mark.slow
@pytest.mark.long
def test_the_commands_with_a_running_motor_work_as_written(tmp_path: Path) -> None:
    run_all(commands_of("live"), tmp_path)
    assert (tmp_path / "model.yaml").exists() and (tmp_path / "gains.yaml").exists()


@pytest.mark.slow
@pytest.mark.long
def test_the_commands_that_work_on_files_work_as_written(tmp_path: Path) -> None:
    write_log(tmp_path / "log.csv")
    run_all(commands_of("files"), tmp_path)
    assert (tmp_path / "report" / "fit.png").stat().st_size > 20_000
    assert 50_000 < (tmp_path / "report" / "report.html").stat().st_size < 3_000_000


@pytest.mark.long
@pytest.mark.slow
def test_the_diagnosis_works_as_written(tmp_path: Path) -> None:
    run_all(commands_of("diagnosis"), tmp_path)
    assert 100_000 < (tmp_path / "diagnosis" / "report.html").stat().st_size < 3_000_000


@pytest.mark.skipif(not shutil.which("avr-gcc"), reason="no compiler for the board here")
def test_the_commands_with_an_emulated_board_work_as_written(tmp_path: Path) -> None:
    run_all(commands_of("board"), tmp_path)


def test_the_environment_says_what_to_do_where_nothing_is_built(tmp_path: Path) -> None:
    (tmp_path / "env.sh").write_text((ROOT / "env.sh").read_text(encoding="utf-8"), encoding="utf-8")
    done = subprocess.run(["bash", "-c", "source ./env.sh"], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 1
    assert re.fullmatch(
        r"The workbench is not built here yet: run \S+/setup\.sh, then source env\.sh again\.\n", done.stderr
    )
