"""`check` as a person runs it, on the emulated board in real time: its sentences, its exit status, its file."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import workbench
import yaml
from board_fixtures import live  # noqa: F401
from forked import Forked
from patience import PATIENCE

from motor_board.emulation.live import LiveBoard
from motor_driver.cli import check
from motor_driver.link import open_port

RUN = "from motor_driver.cli.check import main; import sys; sys.exit(main(sys.argv[1:]))"
TIMES = 5  # a machine that has no time for us is a stop, and a person would check again


def start(*arguments: object) -> "subprocess.Popen[str]":
    words, pipe = [workbench.program("motor_driver", "check"), *map(str, arguments)], subprocess.PIPE
    return Forked(words, env=workbench.ENVIRONMENT, stdin=pipe, stdout=pipe, stderr=pipe, text=True)


def interrupted(board: LiveBoard, port: Path) -> "tuple[int, str]":
    """Ctrl-C while the motor has voltage: exit status and words."""
    running = start("--port", port, "--no-hand")
    while board.truth().voltage == 0.0 and running.poll() is None:
        time.sleep(0.01)
    running.send_signal(signal.SIGINT)
    said, _ = running.communicate(timeout=PATIENCE)
    return running.returncode, said


@pytest.mark.long
@pytest.mark.on_time
def test_a_first_run_stops_at_ctrl_c_and_else_writes_the_parameters(live: LiveBoard, tmp_path: Path) -> None:  # noqa: F811
    """Beside six other processes the emulated chip is silent for 120 ms in three of four first runs: they stop."""
    port, output, found = tmp_path / "port", tmp_path / "motor.yaml", tmp_path / "found.json"
    for _ in range(TIMES):
        status, said = interrupted(live, port)
        if status == 130:
            break
    assert status == 130 and live.truth().voltage == 0.0
    assert "at 6 V at most" in said and "The check has stopped the motor: Ctrl-C." in said
    for _ in range(TIMES):
        running = start("--port", port, "--output", output, "--json", found, "--force")
        said, wrong = running.communicate(timeout=PATIENCE)
        if "stopped the motor" not in said:
            break
    assert running.returncode == 0, said + wrong
    assert live.truth().voltage == 0.0 and f"--params-file {output}" in said
    values = yaml.safe_load(output.read_text(encoding="utf-8"))["/**/motor_driver"]["ros__parameters"]
    assert values["port"] == str(port) and values["edges_per_revolution"] == 96
    measured = json.loads(found.read_text(encoding="utf-8"))["measured"]
    assert 160.0 < measured["top_speed"] < 190.0


def driven(board: LiveBoard) -> "subprocess.Popen[str]":
    """A check whose motor has voltage just now."""
    for _ in range(TIMES):
        running = start("--port", board_port(board), "--no-hand")
        while board.truth().voltage == 0.0 and running.poll() is None:
            time.sleep(0.005)
        if running.poll() is None:
            return running
    raise AssertionError("no check came to give the motor voltage")


def board_port(board: LiveBoard) -> Path:
    return board._port._link


def switched_off(board: LiveBoard) -> float:
    """[s] until the pins are at 0 V."""
    begun = time.monotonic()
    while board.truth().voltage and time.monotonic() < begun + 5.0:
        time.sleep(0.002)
    return time.monotonic() - begun


@pytest.mark.long
@pytest.mark.on_time
def test_however_a_check_ends_the_motor_gets_0_v_and_the_reason_is_said(live: LiveBoard) -> None:  # noqa: F811
    """Who no longer reads what it says is noticed at once, not at the next row, seconds of motion later."""
    unread = driven(live)
    assert unread.stdout is not None and unread.stderr is not None
    unread.stdout.close()
    assert switched_off(live) < 0.3
    assert unread.wait(PATIENCE) == 1
    assert unread.stderr.read() == "The check has stopped the motor: nobody reads what the check says any more.\n"
    unread.stderr.close()
    for number, status, words in (
        (signal.SIGTERM, 130, "stopped the motor: it was told to end."),
        (signal.SIGHUP, 130, "stopped the motor: the terminal was closed."),
        (signal.SIGKILL, -signal.SIGKILL, ""),  # the board's own time-out
    ):
        running = driven(live)
        running.send_signal(number)
        assert switched_off(live) < 0.3, number
        said, wrong = running.communicate(timeout=PATIENCE)
        assert running.returncode == status and words in said and "Traceback" not in wrong
    time.sleep(0.2)
    assert live.truth().voltage == 0.0


def test_half_a_line_is_no_answer_and_holds_nothing_up(live: LiveBoard) -> None:  # noqa: F811
    """A letter and Ctrl-D hand on what was typed without its end; to wait for that was to wait through Ctrl-C too."""
    terminal, ours = os.openpty()
    words = [sys.executable, "-c", RUN, "--port", str(board_port(live))]
    running = subprocess.Popen(words, env=workbench.ENVIRONMENT, stdin=ours, stdout=subprocess.PIPE, text=True)
    os.close(ours)
    assert running.stdout is not None
    said = next(line for line in running.stdout if line.startswith("Turn the shaft"))
    os.write(terminal, b"n\x04")
    time.sleep(0.2)
    running.send_signal(signal.SIGINT)
    said, _ = running.communicate(timeout=PATIENCE)
    os.close(terminal)
    assert running.returncode == 130 and "Ctrl-C" in said and "motion" not in said


def test_what_cannot_be_checked_is_one_sentence(
    live: LiveBoard,  # noqa: F811
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    port, found = str(tmp_path / "port"), tmp_path / "found.json"
    assert check.main(["--port", port, "--board-id", "9", "--json", str(found)]) == 1
    assert capsys.readouterr().err.startswith("This is the board without a number, and the parameter board_id is 9")
    assert json.loads(found.read_text(encoding="utf-8"))["findings"][0]["code"] == "wrong_board"
    assert check.main(["--port", f"{tmp_path}/por?", "--board-id", "9"]) == 1
    assert "parameter board_id is 9" in capsys.readouterr().err
    (tmp_path / "port2").symlink_to("port")  # two names of one board: two boards of one number
    assert check.main(["--port", f"{tmp_path}/por*", "--board-id", "0"]) == 1
    assert capsys.readouterr().err.startswith("Several boards have that board_id")
    assert check.main(["--port", f"{tmp_path}/por*", "--board-id", "9"]) == 1
    said = capsys.readouterr().err
    assert said.startswith("None of ") and "retrying" not in said
    with open_port(port, 500_000):
        assert check.main(["--port", port]) == 1
    said = capsys.readouterr().err
    assert "it is in use: end the other program" in said and "retrying" not in said
    with pytest.raises(SystemExit) as usage:
        check.main(["--max-voltage", "0"])
    assert usage.value.code == 2
