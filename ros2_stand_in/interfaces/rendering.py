"""Messages as text: YAML blocks as `ros2 topic echo` prints them, and lines of comma-separated values."""

import array
import sys
from collections.abc import Iterator
from typing import Any

import numpy as np
import yaml

ARRAYS = (list, tuple, array.array, np.ndarray)
DEFAULT_LENGTH = 128  # of texts and arrays, beyond which they are cut


def is_message(value: Any) -> bool:
    """Whether this is a message rather than one of its plain values."""
    return hasattr(value, "get_fields_and_field_types")


def to_yaml(message: Any, longest: int | None = None, flow_style: bool = False) -> str:
    """A message as YAML; texts and arrays with more than `longest` elements end in '...'."""
    return yaml.dump(
        _plain(message, longest),
        sort_keys=False,
        allow_unicode=True,
        width=sys.maxsize,
        default_flow_style=flow_style,
    )


def to_csv(message: Any, longest: int | None = None) -> str:
    """All values of a message in one line."""
    return ",".join(str(value) for value in _leaves(_plain(message, longest)))


def _plain(value: Any, longest: int | None) -> Any:
    if is_message(value):
        return {name: _plain(getattr(value, name), longest) for name in value.get_fields_and_field_types()}
    if isinstance(value, bytes):
        value = value.decode("latin-1")
    if isinstance(value, str):
        return value if longest is None or len(value) <= longest else value[:longest] + "..."
    if isinstance(value, ARRAYS):
        shown = [_plain(element, longest) for element in value[:longest]]
        return shown if len(shown) == len(value) else [*shown, "..."]
    return value.item() if isinstance(value, np.generic) else value


def _leaves(value: Any) -> Iterator[Any]:
    if isinstance(value, (dict, list)):
        for inner in value.values() if isinstance(value, dict) else value:
            yield from _leaves(inner)
    else:
        yield value
