"""Runs the stand-in as users do, against a node of our own, each in a domain that nobody else uses."""

import contextlib
import os
import queue
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import IO

import pytest
from domains import free_domain
from forked import Forked
from patience import PATIENCE

SUPPORT = Path(__file__).resolve().parents[1] / "support"
LAUNCHER = SUPPORT.parents[1] / "ros2_stand_in" / "ros2"
LAUNCHED = LAUNCHER.with_name("__main__.py")


@dataclass(frozen=True)
class Output:
    status: int
    out: str
    err: str


class Process:
    """A program whose lines can be waited for."""

    def __init__(self, command: list[str], env: dict[str, str]) -> None:
        self._popen = subprocess.Popen(command, env=env, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self._out = _Lines(self._popen.stdout)
        self._err = _Lines(self._popen.stderr)

    @property
    def pid(self) -> int:
        return self._popen.pid

    def wait_for(self, start: str, errors: bool = False) -> str:
        """The next line that begins so."""
        lines = self._err if errors else self._out
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            try:
                line = lines.next(0.1)
            except queue.Empty:
                assert self._popen.poll() is None, f"ended before {start!r}: {self._out.seen}, {self._err.all()}"
                continue
            if line.startswith(start):
                return line
        raise AssertionError(f"no line {start!r} within {PATIENCE} s, but {lines.seen}")

    def end(self, number: int | None = signal.SIGINT) -> tuple[Output, float]:
        """Send a signal, or let it end by itself; all of its output, and the seconds it took to end."""
        started = time.monotonic()
        if number is not None:
            self._popen.send_signal(number)
        status = self._popen.wait(PATIENCE)
        return Output(status, self._out.all(), self._err.all()), time.monotonic() - started

    def stop(self) -> None:
        """End it, gently if it lets us: a killed participant leaves shared memory behind."""
        for stop in (self._popen.terminate, self._popen.kill):
            with contextlib.suppress(subprocess.TimeoutExpired):
                stop()
                self._popen.wait(5.0)


class _Lines:
    """The lines of a pipe as they come."""

    def __init__(self, pipe: IO[str] | None) -> None:
        assert pipe is not None
        self.seen: list[str] = []
        self._queue: queue.Queue[str] = queue.Queue()
        self._reader = threading.Thread(target=lambda: [self._queue.put(line) for line in pipe], daemon=True)
        self._reader.start()

    def next(self, seconds: float) -> str:
        self.seen.append(self._queue.get(timeout=seconds))
        return self.seen[-1].rstrip("\n")

    def all(self) -> str:
        """Everything, when the program has ended."""
        self._reader.join(PATIENCE)
        while not self._queue.empty():
            self.seen.append(self._queue.get())
        return "".join(self.seen)


class Ros2:
    """`ros2`, in one domain.

    Whoever is quick tells of himself twenty times a second instead of every 3 s, so that he is found sooner.
    """

    def __init__(self, domain: int, quick: bool = True) -> None:
        self.env = {**os.environ, "ROS_DOMAIN_ID": str(domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
        self.env |= {"TZ": "UTC", "LC_ALL": "C.UTF-8"}
        if quick:
            self.env["FASTRTPS_DEFAULT_PROFILES_FILE"] = str(SUPPORT / "quick_announcements.xml")
        self._started: list[Process] = []

    def __call__(self, *words: str, status: int = 0, stdin: str = "", **more: str) -> Output:
        """Run to the end; the status is checked, and that no traceback comes.

        Who brings variables of his own begins with the launcher.
        """
        kind, file = (subprocess.Popen, LAUNCHER) if more else (Forked, LAUNCHED)
        pipe, env = subprocess.PIPE, self.env | more
        with kind([str(file), *words], env=env, stdin=pipe, stdout=pipe, stderr=pipe, text=True) as run:
            try:
                out, err = run.communicate(stdin, timeout=PATIENCE)
            finally:
                run.kill()
        assert "Traceback" not in err, err
        assert run.returncode == status, f"{words}: {run.returncode}\n{out}\n{err}"
        return Output(run.returncode, out, err)

    def together(self, *lines: str) -> list[str]:
        """What each of these command lines prints, run two at a time."""
        with ThreadPoolExecutor(2) as pool:
            return [done.out for done in pool.map(lambda line: self(*line.split()), lines)]

    def start(self, *words: str) -> Process:
        """Run on."""
        return self._start([str(LAUNCHER), *words])

    def start_shell(self, line: str) -> Process:
        """Run a line of bash that begins with a verb."""
        return self._start(["bash", "-c", f"'{LAUNCHER}' {line}"])

    def start_node(self, *arguments: str) -> Process:
        """Start the node of bench_node.py and wait until it is up."""
        node = self._start([sys.executable, str(SUPPORT / "bench_node.py"), *arguments])
        node.wait_for("ready")
        return node

    def _start(self, command: list[str]) -> Process:
        self._started.append(Process(command, self.env))
        return self._started[-1]

    def stop_all(self) -> None:
        for process in self._started:
            process.stop()


@pytest.fixture
def ros2() -> Iterator[Ros2]:
    """`ros2` in a domain of this test's own."""
    runner = Ros2(free_domain())
    yield runner
    runner.stop_all()


@pytest.fixture
def ordinary_ros2() -> Iterator[Ros2]:
    """`ros2`, and nodes, with the announcements that users have."""
    runner = Ros2(free_domain(), quick=False)
    yield runner
    runner.stop_all()


@pytest.fixture(scope="module")
def bench() -> Iterator[tuple[Ros2, Process]]:
    """`ros2` and a running bench node, for all tests of a file."""
    runner = Ros2(free_domain())
    yield runner, runner.start_node()
    runner.stop_all()
