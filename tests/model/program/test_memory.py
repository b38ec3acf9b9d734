"""Want of memory is said as such, with what there may be and what to do; and who computes asks for room first."""

import errno
import resource
import subprocess
import sys

import numpy as np
import pytest

from motor_model.program import memory
from motor_model.program.internal_error import InternalError, report
from motor_model.program.memory import MIB, NotEnoughMemory, explain, lacks_memory

LIMITED = """
import resource
from motor_model.program import memory
taken = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (taken + 100 * memory.MIB,) * 2)
memory.ask_for_room(50 * memory.MIB)
try:
    memory.ask_for_room(150 * memory.MIB)
except memory.NotEnoughMemory as error:
    print(error)
"""
START = """
import resource, sys
from motor_model.program import entry_point, memory
resource.setrlimit(resource.RLIMIT_AS, (memory.LEAST + {more} * memory.MIB,) * 2)
@entry_point.entry_point
def program():
    {loading}
    return lambda: 7
sys.exit(program())
"""


def behind(error: Exception) -> Exception:
    """As a library words it whose loading failed."""
    outer = OSError("Could not find/load shared object file 'libllvmlite.so'")
    outer.__context__ = error
    return outer


def run(script: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)


@pytest.mark.parametrize(
    ("error", "lacks"),
    [
        (MemoryError(), True),
        (np._core._exceptions._ArrayMemoryError((9391, 11), np.dtype(float)), True),
        (ImportError("libscipy_openblas.so: failed to map segment from shared object"), True),
        (ImportError("No module named 'scipy'"), False),
        (behind(OSError("libllvmlite.so: failed to map segment from shared object")), True),
        (behind(OSError("libllvmlite.so: invalid ELF header")), False),
        (OSError(errno.ENOMEM, "Cannot allocate memory"), True),
        (OSError(errno.ENOSPC, "No space left on device"), False),
        (RuntimeError("can't start new thread"), True),
        (RuntimeError("dictionary changed size during iteration"), False),
        (ValueError("failed to map segment"), False),
    ],
)
def test_an_error_lacks_memory_or_is_a_mistake(error: Exception, lacks: bool) -> None:
    assert lacks_memory(error) is lacks
    said = report(error)
    assert isinstance(said, NotEnoughMemory if lacks else InternalError)
    assert ("raise the limit, close other programs" in str(said)) is lacks


@pytest.mark.parametrize("limited", [True, False])
def test_what_the_interpreter_loses_is_believed_where_memory_is_limited(
    monkeypatch: pytest.MonkeyPatch, limited: bool
) -> None:
    monkeypatch.setattr(memory, "_limit", lambda: 300 * MIB if limited else None)
    assert (
        lacks_memory(SystemError("<built-in function compile> returned NULL without setting an exception")) is limited
    )
    assert not lacks_memory(SystemError("bad argument"))
    assert ("this process may have 300 MiB (ulimit -v)" in str(explain(MemoryError()))) is limited


def test_the_sentence_has_the_words_that_say_so() -> None:
    assert "(OSError: x.so: failed to map segment)" in str(explain(behind(OSError("x.so: failed to map segment"))))


def test_who_computes_asks_for_room_first() -> None:
    """OpenBLAS without room for its buffer asks again for ever, and hears no Ctrl-C meanwhile."""
    done = run(LIMITED)
    assert done.stdout.startswith("There is not enough memory: 150 MiB are needed beside what is in use; this process")
    assert done.stderr == ""


def test_nobody_asks_where_memory_is_not_limited(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(resource, "getrlimit", lambda which: (resource.RLIM_INFINITY,) * 2)
    memory.ask_for_room(2**60)


@pytest.mark.parametrize(
    ("more", "loading", "status", "said"),
    [
        (1, "pass", 7, ""),
        (-1, "pass", 1, "There is not enough memory: the workbench's programs need 384 MiB to start; this process"),
        (1, "raise MemoryError", 1, "There is not enough memory (MemoryError); this process may have 385 MiB"),
    ],
)
def test_a_program_that_cannot_be_imported_for_want_of_memory_says_so(
    more: int, loading: str, status: int, said: str
) -> None:
    done = run(START.format(more=more, loading=loading))
    assert (done.returncode, done.stdout) == (status, "") and done.stderr.startswith(said)
    assert done.stderr.count("\n") == (1 if said else 0)


def test_another_failed_import_is_none() -> None:
    assert (
        "ModuleNotFoundError: No module named 'nowhere'" in run(START.format(more=1, loading="import nowhere")).stderr
    )
