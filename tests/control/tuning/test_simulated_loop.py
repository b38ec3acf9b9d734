"""The rehearsal: a voltage acts from the sample after the one it answers, and the run is a loop's."""

import numpy as np
import pytest
from tuning_bench import RUBBING

from motor_control.configuration import config_of
from motor_control.parameters import ROWS
from motor_control.tuning.simulated_loop import rehearse
from motor_model.parameters import paper_motor
from motor_model.sensing.board import BoardConfig

DEFAULTS = {row.name: row.default for row in ROWS}


@pytest.mark.parametrize("rate", [200.0, 1000.0])
def test_the_motor_starts_a_sample_after_the_first_answer(rate: float) -> None:
    board = BoardConfig(sample_rate=rate)
    run = rehearse(paper_motor(), board, config_of(DEFAULTS, board.info(paper_motor())), lambda _: 100.0, 0.5)
    assert len(run.time) == round(0.5 * rate) and run.time[1] == pytest.approx(1.0 / rate)
    assert run.voltage[0] == 12.0 and run.speed[1] == 0.0
    assert run.speed[2] == pytest.approx(12.0 / 0.0055 / rate, rel=0.05)
    assert run.speed[-1] == pytest.approx(100.0, rel=0.02) == pytest.approx(run.used[-1], rel=0.02)


def test_the_reference_is_a_function_of_time() -> None:
    board = BoardConfig()
    config = config_of(DEFAULTS, board.info(RUBBING))
    run = rehearse(RUBBING, board, config, lambda t: 40.0 if t < 0.6 else 80.0, 1.5)
    assert np.mean(run.speed[100:120]) == pytest.approx(40.0, rel=0.03)
    assert np.mean(run.speed[-20:]) == pytest.approx(80.0, rel=0.03)
