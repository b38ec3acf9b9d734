"""Hostile workbooks of Excel: odd cells, changed parts, archives that lie about themselves."""

import io
import zipfile
from pathlib import Path
from random import Random
from xml.sax.saxutils import escape

from hostile import mcap_mutation
from hostile.kind import Draw
from hostile.log_files import importing
from hostile.odd_values import NUMBERS, WORDS

MAIN = 'xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"'
RELATIONS = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
USUAL = ["--voltage", "u", "--speed", "w", "--unit", "rad/s"]
ODD_CELLS = (
    *(f'<c t="{kind}"><v>{{}}</v></c>' for kind in ("s", "str", "b", "e", "n")),
    *('<c t="inlineStr"><is><t>{}</t></is></c>', '<c t="{}"><v>1</v></c>', '<c r="{}"><v>1</v></c>'),
    *('<c s="{}"><v>1</v></c>', '<c s="1"><v>{}</v></c>', "<c><f>{}</f></c>", "<c><v>{}</v><v>{}</v></c>"),
    *("<row>{}</row>", "<x><y>{}</y></x>", "<c/>", ""),
)
PLACES = ("A1", "ZZZ9", "XFD1048576", "AAAA1", "A0", "1A", "B99999999999999999999", "é1")


def workbook(draw: Draw, random: Random, folder: Path) -> list[str]:
    """A workbook with odd cells, odd parts, or odd bytes."""
    parts = _parts(random)
    if random.random() < 0.3:
        name = random.choice(list(parts))
        change = random.choice((_changed, mcap_mutation.changed_bytes, lambda data, random: b""))
        parts[name] = change(parts[name], random)
    if random.random() < 0.1:
        del parts[random.choice(list(parts)[1:])]
    data = _packed(parts, random)
    if random.random() < 0.3:
        data = mcap_mutation.changed_bytes(data, random)
        data = data[: random.randrange(len(data) + 1)] if random.random() < 0.2 else data
    (folder / "input.xlsx").write_bytes(data)
    return importing(random, "input.xlsx", USUAL) + (
        ["--sheet", random.choice((*WORDS, "a"))] if random.random() < 0.1 else []
    )


def _parts(random: Random) -> dict[str, bytes]:
    count = random.choice((1, 1, 1, 2, 60))
    rows = [[f"<c><v>{value!r}</v></c>" for value in (0.005 * k, 6.0 * (k > 20), min(k, 60) * 1.5)] for k in range(120)]
    for _ in range(random.choice((0, 0, 1, 1, 5, 200))):
        odd = escape(random.choice((*NUMBERS, *WORDS, *PLACES)), {'"': "&quot;"}).encode("utf-8", "replace").decode()
        row = random.choice(rows)
        row[random.randrange(len(row))] = random.choice(ODD_CELLS).replace("{}", odd)
    if random.random() < 0.1:
        rows[random.randrange(120)] *= random.choice((2, 500))
    head = "".join(f'<c t="s"><v>{k}</v></c>' for k in range(3))
    numbers = [f' r="{k + 1}"' if k % 2 else "" for k in range(121)]
    if random.random() < 0.2:
        numbers[random.randrange(121)] = f' r="{random.choice((5, 10**6, *NUMBERS))}"'
    body = "".join(f"<row{number}>{''.join(row)}</row>" for number, row in zip(numbers, [[head], *rows], strict=True))
    named = "".join(f'<sheet name="s{k}" r:id="r{random.choice((0, k))}"/>' for k in range(count))
    targets = "".join(f'<Relationship Id="r{k}" Target="worksheets/s0.xml"/>' for k in range(count))
    texts = "".join(f"<si><t>{name}</t></si>" for name in ("t", "u", "w"))
    styles = '<xf numFmtId="0"/><xf numFmtId="170"/>'
    formats = '<numFmt numFmtId="170" formatCode="mm:ss.000"/>'
    texts_of = {
        "xl/workbook.xml": f'<workbook {MAIN} xmlns:r="{RELATIONS}"><sheets>{named}</sheets></workbook>',
        "xl/_rels/workbook.xml.rels": f"<Relationships>{targets}</Relationships>",
        "xl/styles.xml": f"<styleSheet {MAIN}><numFmts>{formats}</numFmts><cellXfs>{styles}</cellXfs></styleSheet>",
        "xl/sharedStrings.xml": f"<sst {MAIN}>{texts}</sst>",
        "xl/worksheets/s0.xml": f"<worksheet {MAIN}><sheetData>{body}</sheetData></worksheet>",
    }
    return {name: text.encode() for name, text in texts_of.items()}


def _changed(data: bytes, random: Random) -> bytes:
    """XML that is XML all the same, but of another size, depth or encoding."""
    text = data.decode()
    return random.choice(
        (
            text.encode("utf-16"),
            f'<?xml version="1.0" encoding="{random.choice(("cp037", "utf-7", "x", "utf-16"))}"?>{text}'.encode(),
            ('<!DOCTYPE a [<!ENTITY b "x"><!ENTITY c SYSTEM "file:///etc/passwd">]>' + text).encode(),
            text.replace("<row>", "<a>" * 5000, 1).encode(),
            text.replace("Id=", "ID=").replace("numFmtId", "x").encode(),
            text.replace("worksheets/", random.choice(("../../", "/", "/etc/passwd", ""))).encode(),
        )
    )


def _packed(parts: dict[str, bytes], random: Random) -> bytes:
    file = io.BytesIO()
    kind = random.choice((zipfile.ZIP_DEFLATED, zipfile.ZIP_STORED) * 5 + (zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA))
    with zipfile.ZipFile(file, "w", kind) as archive:
        for name, data in parts.items():
            archive.writestr(name, data)
        if random.random() < 0.1:
            archive.writestr(random.choice(("../../evil", "/etc/passwd", "a" * 5000)), b"x" * 100)
    return file.getvalue()
