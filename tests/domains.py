"""A ROS domain that nobody on this machine uses, so that tests neither hear nor move anybody else's motor."""

import itertools
import os
from pathlib import Path

_offsets = itertools.count()


def free_domain() -> int:
    """A domain from 1 to 101 on which nobody on this machine listens; others for other test processes."""
    used = {int(line.split()[1].rpartition(":")[2], 16) for line in Path("/proc/net/udp").read_text().splitlines()[1:]}
    while True:
        domain = 1 + (os.getpid() * 13 + next(_offsets)) % 101
        first_port = 7400 + 250 * domain
        if not used & set(range(first_port, first_port + 250)):
            return domain
