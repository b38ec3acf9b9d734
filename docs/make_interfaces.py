"""Writes docs/interfaces.md from the .msg, .srv and .action files of motor_msgs: `python docs/make_interfaces.py`."""

import re
from pathlib import Path

from motor_ros.topics import ROBOT_TOPICS, SERVICES, TOPICS, Topic

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "interfaces.md"
PARTS = {"msg": ("",), "srv": ("request", "response"), "action": ("goal", "result", "feedback")}
HEAD = """\
# Interfaces

Topics and services are relative names: a namespace makes a second motor. "Plant" is whichever of `motor_sim` and
`motor_driver` runs. All topics are reliable.
"""
ROBOT = """\
A robot of two motors ([motor_examples](../motor_examples/README.md)) has these besides, in its own namespace:
"""
FOOT = """\
What follows is generated from the definitions in `motor_msgs` by `python docs/make_interfaces.py`; the tables above are
those of `motor_ros/topics.py`.
"""
FIELD = re.compile(
    r"^(?P<type>[\w/\[\]<>=]+)\s+(?P<name>\w+)\s*(?:=\s*(?P<constant>[^#\s]+))?\s*(?:#\s*(?P<note>.*))?$"
)


def page() -> str:
    """The whole page."""
    files = [path for kind in PARTS for path in sorted((ROOT / "motor_msgs" / kind).glob(f"*.{kind}"))]
    tables = [*_topics(TOPICS), "", *_services(), "", ROBOT, *_topics(ROBOT_TOPICS)]
    return "\n".join([HEAD, *tables, "", FOOT, *map(_section, files)])


def _topics(topics: tuple[Topic, ...]) -> list[str]:
    rows = [
        f"| `{topic.name}` | `{topic.type_name}`{f' [{topic.unit}]' if topic.unit else ''} | {topic.way} "
        f"| {topic.qos.durability.name.lower().replace('_', ' ')}, {topic.qos.depth} |"
        for topic in topics
    ]
    return ["| topic | type | from → to | durability, depth |", "|---|---|---|---|", *rows]


def _services() -> list[str]:
    rows = [f"| `{service.name}` | `{service.type_name}` | {service.of}: {service.does} |" for service in SERVICES]
    return ["| service or action | type | of |", "|---|---|---|", *rows]


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
