"""Tell an error that means that memory was not enough, and say what to do about it.

Python says MemoryError, NumPy a kind of it; but where the loader finds no room for a library that is an ImportError or
an OSError with words of its own, and of a thread a RuntimeError. OpenBLAS says nothing: without room for its buffer it
asks again for ever, and hears no Ctrl-C meanwhile. So who is about to compute asks for room first.
"""

import errno
import mmap
import resource
from collections.abc import Iterator

from motor_model.errors import MotorError

WORDS = ("failed to map segment", "cannot allocate memory", "can't start new thread", "failed to start worker thread")
# What the interpreter itself says where even its own error finds no room; only where memory is limited is it believed.
LOST_WORDS = "returned NULL without setting an exception", "error return without exception set"
MIB = 2**20
LEAST = 384 * MIB  # [bytes] of addresses, below which none of the programs gets through its imports: 300 to 350 MiB


class NotEnoughMemory(MotorError):
    """There is not enough memory for what was asked for."""


def lacks_memory(error: BaseException) -> bool:
    """Tell whether an error, or what led to it, says that there was no memory left."""
    return any(_says_so(one) for one in _chain(error))


def explain(error: BaseException) -> NotEnoughMemory:
    """Say that memory was not enough, how much there may be, and what to do."""
    one = next((one for one in _chain(error) if _says_so(one)), error)
    what = f"{type(one).__name__}: {one}".rstrip(": ")
    return _sentence(f" ({what})")


def ask_for_room(room: int) -> None:
    """See that there is room [bytes] to compute in, where this process may not have as much memory as it wants.

    Raises:
        NotEnoughMemory: there is not.
    """
    if _limit() is None:
        return
    try:
        mmap.mmap(-1, room).close()
    except OSError as error:
        raise _sentence(f": {room / MIB:.0f} MiB are needed beside what is in use") from error


def refuse_to_start() -> str:
    """Say why there is no use in starting, as a sentence; "" where there is."""
    limit = _limit()
    needed = f": the workbench's programs need {LEAST / MIB:.0f} MiB to start"
    return "" if limit is None or limit >= LEAST else str(_sentence(needed))


def _sentence(what: str) -> NotEnoughMemory:
    limit = _limit()
    may = "" if limit is None else f"; this process may have {limit / MIB:.0f} MiB (ulimit -v)"
    return NotEnoughMemory(
        f"There is not enough memory{what}{may}: raise the limit, close other programs, or take a shorter recording."
    )


def _limit() -> int | None:
    """[bytes] of addresses that this process may have; None: any number."""
    soft = resource.getrlimit(resource.RLIMIT_AS)[0]
    return None if soft == resource.RLIM_INFINITY else soft


def _says_so(error: BaseException) -> bool:
    if isinstance(error, MemoryError) or (isinstance(error, OSError) and error.errno == errno.ENOMEM):
        return True
    words = str(error).lower()
    if isinstance(error, ImportError | OSError | RuntimeError) and any(word in words for word in WORDS):
        return True
    return isinstance(error, SystemError) and _limit() is not None and any(one.lower() in words for one in LOST_WORDS)


def _chain(error: BaseException) -> Iterator[BaseException]:
    """Follow an error to what led to it."""
    one: BaseException | None = error
    while one is not None:
        yield one
        one = one.__cause__ or one.__context__
