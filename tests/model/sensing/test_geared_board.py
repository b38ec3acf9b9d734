"""The simulated board with a gear and both channels: counts of the motor's shaft, speeds and angles of the output."""

from fractions import Fraction
from math import tau

import numpy as np
import pytest

from motor_model.parameters import Parameters
from motor_model.sensing.board import BoardConfig, SimulatedBoard
from motor_model.sensing.encoder import Lines, make_lines_disc

GEAR = Fraction("34.014")
MOTOR = {"kv": 0.9, "ka": 0.05}


@pytest.mark.parametrize("quadrature", [1, 2, 4])
def test_counts_follow_the_output_and_go_back_with_it(quadrature: int) -> None:
    config = BoardConfig(
        edges_per_revolution=11 * quadrature,
        single_channel=False,
        quadrature=quadrature,
        gear=GEAR,
        slot_irregularity=0.02,
        lines=Lines(0.44, 0.21),
    )
    board = SimulatedBoard(Parameters(MOTOR), config)
    info = config.info(Parameters(MOTOR))
    assert info.edge_angle == pytest.approx(tau / (11 * quadrature * 34.014)) and info.gear == GEAR
    for voltage in np.repeat([6.0, -9.0, 3.0], 200):
        sample = board.sample(voltage)
        assert abs(sample.edge_count * info.edge_angle - board.angle) < 1.6 * info.edge_angle
    assert sample.speed == pytest.approx(board.speed, rel=0.01 if quadrature > 1 else 0.06)


def test_a_dithering_shaft_does_not_drift() -> None:
    """±0.6 counts to and fro for ten minutes."""
    config = BoardConfig(edges_per_revolution=44, single_channel=False, quadrature=4, gear=GEAR, seed=4)
    board = SimulatedBoard(Parameters(MOTOR), config)
    counts = {board.sample(voltage).edge_count for voltage in np.tile([0.5, -0.5], 300)}
    assert max(counts) - min(counts) <= 3


def test_flanks_of_an_uneven_sensor_stand_where_duty_cycle_and_phase_put_them() -> None:
    flanks = make_lines_disc(11, 4, 0.0, 0, 34.014, Lines(0.44, 0.21)).forward
    period = tau / 11 / 34.014
    assert flanks[4:8] - flanks[4] == pytest.approx(period * np.array([0.0, 0.21, 0.44, 0.65]))


def test_a_ripple_and_an_eccentric_disc_are_the_motor_s_shaft_s() -> None:
    """Behind the gear, at the same motion of the motor, both are what they are without it."""
    effects = ("torque_ripple", "encoder_eccentricity")
    wave = {"ripple_voltage": 0.8, "ripple_cycles": 3.0, "ripple_phase": 0.4}
    disc = {"eccentricity": 0.05, "eccentricity_phase": 1.0}
    bare = Parameters({"kv": 0.02, "ka": 0.001, **wave, **disc}, effects)
    geared = Parameters({"kv": 0.02 * 34.0, "ka": 0.001 * 34.0, **wave, **disc}, effects, gear_ratio=34.0)
    config = BoardConfig(edges_per_revolution=44, single_channel=False, start_angle=0.0, edge_resolution=0.0)
    one, other = SimulatedBoard(bare, config), SimulatedBoard(geared, config)
    for _ in range(400):
        first, second = one.sample(5.0), other.sample(5.0)
        assert first.edge_count == second.edge_count
        assert second.edge_time == pytest.approx(first.edge_time, abs=2_000)
        assert one.speed == pytest.approx(34.0 * other.speed, rel=1e-4)
