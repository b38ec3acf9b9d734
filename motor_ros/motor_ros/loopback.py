"""Keep ROS 2 on this machine: before it starts, and unless the user has opened it.

`ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST` says whom a node looks for, not who may look for it: its sockets stay open to
every network. The profile for Fast DDS beside this file closes them. Whoever sets the range to SUBNET or
SYSTEM_DEFAULT opens them; a profile of the user's own is left as it is.
"""

import os
from collections.abc import MutableMapping
from pathlib import Path

RANGE = "ROS_AUTOMATIC_DISCOVERY_RANGE"
PROFILE = "FASTRTPS_DEFAULT_PROFILES_FILE"
CLOSED = Path(__file__).with_name("loopback.xml")
OPEN = Path(__file__).with_name("quick_discovery.xml")
_OPENED = ("SUBNET", "SYSTEM_DEFAULT")


def stay_on_this_machine(environment: MutableMapping[str, str] = os.environ) -> None:
    """Set what Fast DDS reads when the first node starts; env.sh does the same for a shell."""
    environment.setdefault(RANGE, "LOCALHOST")
    ours = CLOSED if environment[RANGE] not in _OPENED else OPEN
    if Path(environment.get(PROFILE, ours)).name in (CLOSED.name, OPEN.name):
        environment[PROFILE] = str(ours)
    environment.setdefault("SKIP_DEFAULT_XML_FILE", "1")  # a profile in the working directory is not read
