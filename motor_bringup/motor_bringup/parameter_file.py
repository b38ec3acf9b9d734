"""What a parameter file says to one node, with the precedence that its reader expects: later files prevail.

ROS 2 itself lets a section for `/**` lose against one for the node's name even if it stands in a later file, because it
goes by the first file that names a section; so the files are read here and the node gets plain values.
"""

import re
from collections.abc import Iterator
from typing import Any

from motor_bringup.program import Value
from motor_model import yaml_file
from motor_model.errors import MotorError

HERE = "ros__parameters"


def parameters_for(node: str, path: str) -> dict[str, Value]:
    """Return the parameters for a node of that full name, such as /left/motor_sim; later sections prevail.

    Raises:
        MotorError: the file is no parameter file.
    """
    return _joined(values for name, values in _sections(path) if _pattern(name).fullmatch(node))


def parameters_named(node: str, path: str) -> dict[str, Value]:
    """Return the parameters for a node in whatever namespace they were written for, as `ros2 param dump` does.

    Raises:
        MotorError: the file is no parameter file, or has nothing for this node.
    """
    sections = ((name.rpartition("/")[2], values) for name, values in _sections(path))
    found = _joined(values for name, values in sections if name in (node, "**"))
    if not found:
        raise MotorError(f"{path} has no parameters for {node}: it needs '/**/{node}:' with '{HERE}:' in it.")
    return found


def _sections(path: str) -> Iterator[tuple[str, dict[str, Any]]]:
    try:
        content = yaml_file.read(path)
    except (OSError, MotorError) as error:
        reason = error.strerror if isinstance(error, OSError) else f"it {error}"
        raise MotorError(f"{path} cannot be read as YAML ({reason}): correct it, or name another file.") from error
    sections = list(_below("", content)) if isinstance(content, dict) else []
    if not sections:
        raise MotorError(f"{path} is no parameter file: it needs '/**:' or the name of a node, and '{HERE}:' in it.")
    yield from sections


def _below(name: str, content: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Namespaces may stand in the name of the node or around it."""
    for key, entry in content.items():
        if key == HERE:
            yield name, entry or {}
        elif isinstance(entry, dict):
            yield from _below(f"{name}/{str(key).strip('/')}", entry)


def _pattern(name: str) -> "re.Pattern[str]":
    """`*` is one part of a name, `**` any number of them, none included."""
    parts = name.strip("/").split("/")
    return re.compile("".join({"**": "(/[^/]+)*", "*": "/[^/]+"}.get(part, "/" + re.escape(part)) for part in parts))


def _joined(sections: Iterator[dict[str, Any]]) -> dict[str, Value]:
    return {name: value for section in sections for name, value in _flat("", section)}


def _flat(prefix: str, values: dict[str, Any]) -> Iterator[tuple[str, Value]]:
    for name, value in values.items():
        if isinstance(value, dict):
            yield from _flat(f"{prefix}{name}.", value)
        else:
            yield f"{prefix}{name}", value
