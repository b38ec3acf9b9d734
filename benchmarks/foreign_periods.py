"""Logs of boards that compute speeds from the time between edges, simulated: does the diagnosis name what is in them?

The motors, effects and excitations of `foreign_logs.py` (a single step is left out). The speed of a row is a slot over
the time between the latest two edges of a disc whose flanks are 1 % off, at half to a hundred edges a row at full
speed; until the next edge it stays, or falls with the time since, and after a tenth of a second or ten rows without one
it is 0. In one log of five the voltage is that which held until the row. The tests' independent plant moves;
`import_log` is told nothing.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
from foreign_logs import run
from foreign_logs_cases import EXCITATIONS, TIMED, Case, Logger, draw

RESULTS = Path(__file__).with_name("results") / "foreign_periods.md"
A_ROW = (0.5, 100.0)  # edges, at full speed


def draw_timed(seed: int) -> Case:
    """Draw a motor and its log as `foreign_logs` does, of a board that times edges."""
    case, random = draw(seed), np.random.default_rng([23, seed])
    per_row = A_ROW[0] * (A_ROW[1] / A_ROW[0]) ** random.random()
    counts = int(np.clip(np.rint(per_row * case.rate * 2.0 * np.pi * case.values["kv"] / case.supply), 2, 8192))
    logger = Logger(before=bool(random.random() < 0.2), falls=bool(random.random() < 0.5))
    return replace(case, sensor=TIMED, counts=counts, logger=logger, excitation=str(random.choice(EXCITATIONS[1:])))


def main() -> None:
    """Print the cases as they come, and write the page."""
    run(draw_timed, RESULTS, __doc__ or "")


if __name__ == "__main__":
    main()
