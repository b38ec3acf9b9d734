"""A program that is run in a fork: how it ended is told, and where nobody can tell, that is a failure."""

import os
import signal
import socket
import subprocess
import time
from pathlib import Path

import forked
import pytest
from domains import free_domain
from forked import Forked
from patience import PATIENCE

SHOWN = "import sys, rclpy\nrclpy.init(domain_id=int(sys.argv[1]))\nnode = rclpy.create_node('shown')\n"
MAPPED = "print(*{line.split()[-1] for line in open('/proc/self/maps') if '/dev/shm/fastrtps_' in line}, sep='\\n')\n"
ENDED = "node.destroy_node()\nrclpy.shutdown()\n"


def run(file: Path, *words: str, stdin: int | None = None) -> Forked:
    return Forked([str(file), *words], stdin=stdin, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


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


def test_a_program_says_its_last_words(tmp_path: Path) -> None:
    """Its modules are not taken apart; what was to be done at its end is, and what was printed is written."""
    file = tmp_path / "program.py"
    file.write_text("import atexit\natexit.register(print, 'last words')\nraise SystemExit(3)\n")
    with run(file) as program:
        assert program.communicate(timeout=PATIENCE) == ("last words\n", "") and program.returncode == 3


def test_a_program_whose_words_nobody_takes_ends_as_pythons_do(tmp_path: Path) -> None:
    file = tmp_path / "program.py"
    file.write_text("input()\nprint('to nobody')\n")
    with run(file, stdin=subprocess.PIPE) as program:
        assert program.stdin is not None and program.stdout is not None and program.stderr is not None
        program.stdout.close()
        program.stdin.write("\n")
        program.stdin.flush()
        assert program.wait(PATIENCE) == 120 and "BrokenPipeError" in program.stderr.read()


@pytest.mark.skipif(not Path("/proc/self/maps").exists(), reason="what a process maps is read from Linux's /proc")
@pytest.mark.parametrize("more", ["", ENDED], ids=["lost", "ended"])
def test_a_node_that_ends_leaves_no_shared_memory(tmp_path: Path, more: str) -> None:
    file = tmp_path / "program.py"
    file.write_text(SHOWN + MAPPED + more)
    with run(file, str(free_domain())) as program:
        out, _ = program.communicate(timeout=PATIENCE)
        assert program.returncode == 0
    mapped = [Path(line) for line in out.splitlines() if "fastrtps_port" not in line]
    assert mapped and [path for path in mapped if path.exists()] == []


@pytest.mark.slow
def test_processes_of_tests_share_one_that_imports_and_end_with_who_began_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(forked.SHARED, "")
    owner, place = forked.share_server.__wrapped__()
    file = tmp_path / "program.py"
    file.write_text("print('ran')\n")
    connect = forked.server.__wrapped__
    for _ in range(2):
        with connect() as asked:
            monkeypatch.setattr(forked, "server", lambda asked=asked: asked)  # as the cache would
            with run(file) as program:
                assert program.communicate(timeout=PATIENCE) == ("ran\n", "") and program.returncode == 0
    owner.close()
    end = time.monotonic() + PATIENCE
    while can_connect(os.environ[forked.SHARED]):
        assert time.monotonic() < end, "it goes on without its owner"
        time.sleep(0.01)
    place.cleanup()


def can_connect(path: str) -> bool:
    with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as asked:
        return asked.connect_ex(path) == 0
