"""The table of a diagnosis: its numbers are the diagnosis' own."""

import re

from motor_identification.diagnosis.result import Diagnosis
from motor_identification.reporting.diagnosis_table import format_diagnosis


def test_the_table_has_the_numbers(found: Diagnosis) -> None:
    lines = format_diagnosis(found).splitlines()
    assert re.split(r"\s{2,}", lines[0]) == ["effect", "gap [rad/s]", "× floor", "parameters"]
    assert re.split(r"\s{2,}", lines[1])[1] == f"{found.gap_before:.4g}"
    assert lines[2].startswith("+ coulomb_friction") and f"{found.gap_after:.4g}" in lines[2] and "ks = 0.4" in lines[2]
    assert (
        lines[3].startswith("noise floor") and lines[4] == f"Evidence for Coulomb friction: {found.findings[0].where}"
    )
