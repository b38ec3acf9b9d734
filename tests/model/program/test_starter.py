"""What a launch started ends with it, however that ends."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from threading import Event

import pytest
import workbench
from forked import Forked
from patience import PATIENCE

from motor_model.errors import MotorError
from motor_model.program import starter
from motor_model.program.starter import STARTER, read_starter, watch_starter
from motor_ros.run import CAUSES, Interrupt

Launch = subprocess.Popen[bytes]


@pytest.fixture
def launch() -> Iterator[Launch]:
    """A process that goes on, as a launch does."""
    process = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(1000)"])
    yield process
    process.kill()
    process.wait()


@pytest.fixture
def handlers() -> Iterator[None]:
    before = {number: signal.getsignal(number) for number in CAUSES}
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


def test_a_program_that_was_started_alone_ends_with_nothing() -> None:
    assert read_starter({}) is None and read_starter({STARTER: ""}) is None
    assert read_starter({STARTER: "12"}) == 12


@pytest.mark.parametrize("text", ["0", "-1", "x", "1.5", " 1", "²", str(2**31)])
def test_what_is_no_process_is_refused_in_a_sentence(text: str) -> None:
    with pytest.raises(MotorError, match=f"{STARTER} is '.*', which is no process: unset it"):
        read_starter({STARTER: text})


@pytest.mark.parametrize("has_handles", [True, False])
def test_the_end_of_a_process_is_heard_and_not_before(
    launch: Launch, has_handles: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(process: int) -> int:
        raise OSError(38, "Function not implemented")

    if not has_handles:
        monkeypatch.setattr(starter.os, "pidfd_open", refuse)
    ended = Event()
    watch_starter(launch.pid, ended.set)
    assert not ended.wait(4 * starter.LOOK_EVERY)
    launch.kill()
    launch.wait()
    assert ended.wait(PATIENCE)


def test_a_process_that_has_ended_and_that_nobody_asks_about_has_ended(
    launch: Launch, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As one under a process 1 that asks about none, in a container."""

    def refuse(process: int) -> int:
        raise OSError(38, "Function not implemented")

    monkeypatch.setattr(starter.os, "pidfd_open", refuse)
    launch.kill()
    ended = Event()
    watch_starter(launch.pid, ended.set)
    assert ended.wait(PATIENCE) and Path(f"/proc/{launch.pid}").exists()


def test_a_process_that_has_ended_already_is_heard_at_once(launch: Launch) -> None:
    launch.kill()
    launch.wait()
    ended = Event()
    watch_starter(launch.pid, ended.set)
    assert ended.wait(PATIENCE)


def test_an_end_interrupts_and_says_why(launch: Launch, handlers: None, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(STARTER, str(launch.pid))
    interrupt = Interrupt()
    assert not interrupt and interrupt.cause == ""
    launch.kill()
    launch.wait()
    begun = time.monotonic()
    while not interrupt and time.monotonic() < begun + PATIENCE:
        time.sleep(0.01)
    assert interrupt and interrupt.cause == "the launch that started it has ended"


def test_a_program_that_is_told_to_end_does_not_say_that_its_launch_has(
    launch: Launch, handlers: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(STARTER, str(launch.pid))
    interrupt = Interrupt()
    os.kill(os.getpid(), signal.SIGTERM)
    assert interrupt and interrupt.cause == "it was told to end"


@pytest.mark.parametrize("kind", [signal.SIGKILL, signal.SIGTERM, signal.SIGHUP])
def test_a_node_ends_with_its_launch(launch: Launch, kind: int) -> None:
    command = [workbench.program("motor_control", "motor_control")]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    environment = workbench.ENVIRONMENT | {STARTER: str(launch.pid)}
    node = Forked(command, env=environment, **pipes)  # type: ignore[call-overload]
    with pytest.raises(subprocess.TimeoutExpired):
        node.wait(timeout=2.0)
    launch.send_signal(kind)
    launch.wait()
    said, _ = node.communicate(timeout=PATIENCE)
    assert node.returncode == 0, said


def test_a_wrong_name_of_a_launch_starts_nothing() -> None:
    command = [workbench.program("motor_control", "motor_control")]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    node = Forked(command, env=workbench.ENVIRONMENT | {STARTER: "x"}, **pipes)  # type: ignore[call-overload]
    _, said = node.communicate(timeout=PATIENCE)
    assert node.returncode == 1 and said.count("\n") == 1 and "is no process" in said
