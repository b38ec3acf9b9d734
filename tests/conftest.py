"""What holds for all tests."""

import gc
import os
import signal
from collections.abc import Generator
from pathlib import Path

import pytest
from forked import share_server
from friction import record_friction
from hypothesis import settings
from shares import share_out

import motor_identification  # noqa: F401  (before NumPy: it keeps BLAS to one thread)

# A script's `./test.sh &` starts with SIGINT ignored, and so would all that tests start; no shell could even trap it.
signal.signal(signal.SIGINT, signal.default_int_handler)
# Nor is what `nohup ./test.sh` starts meant to outlive its terminal: a handler is not inherited, and the tests go on.
if signal.getsignal(signal.SIGHUP) is signal.SIG_IGN:
    signal.signal(signal.SIGHUP, lambda number, frame: None)

# A machine may be busy: no test asserts a time.
settings.register_profile("any machine", deadline=None)
settings.load_profile("any machine")


def pytest_configure(config: pytest.Config) -> None:
    """Where workers run the tests, they have one process between them that imports what programs need."""
    if config.getoption("numprocesses", None) and not hasattr(config, "workerinput"):
        share_server()


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
    """Share out what `-m` leaves of them."""
    items[:] = share_out(items, int(os.environ.get("PYTEST_XDIST_WORKER_COUNT", "1")))


def pytest_collection_finish() -> None:
    """Spare the garbage collector what was imported and collected: it would look through all of it again and again.

    What of it is garbage stays, too: to find that takes every worker half a second.
    """
    gc.freeze()


@pytest.fixture(scope="session")
def bags(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A directory, to be read only: `true.yaml`, a motor with friction, and its recordings `staircase` and `coast`."""
    directory = tmp_path_factory.mktemp("bags")
    record_friction(directory)
    return directory
