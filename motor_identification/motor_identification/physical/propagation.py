"""Propagate standard errors and correlations from fitted parameters to physical quantities (delta method)."""

from collections.abc import Callable, Mapping

import numpy as np

from motor_identification.recording import Floats

STEP = 1e-6  # of a value, for derivatives
DEPENDS = 1e-9  # of a quantity per 100 % of a value: less is rounding

Values = Mapping[str, float]
Correlations = Mapping[str, Mapping[str, float]]


def propagate_errors(
    quantities: Callable[[Values], dict[str, float]], values: Values, errors: Values, correlations: Correlations
) -> dict[str, float]:
    """Return the standard errors of quantities; NaN for one that depends on a value whose error is NaN.

    correlations: of the errors, by name; those that are missing or NaN count as 0, that of a name with itself as 1.
    """
    names = tuple(errors)
    found = quantities(values)
    gradients = _gradients(quantities, values, names, found)
    unknown = np.array([not np.isfinite(errors[name]) for name in names])
    sigma = np.array([0.0 if bad else errors[name] for name, bad in zip(names, unknown, strict=True)])
    related = np.array([[_correlation(correlations, one, other) for other in names] for one in names])
    covariance = related * np.outer(sigma, sigma)
    sizes = np.array([abs(values[name]) for name in names])
    result = {}
    for row, (name, value) in zip(gradients, found.items(), strict=True):
        depends = np.abs(row) * sizes > DEPENDS * abs(value)
        open_one = bool(np.any(depends & unknown))
        result[name] = float("nan") if open_one else float(np.sqrt(max(row @ covariance @ row, 0.0)))
    return result


def _gradients(
    quantities: Callable[[Values], dict[str, float]], values: Values, names: tuple[str, ...], found: Values
) -> Floats:
    """Derivatives of the quantities over the named values, shape (quantities, names)."""
    columns = []
    for name in names:
        step = STEP * (abs(values[name]) or 1.0)
        ahead, back = (quantities({**values, name: values[name] + way * step}) for way in (1.0, -1.0))
        columns.append([(ahead[one] - back[one]) / (2.0 * step) for one in found])
    return np.array(columns).T.reshape(len(found), len(names))


def _correlation(correlations: Correlations, one: str, other: str) -> float:
    if one == other:
        return 1.0
    value = correlations.get(one, {}).get(other, 0.0)
    return value if np.isfinite(value) else 0.0
