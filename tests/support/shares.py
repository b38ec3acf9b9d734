"""In which order the workers of xdist take the tests, so that no processor is idle while there is work."""

from collections.abc import Sequence
from itertools import islice

import pytest

# Nodes wait for one another here, more than they compute.
LIVE = ("tests/ros/", "tests/ros2_stand_in/", "tests/system/")


def share_out(items: Sequence[pytest.Item], workers: int) -> list[pytest.Item]:
    """Put tests in the order of the workers' shares: xdist's `worksteal` cuts the list into one piece a worker.

    Every share begins with some of the longest, so that at the end nobody waits for one of them. Half of the workers go
    on with tests that wait, while the others compute; who is done takes from the end of another's share, where all
    compute. A single share of all that waits would be left for the end, and workers that all wait leave a core idle.

    """
    long = [item for item in items if item.get_closest_marker("long")]
    short = [item for item in items if not item.get_closest_marker("long")]
    live = [item for item in short if item.nodeid.startswith(LIVE)]
    others = iter([item for item in short if not item.nodeid.startswith(LIVE)])
    waiting = (workers + 1) // 2  # workers
    shares: list[pytest.Item] = []
    for worker in range(workers):
        size = (len(items) - len(shares)) // (workers - worker)
        first = long[worker::workers]
        if worker < waiting:
            first += live[len(live) * worker // waiting : len(live) * (worker + 1) // waiting]
        shares += [*first, *islice(others, max(size - len(first), 0))]
    return shares
