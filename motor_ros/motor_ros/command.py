"""What the commands share: an error is one sentence on stderr, and Ctrl-C no traceback."""

import argparse
import os
import signal
import sys
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from math import inf, nan
from shutil import get_terminal_size
from types import FrameType
from typing import Any, NoReturn

from motor_model.errors import MotorError
from motor_model.printable import escape
from motor_model.program.entry_point import is_interrupted_import
from motor_model.program.internal_error import report
from motor_ros.terminal import OutputLost, escaped_output

INTERRUPTED = 130  # exit status after Ctrl-C
_CLEAR = "\r\x1b[K"  # the line of a terminal


class CommandParser(argparse.ArgumentParser):
    """The command line of one executable of a package: its options and `--version`, with completion by TAB.

    Actions may have an attribute `completer` (see `argcomplete`): what their values can be.
    """

    def __init__(self, package: str, prog: str, description: str, epilog: str = "") -> None:
        self._package = package
        super().__init__(prog=prog, description=description, epilog=epilog, formatter_class=_Formatter)
        self.add_argument("--version", action=_Version, package=package, help="print the version and exit")

    def _get_formatter(self) -> "_Formatter":
        """As it has to be typed, with what has to be said; the options are listed below it."""
        return _Formatter(f"ros2 run {self._package} {self.prog} [options]")

    def error(self, message: str) -> NoReturn:
        """Say what is wrong with the command line; what was typed, or pasted, steers no terminal."""
        super().error(escape(message, longest=0))

    def parse_args(self, *args: Any, **named: Any) -> Any:
        """As argparse does; where the shell asks what could come next, answer that and exit."""
        if "_ARGCOMPLETE" in os.environ:
            from argcomplete import autocomplete

            autocomplete(self, always_complete_options=False)
        return super().parse_args(*args, **named)


class _Formatter(argparse.HelpFormatter):
    """Keeps the lines of a text that has several, such as a table, and fills a paragraph; a usage is one short line."""

    def add_usage(self, usage: Any, actions: Iterable[argparse.Action], groups: Any, prefix: Any = None) -> None:
        required = [action for action in actions if action.required or not action.option_strings]
        super().add_usage(usage, required, (), prefix)

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        if "\n" in text:
            return "".join(f"{indent}{line}" for line in text.splitlines(keepends=True))
        return super()._fill_text(text, width, indent)


class _Version(argparse.Action):
    """Looks the version up only where somebody asks for it."""

    def __init__(self, package: str, **named: Any) -> None:
        super().__init__(nargs=0, default=argparse.SUPPRESS, **named)
        self._package = package

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        from importlib.metadata import version

        print(f"{parser.prog} {version(self._package)}")
        parser.exit()


def listed_names(names: Sequence[str]) -> Callable[..., list[str]]:
    """Return a completer for names in a list with commas."""

    def complete(prefix: str, **_: object) -> list[str]:
        before, comma, _begun = prefix.rpartition(",")
        taken = before.split(",")
        return [f"{before}{comma}{name}" for name in names if name not in taken]

    return complete


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
    print(f"{_CLEAR if sys.stderr.isatty() else ''}Interrupted.", file=sys.stderr)
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
        os.write(sys.stderr.fileno(), f"{_CLEAR if sys.stderr.isatty() else ''}{sentence}\n".encode())
        os._exit(INTERRUPTED)

    before = {number: signal.signal(number, end) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def positive(text: str) -> float:
    """Return a number above 0, as an argparse type."""
    number = _number(text)
    if not 0.0 < number < inf:
        raise argparse.ArgumentTypeError(f"{text} is not a number above 0")
    return number


def not_negative(text: str) -> float:
    """Return a number that is 0 or more, as an argparse type."""
    number = _number(text)
    if not 0.0 <= number < inf:
        raise argparse.ArgumentTypeError(f"{text} is not a number from 0 on")
    return number


def between(low: float, high: float) -> Callable[[str], float]:
    """Return an argparse type: a number from `low` to `high`."""

    def take(text: str) -> float:
        number = _number(text)
        if not low <= number <= high:
            raise argparse.ArgumentTypeError(f"{text} is not a number from {low:g} to {high:g}")
        return number

    return take


def whole_between(low: int, high: int) -> Callable[[str], int]:
    """Return an argparse type: a whole number from `low` to `high`."""

    def take(text: str) -> int:
        if not text.removeprefix("-").isdecimal() or not low <= int(text) <= high:
            raise argparse.ArgumentTypeError(f"{text} is not a whole number from {low} to {high}")
        return int(text)

    return take


def _number(text: str) -> float:
    """NaN, which is in no range, where the text is no number."""
    try:
        return float(text)
    except ValueError:
        return nan


def in_place(line: str) -> None:
    """Replace the last line of a terminal; a file or a pipe gets nothing."""
    if sys.stdout.isatty():
        width = get_terminal_size().columns - 1
        print(f"{_CLEAR}{line if len(line) <= width else line[: width - 1] + '…'}", end="", flush=True)
