"""The table of a diagnosis: its numbers are the diagnosis' own."""

import re
from dataclasses import replace

from motor_identification.diagnosis.result import Diagnosis
from motor_identification.reporting.diagnosis_table import describe_rises, format_diagnosis


def test_the_table_has_the_numbers(found: Diagnosis) -> None:
    lines = format_diagnosis(found).splitlines()
    assert re.split(r"\s{2,}", lines[0]) == ["effect", "gap [rad/s]", "× floor", "parameters"]
    assert re.split(r"\s{2,}", lines[1])[1] == f"{found.gap_before:.4g}"
    assert lines[2].startswith("+ coulomb_friction") and f"{found.gap_after:.4g}" in lines[2] and "ks = 0.4" in lines[2]
    assert (
        lines[3].startswith("noise floor") and lines[4] == f"Evidence for Coulomb friction: {found.findings[0].where}"
    )


def test_the_motor_is_told_beside_what_was_found(found: Diagnosis) -> None:
    fit = found.model
    kv, ka = (fit.parameters.value(name) for name in ("kv", "ka"))
    line = format_diagnosis(found).splitlines()[-1]
    told = re.fullmatch(
        r"Motor: kv = ([\d.e-]+) ± ([\d.e-]+) V·s/rad, ka = ([\d.e-]+) ± ([\d.e-]+) V·s²/rad, beside .*", line
    )
    assert told is not None
    numbers = [float(number) for number in told.groups()]
    wanted = [kv, fit.standard_errors["kv"], ka, fit.standard_errors["ka"]]
    assert all(abs(one / other - 1.0) < 0.05 for one, other in zip(numbers, wanted, strict=True))
    assert "beside" not in format_diagnosis(replace(found, findings=())).splitlines()[-1]


def test_a_row_above_the_one_before_is_explained(found: Diagnosis) -> None:
    """Rows of 19.4, 30.4 and 7.0 rad/s were no chain: beside a torque the first one's model had left 49."""
    (ks,) = found.findings
    coast = replace(ks, effect="coast_drive", gap_before=49.0, gap_after=30.4, beside_torque=True)
    chain = replace(found, gap_before=19.4, findings=(coast, replace(ks, gap_before=30.4, gap_after=7.0)))
    said = describe_rises(chain)
    assert "from coast drive on it went on beside a random torque, where the model before left 49 rad/s." in said
    assert "Compare the first with the last." in said and format_diagnosis(chain).splitlines()[-1] == said
    # 0.390, 0.326 and 0.385, where the first finding was beside an eccentric disc of which nothing was certain.
    other = replace(
        coast, gap_before=0.329, gap_after=0.326, beside_torque=False, given_up=("encoder_eccentricity", "backlash")
    )
    rows = (other, replace(ks, gap_before=0.326, gap_after=0.385))
    said = describe_rises(replace(found, gap_before=0.39, findings=rows))
    assert "coast drive was found beside encoder eccentricity and backlash, which the model has no more." in said
    rows = tuple(replace(one, given_up=()) for one in rows)
    assert "what is likelier on unseen motion may leave more." in describe_rises(replace(found, findings=rows))
    for last, told in ((30.1, False), (30.5, True)):
        falls = replace(coast, gap_before=19.4, gap_after=last)
        assert bool(describe_rises(replace(found, gap_before=30.0, findings=(falls,)))) is told
    assert describe_rises(found) == "" and "row" not in format_diagnosis(found)
