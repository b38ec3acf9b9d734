"""Errors go through as the delta method says."""

from math import isnan, nan, sqrt

import pytest

from motor_identification.physical.propagation import Values, propagate_errors


def quotient(values: Values) -> dict[str, float]:
    return {"ratio": values["a"] / values["b"], "twice": 2.0 * values["a"]}


def test_independent_and_related_errors() -> None:
    values, errors = {"a": 3.0, "b": 2.0}, {"a": 0.03, "b": 0.04}
    alone = propagate_errors(quotient, values, errors, {})
    assert alone["ratio"] == pytest.approx(1.5 * sqrt(0.01**2 + 0.02**2), rel=1e-6)
    assert alone["twice"] == pytest.approx(0.06, rel=1e-6)
    together = {"a": {"a": 1.0, "b": 1.0}, "b": {"a": 1.0, "b": 1.0}}
    assert propagate_errors(quotient, values, errors, together)["ratio"] == pytest.approx(1.5 * 0.01, rel=1e-6)


def test_what_depends_on_an_open_value_is_open() -> None:
    found = propagate_errors(quotient, {"a": 3.0, "b": 2.0}, {"a": 0.03, "b": nan}, {"a": {"b": nan}})
    assert isnan(found["ratio"]) and found["twice"] == pytest.approx(0.06, rel=1e-6)
