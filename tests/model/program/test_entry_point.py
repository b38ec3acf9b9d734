"""Ctrl-C while a program imports: it is gone at once and says nothing, also where the signal was held back."""

import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from motor_model.program.entry_point import is_interrupted_import

ROOT = Path(__file__).resolve().parents[3]
SLOW = """
import os, signal, sys, time
from motor_model.program.entry_point import entry_point, hold_interrupt_back
{before}
@entry_point
def slow():
    '''What it does.'''
    {loading}
    return main
def main():
    {running}
    return 7
sys.exit(slow())
"""
INTERRUPT = "os.kill(os.getpid(), signal.SIGINT)"
HEARD = f"""try:
        {INTERRUPT}; time.sleep(60)
    except KeyboardInterrupt: print('heard')"""


def ended(before: str = "", loading: str = "pass", running: str = "pass") -> tuple[int, str, str]:
    script = SLOW.format(before=before, loading=loading, running=running)
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    return done.returncode, done.stdout, done.stderr


@pytest.mark.parametrize(
    ("places", "status", "said"),
    [
        ({}, 7, ""),
        ({"loading": f"{INTERRUPT}; time.sleep(60)"}, -signal.SIGINT, ""),
        ({"running": HEARD}, 7, "heard\n"),  # once it runs it is the program's own
        ({"before": f"hold_interrupt_back(); {INTERRUPT}; print('held', flush=True)"}, -signal.SIGINT, "held\n"),
        ({"before": "signal.signal(signal.SIGINT, signal.SIG_IGN)", "loading": INTERRUPT}, 7, ""),  # a script's `&`
    ],
)
def test_an_interrupt_ends_the_imports_silently(places: dict[str, str], status: int, said: str) -> None:
    assert ended(**places) == (status, said, "")


def test_a_failed_import_is_an_interrupt_where_one_was_the_cause() -> None:
    failed = ImportError("initialization failed")
    assert not is_interrupted_import(failed)
    failed.__cause__ = SystemError()
    failed.__cause__.__context__ = KeyboardInterrupt()
    assert is_interrupted_import(failed)
    other = ValueError()
    other.__cause__ = KeyboardInterrupt()
    assert not is_interrupted_import(other)


@pytest.mark.parametrize("path", sorted(ROOT.glob("motor_*/setup.py")), ids=lambda path: path.parent.name)
def test_every_executable_starts_so(path: Path) -> None:
    package = path.parent.name
    entries = re.findall(r'"(\w+) = ([\w.]+):(\w+)"', path.read_text(encoding="utf-8"))
    assert all(entry == (name, f"{package}.programs", name) for name, *_ in entries for entry in [(name, *_)])
    if entries:
        programs = (path.parent / package / "programs.py").read_text(encoding="utf-8")
        assert re.findall(r"@entry_point\ndef (\w+)\(\) -> Main:", programs) == [name for name, *_ in entries]
