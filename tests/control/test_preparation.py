"""Preparing in a thread: once, done in the end, and the interpreter's own interval is as it was."""

import sys
import time

from motor_control.preparation import Preparation


def test_beside_a_loop() -> None:
    interval, preparation = sys.getswitchinterval(), Preparation()
    assert not preparation.done
    preparation.begin()
    preparation.begin()
    deadline = time.monotonic() + 120.0
    while not preparation.done and time.monotonic() < deadline:
        time.sleep(0.01)
    assert preparation.done
    while sys.getswitchinterval() != interval and time.monotonic() < deadline:
        time.sleep(0.01)
    assert sys.getswitchinterval() == interval
