"""What holds for all tests."""

import signal
from pathlib import Path

import pytest
from friction import record_friction

import motor_identification  # noqa: F401  (before NumPy: it keeps BLAS to one thread)

# A script's `./test.sh &` starts with SIGINT ignored, and so would all that tests start; no shell could even trap it.
signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """The longest come first, so that at the end nobody waits for one of them."""
    items.sort(key=lambda item: item.get_closest_marker("long") is None)


@pytest.fixture(scope="session")
def bags(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A directory, to be read only: `true.yaml`, a motor with friction, and its recordings `staircase` and `coast`."""
    directory = tmp_path_factory.mktemp("bags")
    record_friction(directory)
    return directory
