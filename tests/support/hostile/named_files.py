"""Tables, models and workbooks for the hostile inputs that have a name."""

import os
import zipfile
from pathlib import Path

from hostile.bags import base
from hostile.named_bags import BAG, Write, put

COLUMNS = ["--time", "t", "--voltage", "u"]
MODEL = "name: input\nmax_voltage: {max_voltage!r}\neffects: [{effects}]\nparameters:\n"
SHEET = "<worksheet><sheetData>{}</sheetData></worksheet>"
BOOK = '{}<workbook xmlns:r="r"><sheets><sheet name="a" r:id="r0"/></sheets></workbook>'
ENTITIES = '<!DOCTYPE x [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">]>'


def text(name: str, content: str) -> Write:
    """A file of this text."""
    return lambda folder: (folder / name).write_text(content, encoding="utf-8") and None


def pipe(name: str) -> Write:
    return lambda folder: os.mkfifo(folder / name)


def link(to: str, name: str) -> Write:
    return lambda folder: (folder / name).symlink_to(to)


def aliases() -> str:
    """YAML of 470 bytes that stands for gigabytes."""
    names = list(zip("abcdefghi", "bcdefghij", strict=True))
    rows = [f"{name}: &{name} [{', '.join([f'*{before}'] * 9)}]" for before, name in names]
    return "\n".join(["a: &a [x, x, x, x, x, x, x, x, x]", *rows]) + "\n"


def metadata(content: str) -> Write:
    """A sound bag with other metadata."""

    def make(folder: Path) -> None:
        put(folder, base("golden"))
        (folder / BAG / "metadata.yaml").write_text(content, encoding="utf-8")

    return make


def model(*effects: str, kv: float = 0.07, max_voltage: float = 12.0, **values: float) -> Write:
    """A model file with these effects."""
    rows = {"kv": kv, "ka": 0.0055, **values}
    lines = "".join(f"  {name}: {{value: {value!r}}}\n" for name, value in rows.items())
    return text("input.yaml", MODEL.format(effects=", ".join(effects), max_voltage=max_voltage) + lines)


def csv(rows: int = 200, start: float = 0.0, period: float = 0.005, often: int = 1000, **cells: str) -> Write:
    """A log of a step with other cells in row 100 and every so many behind it; column z alternates."""
    columns = ("t", "u", "w", "n", "z")

    def make(folder: Path) -> None:
        with (folder / "input.csv").open("w", encoding="utf-8") as file:
            file.write(",".join(columns) + "\n")
            for k in range(rows):
                speed = min(k, 60) * 1.5
                row = [f"{start + period * k:.3f}", f"{6.0 * (k > 20)}", f"{speed:.2f}", f"{3 * k}", f"{k % 2}"]
                if k >= 100 and (k - 100) % often == 0:
                    row = [cells.get(name, cell) for name, cell in zip(columns, row, strict=True)]
                file.write(",".join(row) + "\n")

    return make


def workbook(part: str, size: int, around: str = "{}", text: str = "", texts: int = 1, head: str = "") -> Write:
    """A workbook whose sheet is this part again and again, of so many bytes; `texts` are what its cells share."""

    def make(folder: Path) -> None:
        relations = '<Relationships><Relationship Id="r0" Target="worksheets/a.xml"/></Relationships>'
        shared = f"<si><t>{text}</t></si>" if text else "<si/>"
        with zipfile.ZipFile(folder / "input.xlsx", "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("xl/workbook.xml", BOOK.format(head))
            archive.writestr("xl/_rels/workbook.xml.rels", relations)
            _write(archive, "xl/sharedStrings.xml", "<sst>{}</sst>", shared, texts)
            _write(archive, "xl/worksheets/a.xml", SHEET.format(around), part, size // max(len(part), 1))

    return make


def _write(archive: zipfile.ZipFile, name: str, around: str, one: str, count: int) -> None:
    before, behind = around.split("{}")
    many = max(1_000_000 // max(len(one), 1), 1)
    with archive.open(name, "w") as file:
        file.write(before.encode())
        for _ in range(count // many):
            file.write((one * many).encode())
        file.write((one * (count % many)).encode() + behind.encode())
