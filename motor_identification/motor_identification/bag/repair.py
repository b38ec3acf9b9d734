"""Writes the `metadata.yaml` that a crash left unwritten, from what the files hold."""

import fcntl
from contextlib import suppress
from pathlib import Path

from motor_identification.bag.disk import told
from motor_identification.bag.metadata import FILE_NAME, bag_metadata, write_metadata
from motor_identification.bag.storage import Bag

_STORAGES = {".mcap": "mcap", ".db3": "sqlite3"}


def repair(uri: str | Path) -> bool:
    """Write the missing `metadata.yaml` of a bag, so that `ros2 bag info` and `ros2 bag play` take it; whether it did.

    A bag that has one, a single file, a compressed bag, and a bag that is still being recorded are left as they are.

    Raises:
        RecordingError: no such bag, not a bag, or its directory cannot be written.
    """
    path, bag = Path(uri), Bag(uri)
    storages = {file.suffix for file in bag.files}
    if not path.is_dir() or (path / FILE_NAME).exists() or len(storages) > 1 or not storages <= set(_STORAGES):
        return False
    if bag.compressed or any(map(_being_written, bag.files)):
        return False
    metadata = bag_metadata({file.name: bag.contents_of(file) for file in bag.files}, _STORAGES[storages.pop()])
    with told(path):
        write_metadata(path, metadata)
    return True


def _being_written(file: Path) -> bool:
    with file.open("rb") as stream, suppress(OSError):
        try:
            fcntl.flock(stream, fcntl.LOCK_SH | fcntl.LOCK_NB)
        except BlockingIOError:
            return True
    return False
