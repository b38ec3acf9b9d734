"""Names that are paths."""

import pytest

from motor_identification.logs.columns.names.path import find_field, find_struct


@pytest.mark.parametrize(
    ("name", "struct", "field"),
    [
        ("data.step1.u", "data.step1", "u"),
        ("motor.speed", "motor", "speed"),
        ("Time.1", "", ""),
        ("Temps (s.)", "", ""),
        ("VIT. MOTEUR", "", ""),
        ("0.5 m/s", "", ""),
        ("u", "", ""),
    ],
)
def test_a_path_has_a_struct_and_a_field(name: str, struct: str, field: str) -> None:
    assert (find_struct(name), find_field(name)) == (struct, field)
