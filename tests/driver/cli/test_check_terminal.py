"""The terminal of `check`: what it waits for."""

import argparse
import os
import select
import sys
from typing import Any

import pytest

from motor_driver.check.settings import Settings
from motor_driver.cli import _check_terminal as terminal


def test_a_terminal_that_has_ended_is_not_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    """An end of input is ready for ever: to wait for it is not to wait."""
    board, port = os.openpty()
    waited: list[bool] = []
    inner = select.select

    def watch(readers: list[Any], *others: Any) -> Any:
        waited.append(sys.stdin in readers)
        return inner(readers, *others)

    options = argparse.Namespace(decay="brake", baud=500_000, silent_pwm=False)
    with open(os.devnull, encoding="utf-8") as ended, terminal._interruptible() as interrupt:
        monkeypatch.setattr(sys, "stdin", ended)
        monkeypatch.setattr(terminal.select, "select", watch)
        one = terminal._Terminal(options, Settings(hand=True), os.ttyname(port), interrupt)
        for _ in range(3):
            one._step()
        one._port.close()
    os.close(board)
    os.close(port)
    assert waited == [True, False, False]
