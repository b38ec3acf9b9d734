"""Parse the command line of an executable: a short usage, --version, completion by TAB."""

import argparse
import os
from collections.abc import Callable, Iterable, Sequence
from typing import Any, NoReturn

from motor_model.printable import escape


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
