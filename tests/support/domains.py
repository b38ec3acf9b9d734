"""A ROS domain that nobody on this machine uses, so that tests neither hear nor move anybody else's motor."""

import contextlib
import itertools
import socket
from collections.abc import Iterator
from functools import cache
from pathlib import Path

HIGHEST = 101  # above it, DDS takes ports that Linux gives to anybody
EACH = 6  # domains that a process of tests has for itself: some tests take a new one each, in turn
PORTS = 250  # a domain, from 7400 on


def free_domain() -> int:
    """A domain from 1 to 101 on which nobody on this machine listens; never that of another process of tests."""
    lines = Path("/proc/net/udp").read_text().splitlines()[1:]
    used = {(int(line.split()[1].rpartition(":")[2], 16) - 7400) // PORTS for line in lines}
    _, ours = _claimed()
    for domain in itertools.islice(ours, EACH):
        if domain not in used:
            return domain
    raise AssertionError("in each of this test process's ROS domains something still runs")


def free_domains(count: int) -> list[int]:
    """Different such domains, where those who meet in one would be taken for one another's."""
    found = list(dict.fromkeys(free_domain() for _ in range(EACH)))[:count]
    assert len(found) == count, "in too many of this test process's ROS domains something still runs"
    return found


@cache
def _claimed() -> tuple[socket.socket, Iterator[int]]:
    """Our domains, over and over, and what keeps them ours.

    A socket's name that is no file belongs to one process of the machine, and is free again when that has ended.
    """
    claim = socket.socket(socket.AF_UNIX)
    for first in range(1, HIGHEST - EACH + 2, EACH):
        with contextlib.suppress(OSError):
            claim.bind(f"\0domains of motor_workbench tests, from {first}")
            return claim, itertools.cycle(range(first, first + EACH))
    raise AssertionError("no ROS domains are left: too many tests run on this machine at once")
