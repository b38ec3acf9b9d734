"""Writes motor_bringup/security/policy.xml from what nodes say of themselves: `python docs/make_policy.py`.

An enclave for each role, in the form that ROS 2's own `ros2 security generate_artifacts` takes; what is not listed is
denied. Who may publish motor/voltage and call motor/enable stands in one place, here.
"""

from dataclasses import dataclass, replace
from pathlib import Path
from xml.sax.saxutils import quoteattr

from motor_board.parameters import PROGRAM as BOARD
from motor_control.parameters import PROGRAM as CONTROL
from motor_driver.parameters import PROGRAM as DRIVER
from motor_examples.diff_drive.parameters import PROGRAM as DIFF_DRIVE
from motor_identification.live.monitor_parameters import PROGRAM as MONITOR
from motor_identification.service.parameters import PROGRAM as IDENTIFICATION
from motor_ros.program import Program
from motor_ros.topics import SERVICES, TOPICS
from motor_sim.parameters import PROGRAM as SIM

FILE = Path(__file__).resolve().parents[1] / "motor_bringup" / "security" / "policy.xml"
ALL = tuple(topic.name for topic in TOPICS)
ACTIONS = tuple(service.name for service in SERVICES if "/action/" in service.type_name)
CALLS = tuple(service.name for service in SERVICES if service.name not in ACTIONS)
OF_PARAMETERS = (
    "describe_parameters", "get_parameter_types", "get_parameters", "list_parameters", "set_parameters",
    "set_parameters_atomically", "get_type_description",
)  # fmt: skip
NODES = ("motor_sim", "motor_driver", "motor_control", "motor_identification", "monitor", "diff_drive")
HEAD = """\
<?xml version="1.0" encoding="UTF-8"?>
<!-- Who may say and hear what, by role; everything else is denied. Written by docs/make_policy.py.
     make_keystore.sh beside this makes keys and permissions of it; see docs/security.md. -->
"""


@dataclass(frozen=True)
class Role:
    """A node in an enclave, with the topics, services and actions that it may use."""

    enclave: str
    node: str
    publishes: tuple[str, ...] = ()
    subscribes: tuple[str, ...] = ()
    replies: tuple[str, ...] = ()
    requests: tuple[str, ...] = ()
    executes: tuple[str, ...] = ()
    calls: tuple[str, ...] = ()


def of_program(enclave: str, program: Program) -> Role:
    """What a node says of itself on `--help`."""
    services = [name for name in program.services if name not in ACTIONS]
    actions = [name for name in program.services if name in ACTIONS]
    parameters = [f"{program.name}/{name}" for name in OF_PARAMETERS]
    return Role(
        *(enclave, program.name, program.publishes, program.subscribes, (*services, *parameters)),
        *(program.requests, tuple(actions)),
    )


ROLES = (
    of_program("/motor/plant", SIM),
    of_program("/motor/plant", DRIVER),
    of_program("/motor/plant", BOARD),
    of_program("/motor/control", CONTROL),
    of_program("/motor/identification", IDENTIFICATION),
    of_program("/motor/monitor", MONITOR),
    replace(
        of_program("/motor/robot", DIFF_DRIVE),
        requests=(*DIFF_DRIVE.requests, *(f"{side}/motor_control/get_parameters" for side in ("left", "right"))),
    ),
    Role(
        "/motor/experiment",
        "experiment",
        ("motor/voltage",),
        ALL,
        tuple(f"experiment/{name}" for name in OF_PARAMETERS),
    ),
    Role("/motor/record", "record", (), ALL),
    Role("/motor/play", "play", ALL),
    Role(
        "/motor/operator",
        "operator",
        ("motor/reference", "motor/position_reference", "motor/joint_command", "cmd_vel"),
        (*ALL, "odom", "/tf"),
        requests=(*CALLS, *(f"{node}/{name}" for node in NODES for name in OF_PARAMETERS)),
        calls=ACTIONS,
    ),
)


def page() -> str:
    """The policy as XML."""
    enclaves: dict[str, list[str]] = {}
    for role in ROLES:
        enclaves.setdefault(role.enclave, []).append(profile(role))
    parts = []
    for path, profiles in enclaves.items():
        inside = f"      <profiles>\n{''.join(profiles)}      </profiles>\n"
        parts.append(f"    <enclave path={quoteattr(path)}>\n{inside}    </enclave>\n")
    return f'{HEAD}<policy version="0.2.0">\n  <enclaves>\n{"".join(parts)}  </enclaves>\n</policy>\n'


def profile(role: Role) -> str:
    """One node's part; every node tells its log and its changes of parameters."""
    rows = (
        ("topics", "publish", "topic", (*role.publishes, "rosout", "parameter_events")),
        ("topics", "subscribe", "topic", (*role.subscribes, "parameter_events")),
        ("services", "reply", "service", role.replies),
        ("services", "request", "service", role.requests),
        ("actions", "execute", "action", role.executes),
        ("actions", "call", "action", role.calls),
    )
    lines = [f'        <profile ns="/" node={quoteattr(role.node)}>\n']
    for kind, may, one, names in rows:
        if names:
            lines.append(f'          <{kind} {may}="ALLOW">\n')
            lines += [f"            <{one}>{absolute(name)}</{one}>\n" for name in names]
            lines.append(f"          </{kind}>\n")
    return "".join([*lines, "        </profile>\n"])


def absolute(name: str) -> str:
    """A name with its slash."""
    return name if name.startswith("/") else f"/{name}"


if __name__ == "__main__":
    FILE.write_text(page(), encoding="utf-8")
