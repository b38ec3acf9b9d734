"""How a command ends: exit statuses, sentences, interrupts."""

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from motor_model.errors import MotorError
from motor_ros.command.shell import shell


def test_the_status_says_how_it_ended(capsys: pytest.CaptureFixture[str]) -> None:
    def refused() -> int:
        raise MotorError("this cannot be: do that.")

    def interrupted() -> int:
        raise KeyboardInterrupt

    def interrupted_import() -> int:
        raise ImportError("initialization failed") from KeyboardInterrupt()

    works = (lambda: 0, lambda: 3, refused, interrupted, interrupted_import)
    assert [shell(work) for work in works] == [0, 3, 1, 130, 130]
    assert capsys.readouterr() == ("", "this cannot be: do that.\nInterrupted.\nInterrupted.\n")


def test_a_command_hears_ctrl_c_although_whoever_started_it_holds_it_back() -> None:
    def wait() -> int:
        signal.raise_signal(signal.SIGINT)
        return 0

    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        assert shell(wait) == 130
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


END = """
import io, os, signal, sys
from motor_ros.command.shell import ended_by_interrupt, shell

class Interrupted(io.FileIO):
    def write(self, data):
        written = super().write(data)
        interrupt()
        return written

def interrupt():
    os.kill(os.getpid(), signal.{})

def amidst_a_line():
    sys.stdout = io.TextIOWrapper(io.BufferedWriter(Interrupted(1, "w")))
    print("half", flush=True)

def work():
    with ended_by_interrupt("It was interrupted; nothing was written."):
        {}()
    return 0

raise SystemExit(shell(work))
"""


@pytest.mark.parametrize(
    ("name", "when", "said"), [("SIGINT", "interrupt", ""), ("SIGTERM", "amidst_a_line", "half\n")]
)
def test_an_interrupt_while_computing_is_one_sentence(name: str, when: str, said: str) -> None:
    done = subprocess.run([sys.executable, "-c", END.format(name, when)], capture_output=True, text=True, timeout=120.0)
    assert (done.returncode, done.stdout, done.stderr) == (130, said, "It was interrupted; nothing was written.\n")


def test_a_mistake_of_ours_says_so_and_keeps_its_log(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path))
    assert shell(lambda: [].pop()) == 1
    said = capsys.readouterr().err
    (log,) = tmp_path.iterdir()
    assert said.startswith(
        "This is a mistake of the workbench, not yours (IndexError: pop from empty list); the log is "
    )
    assert said.count("\n") == 1 and str(log) in said and "Traceback" in log.read_text()


PRINTS = "from motor_ros.command.shell import shell\nraise SystemExit(shell(lambda: print('x' * 100) or 0))"


@pytest.mark.parametrize(
    ("redirected", "status", "said"),
    [
        ("> /dev/full", 1, "what was to be shown could not be written (No space left on device); files were.\n"),
        (">&-", 0, ""),
        ("2>&-", 0, ""),
        ("| true; exit ${PIPESTATUS[0]}", 0, ""),
    ],
)
def test_output_that_goes_nowhere_is_no_traceback(redirected: str, status: int, said: str) -> None:
    line = f'"{sys.executable}" -c "{PRINTS}" {redirected}'
    done = subprocess.run(["bash", "-c", line], capture_output=True, text=True, timeout=120.0)
    assert (done.returncode, done.stderr) == (status, said)
