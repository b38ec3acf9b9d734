"""Which cases of a table are run by every `./test.sh`, and which by `./test.sh --all` only."""

from collections.abc import Iterable
from typing import Any

import pytest


def keep_fast(cases: Iterable[Any], *fast: Any) -> list[Any]:
    """Mark all cases of a parametrised test but the given ones as slow; a case of several arguments is a tuple.

    Raises:
        ValueError: none is given, or one that is no case.

    """
    listed = list(cases)
    if not fast or any(case not in listed for case in fast):
        raise ValueError(f"{fast} are to stay fast: name one or more of {listed}")
    return [
        case if case in fast else mark_slow(*case) if isinstance(case, tuple) else mark_slow(case) for case in listed
    ]


def mark_slow(*arguments: Any) -> Any:
    """Mark one case of a parametrised test, by its arguments, as slow."""
    return pytest.param(*arguments, marks=pytest.mark.slow)
