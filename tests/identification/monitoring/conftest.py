"""A wheel that was heard, once for all tests of the monitor."""

import pytest
from watched import hear_wheel

from motor_identification.monitoring.heard import Heard


@pytest.fixture(scope="session")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> tuple[Heard, int]:
    """What was heard, and when it ended [ns]."""
    return hear_wheel(tmp_path_factory.mktemp("live"))
