"""Read YAML that strangers wrote: plain values only, bounded in size and depth, without aliases.

A hundred bytes with aliases of aliases stand for gigabytes, and deep nesting for a stack that runs over. Nothing that
the workbench, rosbag2 or ROS 2 writes has aliases; ROS 2's own reader of parameters refuses them as well.
"""

from pathlib import Path
from typing import Any

import yaml

from motor_model.errors import MotorError
from motor_model.regular_file import read_bytes

LARGEST = 1 << 20  # bytes: the metadata of ten thousand topics
DEEPEST = 50  # nested lists and mappings; a model file has 3, parameters have 5
LONGEST_NUMBER = 1000  # characters: to make a number of a million digits takes minutes
_Loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)  # ten times as fast


class NotYaml(MotorError):
    """A text that is not YAML, or more than anybody would write by hand; its message is what a sentence says of it."""


def read(path: str | Path) -> Any:
    """Read the values in a file.

    Raises:
        OSError: it cannot be read.
        MotorError: it is no regular file, too large, or not YAML.
    """
    try:
        return parse(read_bytes(path, LARGEST).decode("utf-8"))
    except UnicodeDecodeError as error:
        raise NotYaml("is not YAML (no text in UTF-8)") from error


def parse(text: str) -> Any:
    """Parse the values in a text.

    Raises:
        NotYaml: it is not YAML, has aliases, is nested too deep or too large.
    """
    if len(text) > LARGEST:
        raise NotYaml(f"is larger than {LARGEST >> 20} MiB")
    try:
        _check(text)
        return yaml.load(text, Loader=_Loader)
    except yaml.MarkedYAMLError as error:
        line = f" in line {error.problem_mark.line + 1}" if error.problem_mark else ""
        raise NotYaml(f"is not YAML ({error.problem}{line})") from error
    except (yaml.YAMLError, ValueError, RecursionError, KeyError, TypeError, AttributeError) as error:
        # ValueError: dates that are none; the others: PyYAML's own constructors, where a tag does not fit its value.
        raise NotYaml("is not YAML") from error


def _check(text: str) -> None:
    depth = 0
    for event in yaml.parse(text, Loader=_Loader):
        if isinstance(event, yaml.AliasEvent):
            raise NotYaml("has an alias (*): write the value out")
        depth += isinstance(event, yaml.CollectionStartEvent) - isinstance(event, yaml.CollectionEndEvent)
        if depth > DEEPEST:
            raise NotYaml(f"is nested deeper than {DEEPEST}")
        if isinstance(event, yaml.ScalarEvent) and len(event.value) > LONGEST_NUMBER and _may_be_number(event):
            raise NotYaml(f"has a number of {len(event.value)} characters")


def _may_be_number(event: yaml.ScalarEvent) -> bool:
    plain = event.implicit[0] or event.tag is not None
    return bool(plain and event.value[:1] in "+-.0123456789")
