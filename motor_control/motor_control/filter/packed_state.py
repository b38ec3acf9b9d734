"""Pack hypotheses into one array and back, so that Python keeps one object and not sixteen nested tuples.

Numba makes a Python object of every tuple that it returns and takes it apart again in the next call: 14 µs a sample,
more than the filter itself takes.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motor_control.filter.direction_hypotheses import Hypotheses
from motor_control.filter.filter_state import (
    Consistency,
    Covariance,
    Estimate,
    FilterState,
    History,
    LatestEdge,
    Silence,
)
from motor_control.filter.load_jump import Jumps
from motor_model.compiled import compiled
from motor_model.dynamics.state import State

Floats = NDArray[np.float64]
STATE = 25  # numbers of one filter state


class Memory(NamedTuple):
    """Packed hypotheses."""

    numbers: Floats  # of both filter states and the lead, shape (51,)
    jumps: Jumps


@compiled
def _pack_state(x: FilterState, into: Floats) -> None:
    """Write a filter state into an array of shape (25,)."""
    e, h = x.estimate, x.history
    for k, value in enumerate(e.motor):
        into[k] = value
    for k, value in enumerate(e.covariance):
        into[6 + k] = value
    for k, value in enumerate(h.edge):
        into[12 + k] = value
    for k, value in enumerate(h.consistency):
        into[16 + k] = value
    into[19], into[20] = h.silence.overdue, 1.0 if h.silence.stands else 0.0
    into[21], into[22], into[23], into[24] = e.load, h.missed, h.doubt, x.elapsed


@compiled
def _unpack_state(m: Floats) -> FilterState:
    """Read a filter state from an array of shape (25,)."""
    motor = State(m[0], m[1], m[2], m[3], m[4], m[5])
    covariance = Covariance(m[6], m[7], m[8], m[9], m[10], m[11])
    history = History(
        LatestEdge(m[12], m[13], m[14], m[15]),
        Silence(m[19], m[20] != 0.0),
        Consistency(m[16], m[17], m[18]),
        m[22],
        m[23],
    )
    return FilterState(Estimate(motor, m[21], covariance), history, m[24])


@compiled
def pack_hypotheses(pair: Hypotheses) -> Memory:
    """Pack the hypotheses."""
    numbers = np.empty(2 * STATE + 1)
    _pack_state(pair.likely, numbers[:STATE])
    _pack_state(pair.other, numbers[STATE : 2 * STATE])
    numbers[2 * STATE] = pair.lead
    return Memory(numbers, pair.jumps)


@compiled
def unpack_hypotheses(memory: Memory) -> Hypotheses:
    """Unpack what `pack_hypotheses` made."""
    numbers = memory.numbers
    likely, other = _unpack_state(numbers[:STATE]), _unpack_state(numbers[STATE : 2 * STATE])
    return Hypotheses(likely, other, numbers[2 * STATE], memory.jumps)
