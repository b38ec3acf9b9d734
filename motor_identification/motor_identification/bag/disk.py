"""What a disk refuses, in one sentence: full, write-protected, not ours, or broken."""

import errno
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from motor_model.errors import RecordingError

_CURES = {
    **dict.fromkeys((errno.ENOSPC, errno.EDQUOT, errno.EFBIG), "make room, or choose another place"),
    **dict.fromkeys((errno.EACCES, errno.EPERM, errno.EROFS), "choose a place that you may write to"),
}


@contextmanager
def told(path: Path) -> Iterator[None]:
    """Whatever the disk refuses inside, as a RecordingError."""
    try:
        yield
    except OSError as error:
        raise refused(path, error) from error


def refused(path: Path, error: OSError, rest: str = "") -> RecordingError:
    """Return what was refused, what to do, and the rest of the sentence."""
    cure = _CURES.get(error.errno or 0, "choose another place")
    return RecordingError(f"{path} cannot be written ({error.strerror}): {cure}{rest}.")
