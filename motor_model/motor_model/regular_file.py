"""Read and write regular files whole: reading is bounded, and writing replaces a file at once or not at all."""

import errno
import os
import stat
import tempfile
from contextlib import suppress
from pathlib import Path

from motor_model.errors import MotorError

_CURES = {
    **dict.fromkeys((errno.ENOSPC, errno.EDQUOT, errno.EFBIG), "make room, or choose another place"),
    **dict.fromkeys((errno.EACCES, errno.EPERM, errno.EROFS), "choose a place that you may write to"),
    **dict.fromkeys((errno.ENOENT, errno.ENOTDIR), "choose a directory that exists"),
}


class Unfit(MotorError):
    """A file that is no regular one, or larger than anything it could be."""


def check_regular(path: str | Path) -> None:
    """Refuse what would block or never end: a pipe, a device, a socket.

    Raises:
        OSError: there is nothing that can be looked at.
        Unfit: it is no regular file.
    """
    if "\0" in str(path):
        raise Unfit(f"{str(path)!r} is no file's name: a NUL character ends it; correct it.")
    if not stat.S_ISREG(os.stat(path).st_mode):
        raise Unfit(f"{path} is no regular file: name a file on a disk.")


def read_bytes(path: str | Path, most: int) -> bytes:
    """Read a regular file of `most` bytes at most.

    Raises:
        OSError: it cannot be read.
        Unfit: it is no regular file, or larger.
    """
    check_regular(path)
    # Without O_NONBLOCK, a pipe that has taken the file's place meanwhile would hold us.
    with open(os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC), "rb") as file:
        content = file.read(most + 1)
    if len(content) > most:
        raise Unfit(f"{path} is larger than {most / 2**20:g} MiB, the most that such a file may have.")
    return content


def write_bytes(path: str | Path, content: bytes) -> None:
    """Write a file beside, and give it the name when all of it is on the disk: a failure leaves what was there.

    A link stays one, permissions stay; a device or a pipe, which nothing can replace, is written to as it is.

    Raises:
        OSError: it cannot be written.
    """
    target = Path(os.path.realpath(path))
    mode = _mode(target)
    if mode is not None and not stat.S_ISREG(mode):
        with target.open("wb") as file:
            file.write(content)
        return
    number, beside = tempfile.mkstemp(dir=target.parent, prefix=".unfinished-")
    try:
        with open(number, "wb") as file:
            file.write(content)
            file.flush()
            os.fchmod(file.fileno(), _usual_mode() if mode is None else stat.S_IMODE(mode))
            os.fsync(file.fileno())
        os.replace(beside, target)
    except BaseException:
        with suppress(OSError):
            os.unlink(beside)
        raise
    _keep_name(target.parent)


def write_text(path: str | Path, text: str) -> None:
    """Write text as UTF-8, as `write_bytes` does; what is no Unicode, such as a name in bytes, becomes its escape.

    Raises:
        OSError: it cannot be written.
    """
    write_bytes(path, text.encode("utf-8", errors="backslashreplace"))


def say_refusal(error: OSError) -> str:
    """Say what a disk refuses, and what to do, for the end of a sentence: `(No space left on device): make room, …`."""
    return f"({error.strerror}): {_CURES.get(error.errno or 0, 'choose another place')}"


def _mode(path: Path) -> int | None:
    try:
        return path.stat().st_mode
    except FileNotFoundError:
        return None


def _usual_mode() -> int:
    """What `open` would give a new file; the mask can only be read by setting it."""
    mask = os.umask(0o077)
    os.umask(mask)
    return 0o666 & ~mask


def _keep_name(directory: Path) -> None:
    """Have the disk keep the new name, too, where the file system can."""
    with suppress(OSError):
        number = os.open(directory, os.O_RDONLY | os.O_DIRECTORY)
        try:
            os.fsync(number)
        finally:
            os.close(number)
