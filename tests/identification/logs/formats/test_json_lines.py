"""Logs of an object a line."""

from pathlib import Path

import pytest

from motor_identification.logs.formats.json_lines import are_json_lines, read_json_lines
from motor_model.errors import RecordingError


def test_which_files_are_such() -> None:
    assert are_json_lines('{"t": 0, "u": 1}\n{"t"')
    for head in ('{"t": 0}', '{\n"t": 0}\n', '{"sysid": true,\n', "[1]\n[2]\n", "{" * 5000 + "\n"):
        assert not are_json_lines(head)


def test_members_become_columns(tmp_path: Path) -> None:
    (tmp_path / "log").write_text('{"t": 0, "m": {"u": 1.5, "deep": {"x": 1}}}\n\n{"t": 1, "on": true, "list": [1]}\n')
    table = read_json_lines(tmp_path / "log")
    assert table.names == ["t", "m u", "on"]
    assert list(table.lines) == [1, 3]
    assert [table.text("m u", row) for row in range(2)] == ["1.5", ""]
    assert table.text("on", 1) == "1"


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ('{"t": 0}\nnothing\n', "line 2 is no JSON object"),
        ('{"t": 0}\n', "has 1 lines"),
        ("\n".join(f'{{"n{k}": 1}}' for k in range(1001)), "line 1001: more than 1000 names"),
    ],
)
def test_what_is_refused(tmp_path: Path, text: str, complaint: str) -> None:
    (tmp_path / "log").write_text(text)
    with pytest.raises(RecordingError, match=complaint):
        read_json_lines(tmp_path / "log")


def test_dictionaries_as_python_prints_them(tmp_path: Path) -> None:
    text = "{'t': 0.1, 'on': True, 'y': None}\n{'t': 0.2, 'on': False, 'y': 3}\n"
    assert are_json_lines(text)
    (tmp_path / "log").write_text(text)
    table = read_json_lines(tmp_path / "log")
    assert [table.text("on", row) for row in range(2)] == ["1", "0"] and table.text("y", 1) == "3"
