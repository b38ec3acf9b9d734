"""The report's table of gaps, its alternatives and its parameters."""

from dataclasses import replace
from math import nan

import pytest

from motor_identification.diagnosis.result import Alternative, Diagnosis
from motor_identification.reporting.html.tables import explain_rejection, list_gaps, list_parameters, rank_alternatives
from motor_model.parameters import Parameters


def test_the_bars_are_logarithmic(found: Diagnosis) -> None:
    one = replace(found, gap_before=10.0, findings=(replace(found.findings[0], gap_after=1.0),), noise_floor=0.1)
    shares = [row.share for row in list_gaps(one)]
    assert shares == pytest.approx([100.0, 54.0, 8.0])
    assert [row.times for row in list_gaps(one)] == ["100 ×", "10 ×", "1 ×"]


def test_why_an_alternative_was_not_taken(found: Diagnosis) -> None:
    one = replace(found.findings[0], gap_after=1.0, evidence=100.0, ambiguous_with=("load_bias",))
    assert explain_rejection(Alternative("sag", 2.5, 90.0), one) == "gap 2.5 times as large"
    assert explain_rejection(Alternative("sag", 1.1, 53.95), one) == "10²⁰ times less likely"
    assert explain_rejection(Alternative("sag", 1.1, 98.0), one) == "7.4 times less likely"
    assert explain_rejection(Alternative("load_bias", 1.0, 99.0), one).endswith("cannot be distinguished")
    assert explain_rejection(Alternative("sag", nan, 1.0), one) == "the fit failed"


def test_alternatives_are_ranked_by_their_gap(found: Diagnosis) -> None:
    """All with 1 % of the improvement taken (9 rad/s) are shown, the best first, and what explains as much anyway."""
    gaps = {
        "load_bias": 9.905,
        "dead_zone": 2.0,
        "supply_sag": 9.915,
        "backlash": nan,
        "quadratic_drag": 5.0,
        "warm_up": 9.99,
    }
    tried = tuple(Alternative(name, gap, 1.0) for name, gap in gaps.items())
    one = replace(found.findings[0], gap_before=10.0, gap_after=1.0, alternatives=tried, ambiguous_with=("warm_up",))
    matters, others = rank_alternatives(one)
    assert [other.effect for other in matters] == ["dead_zone", "quadratic_drag", "load_bias", "warm_up"]
    assert [other.effect for other in others] == ["supply_sag", "backlash"]


def test_parameters_have_95_percent_intervals(found: Diagnosis) -> None:
    rows = {row.name: row for row in list_parameters(found.model, found.baseline)}
    assert list(rows) == ["kv", "ka", "ks"] and rows["ks"].before == "–"
    for name, row in rows.items():
        value, error = found.model.parameters.values[name], found.model.standard_errors[name]
        low, high = map(float, row.interval.split(" … "))
        assert low == pytest.approx(value - 1.96 * error, abs=0.2 * error)
        assert high == pytest.approx(value + 1.96 * error, abs=0.2 * error)
        assert low < float(row.after) < high
    unsure = replace(found, model=replace(found.model, standard_errors=dict.fromkeys(rows, nan)))
    assert {(row.interval, row.note) for row in list_parameters(unsure.model)} == {("–", "not identifiable")}


def test_an_interval_ends_where_physics_does(found: Diagnosis) -> None:
    """A share of 0.99 ± 0.01 is at most 1; friction of 1 ± 1 V is at least 0."""
    motor = Parameters(
        found.model.parameters.values | {"ks": 1.0, "coast_share": 0.99}, ("coulomb_friction", "coast_drive")
    )
    errors = found.model.standard_errors | {"ks": 1.0, "coast_share": 0.01}
    rows = {row.name: row for row in list_parameters(replace(found.model, parameters=motor, standard_errors=errors))}
    assert rows["coast_share"].interval == "0.970 … 1.000" and rows["ks"].interval == "0 … 3.0"
