"""What the commands share: an error is one sentence on stderr, and Ctrl-C no traceback."""

import argparse
import os
import signal
import sys
from collections.abc import Callable
from shutil import get_terminal_size

from motor_model.errors import MotorError


def shell(work: Callable[[], int]) -> int:
    """Run a command's work and return its exit status: 1 with the sentence of a MotorError, 130 after Ctrl-C."""
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:  # so a script's `command &` starts; `kill -INT` is meant
        signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        status = work()
        sys.stdout.flush()
        return status
    except MotorError as error:
        print(error, file=sys.stderr)
        return 1
    except BrokenPipeError:  # nobody reads any further, as behind `| head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except KeyboardInterrupt:
        return 130


def positive(text: str) -> float:
    """A number above 0, as an argparse type."""
    number = float(text)
    if not 0.0 < number < float("inf"):
        raise argparse.ArgumentTypeError(f"{text} is not a number above 0")
    return number


def not_negative(text: str) -> float:
    """A number that is 0 or more, as an argparse type."""
    number = float(text)
    if not 0.0 <= number < float("inf"):
        raise argparse.ArgumentTypeError(f"{text} is not 0 or more")
    return number


def in_place(line: str) -> None:
    """Replace the last line of a terminal; a file or a pipe gets nothing."""
    if sys.stdout.isatty():
        width = get_terminal_size().columns - 1
        print(f"\r\x1b[K{line if len(line) <= width else line[: width - 1] + '…'}", end="", flush=True)
