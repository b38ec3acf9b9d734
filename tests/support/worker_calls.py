"""What a worker process is asked to do in its tests: they stand in a file that the process can import."""

import os
import threading
from collections.abc import Callable

from motor_model.errors import RecordingError

Progress = Callable[..., None]
Stopped = Callable[[], bool]


def nothing() -> None:
    """A preparation."""


def add(a: int, b: int) -> int:
    return a + b


def process() -> int:
    return os.getpid()


def count(to: int, progress: Progress, stopped: Stopped) -> int:
    """Tells each number, the last ones from other threads at the same time."""
    threads = [threading.Thread(target=progress, args=("counted", k)) for k in range(to)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return to


def obey(progress: Progress, stopped: Stopped) -> None:
    """Computes until it is told to stop, and says then that it has heard."""
    progress("begun")
    while not stopped():
        pass
    raise RecordingError("stopped by itself.")


def ignore(progress: Progress, stopped: Stopped) -> None:
    """Computes for ever."""
    progress("begun")
    threading.Event().wait()


def refuse() -> None:
    raise RecordingError("the motor never moves.")


def stumble() -> float:
    return 1.0 / 0


def vanish() -> None:
    os._exit(3)


def unsendable() -> object:
    return threading.Lock()
