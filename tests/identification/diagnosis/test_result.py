"""What a finding says of itself."""

import pytest

from motor_identification.diagnosis.result import Finding, list_vague

NAN = float("nan")


@pytest.mark.parametrize(
    ("parameters", "sized"),
    [
        ({}, True),  # it is there or not, and has no size
        ({"ks": (0.1, 0.02)}, True),
        ({"ks": (0.1, 0.0499)}, True),
        ({"ks": (0.1, 0.0501)}, False),  # more than none it is not
        ({"ks": (0.1, NAN)}, False),
        ({"warm_up_rise": (0.1, NAN), "warm_up_time": (20.0, 3.0)}, True),
        ({"warm_up_rise": (0.1, NAN), "warm_up_time": (20.0, NAN)}, False),
    ],
)
def test_a_finding_has_a_size_where_any_of_its_parameters_is_determined(
    parameters: dict[str, tuple[float, float]], sized: bool
) -> None:
    assert Finding("coulomb_friction", 5.0, 1.0, 100.0, "", parameters, (), (), "").has_size is sized


@pytest.mark.parametrize(("effect", "parameters", "sized"), [
    ("direction_asymmetry", {"reverse_gain": (0.98, 0.0099)}, True),
    ("direction_asymmetry", {"reverse_gain": (0.98, 0.0101)}, False),
    ("load_step", {"step_voltage": (0.1, 0.2), "step_time": (1.0, 0.1)}, False),
    ("warm_up", {"resistance_rise": (0.1, 0.2), "warm_up_time": (20.0, 15.0)}, True),  # of which the product is known
])  # fmt: skip
def test_a_size_that_may_be_none_is_none_where_there_is_but_one(
    effect: str, parameters: dict[str, tuple[float, float]], sized: bool
) -> None:
    """A supply sag of 0.005 ± 0.016, and a load of 0.16 ± 0.21 V, "were missing"."""
    assert Finding(effect, 5.0, 1.0, 100.0, "", parameters, (), (), "").has_size is sized


@pytest.mark.parametrize(("error", "vague"), [(NAN, ["coulomb_friction", "static_friction"]), (0.1, [])])
def test_what_a_determined_finding_implies_needs_no_size_of_its_own(error: float, vague: list[str]) -> None:
    sizes = {"coulomb_friction": {"ks": (0.1, NAN)}, "static_friction": {"breakaway_voltage": (0.5, error)}}
    findings = [Finding(name, 5.0, 1.0, 100.0, "", size, (), (), "") for name, size in sizes.items()]
    assert [one.effect for one in list_vague(findings)] == vague
