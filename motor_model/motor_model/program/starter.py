"""End with the program that started this one: what a launch that is killed leaves behind would drive a motor for ever.

The launch files of the workbench name their process in the environment of what they start. Its end is heard as that of
a file (`pidfd_open`, Linux 5.3), whoever else is in between and whatever ends it.
"""

import os
import select
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from threading import Thread
from time import sleep

from motor_model.errors import MotorError

LOOK_EVERY = 0.05  # [s] where nothing tells of an end
STARTER = "MOTOR_WORKBENCH_STARTER"  # the process that a program ends with


def read_starter(environment: Mapping[str, str]) -> int | None:
    """Read which process a program ends with; None where it was started alone.

    Raises:
        MotorError: it is no process.
    """
    text = environment.get(STARTER, "")
    if not text:
        return None
    if not (text.isascii() and text.isdigit() and 0 < int(text) < 2**31):
        raise MotorError(f"{STARTER} is '{text}', which is no process: unset it; only a launch file sets it.")
    return int(text)


def watch_starter(process: int, ended: Callable[[], None]) -> None:
    """Call `ended` from a thread of its own once a process has ended, or at once where it has."""

    def wait() -> None:
        _wait_for_end(process)
        ended()

    Thread(target=wait, name="starter", daemon=True).start()


def _wait_for_end(process: int) -> None:
    try:
        handle = os.pidfd_open(process)
    except ProcessLookupError:
        return
    except OSError:  # a kernel, or a container, that knows no such files
        while _is_there(process):
            sleep(LOOK_EVERY)
        return
    heard = select.poll()  # of any number, where `select` knows the first thousand
    heard.register(handle, select.POLLIN)
    with suppress(OSError):
        heard.poll()
    os.close(handle)


def _is_there(process: int) -> bool:
    """Whether a process goes on; one that has ended and that nobody has asked about since does not."""
    try:
        said = Path(f"/proc/{process}/stat").read_bytes()
    except OSError:
        return False
    return said.rpartition(b")")[2].split()[:1] not in ([b"Z"], [b"X"])
