"""Compile with Numba, and keep machine code on disk for exactly as long as what it was made of stays the same.

Numba's own cache looks at the file a function stands in, not at the functions it calls, which are inlined here. So the
cache directory of a module is named after a digest of all that its machine code depends on: its compiled functions and
constants, those of every module whose compiled functions they call, and the values that they import. What machine code
does not contain (docstrings, messages, plain Python functions) is not part of it: a sentence may change without a
kernel being compiled again. (Numba itself compiles a file's own kernels again whenever that file was written.)
"""

import ast
import hashlib
import inspect
import json
import shutil
import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import numba
import numpy as np
from numba import njit

from motor_model.regular_file import write_text

F = TypeVar("F", bound=Callable[..., object])

_OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy", "forceinline": True}
_PLAIN = (bool, int, float, complex, str, bytes, tuple, dict, frozenset, type(None))
_IN_USE: set[Path] = set()


def compiled(function: F) -> F:
    """Compile on first call, keep the machine code on disk, let other threads run meanwhile."""
    module = inspect.getmodule(function)
    assert module is not None, "a compiled function stands in a module"
    folder = cache_of(module.__name__)
    _IN_USE.add(folder)
    # Numba files machine code under the path that a module was imported by, which may be a link to its source.
    function.__code__ = function.__code__.replace(co_filename=str(_source(module.__name__)))
    before = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = str(folder)
    try:
        decorated: F = njit(cache=True, **_OPTIONS)(function)
    finally:
        numba.config.CACHE_DIR = before
    return decorated


def cache_of(module: str) -> Path:
    """Name the directory of an imported module's machine code: another one after any edit that could change it."""
    source = _source(module)
    return source.parent / "__pycache__" / f"numba-{source.stem}-{_digest(module)}"


def drop_stale() -> None:
    """Remove machine code of older sources, of every module that has been imported."""
    for folder in _IN_USE:
        stem = folder.name.rpartition("-")[0]
        for old in folder.parent.glob(f"{stem}-*"):
            if old != folder and old.name.rpartition("-")[0] == stem:
                shutil.rmtree(old, ignore_errors=True)  # another process may be at it too


@cache
def _source(module: str) -> Path:
    file = sys.modules[module].__file__
    assert file is not None
    return Path(file).resolve()


def _content(module: str) -> bytes:
    """Read what a module is made of; one that is built into the interpreter is the interpreter's version."""
    if getattr(sys.modules[module], "__file__", None) is None:
        return sys.version.encode()
    return _source(module).read_bytes()


@cache
def _digest(module: str) -> str:
    """Digest all that the machine code of an imported module depends on; its own imports have been executed."""
    outline = _outline_of(module)
    digest = hashlib.sha256(repr((sorted(_OPTIONS.items()), numba.__version__)).encode())
    digest.update(outline.own.encode())
    for name, origin in outline.imports:
        if origin not in sys.modules:
            continue
        value = getattr(sys.modules[origin], name, None)
        if isinstance(value, numba.core.dispatcher.Dispatcher):
            digest.update(f"{name}:{_digest(value.py_func.__module__)}".encode())
        elif hasattr(value, "_fields"):  # a named tuple's layout is compiled into whatever takes it
            digest.update(f"{name}:{_digest(value.__module__)}".encode())
        elif isinstance(value, np.ndarray):
            digest.update(name.encode() + value.tobytes())
        elif isinstance(value, _PLAIN):
            digest.update(f"{name}={value!r}".encode())
        elif name in outline.computing:
            digest.update(_content(origin))
    return digest.hexdigest()[:16]


class _Outline(NamedTuple):
    """What the machine code of a module depends on, as far as its source says."""

    own: str  # a digest of its compiled functions and constants
    computing: list[str]  # functions that assignments call
    imports: list[tuple[str, str]]  # each name that it imports from a module, and which


def _outline_of(module: str) -> _Outline:
    """Outline an imported module's source: to parse all sources takes a tenth of what a short command does.

    So it is kept on disk, where that can be written, for exactly these bytes and rules.
    """
    source = _source(module)
    text = source.read_bytes()
    key = hashlib.sha256(sys.version.encode() + _content(__name__) + text).hexdigest()
    file = source.parent / "__pycache__" / f"numba-{source.stem}.json"
    with suppress(OSError, ValueError, TypeError):
        kept, *outline = json.loads(file.read_bytes())
        if kept == key:
            return _Outline(*outline)
    read = _outline(ast.parse(text))
    with suppress(OSError):
        file.parent.mkdir(exist_ok=True)
        write_text(file, json.dumps([key, *read]))
    return read


def _outline(tree: ast.Module) -> _Outline:
    """Outline a module."""
    computing, digest = _called_by_constants(tree), hashlib.sha256()
    for node in _relevant(tree, computing):
        digest.update(ast.dump(_without_docstring(node)).encode())
    imports = [
        (alias.name, node.module)
        for node in tree.body
        if isinstance(node, ast.ImportFrom) and node.module and node.level == 0
        for alias in node.names
    ]
    return _Outline(digest.hexdigest(), sorted(computing), imports)


def _relevant(tree: ast.Module, computing: set[str]) -> Iterator[ast.stmt]:
    """Find what can be part of machine code: compiled functions, constants and what computes them, named tuples."""
    for node in tree.body:
        if isinstance(node, ast.FunctionDef):
            if node.name in computing or any("compiled" in ast.dump(one) for one in node.decorator_list):
                yield node
        elif isinstance(node, ast.ClassDef):
            if any("NamedTuple" in ast.dump(base) for base in node.bases):
                yield node
        elif isinstance(node, ast.Assign | ast.AnnAssign | ast.If | ast.For):
            yield node


def _called_by_constants(tree: ast.Module) -> set[str]:
    """Find the functions that assignments at the top of a module call."""
    assigned = (node.value for node in tree.body if isinstance(node, ast.Assign | ast.AnnAssign) and node.value)
    calls = (node.func for value in assigned for node in ast.walk(value) if isinstance(node, ast.Call))
    return {call.id for call in calls if isinstance(call, ast.Name)}


def _without_docstring(node: ast.stmt) -> ast.stmt:
    """Drop the docstrings of a function or class, and of what a class holds, in place."""
    for inner in (node, *node.body) if isinstance(node, ast.ClassDef) else (node,):
        if isinstance(inner, ast.FunctionDef | ast.ClassDef) and ast.get_docstring(inner, clean=False) is not None:
            inner.body = inner.body[1:]
    return node
