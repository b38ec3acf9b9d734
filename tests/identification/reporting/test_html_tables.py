"""The report's ladder of gaps, its alternatives and its parameters."""

from dataclasses import replace
from math import nan

import pytest

from motor_identification.diagnosis.result import Alternative, Diagnosis
from motor_identification.reporting.html.tables import ladder, lost, parameter_rows


def test_the_ladder_is_logarithmic(found: Diagnosis) -> None:
    one = replace(found, gap_before=10.0, findings=(replace(found.findings[0], gap_after=1.0),), noise_floor=0.1)
    shares = [rung.share for rung in ladder(one)]
    assert shares == pytest.approx([100.0, 54.0, 8.0])
    assert [rung.times for rung in ladder(one)] == ["1e+02 ×", "10 ×", "1 ×"]


def test_why_an_alternative_lost(found: Diagnosis) -> None:
    one = replace(found.findings[0], gap_after=1.0, evidence=100.0, ambiguous_with=("load_bias",))
    assert lost(Alternative("sag", 2.5, 90.0), one) == "leaves 2.5 times the gap"
    assert lost(Alternative("sag", 1.1, 53.95), one).endswith("is 10^20 times less likely")
    assert lost(Alternative("load_bias", 1.0, 99.0), one).endswith("not told apart")
    assert lost(Alternative("sag", nan, 1.0), one) == "no fit"


def test_parameters_have_95_percent_intervals(found: Diagnosis) -> None:
    rows = {row.name: row for row in parameter_rows(found)}
    assert list(rows) == ["kv", "ka", "ks"] and rows["ks"].before == "–"
    for name, row in rows.items():
        value, error = found.model.parameters.values[name], found.model.standard_errors[name]
        low, high = map(float, row.interval.split(" … "))
        assert low == pytest.approx(value - 1.96 * error, abs=0.2 * error)
        assert high == pytest.approx(value + 1.96 * error, abs=0.2 * error)
        assert low < float(row.after) < high
    unsure = replace(found, model=replace(found.model, standard_errors=dict.fromkeys(rows, nan)))
    assert {(row.interval, row.note) for row in parameter_rows(unsure)} == {("–", "not identifiable")}
