"""The parameter files document the nodes' parameters: the same names, defaults, units and ranges, both ways."""

import re

import pytest
import yaml
from bringup_tables import NODES, ROOT, reference

from motor_ros.parameters import Row

CONFIG = ROOT / "motor_bringup" / "config"
LINE = re.compile(
    r"^    (?P<name>\w+): .*?  # (?:\[(?P<unit>[^]]+)\] )?(?:(?P<low>[-\d.]+) to (?P<high>[-\d.]+): )?(?P<text>.+)$"
)


def sections(file: str) -> dict[str, dict[str, object]]:
    content = yaml.safe_load((CONFIG / file).read_text(encoding="utf-8"))
    return {key: entry["ros__parameters"] for key, entry in content.items()}


def comments(file: str) -> dict[tuple[str, str], "re.Match[str]"]:
    """By section and name; every parameter has one."""
    found, section = {}, ""
    for line in (CONFIG / file).read_text(encoding="utf-8").splitlines():
        if line.startswith("/**"):
            section = line.rstrip(":")
        elif line.startswith("    "):
            match = LINE.match(line)
            assert match is not None, line
            found[section, match["name"]] = match
    return found


@pytest.mark.parametrize("node", NODES)
def test_the_file_says_what_the_node_declares(node: str) -> None:
    file, rows = NODES[node]
    there, words = sections(file), comments(file)
    declared = {row.name: row for row in rows}
    shared, own = there.get("/**", {}), there[f"/**/{node}"]
    assert not set(shared) & set(own)
    missing = set(declared) - set(shared) - set(own)
    assert not missing and set(own) <= set(declared), "run python docs/make_parameters.py"
    if node in ("motor_sim", "motor_driver"):  # the emulator is no plant: it has some of what plants share
        assert set(shared) <= set(declared)
    for name, row in declared.items():
        value = (own | shared)[name]
        assert value == row.default and type(value) is type(row.default), name
        if node != "board_emulator" or name in own:
            same_words(words[f"/**/{node}" if name in own else "/**", name], row)


def same_words(words: "re.Match[str]", row: Row) -> None:
    assert (words["unit"] or "") == row.unit and row.description in words["text"]
    assert ("fixed at the start" in words["text"]) == row.read_only
    span = None if words["low"] is None else (float(words["low"]), float(words["high"]))
    assert span == (None if row.low is None else (row.low, row.high)), row.name


def test_every_file_is_as_it_would_be_written_now() -> None:
    files = reference("make_parameters").FILES
    assert {path.name for path in CONFIG.iterdir()} == set(files)
    for name, (about, rows) in files.items():
        text = reference("make_parameters").text(about, rows)
        assert (CONFIG / name).read_text(encoding="utf-8") == text, "run python docs/make_parameters.py"
