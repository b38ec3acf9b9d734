"""Makes the directory of a new bag: nothing that exists is touched, but a bag that may be replaced."""

import fcntl
import shutil
from contextlib import suppress
from io import BufferedWriter
from pathlib import Path

from motor_identification.bag.disk import told
from motor_model.errors import RecordingError

EXISTS = "{} exists already and is left as it is: choose another name, or replace it with --force."
STORAGE = (".mcap", ".db3")


def check_new_bag(path: Path, replace: bool = False) -> None:
    """Refuse a path at which something exists, unless it is a bag that may be replaced.

    Raises:
        RecordingError: something is there.
    """
    if not (path.exists() or path.is_symlink()):
        return
    if not replace:
        raise RecordingError(EXISTS.format(path))
    if not path.is_dir() or path.is_symlink() or not all(map(_belongs_to_a_bag, path.iterdir())):
        raise RecordingError(f"{path} is not a bag and is left as it is: choose another name.")


def _belongs_to_a_bag(path: Path) -> bool:
    return path.is_file() and (path.name == "metadata.yaml" or any(suffix in STORAGE for suffix in path.suffixes))


def create_bag(path: Path, replace: bool) -> BufferedWriter:
    """Create a bag's directory and the file in it, open and locked.

    Raises:
        RecordingError: something is there already, or it cannot be created.
    """
    with told(path):
        check_new_bag(path, replace)
        if path.exists():
            shutil.rmtree(path)
        path.mkdir(parents=True)
        stream = (path / f"{path.resolve().name}_0.mcap").open("xb")
    with suppress(OSError):  # some file systems have no locks; `repair` must not take it for one that a crash left
        fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
    return stream
