"""A fit as the model file that `motor_sim`, `motor_control` and every command read."""

from math import isfinite
from pathlib import Path

from motor_identification.uncertainty.result import Fit
from motor_model.model_file import save


def save_model(path: str | Path, fit: Fit, created: str) -> None:
    """Write a fitted motor as a model file; `created` is a date and time.

    Raises:
        ModelError: the file cannot be written.
    """
    origin = {
        "bags": list(fit.uris),
        "created": created,
        "residual_rms": fit.residual_rms,
        "noise_floor": fit.noise_floor,
        "not_identifiable": list(fit.not_identifiable),
    }
    if fit.timing is not None and fit.timing.filter:
        origin["speed_filter"] = str(fit.timing.filter)
    errors = {name: error for name, error in fit.standard_errors.items() if isfinite(error)}
    found = fit.physical.standard_errors if fit.physical else {}
    physical_errors = {name: error for name, error in found.items() if isfinite(error)}
    save(path, fit.parameters, errors, origin, physical_errors)
