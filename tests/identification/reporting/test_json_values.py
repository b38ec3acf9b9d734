"""What no JSON can say is null, and a file that cannot be written is one sentence."""

import json
from math import inf, nan
from pathlib import Path

import pytest

from motor_identification.reporting.json_values import to_estimate, to_number, write_json
from motor_model.errors import MotorError


def test_what_is_no_number_is_null() -> None:
    assert [to_number(value) for value in (0.5, 0.0, nan, inf, -inf)] == [0.5, 0.0, None, None, None]
    assert to_estimate(0.4, nan) == {"value": 0.4, "standard_error": None}


def test_a_file_is_json_that_a_person_can_read(tmp_path: Path) -> None:
    content = {"message": "3 µs", "gap": None}
    write_json(tmp_path / "fit.json", content)
    text = (tmp_path / "fit.json").read_text(encoding="utf-8")
    assert json.loads(text) == content and "3 µs" in text and text.count("\n") == 4


def test_a_file_that_cannot_be_written_is_one_sentence(tmp_path: Path) -> None:
    with pytest.raises(
        MotorError,
        match=r"cannot write .*missing/fit\.json \(No such file or directory\): choose a directory that exists\.",
    ):
        write_json(tmp_path / "missing" / "fit.json", {})
