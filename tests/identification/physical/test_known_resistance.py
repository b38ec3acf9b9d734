"""Physics from a resistance that is known otherwise: what follows from it, and what is only assumed."""

from math import isnan

import pytest
from electrical import FRICTION, LUMPED, PHYSICAL, known

from motor_identification.estimation.request import PhysicalRequest, Request, SearchConfig
from motor_identification.identify import identify
from motor_identification.uncertainty.result import Fit
from motor_model.errors import ModelError, MotorError

QUICK = SearchConfig(16, 30)


def fit(**given: float) -> Fit:
    return identify([known()[0]], Request(FRICTION, QUICK, physical=PhysicalRequest(**given)))


def test_with_a_torque_constant_everything_is_found() -> None:
    physical = fit(resistance=2.3, resistance_error=0.023, torque_constant=0.065).physical
    assert physical is not None and physical.source == "resistance"
    for name, true in PHYSICAL.items():
        assert physical.values[name] == pytest.approx(true, rel=2e-3), name
    relative = {name: error / physical.values[name] for name, error in physical.standard_errors.items()}
    assert relative["resistance"] == pytest.approx(0.01) and isnan(relative["torque_constant"])
    assert relative["inertia"] == pytest.approx(0.01, rel=0.02)  # the resistance's own: R is in the denominator
    assert "given, not measured" in physical.notes[0]


def test_without_one_the_torque_constant_is_at_most_kv() -> None:
    result = fit(resistance=2.3)
    physical = result.physical
    assert physical is not None and "viscous_friction" not in physical.values
    assert physical.values["torque_constant"] == result.parameters.values["kv"] == pytest.approx(LUMPED["kv"], rel=1e-3)
    too_large = LUMPED["kv"] / PHYSICAL["torque_constant"]
    assert physical.values["inertia"] / PHYSICAL["inertia"] == pytest.approx(too_large, rel=1e-3)
    assert "which is the most that it can be" in physical.notes[0] and physical.not_identifiable == ()
    assert isnan(physical.standard_errors["resistance"]) and physical.standard_errors["inertia"] > 0.0


def test_nonsense_is_refused() -> None:
    with pytest.raises(ModelError, match=r"--torque-constant 0.65 N·m/A is more than kv = 0.06588 V"):
        fit(resistance=2.3, torque_constant=0.65)
    with pytest.raises(MotorError, match="positive numbers"):
        PhysicalRequest(torque_constant=0.065)
