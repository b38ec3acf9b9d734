"""Make the kernel kill processes for want of memory: a control group of them, and of one that eats."""

import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

ROOT = Path("/sys/fs/cgroup")
ROOM = 64 << 20  # [bytes]
FIRST = "1000"  # the score of those that are to be killed
EATER = """
import pathlib, sys, time
(pathlib.Path(sys.argv[1]) / "cgroup.procs").write_text("0")
eaten = []
while True:
    eaten.append(b"x" * (1 << 20))
    time.sleep(0.001)
"""


@contextmanager
def memory_group(processes: Sequence[int]) -> Iterator[Path]:
    """A group that has ROOM and holds these processes; needs the rights of root.

    Raises:
        OSError: this machine has no such groups, or we may not make one.
    """
    old = ROOT / "memory"  # version 1 has a tree for each resource
    group = Path(tempfile.mkdtemp(prefix="motor_workbench_", dir=old if old.is_dir() else ROOT))
    try:
        limit = group / ("memory.limit_in_bytes" if old.is_dir() else "memory.max")
        limit.write_text(str(ROOM))
        if not old.is_dir():
            with suppress(OSError):
                (group / "memory.swap.max").write_text("0")
        for process in processes:
            Path(f"/proc/{process}/oom_score_adj").write_text(FIRST)
            (group / "cgroup.procs").write_text(str(process))
        yield group
    finally:
        for process in (group / "cgroup.procs").read_text().split():
            (group.parent / "cgroup.procs").write_text(process)
        group.rmdir()


@contextmanager
def eat_until_dead(group: Path) -> Iterator[None]:
    """A process of the group that takes its memory, until the end."""
    eater = subprocess.Popen([sys.executable, "-c", EATER, str(group)], env={**os.environ, "PYTHONPATH": ""})
    try:
        yield
    finally:
        eater.kill()
        eater.wait()
