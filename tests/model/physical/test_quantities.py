"""Lumped gains and physics are the same motor."""

import pytest
from electrical import LUMPED, PHYSICAL

from motor_model.parameters import Parameters
from motor_model.physical.quantities import lumped_values, physical_values, physical_values_of

MORE = PHYSICAL | {"inductance": 1.2e-3, "warm_resistance": 2.53, "load_torque": -0.004, "drag_torque": 1e-6}


def test_physics_becomes_voltages_and_back() -> None:
    lumped = lumped_values(MORE)
    assert lumped["kv"] == pytest.approx(0.065 + 2.3 * 2.5e-5 / 0.065, rel=1e-12)
    assert lumped["ka"] == pytest.approx(2.3 * 1.4e-4 / 0.065, rel=1e-12)
    assert lumped["ks"] == pytest.approx(2.3 * 0.01 / 0.065, rel=1e-12)
    assert lumped["electrical_time_constant"] == pytest.approx(1.2e-3 / 2.3, rel=1e-12)
    assert lumped["resistance_rise"] == pytest.approx(0.1, rel=1e-12)
    back = physical_values(lumped, 2.3, 0.065)
    assert back == {name: pytest.approx(value, rel=1e-9) for name, value in MORE.items()}


def test_without_a_constant_all_of_kv_is_back_emf() -> None:
    motor = Parameters(LUMPED, ("coulomb_friction",), resistance=2.3)
    found = physical_values_of(motor)
    assert found["torque_constant"] == LUMPED["kv"] and found["viscous_friction"] == 0.0
    assert physical_values_of(Parameters(LUMPED, ("coulomb_friction",))) == {}
