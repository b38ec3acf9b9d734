"""Every row of the table of findings says what is so and what to do, and takes its numbers."""

import re

import pytest

from motor_driver.check.findings import TABLE, finding
from motor_driver.config import Config
from motor_driver.parameters import ROWS

VALUES = {
    "supply": 24.0,
    "expected": 12,
    "rate": 962.4,
    "turns": "One turn",
    "counted": 48,
    "told": 96,
    "hint": "Say --edges-per-revolution.",
    "highest": 6.0,
    "way": "positive",
    "low": 2.0,
    "low_rate": 100.0,
    "high": 3.0,
    "high_rate": 101.0,
    "voltage": 12.0,
    "most": 20_000.0,
    "why": "Ctrl-C",
}


@pytest.mark.parametrize("code", TABLE)
def test_a_row_makes_sentences(code: str) -> None:
    found = finding(code, **VALUES)
    for text in (found.sentence, found.cure):
        assert re.fullmatch(r"[A-Z0-9].*[.]", text) and "{" not in text, text
    assert found.cured == bool(TABLE[code][2])


def test_what_software_makes_up_for_are_parameters_of_the_driver() -> None:
    for _, _, parameters in TABLE.values():
        for name in parameters:
            assert name in {row.name for row in ROWS} and getattr(Config(), name) is False
