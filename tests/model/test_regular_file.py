"""Files are read within bounds, and replaced at once or not at all."""

import errno
import os
import resource
from pathlib import Path

import pytest

from motor_model.regular_file import Unfit, check_regular, read_bytes, say_refusal, write_bytes, write_text


def test_what_is_written_is_read(tmp_path: Path) -> None:
    write_text(tmp_path / "a", "ω")
    assert read_bytes(tmp_path / "a", 2) == "ω".encode()
    assert [path.name for path in tmp_path.iterdir()] == ["a"]
    mask = os.umask(0o027)
    try:
        write_bytes(tmp_path / "b", b"")
    finally:
        os.umask(mask)
    assert (tmp_path / "b").stat().st_mode & 0o777 == 0o640
    write_text(tmp_path / "c", os.fsdecode(b"\xff"))
    assert (tmp_path / "c").read_text() == r"\udcff"


def test_a_failure_leaves_the_file_that_was_there(tmp_path: Path) -> None:
    """As on a full disk: no file may grow beyond a kilobyte."""
    path = tmp_path / "model.yaml"
    path.write_text("good")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1024, before[1]))
    try:
        with pytest.raises(OSError, match="File too large"):
            write_bytes(path, bytes(4096))
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert path.read_text() == "good" and list(tmp_path.iterdir()) == [path]


def test_links_and_permissions_stay(tmp_path: Path) -> None:
    (tmp_path / "real").write_text("old")
    (tmp_path / "real").chmod(0o600)
    (tmp_path / "link").symlink_to("real")
    write_text(tmp_path / "link", "new")
    assert (tmp_path / "link").is_symlink() and (tmp_path / "real").read_text() == "new"
    assert (tmp_path / "real").stat().st_mode & 0o777 == 0o600


def test_a_device_is_written_to_as_it_is() -> None:
    write_text("/dev/null", "x")
    with pytest.raises(OSError, match="No space left"):
        write_text("/dev/full", "x")


@pytest.mark.parametrize(
    ("number", "cure"),
    [
        (errno.ENOSPC, "make room, or choose another place"),
        (errno.EROFS, "choose a place that you may write to"),
        (errno.ENOENT, "choose a directory that exists"),
        (errno.EIO, "choose another place"),
    ],
)
def test_what_a_disk_refuses_has_a_cure(number: int, cure: str) -> None:
    error = OSError(number, os.strerror(number))
    assert say_refusal(error) == f"({os.strerror(number)}): {cure}"


def test_what_blocks_or_never_ends_is_refused(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    for path in (tmp_path / "pipe", Path("/dev/zero"), tmp_path):
        with pytest.raises(Unfit, match="is no regular file"):
            read_bytes(path, 10)
        with pytest.raises(Unfit, match="is no regular file"):
            check_regular(path)
    (tmp_path / "loop").symlink_to("loop")
    with pytest.raises(OSError, match="Too many levels"):
        read_bytes(tmp_path / "loop", 10)


def test_the_limit_is_the_largest_that_is_read(tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(bytes(2**20))
    assert len(read_bytes(tmp_path / "file", 2**20)) == 2**20
    (tmp_path / "file").write_bytes(bytes(2**20 + 1))
    with pytest.raises(Unfit, match=r"is larger than 1 MiB"):
        read_bytes(tmp_path / "file", 2**20)


def test_a_name_with_a_nul_in_it_is_a_sentence(tmp_path: Path) -> None:
    with pytest.raises(Unfit, match="NUL"):
        read_bytes(f"{tmp_path}/model\0.yaml", 10)
