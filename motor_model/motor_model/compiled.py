"""How this project compiles: Numba with a disk cache that never serves machine code of an older equation.

Numba's own cache looks at the file a function stands in, not at the functions it calls. Here the cache directory is
named after the sources of the whole model, so that an edit to any of them is an edit to all.
"""

import hashlib
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import numba
from numba import njit

F = TypeVar("F", bound=Callable[..., object])

_HERE = Path(__file__).resolve().parent


def _cache_directory() -> Path:
    digest = hashlib.sha256()
    for source in sorted(_HERE.glob("*.py")):
        digest.update(source.read_bytes())
    return _HERE / "__pycache__" / f"numba-{digest.hexdigest()[:16]}"


CACHE = _cache_directory()


def compiled(function: F) -> F:
    """Compile on first call, keep the machine code on disk, let other threads run meanwhile."""
    before = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = str(CACHE)
    try:
        decorated: F = njit(cache=True, nogil=True, error_model="numpy", forceinline=True)(function)
    finally:
        numba.config.CACHE_DIR = before
    return decorated
