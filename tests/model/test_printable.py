"""Names that strangers wrote, as a terminal may show them."""

import os

import pytest

from motor_model.printable import escape


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("rotor ω 1", "rotor ω 1"),
        ("\x1b[2J\x07", r"\x1b[2J\x07"),
        ("two\nlines\r", r"two\nlines\r"),
        (os.fsdecode(b"bag\xff"), r"bag\xff"),
        ("\u202egnp", r"\u202egnp"),  # written from right to left
    ],
)
def test_what_is_no_visible_character_is_shown_as_its_escape(text: str, shown: str) -> None:
    assert escape(text) == shown


def test_a_name_without_end_is_shortened_and_a_sentence_is_not() -> None:
    assert escape("x" * 201) == "x" * 199 + "…" and escape("x" * 200) == "x" * 200
