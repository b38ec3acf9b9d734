"""A program that is run in a fork: how it ended is told, and where nobody can tell, that is a failure."""

import os
import signal
import subprocess
from pathlib import Path

import pytest
from forked import Forked
from patience import PATIENCE


def run(file: Path) -> Forked:
    return Forked([str(file)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="the parent's number is read from Linux's /proc")
def test_a_program_whose_supervising_process_is_killed_has_failed_and_ends(tmp_path: Path) -> None:
    """It passed for a success, and ran on."""
    file = tmp_path / "program.py"
    file.write_text("import time\nprint('begun', flush=True)\ntime.sleep(600)\n")
    with run(file) as program:
        assert program.stdout is not None and program.stdout.readline() == "begun\n"
        parent = int(Path(f"/proc/{program.pid}/stat").read_text().rpartition(")")[2].split()[1])
        assert parent != os.getpid()
        os.kill(parent, signal.SIGKILL)
        program.communicate(timeout=PATIENCE)  # both pipes are closed: it has ended
        assert program.returncode == 1


def test_a_programs_own_status_is_told(tmp_path: Path) -> None:
    file = tmp_path / "program.py"
    file.write_text("raise SystemExit(3)\n")
    with run(file) as program:
        assert program.wait(PATIENCE) == 3
