"""The model's current is that of the independent plant, whatever the motor has between voltage and current."""

import numpy as np
import pytest
from electrical import ELECTRIC, LUMPED
from plant import profiles, record

from motor_model.parameters import Parameters
from motor_model.simulate import simulate

CASES = {
    "plain": ({}, ()),
    "inductance": ({"electrical_time_constant": 8e-4}, ("armature_inductance",)),
    "warm": ({"resistance_rise": 0.3, "warm_up_time": 2.0}, ("warm_up",)),
    "coasting": ({"coast_share": 0.5}, ("coast_drive",)),
    "a bridge between": ({"delay": 0.0043, "dead_zone_voltage": 0.7}, ("transport_delay", "dead_zone")),
}


@pytest.mark.parametrize("case", CASES)
def test_current_of_model_and_plant(case: str) -> None:
    values, effects = CASES[case]
    drive = profiles.reversals(10.0, 4, 0.25)
    recording, truth = record(LUMPED | ELECTRIC | values, *drive, seed=2)
    motor = Parameters(LUMPED | values, ("coulomb_friction", *effects), **ELECTRIC)
    motion = simulate(motor, recording.time, recording.voltage, recording.time)
    assert np.max(np.abs(motion.speed - truth.speed)) < 5e-5
    assert np.max(np.abs(motion.current - recording.current)) < 2e-6
    assert 4.0 < np.max(np.abs(recording.current)) < 9.0  # a start takes 4.3 A, a reversal up to twice that
    reversal = int(np.flatnonzero(np.diff(np.sign(recording.voltage)) < 0.0)[0]) + 1
    assert recording.current[reversal] > 0.0  # read before the new voltage acts


def test_a_motor_without_a_resistance_has_no_current() -> None:
    assert len(simulate(Parameters(LUMPED, ("coulomb_friction",)), *(np.array([0.0]),) * 3).current) == 0


def test_the_split_of_kv_does_not_move_a_plain_motor() -> None:
    time, volts = np.arange(200) * 0.005, np.where(np.arange(200) < 120, 9.0, -4.0)
    one, other = (
        simulate(Parameters(LUMPED, ("coulomb_friction",), **known), time, volts, time) for known in ({}, ELECTRIC)
    )
    assert np.max(np.abs(one.speed - other.speed)) < 1e-9
