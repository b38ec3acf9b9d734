"""Hostile logs of other tools: MATLAB, SysId's JSON, JSON lines, WPILOG, and formats that are refused."""

import io
import json
import zlib
from functools import cache
from pathlib import Path
from random import Random
from struct import error as StructError
from struct import pack, unpack_from
from typing import Any

import numpy as np
from wpilib_log import Log, record, write_routine

from hostile import mcap_mutation
from hostile.kind import ROOT, Draw
from hostile.odd_values import NUMBERS, VALUES, WORDS
from hostile.yaml_files import changed_yaml

COUNT = 120  # rows
OPTIONS = (
    ["--voltage", "u", "--speed", "w"],
    ["--voltage", "u", "--position", "w", "--unit", "rad"],
    ["--voltage", "u", "--count", "n", "--edges-per-revolution", "96"],
    ["--sample-period", "0.005"],
    ["--constant-voltage", "6"],
    ["--split", "n"],
    ["--time-unit", "ms"],
    ["--motor", "left:u,w", "--motor", "right:u,n"],
    ["--units-per-revolution", "0.4878"],
)


USUAL = ["--voltage", "u", "--speed", "w", "--unit", "rad/s"]


def importing(random: Random, name: str, usual: list[str]) -> list[str]:
    """A command line for a log, mostly the one that its sound version takes."""
    words = ["import_log", name, *random.choice((["--output", "out/bag"], ["--dry-run"]))]
    if random.random() < 0.7:
        return words + usual
    for _ in range(random.choice((0, 1, 2))):
        words += random.choice(OPTIONS)
    return words


@cache
def columns() -> dict[str, Any]:
    time = np.arange(COUNT) * 0.005
    speed = 80.0 * (1.0 - np.exp(-np.maximum(time - 0.1, 0.0) / 0.08))
    return {"t": time, "u": 6.0 * (time >= 0.1), "w": speed, "n": np.floor(np.cumsum(speed) * 0.005 * 96 / 6.283)}


def matlab(draw: Draw, random: Random, folder: Path) -> list[str]:
    """A MATLAB file with odd variables, or with odd elements."""
    content = _version_4(random) if random.random() < 0.25 else _changed_elements(_odd_variables(draw, random), random)
    (folder / "input.mat").write_bytes(content)
    return importing(random, "input.mat", USUAL)


def _version_4(random: Random) -> bytes:
    """The file as version 4 has it, with other numbers in the heads of its variables, or cut off."""
    from scipy.io import savemat

    file = io.BytesIO()
    savemat(file, columns(), format="4")
    data = bytearray(file.getvalue())
    for _ in range(random.choice((0, 1, 1, 2))):
        at = random.randrange(len(columns())) * (len(data) // len(columns())) + 4 * random.randrange(6)
        data[at : at + 4] = pack("<I", random.choice(mcap_mutation.INTEGERS) % 2**32)
    return bytes(data[: random.choice((len(data), len(data), random.randrange(len(data))))])


def _odd_variables(draw: Draw, random: Random) -> bytes:
    from scipy.io import savemat

    content = dict(columns())
    name = random.choice(list(content))
    column = np.array(content[name], np.float64)
    if random.random() < 0.5:
        at = random.randrange(COUNT)
        column[at : at + random.choice((1, 1, COUNT))] = random.choice((np.nan, np.inf, -np.inf, 1e308, 5e-324, -1.0))
    odd = (
        column, np.arange(COUNT, dtype=np.int8), column[:, None], column[: random.randrange(COUNT)], column + 1j,
        column > 1.0, column.reshape(2, -1), np.zeros((0, 0)), np.zeros((2, 0, 3)), "text", draw(VALUES),
        {"a": column, "b": "x"}, np.array([column, "x", None], dtype=object), column.astype(str), np.zeros((COUNT, 65)),
    )  # fmt: skip
    content[name] = random.choice(odd[:1] * 15 + odd)
    if random.random() < 0.3:
        content = {"log": content}
    file = io.BytesIO()
    try:
        savemat(file, content, do_compression=random.random() < 0.5)
    except (TypeError, ValueError, OverflowError, UnicodeError, LookupError):  # such as a name without a letter
        file = io.BytesIO()
        savemat(file, columns())
    return file.getvalue()


def _changed_elements(data: bytes, random: Random) -> bytes:
    """Elements of the file doubled, lost, with other types, sizes, dimensions, inside of compressed ones too."""
    way = random.randrange(5)
    if way == 0:
        return data
    if way == 1:
        return mcap_mutation.changed_bytes(data, random)
    if way == 2:
        return data[: random.randrange(len(data))]
    out, position = data[:128], 128
    while position + 8 <= len(data):
        kind, size = unpack_from("<II", data, position)
        body = data[position + 8 : position + 8 + size]
        position += 8 + size
        if random.random() < 0.4:
            try:
                inner = bytearray(zlib.decompress(body) if kind == 15 else body)
                at = 4 * random.randrange(max(min(len(inner), 80) // 4, 1))
                inner[at : at + 4] = pack("<I", random.choice(mcap_mutation.INTEGERS) % 2**32)
                body = zlib.compress(bytes(inner)) if kind == 15 else bytes(inner)
            except (zlib.error, StructError):
                body = mcap_mutation.changed_bytes(body, random)
            kind = random.choice((kind, kind, kind, random.randrange(20)))
            size = random.choice((len(body), len(body), len(body), random.choice(mcap_mutation.INTEGERS) % 2**32))
        out += (pack("<II", kind, size) + body) * random.choice((1, 1, 1, 1, 0, 2))
    return out + _bomb(random.choice(("bytes", "dimensions"))) if random.random() < 0.05 else out


@cache
def _bomb(kind: str) -> bytes:
    """A variable that says the truth of itself: half a gigabyte of float64 in 70 kB, or a million dimensions in 8."""
    count = 1 << 26 if kind == "bytes" else 1
    shape = pack("<2i", count, 1) if kind == "bytes" else pack("<i", 2**31 - 1) * 1_000_000
    inner = pack("<IIII", 6, 8, 6, 0) + pack("<II", 5, len(shape)) + shape + pack("<HHI", 1, 1, ord("b"))
    inner += pack("<II", 2, count) + bytes(count + -count % 8)
    packed = zlib.compress(pack("<II", 14, len(inner)) + inner)
    return pack("<II", 15, len(packed)) + packed


def json_log(draw: Draw, random: Random, folder: Path) -> list[str]:
    """SysId's log, or an object a line, with odd values in places of its own."""
    usual = USUAL
    if random.random() < 0.7:
        usual = []
        whole = json.loads((ROOT / "tests" / "data" / "frc" / "drivetrain_sysid.json").read_text())
        content = {name: value[:60] if isinstance(value, list) else value for name, value in whole.items()}
        for _ in range(random.choice((1, 1, 2, 4))):
            content = changed_yaml(content, draw, random)
        text = _text(content)
    else:
        rows = [{name: float(column[k]) for name, column in columns().items()} for k in range(COUNT)]
        for _ in range(random.choice((1, 1, 5, 100))):
            rows[random.randrange(COUNT)] = changed_yaml(random.choice(rows), draw, random)
        text = "\n".join(_text(row) for row in rows)
    way = random.randrange(8)
    if way == 0:
        text = text.replace("1", random.choice(NUMBERS), random.choice((1, 1000)))
    elif way == 1:
        text = random.choice(("[" * 100_000, '{"a":' * 100_000, '{"sysid": true, "x": ' + "9" * 100_000)) + text
    data = text.encode("utf-8", errors="surrogatepass")
    (folder / "input.json").write_bytes(mcap_mutation.changed_bytes(data, random) if way == 2 else data)
    return importing(random, "input.json", usual)


def _text(content: Any) -> str:
    return json.dumps(content, default=lambda value: value.hex() if isinstance(value, bytes) else str(value))


@cache
def routine() -> bytes:
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        write_routine(Path(folder) / "log", period=0.1)
        return (Path(folder) / "log").read_bytes()


def wpilog(draw: Draw, random: Random, folder: Path) -> list[str]:
    """A robot's log whose records are odd, or another one of odd entries."""
    if random.random() < 0.5:
        data = mcap_mutation.changed_bytes(routine(), random)
        data = data[: random.randrange(len(data))] if random.random() < 0.2 else data
    else:
        data = _odd_log(draw, random)
    (folder / "input.wpilog").write_bytes(data)
    return importing(random, "input.wpilog", [])


def _odd_log(draw: Draw, random: Random) -> bytes:
    log = Log(random.choice(("", "x" * 5000)))
    kinds = ("double", "double", "double", "float", "int64", "boolean", "string", "double[]", "structschema", "")
    names = ("voltage", "position", "velocity", "sysid-test-state-x", *WORDS)
    units = ("", "Volt", "Rotation", "Meter per Second", " per ", "Rotation per Rotation", "é" * 3000)
    count = random.choice((1, 3, 3, 6, 1100))
    if random.random() < 0.02:  # entries that are looked for in a list take minutes
        for k in range(100_000):
            log.start(f"{k}", "double")
    for _ in range(count):
        name = random.choice(names).encode("utf-8", "replace").decode()
        log.start(name + random.choice(("", "2")), random.choice(kinds), random.choice(units))
    time = 0
    for _ in range(random.choice((3, 300))):
        number = random.choice((1.0, -1.0, 1e308, float("nan"), float("inf"), float(time)))
        payload = random.choice((pack("<d", number), pack("<d", number), pack("<f", min(number, 1e38)), b"text", b""))
        log.data += record(random.randrange(count + 3), time, payload)
        time = max(time + random.choice((20_000, 20_000, 0, -5, 10**15, 2**62)), 0) % 2**63
    head = random.choice((b"", b"", b"", pack("<BIIQ", 0x7F, 1, random.choice((2**31, 2**32 - 1)), 2**64 - 1)))
    return log.data + head


def refused(draw: Draw, random: Random, folder: Path) -> list[str]:
    """The beginning of a format that is not read, and anything behind it."""
    head = random.choice(
        (b"PAR1", b"ARROW1\0\0", b"PK\x03\x04", b"\x89HDF\r\n\x1a\n", b"MATLAB 7.3 MAT-file", b"\x1f\x8b",
         b"\x28\xb5/\xfd", b"\x89MCAP0\r\n", b"SQLite format 3\0", b"\x80\x04\x95", b"TDSm", b"\x93NUMPY", b"\x7fELF")
    )  # fmt: skip
    body = bytes(random.getrandbits(8) for _ in range(random.choice((0, 3, 300, 5000))))
    tail = random.choice((b"", head, b"\0" * 100_000, b"\n1,2,3" * 100))
    (folder / "input").write_bytes(head + body + tail)
    return importing(random, "input", [])
