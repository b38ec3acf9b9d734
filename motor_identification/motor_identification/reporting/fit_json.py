"""A fit in the JSON form that the interfaces promise."""

from typing import Any

from motor_identification.reporting.fit_text import summarize_fit
from motor_identification.reporting.json_values import to_model, to_number
from motor_identification.uncertainty.result import Fit
from motor_model.physical.quantities import PHYSICAL_BY_NAME
from motor_model.physical.result import PhysicalResult


def fit_to_json(fit: Fit) -> dict[str, Any]:
    """Convert a fit to JSON values; null where there is no number."""
    return {
        "bags": list(fit.uris),
        "model": to_model(fit),
        "on_bound": [name for name, hit in fit.on_bound.items() if hit],
        "residual_rms": to_number(fit.residual_rms),
        "noise_floor": to_number(fit.noise_floor),
        "r_squared": to_number(fit.r_squared),
        "correlations": {
            name: {other: to_number(value) for other, value in row.items()} for name, row in fit.correlations.items()
        },
        "whiteness": {
            "p_value": to_number(fit.whiteness.p_value),
            "autocorrelation": to_number(fit.whiteness.autocorrelation),
            "lag": fit.whiteness.lag,
        },
        "input_correlation": {
            "p_value": to_number(fit.whiteness.input_p_value),
            "correlation": to_number(fit.whiteness.input_correlation),
            "lag": to_number(fit.whiteness.input_lag),
        },
        "slot_irregularity": [to_number(share) for share in fit.slot_irregularity],
        "not_identifiable": list(fit.not_identifiable),
        "absent": list(fit.absent),
        "not_told_apart": {effect: list(rivals) for effect, rivals in fit.not_told_apart.items()},
        "suggested_experiment": fit.suggested_experiment or None,
        "duration": fit.duration,
        "evaluations": fit.evaluations,
        "search": {
            "swarms": fit.search.swarms,
            "descents": len(fit.search.descents),
            "agreeing": fit.search.agreeing,
            "agreed": fit.search.agreed,
        },
        "physical": _to_physical(fit.physical),
        "message": summarize_fit(fit),
    }


def _to_physical(result: PhysicalResult | None) -> dict[str, Any] | None:
    if result is None:
        return None
    return {
        "source": result.source,
        "parameters": {
            name: {
                "value": to_number(value),
                "standard_error": to_number(result.standard_errors[name]),
                "unit": PHYSICAL_BY_NAME[name].unit,
            }
            for name, value in result.values.items()
        },
        "not_identifiable": list(result.not_identifiable),
        "current_noise": [to_number(noise) for noise in result.current_noise],
        "notes": list(result.notes),
    }
