"""What an archive of a workbook says of its sizes is not believed: what is read of it is counted."""

import zipfile
from pathlib import Path

import pytest

from motor_identification.logs.formats import workbook_parts
from motor_identification.logs.formats.workbook_parts import Workbook, name_of
from motor_model.errors import RecordingError


def opened(tmp_path: Path, content: str | bytes) -> Workbook:
    path = tmp_path / "a.xlsx"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("part", content)
    return Workbook(path, zipfile.ZipFile(path))


def rows_of(book: Workbook) -> list[str]:
    return [row.get("r", "") for row in book.elements("part", "row")]


def test_elements_come_one_by_one_and_nothing_before_them_is_kept(tmp_path: Path) -> None:
    rows = "".join(f'<row r="{k}"><c/><c/></row>' for k in range(50))
    book = opened(tmp_path, f'<a xmlns="x"><b><d/></b><s>{rows}</s><e/></a>')
    assert "part" in book and "other" not in book
    inside = [len(list(row.iter())) for row in book.elements("part", "row")]
    assert inside == [3] * 50 and rows_of(book) == [str(k) for k in range(50)]
    assert name_of(book.parse("part")) == "a"


@pytest.mark.parametrize(
    ("content", "kept"),
    [
        ("<a><s>" + "<row><c/></row>" * 50 + "</s></a>", 4),  # a, s, row, c
        ("<a><s>" + "<row><c/><c/><c/></row>" * 50 + "</s></a>", 6),
        ("<a><s>" + "<x/>" * 9 + "<row/>" * 50 + "</s></a>", 12),  # what stands before the first row
        ("<a>" + "<b><x/><x/></b><s><row/></s>" * 10 + "</a>", 42),  # that beside the rows is never forgotten
        ("<a>" + "<b>" * 20 + "</b>" * 20 + "</a>", 21),
    ],
)
def test_no_more_elements_than_that_are_kept_at_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, content: str, kept: int
) -> None:
    monkeypatch.setattr(workbook_parts, "MOST_ELEMENTS", kept)
    rows_of(opened(tmp_path, content))
    monkeypatch.setattr(workbook_parts, "MOST_ELEMENTS", kept - 1)
    with pytest.raises(RecordingError, match=f"has more than {kept - 1} elements in a row of part, or beside its rows"):
        rows_of(opened(tmp_path, content))


@pytest.mark.parametrize(
    ("name", "most", "words"),
    [("MOST_ROWS", 2, "2 rows"), ("MOST_CELLS", 6, "0 million cells"), ("MOST_BYTES", 14, "0 MiB of text")],
)
def test_lines_are_counted_in_every_way(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, most: int, words: str
) -> None:
    for limit, refused in ((most, False), (most - 1, True)):
        book = opened(tmp_path, "<a/>")
        monkeypatch.setattr(workbook_parts, name, limit)
        book.count_line(7, 3)
        if refused:
            with pytest.raises(RecordingError, match="more than"):
                book.count_line(7, 3)
        else:
            book.count_line(7, 3)
    with pytest.raises(RecordingError, match=f"has more than {words}: save the sheet with the table as CSV"):
        monkeypatch.setattr(workbook_parts, name, most)
        book.count_line(7, 3)


def test_parts_are_read_up_to_their_limits(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    book = opened(tmp_path, "<a/>" + " " * 96)
    monkeypatch.setattr(workbook_parts, "MOST_OF_SMALL", 100)
    monkeypatch.setattr(workbook_parts, "MOST_IN_ALL", 300)
    for _ in range(3):
        book.parse("part")
    with pytest.raises(RecordingError, match="0 MiB in all its parts"):
        book.parse("part")
    monkeypatch.setattr(workbook_parts, "MOST_OF_SMALL", 99)
    with pytest.raises(RecordingError, match="0 MiB in part"):
        book.parse("part")


ENTITY = '<!DOCTYPE a [<!ENTITY b "x">]><a>&b;</a>'


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (ENTITY, "declares entities"),
        (ENTITY.encode("utf-16"), "not in UTF-8"),
        (ENTITY.encode("utf-16-be"), "not in UTF-8"),
        (b'<?xml version="1.0" encoding="cp037"?>' + ENTITY.encode("cp037"), "not in UTF-8"),
        (b"<?xml version='1.0' encoding = 'iso-8859-1'?><a>\xe9</a>", "not in UTF-8"),
    ],
)
def test_entities_are_refused_in_whatever_encoding(tmp_path: Path, content: str | bytes, words: str) -> None:
    with pytest.raises(RecordingError, match=words):
        opened(tmp_path, content).parse("part")


@pytest.mark.parametrize(
    "head", ["", '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\r\n', "<?xml version='1.0'?>"]
)
def test_parts_in_utf_8_are_read(tmp_path: Path, head: str) -> None:
    assert opened(tmp_path, f"{head}<a>ω encoding='x'</a>").parse("part").text == "ω encoding='x'"


@pytest.mark.parametrize(
    ("kind", "taken"),
    [(zipfile.ZIP_STORED, True), (zipfile.ZIP_DEFLATED, True), (zipfile.ZIP_LZMA, False), (zipfile.ZIP_BZIP2, False)],
)
def test_workbooks_are_packed_as_excel_packs_them(tmp_path: Path, kind: int, taken: bool) -> None:
    """A damaged LZMA stream raised what nobody foresaw."""
    with zipfile.ZipFile(tmp_path / "a.xlsx", "w", kind) as archive:
        archive.writestr("part", "<a/>")
    book = Workbook(tmp_path / "a.xlsx", zipfile.ZipFile(tmp_path / "a.xlsx"))
    if taken:
        assert book.parse("part").tag == "a"
    else:
        with pytest.raises(RecordingError, match="is packed in a way that workbooks are not"):
            book.parse("part")
