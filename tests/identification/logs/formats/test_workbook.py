"""Workbooks of Excel, made part by part."""

import zipfile
from pathlib import Path

import pytest

from motor_identification.logs.columns.said import Said
from motor_identification.logs.formats import workbook, workbook_parts
from motor_identification.logs.formats.workbook import read_workbook
from motor_identification.logs.imported import import_log
from motor_model.errors import RecordingError

MAIN = 'xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"'
RELATION = 'xmlns:r="http://schemas.openxmlformats.org/officeDocument/2006/relationships"'
STYLES = (
    f'<styleSheet {MAIN}><numFmts><numFmt numFmtId="170" formatCode="&quot;day&quot; 0.0"/>'
    '<numFmt numFmtId="171" formatCode="mm:ss.000"/></numFmts><cellXfs><xf numFmtId="0"/><xf numFmtId="22"/>'
    '<xf numFmtId="170"/><xf numFmtId="171"/></cellXfs></styleSheet>'
)


def sheet(*rows: str) -> str:
    """A sheet of rows, each of cells as they stand in the file."""
    return f"<worksheet {MAIN}><sheetData>{''.join(f'<row>{row}</row>' for row in rows)}</sheetData></worksheet>"


def numbers(*rows: tuple[float, ...]) -> list[str]:
    return ["".join(f"<c><v>{value!r}</v></c>" for value in row) for row in rows]


def write(path: Path, texts: tuple[str, ...] = (), **sheets: str) -> Path:
    named = "".join(f'<sheet name="{name}" r:id="rId{k}"/>' for k, name in enumerate(sheets))
    relations = "".join(f'<Relationship Id="rId{k}" Target="worksheets/s{k}.xml"/>' for k in range(len(sheets)))
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("[Content_Types].xml", "<Types/>")
        archive.writestr("xl/workbook.xml", f"<workbook {MAIN} {RELATION}><sheets>{named}</sheets></workbook>")
        archive.writestr("xl/_rels/workbook.xml.rels", f"<Relationships>{relations}</Relationships>")
        archive.writestr("xl/styles.xml", STYLES)
        if texts:
            shared = "".join(f"<si>{text}</si>" for text in texts)
            archive.writestr("xl/sharedStrings.xml", f"<sst {MAIN}>{shared}</sst>")
        for k, content in enumerate(sheets.values()):
            archive.writestr(f"xl/worksheets/s{k}.xml", content)
    return path


def test_the_sheet_with_the_most_numbers_and_the_one_that_is_named(tmp_path: Path) -> None:
    path = write(
        tmp_path / "a.xlsx",
        notes=sheet('<c t="str"><v>12 V, 64 lines</v></c>'),
        step=sheet(*numbers((0.0, 1.0), (0.1, 2.5))),
        long=sheet(*numbers((0.0, 1.0), (0.1, 2.5), (0.2, 0.30000000000000004))),
    )
    assert read_workbook(path, None) == (
        ["0\t1", "0.1\t2.5", "0.2\t0.3"],
        "Sheet: long (others: step; otherwise: --sheet).",
    )
    assert read_workbook(path, "step") == (["0\t1", "0.1\t2.5"], "Sheet: step.")
    with pytest.raises(RecordingError, match="a.xlsx has no sheet two: name one of notes, step, long."):
        read_workbook(path, "two")


def words(*texts: str) -> str:
    return "".join(f'<c t="str"><v>{text}</v></c>' for text in texts)


def test_a_sheet_of_one_line_of_words_names_the_columns_of_another(tmp_path: Path) -> None:
    data = numbers((0.0, 1.0), (0.1, 2.5))
    path = write(tmp_path / "a.xlsx", Hoja1=sheet(*data), Hoja2=sheet(words("Tiempo [Seg.]", "Torque")))
    said = "Sheet: Hoja1, whose columns are named on Hoja2."
    assert read_workbook(path, None) == (["Tiempo [Seg.]\tTorque", "0\t1", "0.1\t2.5"], said)
    for others in (
        {"b": sheet(words("t", "u", "y"))},  # another number of columns
        {"b": sheet(words("t", "u"), words("s", "V"))},
        {"b": sheet(words("t", "u")), "c": sheet(words("t", "y"))},  # which of both?
    ):
        assert read_workbook(write(tmp_path / "b.xlsx", a=sheet(*data), **others), None)[0] == ["0\t1", "0.1\t2.5"]
    named = write(tmp_path / "c.xlsx", a=sheet(words("t", "u"), *data), b=sheet(words("x", "y")))
    assert read_workbook(named, None)[0] == ["t\tu", "0\t1", "0.1\t2.5"]


def test_cells_of_every_kind(tmp_path: Path) -> None:
    cells = (
        '<c t="s"><v>0</v></c><c t="s"><v>1</v></c><c t="inlineStr"><is><t>rpm</t></is></c><c t="b"><v>1</v></c>'
        '<c><f>A1*2</f><v>7.5</v></c><c t="e"><v>#DIV/0!</v></c><c/>'
    )
    texts = ("<t>time  [s]</t>", "<r><t>du</t></r><r><t>ty</t></r><rPh><t>spoken</t></rPh>")
    lines, _ = read_workbook(write(tmp_path / "a.xlsx", texts, a=sheet(cells)), None)
    assert lines == ["time [s]\tduty\trpm\t1\t7.5"]


def test_cells_and_rows_that_are_left_out_are_empty(tmp_path: Path) -> None:
    rows = '<row r="2"><c r="B2"><v>1</v></c><c r="AA2"><v>2</v></c><c r="ZZZ2"><v>3</v></c></row>'
    path = write(tmp_path / "a.xlsx", a=f"<worksheet {MAIN}><sheetData>{rows}</sheetData></worksheet>")
    lines, _ = read_workbook(path, None)
    assert lines == ["", "1"]


def test_what_stands_beside_the_table_is_left_out(tmp_path: Path) -> None:
    """Two columns of the table, one of which begins later, an empty one, and a note with its number."""
    rows = ['<c r="B1"><v>1</v></c><c r="E1" t="str"><v>R</v></c><c r="F1"><v>1.6</v></c>']
    rows += [f'<c r="B{k}"><v>{k}</v></c><c r="C{k}"><v>7</v></c>' for k in range(2, 5)]
    lines, _ = read_workbook(write(tmp_path / "a.xlsx", a=sheet(*rows)), None)
    assert lines == ["1\t", "2\t7", "3\t7", "4\t7"]


def texts(row: int, **cells: str) -> str:
    return "".join(f'<c r="{at}{row}" t="str"><v>{text}</v></c>' for at, text in cells.items())


def test_tables_of_the_same_columns_side_by_side_follow_each_other(tmp_path: Path) -> None:
    """As where every voltage has its own; notes, and tables of other columns, are left out as before."""

    def block(columns: str, *rows: tuple[float, ...]) -> list[str]:
        return [
            "".join(f'<c r="{at}{k}"><v>{value}</v></c>' for at, value in zip(columns, row, strict=True))
            for k, row in enumerate(rows, start=2)
        ]

    first, second = block("AB", (0, 1), (5, 2), (10, 3)), block("DE", (15, 4), (20, 5))
    sums = block("GH", (7, 7))
    rows = [
        texts(1, A="t", B="y", D="t", E="y", G="mean", H="y"),
        first[0] + second[0] + sums[0],
        first[1] + second[1],
        first[2],
    ]
    lines, note = read_workbook(write(tmp_path / "a.xlsx", log=sheet(*rows)), None)
    assert lines == ["t\ty", "0\t1", "5\t2", "10\t3", "15\t4", "20\t5"]
    assert note == "Sheet: log. 2 tables of the same columns stand side by side: read one below the other."
    rows[0] = texts(1, A="t", B="y", D="t", E="u", G="mean", H="y")
    lines, note = read_workbook(write(tmp_path / "b.xlsx", log=sheet(*rows)), None)
    assert lines[:2] == ["t\ty", "0\t1"] and lines[-1] == "10\t3" and note == "Sheet: log."


def test_dates_and_times_of_day(tmp_path: Path) -> None:
    cells = "".join(f'<c s="{style}"><v>{value}</v></c>' for style, value in ((1, 45413.5), (2, 45413.5), (3, 0.25)))
    lines, _ = read_workbook(write(tmp_path / "a.xlsx", a=sheet(cells)), None)
    assert lines == ["2024-05-01T12:00:00.000000\t45413.5\t06:00:00.000000"]


def test_a_log_in_a_workbook_is_read_as_the_text_table(tmp_path: Path) -> None:
    rows = [(0.01 * k, 6.0 * (k >= 20), round(100.0 * max(1.0 - 0.9 ** (k - 20), 0.0), 1)) for k in range(200)]
    head = "".join(f'<c t="inlineStr"><is><t>{name}</t></is></c>' for name in ("t [s]", "voltage [V]", "speed [rpm]"))
    (motor,) = import_log(write(tmp_path / "a.xlsx", a=sheet(head, *numbers(*rows))), Said()).motors
    (run,) = motor.log.runs
    assert len(run.samples) == 200 and run.samples[-1].speed == pytest.approx(100.0 * 0.10471975511965977, rel=1e-3)
    with pytest.raises(RecordingError, match="log.csv has no sheets: leave out --sheet."):
        (tmp_path / "log.csv").write_text("t,u,y\n0,1,2\n1,2,3\n")
        import_log(tmp_path / "log.csv", Said(sheet="a"))


@pytest.mark.parametrize(
    ("content", "complaint"),
    [
        ("<worksheet><sheetData><row>", "is a damaged workbook"),
        ('<!DOCTYPE x [<!ENTITY a "b">]><worksheet/>', "declares entities, as no workbook does"),
        (sheet('<c t="s"><v>9</v></c>'), "is a damaged workbook"),
        (sheet(), "has no sheet with cells"),
        (sheet('<c t="s"><v>-9</v></c>'), "is a damaged workbook"),
        (sheet('<c s="x"><v>1</v></c>'), "is a damaged workbook"),
    ],
)
def test_what_cannot_be_read_is_a_sentence(tmp_path: Path, content: str, complaint: str) -> None:
    with pytest.raises(RecordingError, match=complaint):
        read_workbook(write(tmp_path / "a.xlsx", a=content), None)


def test_texts_are_counted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = write(tmp_path / "a.xlsx", ("<t>t</t>", "<t>u</t>", "<t/>"), a=sheet(*numbers(*[(1.0, 2.0)] * 3)))
    monkeypatch.setattr(workbook, "MOST_TEXTS", 3)
    assert len(read_workbook(path, None)[0]) == 3
    monkeypatch.setattr(workbook, "MOST_TEXTS", 2)
    with pytest.raises(RecordingError, match="has more than 0 million texts: save the sheet with the table as CSV"):
        read_workbook(path, None)


def test_the_limits_are_those_that_are_documented() -> None:
    """Inputs that reach them take seconds each: benchmarks/hostile.py has those."""
    page = (Path(__file__).parents[4] / "docs" / "security.md").read_text("utf-8")
    row = next(line for line in page.splitlines() if line.startswith("| a workbook of Excel |"))
    parts = workbook_parts
    assert f"{parts.MOST_BYTES >> 20} MiB a sheet and {parts.MOST_IN_ALL >> 20} MiB in all" in row
    cells, texts = parts.MOST_CELLS // 10**6, parts.MOST_TEXTS // 10**6
    assert f"2²⁰ rows, {cells} million cells, {texts} million texts" in row and parts.MOST_ROWS == 2**20
    assert parts.MOST_ELEMENTS <= parts.MOST_CELLS


def test_limits(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = write(tmp_path / "a.xlsx", a=sheet(*numbers(*[(1.0, 2.0)] * 50)))
    monkeypatch.setattr(workbook_parts, "MOST_CELLS", 100)
    assert len(read_workbook(path, None)[0]) == 50
    monkeypatch.setattr(workbook_parts, "MOST_CELLS", 99)
    with pytest.raises(RecordingError, match="million cells: save the sheet with the table as CSV"):
        read_workbook(path, None)
    monkeypatch.setattr(workbook_parts, "MOST_BYTES", 1000)
    with pytest.raises(RecordingError, match="MiB in xl/worksheets/s0.xml: save the sheet with the table as CSV"):
        read_workbook(path, None)


def test_every_damage_is_a_sentence(tmp_path: Path) -> None:
    whole = write(tmp_path / "a.xlsx", ("<t>x</t>",), a=sheet(*numbers(*[(1.0, 2.0)] * 30))).read_bytes()
    for k in range(0, len(whole), 23):
        (tmp_path / "b.xlsx").write_bytes(whole[:k] + bytes([whole[k] ^ 0x55]) + whole[k + 1 :])
        try:
            read_workbook(tmp_path / "b.xlsx", None)
        except RecordingError as error:
            assert "\n" not in str(error) and str(error).endswith(".")
