"""What a finding says of itself."""

import pytest

from motor_identification.diagnosis.result import Finding, list_vague

NAN = float("nan")


@pytest.mark.parametrize(
    ("parameters", "sized"),
    [
        ({}, True),  # it is there or not, and has no size
        ({"ks": (0.1, 0.02)}, True),
        ({"ks": (0.1, NAN)}, False),
        ({"warm_up_rise": (0.1, NAN), "warm_up_time": (20.0, 3.0)}, True),
        ({"warm_up_rise": (0.1, NAN), "warm_up_time": (20.0, NAN)}, False),
    ],
)
def test_a_finding_has_a_size_where_any_of_its_parameters_is_determined(
    parameters: dict[str, tuple[float, float]], sized: bool
) -> None:
    assert Finding("coulomb_friction", 5.0, 1.0, 100.0, "", parameters, (), (), "").has_size is sized


@pytest.mark.parametrize(("error", "vague"), [(NAN, ["coulomb_friction", "static_friction"]), (0.1, [])])
def test_what_a_determined_finding_implies_needs_no_size_of_its_own(error: float, vague: list[str]) -> None:
    sizes = {"coulomb_friction": {"ks": (0.1, NAN)}, "static_friction": {"breakaway_voltage": (0.5, error)}}
    findings = [Finding(name, 5.0, 1.0, 100.0, "", size, (), (), "") for name, size in sizes.items()]
    assert [one.effect for one in list_vague(findings)] == vague
