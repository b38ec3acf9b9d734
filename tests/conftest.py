"""What holds for all tests."""

import gc
import itertools
import os
import signal
from collections.abc import Generator
from pathlib import Path

import pytest
from friction import record_friction
from hypothesis import settings

import motor_identification  # noqa: F401  (before NumPy: it keeps BLAS to one thread)

# A script's `./test.sh &` starts with SIGINT ignored, and so would all that tests start; no shell could even trap it.
signal.signal(signal.SIGINT, signal.default_int_handler)

# A machine may be busy: no test asserts a time.
settings.register_profile("any machine", deadline=None)
settings.load_profile("any machine")


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_collection() -> Generator[None, object, object]:
    """Spare the garbage collector what is collected: all of it stays, and every worker collects everything."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.enable()


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin every worker's share with some of the longest, so that at the end nobody waits for one of them.

    xdist's `worksteal` cuts the list into one piece a worker before anybody steals: what `-m` leaves of it.
    """
    workers = int(os.environ.get("PYTEST_XDIST_WORKER_COUNT", "1"))
    long = [item for item in items if item.get_closest_marker("long")]
    others = iter([item for item in items if not item.get_closest_marker("long")])
    shares: list[pytest.Item] = []
    for worker in range(workers):
        size = (len(items) - len(shares)) // (workers - worker)
        first = long[worker::workers]
        shares += [*first, *itertools.islice(others, size - len(first))]
    items[:] = shares


def pytest_collection_finish() -> None:
    """Spare the garbage collector what was imported and collected: it would look through all of it again and again."""
    gc.collect()
    gc.freeze()


@pytest.fixture(scope="session")
def bags(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A directory, to be read only: `true.yaml`, a motor with friction, and its recordings `staircase` and `coast`."""
    directory = tmp_path_factory.mktemp("bags")
    record_friction(directory)
    return directory
