"""Columns stand under each other, and no line ends in blanks."""

from motor_model.text_table import align_columns


def test_columns_are_as_wide_as_their_widest_cell() -> None:
    rows = [("name", "value", "unit"), ("kv", "0.07", "V·s/rad"), ("reverse_gain", "1", "")]
    assert align_columns(rows).splitlines() == [
        "name          value  unit",
        "kv            0.07   V·s/rad",
        "reverse_gain  1",
    ]
