"""Read the sections of a parameter file, and tell which nodes they are for."""

import re
from collections.abc import Iterator
from typing import Any

from motor_model import yaml_file
from motor_model.errors import MotorError

HERE = "ros__parameters"


def read_sections(path: str) -> list[tuple[str, dict[str, Any]]]:
    """Read the names of nodes in a parameter file, patterns with `*` among them, and the values below each.

    Raises:
        MotorError: the file is no parameter file.
    """
    try:
        content = yaml_file.read(path)
    except (OSError, MotorError) as error:
        reason = error.strerror if isinstance(error, OSError) else f"it {error}"
        raise MotorError(f"{path} cannot be read as YAML ({reason}): correct it, or name another file.") from error
    sections = list(_below("", content)) if isinstance(content, dict) else []
    if not sections:
        raise MotorError(f"{path} is no parameter file: it needs '/**:' or the name of a node, and '{HERE}:' in it.")
    return sections


def reaches(name: str, node: str) -> bool:
    """Tell whether a section of that name is for a node of that full name, such as /left/motor_sim.

    `*` is one part of a name, `**` any number of them, none included.
    """
    parts = name.strip("/").split("/")
    pattern = "".join({"**": "(/[^/]+)*", "*": "/[^/]+"}.get(part, "/" + re.escape(part)) for part in parts)
    return re.fullmatch(pattern, node) is not None


def _below(name: str, content: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Namespaces may stand in the name of the node or around it."""
    for key, entry in content.items():
        if key == HERE:
            yield name, entry or {}
        elif isinstance(entry, dict):
            yield from _below(f"{name}/{str(key).strip('/')}", entry)
