"""What is printed steers no terminal: names in bags and logs may be anybody's."""

import os
import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from shutil import get_terminal_size
from typing import Any, TextIO

from motor_model.errors import MotorError
from motor_model.printable import escape

CLEAR = "\r\x1b[K"  # the line of a terminal
# Line ends, tabs, and what progress bars need: to the line's beginning, clear the rest of it, one line up.
_OURS = re.compile(r"(\r?\n|\r|\t|\x1b\[[KA])")


class OutputLost(MotorError):
    """What was to be shown could not be written, such as to /dev/full."""


@contextmanager
def _lost() -> Iterator[None]:
    try:
        yield
    except BrokenPipeError:  # who read has gone: no mistake
        raise
    except OSError as error:
        raise OutputLost(f"what was to be shown could not be written ({error.strerror}); files were.") from error


class EscapedStream:
    """A text stream that shows control characters, and bytes that are no text, as their escapes."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def write(self, text: str) -> int:
        """Write the text so that it can be shown."""
        if not text.isprintable():
            text = "".join(part if _OURS.fullmatch(part) else escape(part, longest=0) for part in _OURS.split(text))
        encoding = self._stream.encoding or "utf-8"
        with _lost():
            return self._stream.write(text.encode(encoding, errors="backslashreplace").decode(encoding))
        return 0

    def flush(self) -> None:
        """Have it written now."""
        with _lost():
            self._stream.flush()

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


@contextmanager
def escaped_output() -> Iterator[None]:
    """Within, what is printed is escaped; a stream that was closed swallows it."""
    before = sys.stdout, sys.stderr
    with open(os.devnull, "w", encoding="utf-8") as nowhere:
        sys.stdout, sys.stderr = (EscapedStream(stream or nowhere) for stream in before)
        try:
            yield
        finally:
            sys.stdout, sys.stderr = before


def in_place(line: str) -> None:
    """Replace the last line of a terminal; a file or a pipe gets nothing."""
    if sys.stdout.isatty():
        width = get_terminal_size().columns - 1
        print(f"{CLEAR}{line if len(line) <= width else line[: width - 1] + '…'}", end="", flush=True)
