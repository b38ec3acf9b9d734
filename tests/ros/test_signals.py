"""Programs that a script starts: they end when they are told to, and live on when only the terminal is closed."""

import os
import signal
from pathlib import Path
from subprocess import PIPE, Popen

import pytest
from std_msgs.msg import Float64
from workbench import ENVIRONMENT, PATIENCE, Bench, program

from motor_identification.bag import messages
from motor_ros.command.shell import shell

BASH = ("env", "--default-signal=HUP", "bash", "-c")  # whether or not the tests themselves run behind nohup
BACKGROUND = '"$@" & echo $!; wait $!'  # bash lets this ignore SIGINT, for there is no terminal


def in_background(prefix: str, *words: object) -> "tuple[Popen[str], int]":
    """A bash that waits for a command, and the command's process."""
    line = [*BASH, prefix + BACKGROUND, "bash", *map(str, words)]
    bash = Popen(line, env=ENVIRONMENT, stdout=PIPE, stderr=PIPE, text=True)
    assert bash.stdout is not None
    return bash, int(bash.stdout.readline())


@pytest.mark.parametrize(
    ("prefix", "survived", "last"),
    [("", [], signal.SIGINT), ("", [], signal.SIGHUP), ("nohup ", [signal.SIGHUP] * 2, signal.SIGINT)],
    ids=["interrupted", "terminal closed", "behind nohup"],
)
def test_a_recorder_in_the_background_of_a_script(
    bench: Bench, tmp_path: Path, prefix: str, survived: list[signal.Signals], last: signal.Signals
) -> None:
    topic = bench.publisher(Float64, "/said")
    bash, recorder = in_background(prefix, program("motor_identification", "record"), tmp_path / "bag", "/said")

    def written() -> int:
        return sum(1 for _ in messages(tmp_path / "bag")) if (tmp_path / "bag").is_dir() else 0

    bench.heard(topic)
    for count, number in enumerate([*survived, last], 1):
        topic.publish(Float64(data=1.0))
        bench.wait(lambda: written() == count, "the message in the bag")  # noqa: B023
        os.kill(recorder, number)
    out, err = bash.communicate(timeout=PATIENCE)
    assert bash.returncode == 0 and f"bag: {len(survived) + 1} messages, " in out, err


def test_a_command_hears_ctrl_c_where_it_starts_with_that_ignored() -> None:
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        assert shell(lambda: signal.raise_signal(signal.SIGINT) or 0) == 130
    finally:
        signal.signal(signal.SIGINT, before)
