"""What a command prints may hold anybody's names, and steers no terminal."""

import io
import os
import sys

import pytest

from motor_ros.terminal import EscapedStream, escaped_output


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("a table\n\tand ω\r\n", "a table\n\tand ω\r\n"),
        ("\r\x1b[K50 %\x1b[A", "\r\x1b[K50 %\x1b[A"),  # a progress bar
        ("\x1b[2Jgone\x07", r"\x1b[2Jgone\x07"),
        ("\x1b]0;title\x1b\\", r"\x1b]0;title\x1b" + "\\"),
        (os.fsdecode(b"bag\xff\n"), "bag\\xff\n"),
        ("", ""),
    ],
)
def test_control_characters_are_shown_and_progress_bars_work(text: str, shown: str) -> None:
    stream = io.StringIO()
    EscapedStream(stream).write(text)
    assert stream.getvalue() == shown


def test_what_the_terminal_cannot_show_is_no_error(monkeypatch: pytest.MonkeyPatch) -> None:
    raw = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(raw, encoding="ascii", write_through=True))
    monkeypatch.setattr(sys, "stderr", None)  # closed
    with escaped_output():
        print("10 rad/s, ω")
        print("nobody reads this", file=sys.stderr)
    assert raw.getvalue() == b"10 rad/s, \\u03c9\n" and sys.stderr is None
