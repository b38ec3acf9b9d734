"""Other people's logs come with their source and licence, and stay small."""

import json
import re
from itertools import pairwise
from pathlib import Path
from statistics import median

import pytest

DATA = Path(__file__).with_name("data")
PAGE = (DATA / "README.md").read_text(encoding="utf-8")
FOLDERS = sorted(path for path in DATA.iterdir() if path.is_dir())


def test_every_log_is_described_and_every_description_has_its_log() -> None:
    named = set()
    for row in re.findall(r"^\| (`\w+/.*?) \|", PAGE, re.MULTILINE):
        folder = row[1 : row.index("/")]
        names = re.findall(r"`(?:\w+/)?([\w.-]+\.(?:csv|json))`", row)
        named |= {f"{folder}/{name}" for name in names}
    logs = {path.relative_to(DATA).as_posix() for folder in FOLDERS for path in folder.iterdir()}
    assert named == {log for log in logs if log.endswith((".csv", ".json"))}


def test_every_folder_has_its_licence_and_its_source() -> None:
    assert len(FOLDERS) == 5
    for folder in FOLDERS:
        licences = [path for path in folder.iterdir() if path.name.startswith("LICEN")]
        row = rf"^\| `{folder.name}`.*? \| [\w.-]+/[\w.-]+ \| [0-9a-f]{{7}} \| .* \|$"
        sources = re.findall(row, PAGE, re.MULTILINE)
        assert licences and len(sources) == len(licences), folder.name
        texts = [path.read_text(encoding="utf-8") for path in licences]
        assert all(re.search("MIT License|Redistribution and use|CERN Open Hardware Licence", text) for text in texts)


def test_all_of_it_stays_small() -> None:
    assert 0.5e6 < sum(path.stat().st_size for folder in FOLDERS for path in folder.iterdir()) < 1.5e6


def test_the_drivetrain_is_thinned_as_its_description_says() -> None:
    content = json.loads((DATA / "frc" / "drivetrain_sysid.json").read_text(encoding="utf-8"))
    for name, period in (("fast", 0.005), ("slow", 0.020)):
        for way in ("forward", "backward"):
            rows = content[f"{name}-{way}"]
            assert len(rows[0]) == 9 and len(rows) > 600
            assert median(b[0] - a[0] for a, b in pairwise(rows)) == pytest.approx(period, rel=0.01)
    assert content["unitsPerRotation"] == 0.4878
