"""YAML that strangers wrote is plain values, or a sentence; never gigabytes or minutes."""

import os
from pathlib import Path

import pytest

from motor_model.errors import MotorError
from motor_model.yaml_file import DEEPEST, LARGEST, NotYaml, parse, read

BOMB = "a: &a [x,x,x,x,x,x,x,x,x]\n" + "".join(
    f"{name}: &{name} [{','.join([f'*{before}'] * 9)}]\n" for before, name in zip("abcdefgh", "bcdefghi", strict=True)
)
MERGES = "a: &a {x: 1}\nb: {<<: *a}\n"
REFUSED = {
    "aliases of aliases": (BOMB, r"has an alias"),
    "merges": (MERGES, r"has an alias"),
    "deep": ("[" * (DEEPEST + 1) + "]" * (DEEPEST + 1), "nested deeper than 50"),
    "very deep": ("[" * 5000, "nested deeper than 50"),
    "large": ("x" * (LARGEST + 1), "larger than 1 MiB"),
    "digits": ("a: 1" + "0" * 1000, "a number of 1001 characters"),
    "sixties": ("a: 1" + ":10" * 100_000, "a number of 300001 characters"),
    "code": ("!!python/object/apply:os.getcwd []", "is not YAML"),
    "no number": ("!!int x", "is not YAML"),
    "no map": ("!!map [1]", "is not YAML"),
    "no date": ("2026-99-99", "is not YAML"),
    "a key that is a list": ("? [1]\n: 2", "is not YAML"),
    "not closed": ("a: [", "is not YAML .*line 2"),
    "control characters": ("a: \x00", "is not YAML"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_refused_says_why(name: str) -> None:
    text, why = REFUSED[name]
    with pytest.raises(NotYaml, match=why):
        parse(text)


def test_what_anybody_would_write_is_taken() -> None:
    assert parse("[" * DEEPEST + "]" * DEEPEST)
    assert parse("a: 1" + "0" * 999) == {"a": 10**999}
    assert len(parse(f"a: '{'1' * (LARGEST - 10)}'")["a"]) == LARGEST - 10  # a text, however long
    assert parse("a: {b: [1, 2.5, yes, 2026-11-22, null]}\nc: &anchor text") is not None
    assert parse("") is None


def test_files(tmp_path: Path) -> None:
    (tmp_path / "good").write_text("a: ω", encoding="utf-8")
    assert read(tmp_path / "good") == {"a": "ω"}
    (tmp_path / "bytes").write_bytes(b"\xff\xfe")
    (tmp_path / "large").write_bytes(b"#" * (LARGEST + 1))
    os.mkfifo(tmp_path / "pipe")
    for name in ("bytes", "large", "pipe"):
        with pytest.raises(MotorError):
            read(tmp_path / name)
    with pytest.raises(FileNotFoundError):
        read(tmp_path / "none")
