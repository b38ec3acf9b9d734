"""A gearmotor is identified in the output's units, though slots and ripple repeat with the motor's shaft."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from fits import quick
from plant import profiles, record

from motor_identification.identify import identify
from motor_identification.recording import Recording, check, recording_of
from motor_model.parameters import Parameters
from motor_model.sensing.board import BoardConfig, SimulatedBoard
from motor_model.sensing.encoder import Lines

GEAR = Fraction("34.014")


def behind_the_gear(values: dict[str, float], seed: int, drive: profiles.Profile | None = None) -> Recording:
    """The independent plant is the motor's shaft, with 44 irregular slots; who reads speaks of the output."""
    drive = drive or profiles.compact(6.0, seed)
    recording, _ = record(values, *drive, edges=44, irregularity=0.02, seed=seed, tick=5e-7)
    info = replace(recording.info, gear_ratio=float(GEAR))
    return check(replace(recording, info=info, speed=recording.speed / float(GEAR)))


@pytest.mark.parametrize("seed", [1, 2])
def test_an_independent_geared_motor_is_found_within_its_errors(seed: int) -> None:
    fit = identify([behind_the_gear({"kv": 0.0265, "ka": 0.0018, "ks": 0.7}, seed)], quick("coulomb_friction"))
    truth = {"kv": 0.0265 * float(GEAR), "ka": 0.0018 * float(GEAR), "ks": 0.7}
    for name, value in truth.items():
        error = fit.parameters.values[name] - value
        assert abs(error) < 4.0 * fit.standard_errors[name] and fit.standard_errors[name] < 0.01 * value, name
    assert fit.parameters.gear_ratio == pytest.approx(34.014) and 0.01 < fit.slot_irregularity[0] < 0.03


@pytest.mark.slow
def test_a_ripple_of_the_motor_s_shaft_is_found_behind_the_gear() -> None:
    wave = {"ripple_voltage": 0.3, "ripple_cycles": 3.0, "ripple_phase": 0.5}
    recording = behind_the_gear({"kv": 0.0265, "ka": 0.0018, **wave}, 1, profiles.random(6.0, 8.0, 1))
    fit = identify([recording], quick("torque_ripple"))
    assert fit.parameters.values["ripple_cycles"] == pytest.approx(3.0, abs=0.002)
    assert fit.parameters.values["ripple_voltage"] == pytest.approx(
        0.3, abs=4.0 * fit.standard_errors["ripple_voltage"]
    )


def test_fourfold_counting_of_an_uneven_sensor_costs_nothing() -> None:
    """Duty cycle 44 %, phase 76°: the four flanks of a period are learnt, the motor is found within its errors."""
    truth = Parameters({"kv": 0.9, "ka": 0.06, "ks": 0.7}, ("coulomb_friction",))
    config = BoardConfig(
        edges_per_revolution=44, single_channel=False, quadrature=4, gear=GEAR, edge_resolution=5e-7, seed=2,
        slot_irregularity=0.02, lines=Lines(0.44, 0.21),
    )  # fmt: skip
    board, (_, volts) = SimulatedBoard(truth, config), profiles.compact(8.0, 3)
    samples = [board.sample(float(volt)) for volt in volts]
    fit = identify([check(recording_of(samples, config.info(truth), "geared"))], quick("coulomb_friction"))
    for name, value in truth.values.items():
        error = fit.parameters.values[name] - value
        assert abs(error) < 4.0 * fit.standard_errors[name] and fit.standard_errors[name] < 0.01 * value, name
    assert 0.1 < fit.slot_irregularity[0] < 0.3 and np.isfinite(fit.residual_rms)
