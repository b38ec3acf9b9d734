"""What a disk refuses, in one sentence: full, write-protected, not ours, or broken."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from motor_model.errors import RecordingError
from motor_model.regular_file import say_refusal


@contextmanager
def told(path: Path) -> Iterator[None]:
    """Whatever the disk refuses inside, as a RecordingError."""
    try:
        yield
    except OSError as error:
        raise refused(path, error) from error


def refused(path: Path, error: OSError, rest: str = "") -> RecordingError:
    """Return what was refused, what to do, and the rest of the sentence."""
    return RecordingError(f"{path} cannot be written {say_refusal(error)}{rest}.")
