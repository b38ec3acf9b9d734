"""Where a current's unknowns stand among those of the motion."""

import numpy as np
import pytest
from electrical import LUMPED, known

from motor_identification.estimation.parameter_space import make_unknowns, map_theta
from motor_identification.physical.unknowns import add_electrical_unknowns, join_theta
from motor_model.effects import EFFECT_BY_NAME, INDEX


def test_theta_goes_through_with_two_recordings_and_phases_of_their_own() -> None:
    recording, _ = known()
    ripple = next(effect.name for effect in EFFECT_BY_NAME.values() if effect.parameters[0].name == "ripple_voltage")
    bare = make_unknowns([recording, recording], (ripple,))
    unknowns = add_electrical_unknowns(bare, LUMPED["kv"], 5.0)
    theta = np.array([np.log(0.066), np.log(0.005), 0.2, 7.0, 0.5, 1.5])  # the last: the second recording's phase
    joined = join_theta(bare, theta, unknowns, np.array([2.3, 0.065, 0.03, 0.002]))
    vectors, _ = unknowns.decode(joined[None])
    assert vectors[0, :, INDEX["ripple_phase"]].tolist() == [0.5, 1.5]
    assert vectors[0, :, INDEX["current_offset"]].tolist() == [0.03, 0.03]
    assert vectors[0, :, INDEX["resistance"]] == pytest.approx([2.3, 2.3])
    assert unknowns.values(joined)["torque_constant"] == 0.065
    motor = unknowns.parameters(joined, "m")
    assert (motor.resistance, motor.torque_constant) == (pytest.approx(2.3), 0.065)
    assert np.allclose(map_theta(unknowns, joined, bare, {}), theta)


def test_the_box_is_scaled_by_voltage_and_current() -> None:
    recording, _ = known()
    unknowns = add_electrical_unknowns(make_unknowns([recording], ()), 0.066, 5.0)
    resistance = unknowns.names.index("resistance")
    assert np.exp(unknowns.low[resistance]) == pytest.approx(0.02 * 12.0 / 5.0)
    assert np.exp(unknowns.high[resistance]) == pytest.approx(20.0 * 12.0 / 5.0)
    constant = unknowns.names.index("torque_constant")
    assert (unknowns.low[constant], unknowns.high[constant]) == pytest.approx((0.0132, 0.0792))
