"""Names that are paths, `data.step1.u`: the fields of structs, as MATLAB and JSON have them."""

import re

_STEP = re.compile(r"(?<=\w)\.(?=[^\W\d])")  # no decimal point, and no full stop


def find_struct(name: str) -> str:
    """The path of the struct that a column is a field of, `data.step1`; empty where its name is no path."""
    steps = _steps(name)
    return name[: steps[-1]] if steps else ""


def find_field(name: str) -> str:
    """The last part of a path, `u` of `data.step1.u`; empty where the name is none."""
    steps = _steps(name)
    return name[steps[-1] + 1 :] if steps else ""


def _steps(name: str) -> list[int]:
    return [match.start() for match in _STEP.finditer(name)]
