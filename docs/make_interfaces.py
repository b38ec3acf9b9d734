"""Writes docs/interfaces.md from the .msg, .srv and .action files of motor_msgs: `python docs/make_interfaces.py`."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "interfaces.md"
PARTS = {"msg": ("",), "srv": ("request", "response"), "action": ("goal", "result", "feedback")}
TOPICS = """\
# Interfaces

Topics and services are relative names: a namespace makes a second motor. "Plant" is whichever of `motor_sim` and
`motor_driver` runs. All topics are reliable.

| topic | type | from → to | durability, depth |
|---|---|---|---|
| `motor/speed` | `motor_msgs/msg/MotorSpeed` | plant → all, every sample (200 Hz by default) | volatile, 100 |
| `motor/info` | `motor_msgs/msg/MotorInfo` | plant → all, at start and on change | transient local, 1 |
| `motor/voltage` | `motor_msgs/msg/MotorVoltage` | controller → plant; must keep coming | volatile, 1 |
| `motor/reference` | `std_msgs/msg/Float64` [rad/s] | user → controller; once is enough | volatile, 1 |
| `motor/control_state` | `motor_msgs/msg/ControlState` | controller → all, every sample | volatile, 100 |
| `motor/model` | `motor_msgs/msg/MotorModel` | identification → all, after each success | transient local, 1 |
| `joint_states` | `sensor_msgs/msg/JointState` | plant → all, every sample | volatile, 10 |
| `/diagnostics` | `diagnostic_msgs/msg/DiagnosticArray` | plant, controller → all, 1 Hz | volatile, 10 |

| service or action | type | of |
|---|---|---|
| `motor/enable` | `std_srvs/srv/SetBool` | plant: false switches the output off and latches that, true clears it |
| `motor/reset` | `std_srvs/srv/Trigger` | controller: clears its latched stop |
| `motor/identify` | `motor_msgs/srv/Identify` | identification: fit a model to bags |
| `motor/diagnose` | `motor_msgs/action/Diagnose` | identification: find what the model lacks |

What follows is generated from the definitions in `motor_msgs` by `python docs/make_interfaces.py`.
"""
FIELD = re.compile(
    r"^(?P<type>[\w/\[\]<>=]+)\s+(?P<name>\w+)\s*(?:=\s*(?P<constant>[^#\s]+))?\s*(?:#\s*(?P<note>.*))?$"
)


def page() -> str:
    """The whole page."""
    files = [path for kind in PARTS for path in sorted((ROOT / "motor_msgs" / kind).glob(f"*.{kind}"))]
    return "\n".join([TOPICS, *map(_section, files)])


def _section(path: Path) -> str:
    kind = path.suffix[1:]
    about, rest = _comment(path.read_text(encoding="utf-8"))
    lines = [f"## motor_msgs/{kind}/{path.stem}", "", about, ""]
    for title, text in zip(PARTS[kind], re.split(r"^---$", rest, flags=re.MULTILINE), strict=True):
        lines += [*([f"**{title}**", ""] if title else []), *_table(text), ""]
    return "\n".join(lines)


def _comment(text: str) -> tuple[str, str]:
    """What the file says of itself at its top, and the rest."""
    lines = text.splitlines()
    count = next(i for i, line in enumerate(lines) if not line.startswith("#"))
    return _plain(" ".join(line.lstrip("# ") for line in lines[:count])), "\n".join(lines[count:])


def _table(text: str) -> list[str]:
    rows = []
    for line in filter(str.strip, text.splitlines()):
        field = FIELD.match(line.strip())
        if field is None:
            raise ValueError(f"this line is neither a field nor a constant: {line!r}")
        if field["constant"] is None:
            rows.append(f"| `{field['name']}` | `{field['type']}` | {_plain(field['note'] or '')} |")
    return ["| field | type | meaning |", "|---|---|---|", *rows]


def _plain(text: str) -> str:
    """Without what Markdown would take for a table's border or for emphasis."""
    text = text.replace("+-", "±").replace("|", "or")
    return "`".join(part if i % 2 else part.replace("*", "·") for i, part in enumerate(text.split("`")))


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
