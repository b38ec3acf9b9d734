"""Choose how much of a gear's play is open where a recording begins: nobody knows, and its first motion tells.

Where the motor begins by moving away from the load it runs alone until the play is taken up, as after a reversal. What
is open is of the recording, as an initial speed is, but shows in its first motion only; so it is no unknown of a fit:
of a few shares the one that leaves least is taken, for every motor that is simulated. Measured: of a play of 0.92 rad
that was open, with all else as it was, the first motion was off by 45 of 80 rad/s, and a fit ended without friction.
"""

from collections.abc import Callable

import numpy as np

from motor_identification.recording import Bools, Floats
from motor_model.effects import INDEX, OPEN_PLAY

SHARES = (0.0, 0.5, 1.0)
OPEN, PLAY, LOAD_FRACTION = INDEX[OPEN_PLAY], INDEX["backlash_angle"], INDEX["load_fraction"]


def choose_open_play(
    simulate: Callable[[Floats, Floats], Floats], vectors: Floats, starts: Floats, weight: Floats
) -> tuple[Floats, Floats]:
    """Choose the share of the play that is open for each of a swarm of motors (S,), and its residuals (S, I) [rad/s].

    simulate: residuals of vectors (S, P) that begin with speeds (S,) [rad/s]. weight: of the residuals, (I,). A motor
    without a play, or that turns already, has none that is open.
    """
    vectors[:, OPEN] = SHARES[0]
    residuals = simulate(vectors, starts)
    shares = np.full(len(vectors), SHARES[0])
    loose = np.flatnonzero(mark_loose(vectors, starts))
    if len(loose) == 0:
        return residuals, shares
    least = residuals[loose] ** 2 @ weight
    for share in SHARES[1:]:
        opened = vectors[loose]
        opened[:, OPEN] = share
        again = simulate(opened, starts[loose])
        cost = again**2 @ weight
        better = cost < least
        residuals[loose[better]], shares[loose[better]] = again[better], share
        least = np.minimum(cost, least)
    return residuals, shares


def mark_loose(vectors: Floats, starts: Floats) -> Bools:
    """Mark the motors (S,), of vectors (S, P), whose motion depends on what is open of their play as they begin."""
    return np.asarray((vectors[:, PLAY] > 0.0) & (vectors[:, LOAD_FRACTION] > 0.0) & (starts == 0.0))
