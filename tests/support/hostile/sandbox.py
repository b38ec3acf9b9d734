"""Run a command in a process of its own under limits, and judge how it ended."""

import os
import resource
import shutil
import signal
import sys
import time
import traceback
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

MEMORY = 2 << 30  # bytes beyond what the warm process has
PATIENCE = 60.0  # [s]
OUT = "out"  # the one folder that a command may write into
CANARIES = ("sitecustomize", "ensurepip", "evil", "std_msgs", "motor_msgs")  # packages beside the input
RAN = "ran"
Main = Callable[[list[str]], int]


@dataclass(frozen=True)
class Verdict:
    """How an input ended; `faults` are words such as `traceback`, none where all is well."""

    status: int
    seconds: float
    megabytes: float
    faults: tuple[str, ...]
    said: str  # the end of what it said on stderr
    busy: float = 0.0  # [s] of a processor


def prepare(folder: Path) -> None:
    """Make the folder, with packages that tell when somebody imports or runs them."""
    (folder / OUT).mkdir(parents=True)
    for package in CANARIES:
        (folder / package).mkdir()
        for module in ("__init__", "__main__"):
            (folder / package / f"{module}.py").write_text(f"open({str(folder / RAN)!r}, 'w').close()\n")


def run(main: Main, words: list[str], folder: Path, interrupt: float = 0.0) -> Verdict:
    """Run a command in the prepared folder; `interrupt` sends SIGINT after so many seconds to what would not end."""
    before = _files(folder)
    began = time.monotonic()
    sys.stdout.flush()
    child = os.fork()
    if child == 0:
        _child(main, words, folder)
    status, usage, late = _ended(child, began, interrupt)
    seconds = time.monotonic() - began
    said = _read(folder / "err")
    faults = _faults(status, said, late, interrupt)
    if usage.ru_maxrss > (MEMORY >> 10):
        faults.append("memory")
    if _files(folder) != before:
        faults.append("files")
    if (folder / RAN).exists():
        faults.append("code")
    return Verdict(status, seconds, usage.ru_maxrss / 1024, tuple(faults), said[-400:], usage.ru_utime + usage.ru_stime)


def _child(main: Main, words: list[str], folder: Path) -> None:
    """In the new process: never returns."""
    status = 70
    try:
        os.setsid()
        os.chdir(folder)
        for number, name in ((1, "out.txt"), (2, "err")):
            os.dup2(os.open(folder / name, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), number)
        os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
        sys.stdout = os.fdopen(1, "w", closefd=False)
        sys.stderr = os.fdopen(2, "w", closefd=False, buffering=1, errors="backslashreplace")  # as Python opens it
        os.environ.update(HOME=str(folder / OUT), ROS_LOG_DIR=str(folder / OUT / "log"))
        sys.path.insert(0, "")  # as an empty entry of PYTHONPATH does
        begun = sys.modules["__main__"].__dict__  # what a node starts is not to begin as this process did
        begun.update(__spec__=None)
        begun.pop("__file__", None)
        signal.signal(signal.SIGINT, signal.default_int_handler)
        size = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (size + MEMORY, size + MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        status = main(words)
    except SystemExit as end:
        status = end.code if isinstance(end.code, int) else int(end.code is not None)
    except BaseException:
        traceback.print_exc()
    finally:
        try:
            sys.stdout.flush()
            sys.stderr.flush()
        finally:
            os._exit(status or 0)


def _ended(child: int, began: float, interrupt: float) -> tuple[int, resource.struct_rusage, bool]:
    while True:
        pid, code, usage = os.wait4(child, os.WNOHANG)
        if pid:
            return os.waitstatus_to_exitcode(code), usage, False
        spent = time.monotonic() - began
        if spent > PATIENCE:
            os.killpg(child, signal.SIGKILL)
            _, code, usage = os.wait4(child, 0)
            return os.waitstatus_to_exitcode(code), usage, True
        if interrupt and spent > interrupt:
            interrupt = spent + 1.0
            os.kill(child, signal.SIGINT)
        time.sleep(0.002 if spent < 0.1 else 0.02)


def _faults(status: int, said: str, late: bool, interrupt: float) -> list[str]:
    faults = []
    if late:
        faults.append("hang")
    elif status < 0 or status not in (0, 1, 2, *((130,) if interrupt else ())):
        faults.append(f"status {status}")
    if "Traceback (most recent call last)" in said or status == 70:
        faults.append("traceback")
    if "mistake of the workbench" in said:
        faults.append("internal error")
    lines = [line for line in said.splitlines() if line.strip() and not line.startswith(("usage:", "[", " "))]
    if status == 1 and not (1 <= len(lines) <= 6):
        faults.append("no sentence" if not lines else "a flood of words")
    return faults


def _files(folder: Path) -> dict[str, tuple[int, int]]:
    """Everything outside of `out`, with size and time of its last change, and what lies beside the folder."""
    ours = {"err", "out.txt", RAN}
    found = {}
    for path in [*folder.rglob("*"), *folder.parent.iterdir()]:
        name = path.relative_to(folder.parent).as_posix()
        if path.name in ours or "__pycache__" in path.parts or f"{folder.name}/{OUT}" in name or path == folder:
            continue
        state = path.lstat()
        found[name] = (state.st_size if path.is_file() else 0, state.st_mtime_ns if path.is_file() else 0)
    return found


def _read(path: Path) -> str:
    return path.read_text(encoding="utf-8", errors="replace") if path.exists() else ""


def clear(folder: Path) -> None:
    """Remove the folder."""
    shutil.rmtree(folder, ignore_errors=True)
