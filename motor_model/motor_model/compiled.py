"""How this project compiles: Numba with a disk cache that never serves machine code of an older equation.

Numba's own cache looks at the file a function stands in, not at the functions it calls. Here the cache directory is
named after the sources of the whole model, and below it after those of the package that a compiled function stands in
where that is another one, so that an edit to any of them is an edit to all.
"""

import hashlib
import inspect
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import TypeVar

import numba
from numba import njit

F = TypeVar("F", bound=Callable[..., object])

_HERE = Path(__file__).resolve().parent


@cache
def _digest(folder: Path) -> str:
    """Changes with any source in a folder."""
    digest = hashlib.sha256()
    for source in sorted(folder.glob("*.py")):
        digest.update(source.read_bytes())
    return digest.hexdigest()[:16]


CACHE = _HERE / "__pycache__" / f"numba-{_digest(_HERE)}"


def _cache_of(folder: Path) -> Path:
    """Where the machine code of functions from a package's folder is kept."""
    return CACHE if folder == _HERE else CACHE / f"{folder.name}-{_digest(folder)}"


def compiled(function: F) -> F:
    """Compile on first call, keep the machine code on disk, let other threads run meanwhile."""
    before = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = str(_cache_of(Path(inspect.getfile(function)).resolve().parent))
    try:
        decorated: F = njit(cache=True, nogil=True, error_model="numpy", forceinline=True)(function)
    finally:
        numba.config.CACHE_DIR = before
    return decorated
