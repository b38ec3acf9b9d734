"""Building and flashing: what reaches a board, and the sentences of whoever lacks something."""

import pytest

from motor_board.cli.flash import main

Capture = pytest.CaptureFixture[str]


def test_without_the_compiler_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch, capsys: Capture) -> None:
    monkeypatch.setenv("PATH", "/nowhere")
    assert main(["--build"]) == 1
    said = capsys.readouterr().err
    assert said.startswith("avr-gcc is not installed: sudo apt install gcc-avr avr-libc") and said.count("\n") == 1
