"""Run Python files in forks of a process that has what they need: most of a short process's time is imports.

What is asked for comes over a socket, see `forked.Forked`: words, environment and directory, with file descriptors for
standard input, output, error, and a pipe that is told the process's number and, in the end, its status. Workers of
xdist have one process that imports, and each a fork of it that serves.
"""

import atexit
import contextlib
import ctypes
import gc
import importlib
import importlib.util
import inspect
import json
import os
import runpy
import select
import signal
import socket
import sys
import threading
import time
from collections.abc import Sequence
from pathlib import Path

import motor_control.warm_up
import motor_identification.service.warm_up  # before what may load NumPy: they keep BLAS to one thread

PR_SET_PDEATHSIG = 1  # a signal to the child when its parent ends (prctl, Linux)

# What programs import, rclpy and its libraries too.
IMPORTED = (
    "motor_identification.monitoring.evaluation",
    "motor_control.controller.controller",
    "motor_control.preparation",
    "motor_driver.driver",
    "motor_driver.link",
    "motor_examples.diff_drive.drive",
    "motor_identification.experiment",
    "motor_identification.service.fit_queue",
    "motor_model.sensing.board",
    "motor_model.sensing.motion_check",
    "diagnostic_msgs.msg",
    "motor_msgs.msg",
    "motor_msgs.srv",
    "sensor_msgs.msg",
    "std_srvs.srv",
    "motor_control.node",
    "motor_driver.node",
    "motor_identification.live.experiment_node",
    "motor_identification.live.playback",
    "motor_identification.live.recorder",
    "motor_sim.node",
)


def main(sock: socket.socket, owner: socket.socket | None) -> str:
    """Fork for whoever asks, until nobody can any more; returns in the fork, with the file to run.

    With an owner, the socket is one that listens, for as long as that process is there.
    """
    for module in IMPORTED:
        importlib.import_module(module)
    for module in ("motor_msgs", "rcl_interfaces", "std_msgs", "std_srvs", "diagnostic_msgs"):
        load_type_support(module)
    load_type_support("sensor_msgs", "JointState")
    inspect.getmodule(sys._getframe())  # as rclpy does for its first log line: through all that is imported
    motor_control.warm_up.main()
    motor_identification.service.warm_up.prepare()
    wait_for_sleep()
    gc.collect()
    gc.freeze()
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    if owner is not None:
        sock = accept_clients(sock, owner)
    while True:
        data, files, _, _ = socket.recv_fds(sock, 1 << 20, 4)
        if not data:
            os._exit(0)
        if os.fork() == 0:
            sock.close()
            supervise(files)
            return become(json.loads(data), files)
        for file in files:
            os.close(file)


def load_type_support(package: str, name: str = "") -> None:
    """Load what rclpy loads for the messages and services of a package, or for one, when they are first used."""
    from rclpy.type_support import check_for_type_support

    for kinds in ("msg", "srv"):
        if importlib.util.find_spec(f"{package}.{kinds}") is not None:
            for kind in vars(importlib.import_module(f"{package}.{kinds}")).values():
                if isinstance(kind, type) and name in ("", kind.__name__):
                    check_for_type_support(kind)


def accept_clients(listener: socket.socket, owner: socket.socket) -> socket.socket:
    """Fork for every process of tests that connects, until the owner has ended; returns in the fork."""
    while True:
        if owner in select.select([listener, owner], [], [])[0]:
            os._exit(0)
        client, _ = listener.accept()
        if os.fork() == 0:
            listener.close()
            owner.close()
            return client
        client.close()


def wait_for_sleep() -> None:
    """Wait until no thread but this one does anything: what a fork cuts off amidst something is never done.

    The libraries of rclpy start two: LTTng's, which wait for somebody to trace this process, and hold nothing.
    """
    own, end = str(threading.get_native_id()), time.monotonic() + 10.0
    while True:
        others = [task for task in Path("/proc/self/task").iterdir() if task.name != own]
        assert len(others) <= 2, "a process with threads of its own must not be forked"
        if all((task / "stat").read_text().rpartition(")")[2].split()[0] == "S" for task in others):
            return
        assert time.monotonic() < end, "a thread does not rest"
        time.sleep(0.01)


def supervise(files: list[int]) -> None:
    """Fork once more, and wait for that process; returns in it."""
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    end_with_parent()
    pipe = files.pop()
    child = os.fork()
    if child == 0:
        end_with_parent()
        os.close(pipe)
        return
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for file in (0, 1, 2, *files):
        os.close(file)
    os.write(pipe, child.to_bytes(4, "little"))
    os.write(pipe, os.waitpid(child, 0)[1].to_bytes(4, "little"))
    os._exit(0)


def end_with_parent() -> None:
    """Have Linux kill this process when its parent ends: nodes outlived a process of the tests that was killed."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, int(signal.SIGKILL))


def become(request: dict[str, object], files: Sequence[int]) -> str:
    """Take on words, environment, directory, and standard input, output and error; returns the file to run."""
    for target, file in enumerate(files):
        os.dup2(file, target)
        os.close(file)
    os.environ.clear()
    os.environ.update(request["env"])  # type: ignore[call-overload]
    time.tzset()
    os.chdir(str(request["cwd"]))
    signal.signal(signal.SIGINT, signal.default_int_handler)
    sys.stdin = sys.__stdin__ = open(0, encoding="utf-8", closefd=False)  # noqa: SIM115
    sys.stdout = sys.__stdout__ = open(1, "w", encoding="utf-8", closefd=False)  # noqa: SIM115
    sys.stderr = sys.__stderr__ = open(  # noqa: SIM115
        2, "w", buffering=1, encoding="utf-8", errors="backslashreplace", closefd=False
    )
    sys.argv = list(request["words"])  # type: ignore[call-overload]
    sys.path[0] = str(Path(sys.argv[0]).parent)
    return sys.argv[0]


def end_at_once(status: int) -> None:
    """End as Python does but for taking all modules apart, which was a third of what a short process computes.

    What DDS shares with others is given back with the context of ROS.
    """
    threading._shutdown()  # type: ignore[attr-defined]
    atexit._run_exitfuncs()
    if (ros := sys.modules.get("rclpy.utilities")) is not None:
        ros.g_default_context = None  # type: ignore[attr-defined]
        gc.collect()
    sys.stdout.flush()  # where that fails, Python is left to end, and to say so
    sys.stderr.flush()
    os._exit(status)


def run_file(path: str) -> None:
    """Run it as a program; whatever else it ends by than a number, Python's own end tells of it."""
    try:
        runpy.run_path(path, run_name="__main__")
    except SystemExit as end:
        if end.code is not None and not isinstance(end.code, int):
            raise
        status = int(end.code or 0) & 0xFF
    else:
        status = 0
    with contextlib.suppress(OSError, ValueError):  # standard output may be closed
        end_at_once(status)
    sys.exit(status)


if __name__ == "__main__":
    given = [socket.socket(fileno=int(word)) for word in sys.argv[1:]]
    run_file(main(given[0], given[1] if len(given) > 1 else None))
