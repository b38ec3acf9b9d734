"""Notice that the middleware listens to every network although the user has not opened it.

A profile that Fast DDS does not understand (a tag that it does not know, a profile that is there twice) it logs as an
error and goes on without, on 0.0.0.0. Only the sockets tell: those on which a participant listens have ports of
its domain (the wire protocol's, DDSI-RTPS 9.6.1).
"""

import os
import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from rclpy.node import Node

from motor_model.errors import MotorError
from motor_ros.loopback import OPENED_RANGES, PROFILE, RANGE, reads_profiles

FIRST, EACH = 7400, 250  # ports: the first domain's first, and how many a domain has
TABLES = Path("/proc/self/net/udp"), Path("/proc/self/net/udp6")
LISTENING = 2  # sockets of a participant, for discovery and for messages; one alone may be there to send, on any port
REFUSED = (
    "This node listens to every network, not only on this machine: Fast DDS does not understand the profile {}, or it "
    "opens it. Correct or unset FASTRTPS_DEFAULT_PROFILES_FILE; or export ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET, if "
    "everybody on the network may drive the motors."
)


def refuse_open_sockets(node: Node, environment: Mapping[str, str] = os.environ) -> None:
    """Refuse to go on with a node that can be reached from elsewhere, where the user has not opened it.

    Where the kernel does not tell, and of another middleware than Fast DDS's, nothing is known, and nothing said.

    Raises:
        MotorError: its sockets are open.
    """
    if not reads_profiles(environment) or environment.get(RANGE) in OPENED_RANGES:
        return
    try:
        own = own_sockets()
    except OSError:
        return
    if count_open(node.context.get_domain_id(), map(read_table, TABLES), own) >= LISTENING:
        raise MotorError(REFUSED.format(environment.get(PROFILE, "")))


def count_open(domain: int, tables: Iterable[str], own: Iterable[str]) -> int:
    """Count a process's sockets on all addresses at ports of a domain, in the kernel's tables of sockets."""
    ports = range(FIRST + EACH * domain, FIRST + EACH * (domain + 1))
    rows = [line.split() for table in tables for line in table.splitlines()[1:]]
    mine = set(own)
    open_ones = (row[1].split(":") for row in rows if row[9] in mine)
    return sum(not address.strip("0") and int(port, 16) in ports for address, port in open_ones)


def read_table(table: Path) -> str:
    """Read a table of the kernel's; "" where there is none, as of a kernel without IPv6."""
    try:
        return table.read_text()
    except OSError:
        return ""


def own_sockets() -> set[str]:
    """Read the inodes of this process's sockets; a descriptor that is closed meanwhile is none."""
    found = set()
    for one in os.listdir("/proc/self/fd"):
        try:
            target = os.readlink(f"/proc/self/fd/{one}")
        except FileNotFoundError:
            continue
        found |= set(re.findall(r"^socket:\[(\d+)\]$", target))
    return found
