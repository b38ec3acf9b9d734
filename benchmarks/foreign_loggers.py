"""Logs as other people make them by loggers as other people have them, simulated: does the diagnosis name what is in?

The motors, effects and excitations of `foreign_logs.py` (a single step is left out), in two of three logs beside a
logger's own ways: periods that are irregular by 5 or 30 %, stamps that are late by a twentieth or a third of a row in
the mean, stamps in whole milliseconds, the voltage that held until a row instead of the one from there on, counts
divided by the period that the loop should have had, speeds that keep a half or four fifths of the one before, or were
filtered otherwise: a low-pass by the bilinear transform, two in series, a Butterworth filter of second order, a mean of
the last rows. The tests' independent plant moves; `import_log` is told nothing. Where speeds are smoothed, a lag may be
named.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
from foreign_logs import run
from foreign_logs_cases import EXCITATIONS, SENSORS, Case, Logger, draw

RESULTS = Path(__file__).with_name("results") / "foreign_loggers.md"
SLOWEST_WHOLE = 200.0  # [Hz] from which on whole milliseconds are no stamps
FILTERS = ("bilinear 0.854", "twice 0.7", "butterworth 0.2", "mean 2", "mean 5", "mean 10")


def draw_logged(seed: int) -> Case:
    """Draw a motor and its log as `foreign_logs` does, and a logger."""
    case, random = draw(seed), np.random.default_rng([19, seed])
    excitation = str(random.choice(EXCITATIONS[1:]))
    loop = float(random.choice([0.0, 0.0, 0.05, 0.3]))
    logger = Logger(
        loop=loop,
        late=float(random.choice([0.0, 0.0, 0.05, 0.3])),
        whole=bool(random.random() < 0.4) and case.rate <= SLOWEST_WHOLE,
        before=bool(random.random() < 0.2),
        nominal=bool(random.random() < 0.5) and loop > 0.0 and case.sensor == SENSORS[1],
        memory=float(random.choice([0.0, 0.0, 0.0, 0.5, 0.8])) if case.sensor != SENSORS[0] else 0.0,
    )
    other = str(np.random.default_rng([22, seed]).choice(["", *FILTERS]))
    if case.sensor != SENSORS[0] and not logger.memory and other:
        logger = replace(logger, filter=other)
    return replace(case, excitation=excitation, logger=logger)


def main() -> None:
    """Print the cases as they come, and write the page."""
    run(draw_logged, RESULTS, __doc__ or "")


if __name__ == "__main__":
    main()
