"""Two motors side by side: what differs by more than its errors is said, from both sides of the bound."""

import pytest

from motor_identification.reporting.model_comparison import (
    DIFFERENT,
    MANY,
    Identified,
    compare_text,
    deviations_of,
    format_deviations,
)
from motor_model.parameters import Parameters


def motor(name: str, kv: float, error: float = 0.003, ks: float | None = None) -> Identified:
    friction = {"ks": ks} if ks is not None else {}
    effects = ("coulomb_friction",) if friction else ()
    return Identified(name, Parameters({"kv": kv, "ka": 0.01} | friction, effects), {"kv": error, "ka": 0.001})


def test_what_differs_is_said_with_its_numbers() -> None:
    text = compare_text([motor("left", 0.5), motor("right", 0.55, 0.004)])
    assert "0.5000 ± 0.003" in text and "0.5500 ± 0.004" in text and "+10 % (10 σ)" in text
    assert text.endswith("right differs from left in kv.")


@pytest.mark.parametrize(("share", "differs"), [(0.99, False), (1.01, True)])
def test_the_bound_from_both_sides(share: float, differs: bool) -> None:
    left, right = motor("left", 0.5), motor("right", 0.5 + share * DIFFERENT * 0.005, 0.004)
    assert deviations_of(left, right, "kv") == pytest.approx(share * DIFFERENT)
    assert ("differs from left in kv" in compare_text([left, right])) == differs


def test_a_number_that_says_nothing_more_is_not_written() -> None:
    assert [format_deviations(x) for x in (1.26, 148.2, 0.999 * MANY, MANY)] == ["1.3", "148", "999", "> 1000"]


def test_a_difference_from_nothing_is_no_per_cent() -> None:
    """A friction of 0 ± 0.1 V, or of 0.29, has no percentage; one of 0.31 is beyond three errors, and has."""

    def rubbing(name: str, ks: float) -> Identified:
        return Identified(name, motor(name, 0.5, ks=ks).parameters, {"kv": 0.003, "ka": 0.001, "ks": 0.1})

    for ks, shown in ((0.0, "+0.6 V (4.2 σ)"), (0.29, "+0.31 V (2.2 σ)"), (0.31, "+93.5 % (2.1 σ)")):
        assert shown in compare_text([rubbing("left", ks), rubbing("right", 0.6)])


def test_what_one_lacks_and_errors_that_are_not_known() -> None:
    text = compare_text([motor("left", 0.5), motor("right", 0.5, ks=0.4), motor("third", 0.7, float("nan"))])
    assert "left has no ks: fit both with the same effects" in text
    assert "third" in text and "No parameter of third differs" in text and "nan" not in text
