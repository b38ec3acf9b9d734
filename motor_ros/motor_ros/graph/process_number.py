"""Know which ROS process of its domain and machine a node is: only the first 62 are found by all others.

Nodes that stay on this machine ask at the ports of that many whether somebody is there (loopback.xml). A process beyond
them asks those, and they answer; two beyond them never hear of each other. Then a shell that is opened later does not
find a plant, to stop its motor, which somebody else, who was there before, goes on driving.

The number is in the ports that a process listens at (the wire protocol's, DDSI-RTPS 9.6.1), and stays for its life.
"""

import os
from collections.abc import Iterable, Mapping
from pathlib import Path

from rclpy.node import Node

from motor_model.errors import MotorError
from motor_ros.graph.open_sockets import EACH, FIRST, TABLES, own_sockets, read_table
from motor_ros.loopback import CLOSED, PROFILE, reads_profiles

FOUND = 62  # processes that are asked, of loopback.xml
PORTS, STEP = 10, 2  # the first process's port for discovery in a domain, and from one process to the next
MOST = (EACH - PORTS) // STEP  # processes for which a domain has ports; those of the next one follow
REFUSED = (
    "This is ROS process no. {} of domain {} on this machine, and those beyond the {}nd do not find each other: a new "
    "shell could not stop it. End others, or export another ROS_DOMAIN_ID for all that belong to it, and start again."
)
CROWDED = (
    "ROS process no. {} of domain {} runs on this machine, and those beyond the {}nd do not find each other: end some, "
    "or export another ROS_DOMAIN_ID for those that belong together."
)


def refuse_crowd(node: Node, environment: Mapping[str, str] = os.environ) -> None:
    """Refuse to go on with a node that drives a motor and that not everybody on this machine would find.

    Raises:
        MotorError: its process comes too late among those of the domain.
    """
    domain = node.context.get_domain_id()
    try:
        number = find_number(domain, map(read_table, TABLES), own_sockets()) if _is_limited(environment) else 0
    except OSError:
        return
    if number > FOUND:
        raise MotorError(REFUSED.format(number, domain, FOUND))


def tell_crowd(node: Node, environment: Mapping[str, str] = os.environ) -> str:
    """Say that there are processes on this machine that do not find each other; empty if all do, or nobody knows."""
    domain = node.context.get_domain_id()
    number = find_number(domain, map(read_table, TABLES)) if _is_limited(environment) else 0
    return CROWDED.format(number, domain, FOUND) if number > FOUND else ""


def find_number(domain: int, tables: Iterable[str], own: Iterable[str] | None = None) -> int:
    """Find the highest number, from 1 on, of the processes that listen in a domain by the kernel's tables of sockets.

    own: inodes of the sockets of one process, to look at those alone. 0: nobody listens there.

    A process goes on by a STEP from each port that it finds taken, for discovery and for messages by itself: where a
    stranger has one of the latter, its two are further apart. Its first one counts, for no lower one was free.
    """
    mine = None if own is None else set(own)
    rows = [line.split() for table in tables for line in table.splitlines()[1:]]
    taken = {int(row[1].rpartition(":")[2], 16) for row in rows if mine is None or row[9] in mine}
    first = FIRST + EACH * domain + PORTS
    if mine is None:
        both = (n for n in range(MOST) if {first + STEP * n, first + STEP * n + 1} <= taken)
        return max(both, default=-1) + 1
    most = first + STEP * 2 * MOST  # one process has a single domain, and may have ports of the next one
    messages = {port for port in range(first + 1, most, STEP) if port in taken}
    found = (port for port in range(first, most, STEP) if port in taken and any(port < other for other in messages))
    return (next(found, first - STEP) - first) // STEP + 1


def _is_limited(environment: Mapping[str, str]) -> bool:
    """Whether nodes find each other at those ports only; a profile of the user's own may say whatever it likes."""
    return reads_profiles(environment) and Path(environment.get(PROFILE, "")).name == CLOSED.name
