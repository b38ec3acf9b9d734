"""Runs the stand-in as users do, against a node of our own, each in a domain that nobody else uses."""

import itertools
import os
import queue
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
LAUNCHER = HERE.parent.parent / "ros2_stand_in" / "ros2"
LONGEST = 20.0  # [s] for anything that a test waits for
_offsets = itertools.count()


def free_domain() -> int:
    """A domain from 1 to 101 on which nobody on this machine listens; others for other test processes."""
    used = {int(line.split()[1].rpartition(":")[2], 16) for line in Path("/proc/net/udp").read_text().splitlines()[1:]}
    while True:
        domain = 1 + (os.getpid() * 13 + next(_offsets)) % 101
        first_port = 7400 + 250 * domain
        if not used & set(range(first_port, first_port + 250)):
            return domain


@dataclass(frozen=True)
class Output:
    status: int
    out: str
    err: str


class Process:
    """A program whose lines can be waited for."""

    def __init__(self, command: list[str], env: dict[str, str]) -> None:
        self._popen = subprocess.Popen(command, env=env, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self._lines: queue.Queue[str] = queue.Queue()
        self.seen: list[str] = []
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        assert self._popen.stdout is not None
        for line in self._popen.stdout:
            self._lines.put(line.rstrip("\n"))

    @property
    def pid(self) -> int:
        return self._popen.pid

    def wait_for(self, start: str) -> str:
        """The next line that begins so."""
        end = time.monotonic() + LONGEST
        while time.monotonic() < end:
            try:
                line = self._lines.get(timeout=0.2)
            except queue.Empty:
                assert self._popen.poll() is None, f"ended before {start!r}: {self.seen}, {self._popen.stderr.read()}"
                continue
            self.seen.append(line)
            if line.startswith(start):
                return line
        raise AssertionError(f"no line {start!r} within {LONGEST} s, but {self.seen}")

    def end(self, number: int = signal.SIGINT) -> tuple[Output, float]:
        """Send a signal; the rest of the output, and the seconds it took to end."""
        started = time.monotonic()
        self._popen.send_signal(number)
        self._popen.wait(LONGEST)
        took = time.monotonic() - started
        self._reader.join()
        while not self._lines.empty():
            self.seen.append(self._lines.get())
        assert self._popen.stderr is not None
        return Output(self._popen.returncode, "\n".join(self.seen), self._popen.stderr.read()), took

    def kill(self) -> None:
        if self._popen.poll() is None:
            self._popen.kill()
            self._popen.wait(LONGEST)


class Ros2:
    """`ros2`, in one domain."""

    def __init__(self, domain: int) -> None:
        self.env = {**os.environ, "ROS_DOMAIN_ID": str(domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
        self.env |= {"TZ": "UTC", "LC_ALL": "C.UTF-8", "PYTHONUNBUFFERED": "1"}
        self._started: list[Process] = []

    def __call__(self, *words: str, status: int = 0, stdin: str = "", **more: str) -> Output:
        """Run to the end; the status is checked, and that no traceback comes."""
        done = subprocess.run(
            [str(LAUNCHER), *words], env=self.env | more, input=stdin, capture_output=True, text=True, timeout=LONGEST
        )
        assert "Traceback" not in done.stderr, done.stderr
        assert done.returncode == status, f"{words}: {done.returncode}\n{done.stdout}\n{done.stderr}"
        return Output(done.returncode, done.stdout, done.stderr)

    def start(self, *words: str) -> Process:
        """Run on."""
        return self._keep(Process([str(LAUNCHER), *words], self.env))

    def start_node(self, *arguments: str) -> Process:
        """Start the node of bench_node.py and wait until it is up."""
        node = self._keep(Process([sys.executable, str(HERE / "bench_node.py"), *arguments], self.env))
        node.wait_for("ready")
        return node

    def _keep(self, process: Process) -> Process:
        self._started.append(process)
        return process

    def kill_all(self) -> None:
        for process in self._started:
            process.kill()


@pytest.fixture
def ros2() -> Iterator[Ros2]:
    """`ros2` in a domain of this test's own."""
    runner = Ros2(free_domain())
    yield runner
    runner.kill_all()


@pytest.fixture(scope="module")
def bench() -> "Iterator[tuple[Ros2, Process]]":
    """`ros2` and a running bench node, for all tests of a file."""
    runner = Ros2(free_domain())
    yield runner, runner.start_node()
    runner.kill_all()
