"""A simulated board with a current sensor: honest noise, honest steps, an honest end of its range."""

import numpy as np
import pytest
from electrical import ELECTRIC, LUMPED

from motor_model.parameters import Parameters
from motor_model.sensing.board import BoardConfig, SimulatedBoard
from motor_model.sensing.current_sense import make_current_sense

MOTOR = Parameters(LUMPED, ("coulomb_friction",), **ELECTRIC)


def test_it_reads_in_steps_with_a_step_of_noise() -> None:
    sense = make_current_sense(MOTOR, 0)
    assert sense is not None and 0.0224 < sense.step < 0.0225
    read = np.array([sense.read(1.0) for _ in range(4000)])
    assert np.max(np.abs(read / sense.step - np.round(read / sense.step))) < 1e-9
    assert abs(np.mean(read) - 1.0) < 0.1 * sense.step and 0.95 < np.std(read) / sense.step < 1.15
    assert sense.read(1e3) == pytest.approx(511 * sense.step) and sense.read(-1e3) == pytest.approx(-512 * sense.step)


def test_a_board_reports_it_where_the_resistance_is_known() -> None:
    board = SimulatedBoard(MOTOR, BoardConfig())
    seen = [board.sample(12.0) for _ in range(100)]
    assert abs(seen[0].current) < 0.1  # nothing has acted yet
    assert 4.5 < seen[1].current < 5.3  # 12 V on 2.3 Ω, and 4 rad/s already
    steady = np.mean([one.current for one in seen[80:]])
    assert abs(steady - board.current) < 0.03 and 0.18 < board.current < 0.24  # friction: 10 mN·m and 4.4 mN·m
    assert np.isnan(SimulatedBoard(Parameters(LUMPED, ("coulomb_friction",)), BoardConfig()).sample(1.0).current)
