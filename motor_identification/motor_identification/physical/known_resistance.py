"""Convert a fit in armature voltages to physics by a resistance that is known otherwise: no current was measured."""

from dataclasses import replace
from math import isnan, nan

from motor_identification.estimation.request import PhysicalRequest
from motor_identification.physical.propagation import Values, propagate_errors
from motor_identification.uncertainty.result import Fit
from motor_model.errors import ModelError
from motor_model.parameters import MOST_BACK_EMF
from motor_model.physical.quantities import CONSTANT, RESISTANCE, VISCOUS, physical_values
from motor_model.physical.result import PhysicalResult

ALL_BACK_EMF = (
    "Without a measured current kv cannot be split into back-EMF and viscous friction: the torque constant is taken as "
    "kv, which is the most that it can be. Torques and inertia are in proportion to it; give --torque-constant, or "
    "record with a current sensor."
)
GIVEN = "Resistance and torque constant are given, not measured: what kv has beyond the constant is viscous friction."
TOO_LARGE = (
    "--torque-constant {:g} N·m/A is more than kv = {:.4g} V·s/rad, which is back-EMF and viscous friction: check its "
    "unit, and the unit of speed."
)


def convert_with_resistance(fit: Fit, request: PhysicalRequest) -> Fit:
    """Return the fit with its physical quantities.

    Raises:
        ModelError: the torque constant cannot be this motor's.
    """
    kv = fit.parameters.values["kv"]
    given = request.torque_constant
    if given > MOST_BACK_EMF * kv:
        raise ModelError(TOO_LARGE.format(given, kv))

    def quantities(values: Values) -> dict[str, float]:
        found = physical_values(values, values[RESISTANCE.name], given or values["kv"])
        if not given:
            del found[VISCOUS.name]  # taken as 0, not found to be
        return found

    values = {**fit.parameters.values, RESISTANCE.name: request.resistance}
    errors = {**fit.standard_errors, RESISTANCE.name: request.resistance_error}
    found = quantities(values)
    sure = propagate_errors(quantities, values, errors, fit.correlations)
    exact = {RESISTANCE.name} if request.resistance_error == 0.0 else set()
    exact |= {CONSTANT.name} if given else set()
    result = PhysicalResult(
        "resistance",
        found,
        {name: nan if name in exact else error for name, error in sure.items()},
        tuple(name for name, error in sure.items() if isnan(error)),
        notes=(GIVEN if given else ALL_BACK_EMF,),
    )
    parameters = replace(fit.parameters, resistance=request.resistance, torque_constant=given)
    return replace(fit, parameters=parameters, physical=result)
