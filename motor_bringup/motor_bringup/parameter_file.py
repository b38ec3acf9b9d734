"""What a parameter file says to one node, with the precedence that its reader expects: later files prevail.

ROS 2 itself lets a section for `/**` lose against one for the node's name even if it stands in a later file, because it
goes by the first file that names a section; so the files are read here and the node gets plain values.
"""

from collections.abc import Iterator
from typing import Any

from motor_bringup.program import Value
from motor_model.errors import MotorError
from motor_model.given.mistakes import find_unreached
from motor_model.given.sections import HERE, reaches, read_sections


def parameters_for(node: str, path: str) -> dict[str, Value]:
    """Return the parameters for a node of that full name, such as /left/motor_sim; later sections prevail.

    Raises:
        MotorError: the file is no parameter file.
    """
    return _joined(values for name, values in read_sections(path) if reaches(name, node))


def parameters_told(node: str, path: str) -> dict[str, Value]:
    """Return the same of a file that a user has named.

    Raises:
        MotorError: the file is no parameter file, or a section in it was meant for this node and is not for it.
    """
    if unreached := find_unreached(path, node):
        raise MotorError(f"{unreached}.")
    return parameters_for(node, path)


def parameters_named(node: str, path: str) -> dict[str, Value]:
    """Return the parameters for a node in whatever namespace they were written for, as `ros2 param dump` does.

    Raises:
        MotorError: the file is no parameter file, or has nothing for this node.
    """
    sections = ((name.rpartition("/")[2], values) for name, values in read_sections(path))
    found = _joined(values for name, values in sections if name in (node, "**"))
    if not found:
        raise MotorError(f"{path} has no parameters for {node}: it needs '/**/{node}:' with '{HERE}:' in it.")
    return found


def _joined(sections: Iterator[dict[str, Any]]) -> dict[str, Value]:
    return {name: value for section in sections for name, value in _flat("", section)}


def _flat(prefix: str, values: dict[str, Any]) -> Iterator[tuple[str, Value]]:
    for name, value in values.items():
        if isinstance(value, dict):
            yield from _flat(f"{prefix}{name}.", value)
        else:
            yield f"{prefix}{name}", value
