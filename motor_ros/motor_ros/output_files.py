"""Files that commands write: nothing that exists is replaced, unless the user says --force."""

import argparse
import os
from collections.abc import Iterable
from pathlib import Path

from motor_model.errors import MotorError

EXISTS = "{} exists already and is left as it is: choose another name, or replace it with --force."


def add_force_option(parser: argparse.ArgumentParser) -> None:
    """Add `--force` to a command that writes."""
    parser.add_argument("--force", action="store_true", help="replace what exists already (default: refuse)")


def check_outputs(files: Iterable[str | Path], force: bool, made: str | Path | None = None) -> None:
    """Refuse before anything is computed what could not be written afterwards, or would replace what is there.

    made: a directory that the command makes, with those above it.

    Raises:
        MotorError: a file exists already and `force` is false, or its directory cannot be written to.
    """
    for path in map(Path, files):
        try:
            _check(path, force, made)
        except OSError as error:  # such as a name of more than 255 characters
            raise MotorError(f"cannot write {path} ({error.strerror}): choose another name.") from error


def _check(path: Path, force: bool, made: str | Path | None) -> None:
    directory = path.parent
    if made is not None and directory == Path(made):
        directory = next(parent for parent in path.absolute().parents if parent.exists())
    if not directory.is_dir() or not os.access(directory, os.W_OK) or path.is_dir():
        raise MotorError(f"cannot write {path}: name a file in a directory that exists and can be written to.")
    if path.exists() and not force:
        raise MotorError(EXISTS.format(path))
