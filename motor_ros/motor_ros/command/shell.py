"""Run a command's work: an error is one sentence on stderr and an exit status, and Ctrl-C no traceback."""

import os
import signal
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from types import FrameType

from motor_model.errors import MotorError
from motor_model.program.entry_point import is_interrupted_import
from motor_model.program.internal_error import report
from motor_ros.terminal import CLEAR, OutputLost, escaped_output

INTERRUPTED = 130  # exit status after Ctrl-C


def shell(work: Callable[[], int]) -> int:
    """Run a command's work and return its exit status: 1 with a sentence where it fails, 130 after Ctrl-C.

    A MotorError has its sentence; what nobody foresaw says that it is the workbench's mistake, and where its log is.
    """
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:  # so a script's `command &` starts; `kill -INT` is meant
        signal.signal(signal.SIGINT, signal.default_int_handler)
    if signal.getsignal(signal.SIGTERM) == signal.SIG_DFL:  # what is half done is taken back then, too
        signal.signal(signal.SIGTERM, signal.default_int_handler)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT, signal.SIGTERM})  # who started us may hold them back
    with escaped_output(), warnings.catch_warnings():
        if not sys.warnoptions:  # what NumPy says of odd numbers is no sentence for users
            warnings.simplefilter("ignore", RuntimeWarning)
        try:
            status = work()
            sys.stdout.flush()
            return status
        except OutputLost as error:
            _drop_output()
            print(error, file=sys.stderr)
            return 1
        except MotorError as error:
            print(error, file=sys.stderr)
            return 1
        except BrokenPipeError:  # nobody reads any further, as behind `| head`
            _drop_output()
            return 0
        except KeyboardInterrupt:
            return _interrupted()
        except Exception as error:
            if is_interrupted_import(error):
                return _interrupted()
            of_ros = type(error).__name__ in ("RCLError", "RMWError")  # without importing rclpy, which takes a while
            said = f"ROS 2 refuses ({error})." if of_ros else _capitalized(report(error))
            print(" ".join(said.split()), file=sys.stderr)
            return 1


def _interrupted() -> int:
    print(f"{CLEAR if sys.stderr.isatty() else ''}Interrupted.", file=sys.stderr)
    return INTERRUPTED


def _drop_output() -> None:
    """Have what is still to be shown go nowhere: Python would try again at its end."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _capitalized(error: MotorError) -> str:
    text = str(error)
    return text[:1].upper() + text[1:]


@contextmanager
def ended_by_interrupt(sentence: str) -> Iterator[None]:
    """Within, Ctrl-C or SIGTERM says a sentence and ends the process at once (130): for computing, without open files.

    A KeyboardInterrupt would not do: where Numba calls back through ctypes it is printed as a traceback and lost, and
    threads that compute would hold the process until they are done.
    """

    def end(number: int, frame: FrameType | None) -> None:
        with suppress(RuntimeError, OSError, MotorError):  # the signal may have come amidst a write: it ends here, too
            sys.stdout.flush()
        os.write(sys.stderr.fileno(), f"{CLEAR if sys.stderr.isatty() else ''}{sentence}\n".encode())
        os._exit(INTERRUPTED)

    before = {number: signal.signal(number, end) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
