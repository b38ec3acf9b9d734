"""Processes of our Python programs that are forked instead of started anew; see `fork_server.py`."""

import contextlib
import json
import os
import select
import socket
import subprocess
import sys
import tempfile
from functools import cache
from pathlib import Path
from typing import Any

LOST = 1 << 8  # the status of a failure: its supervising process was killed, and nobody can tell how it ended
SERVER = Path(__file__).with_name("fork_server.py")
SHARED = "MOTOR_TESTS_FORK_SERVER"  # where the workers of xdist find theirs: in a directory that is this user's alone


@cache
def server() -> socket.socket:
    """Start the process that forks, or ask the workers' one for a fork; it ends with this process of the tests."""
    if path := os.environ.get(SHARED):
        asked = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        asked.connect(path)
        return asked
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    subprocess.Popen([sys.executable, str(SERVER), str(theirs.fileno())], pass_fds=[theirs.fileno()])
    theirs.close()
    return ours


@cache
def share_server() -> tuple[socket.socket, "tempfile.TemporaryDirectory[str]"]:
    """Start one process that forks for all workers of this one; what is returned keeps it and its socket there."""
    place = tempfile.TemporaryDirectory(prefix="fork_server_")
    path = str(Path(place.name) / "socket")
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    listener = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    with contextlib.suppress(OSError), listener, theirs:  # a path may be too long: every worker then has its own
        listener.bind(path)
        listener.listen()
        files = [listener.fileno(), theirs.fileno()]
        subprocess.Popen([sys.executable, str(SERVER), *map(str, files)], pass_fds=files)
        os.environ[SHARED] = path
    return ours, place


class Forked(subprocess.Popen[str]):
    """A `Popen` of a Python file; its parent is not this process, so that its end is told by a pipe."""

    _told: int  # the pipe

    def _execute_child(self, args: Any, _executable: Any, _preexec: Any, _close: Any, _keep: Any, *more: Any) -> None:
        cwd, env, _, _, _, *pipes = more[:11]  # the child's and our end of input, our and the child's of output, error
        stdin, stdout, stderr = pipes[0], pipes[3], pipes[5]
        assert stdout >= 0 and stderr >= 0, "output and error are pipes"
        request = {"words": list(args), "env": dict(env or os.environ), "cwd": str(cwd or os.getcwd())}
        self._told, theirs = os.pipe()
        with open(os.devnull, "rb") as nothing:
            files = [stdin if stdin >= 0 else nothing.fileno(), stdout, stderr, theirs]
            socket.send_fds(server(), [json.dumps(request).encode()], files)
        os.close(theirs)
        self._close_pipe_fds(*pipes)  # type: ignore[attr-defined]
        told = os.read(self._told, 4)
        assert len(told) == 4, "the process that forks has ended"
        self.pid, self._child_created = int.from_bytes(told, "little"), True

    def _try_wait(self, flags: int) -> tuple[int, int]:
        if flags & os.WNOHANG and not select.select([self._told], [], [], 0.0)[0]:
            return 0, 0
        status = os.read(self._told, 4)
        os.close(self._told)
        return self.pid, int.from_bytes(status, "little") if len(status) == 4 else LOST

    def _internal_poll(self, _deadstate: int | None = None) -> int | None:
        if self.returncode is None and self._waitpid_lock.acquire(False):  # type: ignore[attr-defined]
            try:
                pid, status = self._try_wait(os.WNOHANG) if self.returncode is None else (0, 0)
                if pid:
                    self._handle_exitstatus(status)  # type: ignore[attr-defined]
            finally:
                self._waitpid_lock.release()  # type: ignore[attr-defined]
        return self.returncode
