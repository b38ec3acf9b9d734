"""Keep ROS 2 on this machine: before it starts, and unless the user has opened it.

`ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST` says whom a node looks for, not who may look for it: its sockets stay open to
every network. The profile for Fast DDS beside this file closes them. Whoever sets the range to SUBNET or
SYSTEM_DEFAULT opens them; a profile of the user's own is left as it is. One that is not there, or is another program's
file, would leave them open (Fast DDS says so among its errors, and goes on without), and so ours is used. What is set
and empty is not set: a line of a script that found nothing.

Peers and servers that the environment names would be told of a node all the same, and could not answer a closed one.
"""

import os
from collections.abc import Mapping, MutableMapping
from pathlib import Path
from xml.parsers.expat import ExpatError, ParserCreate

from motor_model import regular_file
from motor_model.errors import MotorError

RANGE = "ROS_AUTOMATIC_DISCOVERY_RANGE"
PROFILE = "FASTRTPS_DEFAULT_PROFILES_FILE"
CLOSED = Path(__file__).with_name("loopback.xml")
OPEN = Path(__file__).with_name("quick_discovery.xml")
ELSEWHERE = ("ROS_STATIC_PEERS", "ROS_DISCOVERY_SERVER")  # who is told of a node, whatever the range
SKIP = "SKIP_DEFAULT_XML_FILE"
MIDDLEWARE = "RMW_IMPLEMENTATION"
MOST = 1 << 20  # [byte] of a profile
OPENED_RANGES = ("SUBNET", "SYSTEM_DEFAULT")
NOT_TOLD = (
    "{} is set and not used, for nodes stay on this machine: export ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET to open it."
)
OPENED = (
    "ROS_AUTOMATIC_DISCOVERY_RANGE opens the network: everybody on it hears the motors and drives them; unset it to "
    "stay on this machine."
)
LOST = "{} is {}, which cannot be read as a profile: the workbench's own {} is used. Correct it, or unset it."
ROOTS = ("dds", "profiles")  # of a profile, without a prefix: Fast DDS takes no other file for one
OTHER = (
    "RMW_IMPLEMENTATION is {}, which does not read what keeps nodes on this machine: give it an interface list of its "
    "own (docs/security.md), or everybody on the network may hear the motors and drive them."
)


def stay_on_this_machine(environment: MutableMapping[str, str] = os.environ) -> str:
    """Set what Fast DDS reads when the first node starts, as env.sh does for a shell; say what is not used, or open."""
    environment[RANGE] = environment.get(RANGE) or "LOCALHOST"
    environment[SKIP] = environment.get(SKIP) or "1"  # a profile in the working directory is not read
    ours = CLOSED if environment[RANGE] not in OPENED_RANGES else OPEN
    theirs = environment.get(PROFILE) or str(ours)
    named = Path(theirs).name in (CLOSED.name, OPEN.name)
    lost = not named and not is_profile(theirs)
    environment[PROFILE] = str(ours) if named or lost else theirs
    said = [_find_other_middleware(environment)] + [LOST.format(PROFILE, theirs, ours.name)] * lost
    if environment[PROFILE] == str(OPEN):
        return " ".join(filter(None, (*said, OPENED)))
    closed = environment[PROFILE] == str(CLOSED)
    unused = [name for name in ELSEWHERE if closed and environment.pop(name, "")]
    said += [NOT_TOLD.format(" and ".join(unused))] if unused else []
    return " ".join(filter(None, said))


def is_profile(path: str) -> bool:
    """Tell whether a file can be read, and is XML of Fast DDS; what else is wrong with a profile is its owner's.

    Fast DDS reads bytes, no UTF-16, and knows no entities that a file declares.
    """
    parser, tags, unknown = ParserCreate(), list[str](), list[str]()
    parser.StartElementHandler = lambda tag, _: tags.append(tag)
    parser.EntityDeclHandler = lambda name, *_: unknown.append(name)
    try:
        data = regular_file.read_bytes(path, MOST)
        parser.Parse(data, True)
    except (OSError, MotorError, ExpatError, ValueError):
        return False
    return tags[0] in ROOTS and not unknown and b"\0" not in data


def reads_profiles(environment: Mapping[str, str]) -> bool:
    """Tell whether the middleware is one of Fast DDS's, as it is where none is named: no other reads its profiles."""
    return (environment.get(MIDDLEWARE) or "rmw_fastrtps_cpp").startswith("rmw_fastrtps")


def _find_other_middleware(environment: MutableMapping[str, str]) -> str:
    """Say that a middleware is none of Fast DDS's, unless Cyclone DDS has a configuration of its own; "" otherwise."""
    name = environment.get(MIDDLEWARE, "")
    configured = "cyclonedds" in name and bool(environment.get("CYCLONEDDS_URI"))
    return "" if reads_profiles(environment) or configured else OTHER.format(name)
