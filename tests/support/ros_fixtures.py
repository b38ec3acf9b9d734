"""A bench, and processes that end with the test."""

import subprocess
from collections.abc import Callable, Iterator

import pytest
import workbench


@pytest.fixture
def bench() -> Iterator[workbench.Bench]:
    bench = workbench.Bench()
    yield bench
    bench.close()


@pytest.fixture
def start() -> Iterator[Callable[..., "subprocess.Popen[str]"]]:
    """Starts a program of a package; whatever still runs at the end of the test is ended."""
    running: list[subprocess.Popen[str]] = []

    def start(package: str, command: str, *arguments: object) -> "subprocess.Popen[str]":
        running.append(workbench.start(package, command, *arguments))
        return running[-1]

    yield start
    workbench.quit_all(running)
