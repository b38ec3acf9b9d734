"""Keep ROS 2 on this machine: before it starts, and unless the user has opened it.

`ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST` says whom a node looks for, not who may look for it: its sockets stay open to
every network. The profile for Fast DDS beside this file closes them. Whoever sets the range to SUBNET or
SYSTEM_DEFAULT opens them; a profile of the user's own is left as it is.

Peers and servers that the environment names would be told of a node all the same, and could not answer a closed one.
"""

import os
from collections.abc import MutableMapping
from pathlib import Path

RANGE = "ROS_AUTOMATIC_DISCOVERY_RANGE"
PROFILE = "FASTRTPS_DEFAULT_PROFILES_FILE"
CLOSED = Path(__file__).with_name("loopback.xml")
OPEN = Path(__file__).with_name("quick_discovery.xml")
ELSEWHERE = ("ROS_STATIC_PEERS", "ROS_DISCOVERY_SERVER")  # who is told of a node, whatever the range
_OPENED = ("SUBNET", "SYSTEM_DEFAULT")
NOT_TOLD = (
    "{} is set and not used, for nodes stay on this machine: export ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET to open it."
)
OPENED = (
    "ROS_AUTOMATIC_DISCOVERY_RANGE opens the network: everybody on it hears the motors and drives them; unset it to "
    "stay on this machine."
)


def stay_on_this_machine(environment: MutableMapping[str, str] = os.environ) -> str:
    """Set what Fast DDS reads when the first node starts, as env.sh does for a shell; say what is not used, or open."""
    environment.setdefault(RANGE, "LOCALHOST")
    ours = CLOSED if environment[RANGE] not in _OPENED else OPEN
    if Path(environment.get(PROFILE, ours)).name in (CLOSED.name, OPEN.name):
        environment[PROFILE] = str(ours)
    environment.setdefault("SKIP_DEFAULT_XML_FILE", "1")  # a profile in the working directory is not read
    if environment[PROFILE] == str(OPEN):
        return OPENED
    closed = environment[PROFILE] == str(CLOSED)
    unused = [name for name in ELSEWHERE if closed and environment.pop(name, "")]
    return NOT_TOLD.format(" and ".join(unused)) if unused else ""
