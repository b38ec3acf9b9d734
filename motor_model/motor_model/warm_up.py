"""`python -m motor_model.warm_up`: compile the motor ahead of time, so that nobody waits at the first start."""

import numpy as np

from motor_model.compiled import drop_stale
from motor_model.parameters import paper_motor
from motor_model.sensing.board import BoardConfig, SimulatedBoard
from motor_model.simulate import simulate


def main() -> None:
    """Drop machine code of older sources and run every compiled function once."""
    drop_stale()
    board = SimulatedBoard(paper_motor(), BoardConfig())
    for _ in range(20):
        board.sample(12.0)
    simulate(paper_motor(), np.array([0.0]), np.array([10.0]), np.array([0.0, 0.05, 0.1]))


if __name__ == "__main__":
    main()
