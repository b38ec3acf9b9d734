"""Say of an error that nobody foresaw that it is the workbench's own, and keep its traceback for whoever mends it."""

import os
import time
import traceback
from pathlib import Path

from motor_model.errors import MotorError
from motor_model.program.memory import explain, lacks_memory


class InternalError(MotorError):
    """A mistake of the workbench: what it was, where its log is, and how to report it."""


def report(error: BaseException) -> MotorError:
    """Write the traceback to a log of its own, and return the sentence that a user reads; want of memory is no mistake.

    It has no log, which would want memory, too.
    """
    if lacks_memory(error):
        return explain(error)
    what = traceback.format_exception_only(error)[-1].strip()
    try:
        where = f"the log is {_write(''.join(traceback.format_exception(error)))}"
    except OSError as refused:
        where = f"no log could be written ({refused.strerror})"
    return InternalError(
        f"this is a mistake of the workbench, not yours ({what}); {where}: please report it with what you did, "
        "as CONTRIBUTING.md says."
    )


def log_directory() -> Path:
    """Return where ROS 2 keeps its logs."""
    if own := os.environ.get("ROS_LOG_DIR"):
        return Path(own)
    return Path(os.environ.get("ROS_HOME") or Path.home() / ".ros") / "log"


def _write(text: str) -> Path:
    directory = log_directory()
    directory.mkdir(parents=True, exist_ok=True)
    path = directory / f"motor_workbench_{time.strftime('%Y-%m-%d-%H-%M-%S')}_{os.getpid()}.log"
    with path.open("a", encoding="utf-8", errors="backslashreplace") as file:
        file.write(text)
    return path
