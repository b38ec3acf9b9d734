"""Undo what `ros2 bag record --compression-mode` has done: files, or the messages in them, compressed by Zstandard."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import BinaryIO

import zstandard

from motor_identification.bag.mcap.file import LARGEST_BAG
from motor_identification.bag.mcap.records import LARGEST_RATIO, LARGEST_RECORD, SMALL, unpack_zstd
from motor_model.errors import RecordingError

COMPRESSED = ".zstd"  # what ros2 bag appends to a file's name
_ZSTD_MAGIC = b"\x28\xb5\x2f\xfd"  # of a compressed message; CDR starts with a zero byte


def plain_name(path: Path) -> str:
    """Return what a file is called before it is compressed."""
    return path.name.removesuffix(COMPRESSED)


@contextmanager
def decompress_file(path: Path) -> Iterator[Path]:
    """Yield where a file is that was decompressed if it had to be; gone afterwards.

    Raises:
        RecordingError: it is damaged, or unpacks to more than there is room for.
    """
    if path.suffix != COMPRESSED:
        yield path
        return
    with TemporaryDirectory() as folder:
        plain = Path(folder) / plain_name(path)
        try:
            with path.open("rb") as source, plain.open("wb") as target:
                _unpack_file(source, target, path)
        except zstandard.ZstdError as error:
            raise RecordingError(f"{path} cannot be decompressed ({error}): restore it from a copy.") from error
        yield plain


def is_compressed(data: bytes) -> bool:
    """Tell whether a message is compressed."""
    return data[:4] == _ZSTD_MAGIC


def decompress_message(data: bytes) -> bytes:
    """Decompress a message; empty where it cannot be decompressed, which is then no message of its type."""
    try:
        plain = unpack_zstd(data, LARGEST_RECORD)
    except zstandard.ZstdError:
        return b""
    return plain if len(plain) <= LARGEST_RECORD else b""


def _unpack_file(source: BinaryIO, target: BinaryIO, path: Path) -> None:
    """Decompress as far as it goes, but no more than a bag can have, and never the last of the disk."""
    most = min(LARGEST_BAG, shutil.disk_usage(Path(target.name).parent).free // 2)
    most = min(most, max(SMALL, LARGEST_RATIO * path.stat().st_size))
    for part in zstandard.ZstdDecompressor().read_to_iter(source, write_size=1 << 20):
        target.write(part)
        if target.tell() > most:
            raise RecordingError(f"{path} unpacks to more than {most / 2**20:.0f} MiB: split it, or make room.")
