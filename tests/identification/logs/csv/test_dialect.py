"""How a text table is written: separators, decimal signs, comments, headers, rows of units."""

from pathlib import Path

import pytest

from motor_identification.logs.csv.dialect import find_dialect, read_text
from motor_model.errors import RecordingError

ROWS = [("0.0", "1.5", "2"), ("0.02", "1.5", "3"), ("0.04", "-2", "4.25")]


def written(delimiter: str, comma: bool, *before: str) -> list[str]:
    rows = [delimiter.join(row) for row in ROWS]
    return [*before, *(row.replace(".", ",") if comma else row for row in rows)]


@pytest.mark.parametrize(
    ("delimiter", "comma"),
    [(",", False), (";", False), (";", True), ("\t", False), ("\t", True), ("|", True), (" ", False), (" ", True)],
)
def test_the_delimiter_and_the_decimal_sign(delimiter: str, comma: bool) -> None:
    found = find_dialect(written(delimiter, comma, delimiter.join("tuy")))
    assert found is not None
    assert (found.delimiter, found.decimal_comma, found.header, found.first_row) == (
        delimiter,
        comma,
        ("t", "u", "y"),
        1,
    )


def test_what_comes_before_the_rows() -> None:
    for before, header in (
        ((), ("column 1", "column 2", "column 3")),
        (("# t,u,y",), ("t", "u", "y")),
        (("Logger 3.1", "", "% made on 2026-05-01", "t,u,y"), ("t", "u", "y")),
        (("t,u,y", "s,V,deg/s"), ("t [s]", "u [V]", "y [deg/s]")),
        (("t,u,y", "[ms],[V],[rpm]"), ("t [ms]", "u [V]", "y [rpm]")),
    ):
        found = find_dialect(written(",", False, *before))
        assert found is not None and found.header == header, before
        assert found.named == bool(before)


@pytest.mark.parametrize("text", ["", "hello", "a,b\nc,d\n", "1\n2\n3\n"])
def test_what_is_no_table(text: str) -> None:
    assert find_dialect(text.split("\n")) is None


def test_encodings(tmp_path: Path) -> None:
    for text, encoding, told in (
        ("t,ω\n", "utf-8", ""),
        ("t,ω\n", "utf-8-sig", ""),
        ("t,µ\n", "latin-1", "Latin-1"),
        ("t,ω\n", "utf-16", "UTF-16"),
    ):
        (tmp_path / "log.csv").write_bytes(text.encode(encoding))
        assert read_text(tmp_path / "log.csv") == (text, told)


def test_what_is_no_file_to_read(tmp_path: Path) -> None:
    import os

    os.mkfifo(tmp_path / "pipe")
    for path, complaint in ((tmp_path / "none", "There is no file"), (tmp_path / "pipe", "is not a regular file")):
        with pytest.raises(RecordingError, match=complaint):
            read_text(path)
    with pytest.raises(RecordingError, match="is not a regular file"):
        read_text(Path("/dev/zero"))
    sparse = tmp_path / "large.csv"
    with sparse.open("wb") as file:
        file.truncate(2**30 + 1)
    with pytest.raises(RecordingError, match="has 1024 MiB, and 1024 MiB is the most: cut it"):
        read_text(sparse)


@pytest.mark.parametrize(
    ("cell", "comma"), [('"0,06"', True), ('"1682182517,903"', True), ('"1,234"', False), ("6", False)]
)
def test_commas_in_quotes_are_decimal_where_they_mark_no_thousands(cell: str, comma: bool) -> None:
    found = find_dialect(["t,u,y", *(f'"{k}",{cell},7' for k in range(5))])
    assert found is not None and (found.delimiter, found.decimal_comma) == (",", comma)


def test_names_of_columns_may_be_numbers() -> None:
    """As an oscilloscope writes them: its channels, and then their units."""
    rows = [f"{k / 1e3},{0.012 * k},{0.6 + k}" for k in range(8)]
    found = find_dialect(["x-axis,1,2", "second,Volt,Volt", *rows])
    channels = ("x-axis [second]", "channel 1 [Volt]", "channel 2 [Volt]")
    assert found is not None and (found.first_row, found.header) == (2, channels)
    single = find_dialect(["x-axis,1,2", *rows])
    assert single is not None and single.first_row == 1
    words = find_dialect([f"{k},run,{k}" for k in range(8)])  # a column of words
    assert words is not None and words.first_row == 0
    mixed = find_dialect([f"{k},{'run' if k < 2 else 7},{k}" for k in range(8)])
    assert mixed is not None and mixed.first_row == 0
    garbled = find_dialect(["t,u,y", "0,x,1", *rows])  # told when it is left out
    assert garbled is not None and garbled.first_row == 1
