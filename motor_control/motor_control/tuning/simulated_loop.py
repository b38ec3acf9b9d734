"""A closed loop in simulation: the motor of a model file, its encoder and board, and the controller as it runs."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from motor_control.controller import controller
from motor_control.controller.run import Config
from motor_model.parameters import Parameters
from motor_model.sensing.board import BoardConfig, SimulatedBoard

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Rehearsal:
    """What happened at each sample; arrays of shape (K,)."""

    time: Floats  # [s]
    speed: Floats  # [rad/s] true
    used: Floats  # [rad/s] what the law used
    voltage: Floats  # [V] answered


def rehearse(
    parameters: Parameters,
    board: BoardConfig,
    config: Config,
    reference: Callable[[float], float],
    duration: float,
) -> Rehearsal:
    """Run a loop from rest: reference [rad/s] of time [s]; a voltage acts from the sample after the one it answers."""
    plant, state, voltage = SimulatedBoard(parameters, board), controller.State(), 0.0
    rows = np.empty((round(duration * board.sample_rate), 4))
    for k in range(len(rows)):
        time = k / board.sample_rate
        sample = plant.sample(voltage)
        output, state = controller.update(config, state, sample, reference(time), time)
        voltage = output.terms.voltage
        rows[k] = time, plant.speed, output.speed, voltage
    return Rehearsal(rows[:, 0], rows[:, 1], rows[:, 2], rows[:, 3])
