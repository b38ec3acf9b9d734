"""The graph of nodes: waiting until all of it is known, and leaving out what is hidden.

A node that has just started does not know the others yet. Two participants on one machine usually find each other in
0.15 s, but Fast DDS drops what arrives while it is still starting (`RTPSParticipantImpl::enable` makes its first
announcement before it registers its receivers), and then nothing comes before the other side's next announcement, up
to 3 s later. So we count who listens on this machine, and wait for all of them.
"""

import argparse
import os
import re
import time
from collections.abc import Callable, Iterable
from pathlib import Path

from rclpy.node import Node

from motor_model.errors import MotorError
from ros2_stand_in.graph.session import Session

ANNOUNCEMENT_PERIOD = 3.0  # [s] of Fast DDS
_LONGEST = ANNOUNCEMENT_PERIOD + 0.5  # [s]
_SHORTEST_BEYOND_THIS_MACHINE = 0.5  # [s] nobody can be counted there
_QUIET = 0.1  # [s] without a change
_LOOK_EVERY = 0.02  # [s]
_PARTICIPANT = slice(0, 12)  # the part of an endpoint's GID that is its participant's
_UNKNOWN_NODE = "_NODE_NAME_UNKNOWN_"
_NAME = re.compile(r"(/[A-Za-z_][A-Za-z0-9_]*)+")


def discovery_arguments(parser: argparse.ArgumentParser) -> None:
    """The options of the real command about finding nodes."""
    parser.add_argument("--spin-time", type=float, default=_LONGEST, help="longest wait for the graph [s]")
    parser.add_argument("--no-daemon", action="store_true", help="accepted; there is no daemon here")


def settle(session: Session, longest: float = _LONGEST, enough: Callable[[], object] = lambda: False) -> None:
    """Wait until everyone who listens on this machine is known, or enough is, at most this long [s]."""
    here_only = os.environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE") == "LOCALHOST"
    earliest = time.monotonic() + (0.0 if here_only else _SHORTEST_BEYOND_THIS_MACHINE)
    domain = session.node.context.get_domain_id()
    seen: object = None
    quiet_since = 0.0

    def complete() -> bool:
        nonlocal seen, quiet_since
        now = time.monotonic()
        graph = _snapshot(session.node)
        if graph != seen:
            seen, quiet_since = graph, now
        everyone = len(_known_participants(session.node)) >= _listening_participants(domain)
        return everyone and now >= earliest and now >= quiet_since + _QUIET

    session.spin(lambda: bool(enough()) or complete(), longest, _LOOK_EVERY)


def _snapshot(node: Node) -> object:
    return (
        sorted(node.get_node_names_and_namespaces()),
        node.get_topic_names_and_types(),
        node.get_service_names_and_types(),
    )


def _known_participants(node: Node) -> set[bytes]:
    """Participants whose nodes' names are known: every node publishes its parameter events."""
    events = node.get_publishers_info_by_topic("/parameter_events")
    return {bytes(event.endpoint_gid[_PARTICIPANT]) for event in events if event.node_name != _UNKNOWN_NODE}


def _listening_participants(domain: int) -> int:
    """How many participants of a domain listen on this machine, us included (RTPS 2.5, 9.6.2.3: every second port)."""
    first = 7400 + 250 * domain + 10
    try:
        lines = Path("/proc/net/udp").read_text().splitlines()[1:]
    except OSError:
        return 0
    ports = {int(line.split()[1].rpartition(":")[2], 16) for line in lines}
    return len(ports & set(range(first, first + 240, 2)))


def full_name(name: str) -> str:
    """A topic, service or node name with its leading slash.

    Raises:
        MotorError: nothing in ROS can have this name.
    """
    full = name if name.startswith("/") else f"/{name}"
    if not _NAME.fullmatch(full):
        raise MotorError(
            f"'{name}' cannot be a name in ROS: between slashes stand letters, digits and _, a digit not first."
        )
    return full


def is_hidden(name: str) -> bool:
    """Whether a topic or service is one that lists leave out."""
    return any(part.startswith("_") for part in name.split("/"))


def visible(names_and_types: Iterable[tuple[str, list[str]]], hidden_too: bool) -> list[tuple[str, list[str]]]:
    """The rows of a list that are to be shown."""
    return [(name, types) for name, types in names_and_types if hidden_too or not is_hidden(name)]


def print_list(rows: list[tuple[str, list[str]]], with_types: bool, count_only: bool = False) -> None:
    """Print names, one a line, or how many there are."""
    if count_only:
        print(len(rows))
        return
    for name, types in rows:
        print(f"{name} [{', '.join(types)}]" if with_types else name)


def node_names(node: Node, hidden_too: bool = False) -> list[str]:
    """The full names of all nodes, sorted; hidden ones start with an underscore."""
    everyone = node.get_node_names_and_namespaces()
    return sorted(
        f"{namespace.rstrip('/')}/{name}"
        for name, namespace in everyone
        if hidden_too or (name and not name.startswith("_"))
    )
