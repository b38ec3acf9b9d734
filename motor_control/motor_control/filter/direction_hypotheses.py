"""Two beliefs where a single channel leaves the direction open: the likely one, and the same edges the other way.

Near a reversal the model decides, and may be wrong by an edge. So wherever an edge has left doubt, the mirrored motion
is followed too. The voltage drives one of them on and brakes the other, hence the next edge or two tell which is true
(a bank of two filters, compared by the likelihood of the edges: Bar-Shalom, Li & Kirubarajan, "Estimation with
Applications to Tracking and Navigation", 2001, section 11.6).
"""

from math import inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motor_control.filter.edge_update import edge_passed
from motor_control.filter.filter_state import Belief, Noise, mirrored
from motor_control.filter.load_jump import forgotten, led_on
from motor_control.filter.no_edge_update import bounded, nothing_seen, turned_round
from motor_control.filter.prediction import acting, carried
from motor_model.compiled import compiled

OPEN = 12.0  # log-likelihood by which the chosen direction has to lead, else the other one is followed as well
HEAD_START = 3.0  # of it, at most, that the chosen one is given: a wrong model is too sure of itself
OVERTAKEN = 25.0  # by which the other has to lead to be taken for the true one: a model's own errors make less
SETTLED = 25.0  # after which the other one is dropped

Floats = NDArray[np.float64]


class Pair(NamedTuple):
    """The likely belief, the other one, and by how much log-likelihood the first leads; infinite: there is no other."""

    likely: Belief
    other: Belief
    lead: float
    jumps: Floats  # of the likely belief's load; see `jump`


@compiled
def _settled(likely: Belief, other: Belief, lead: float, jumps: Floats, choice: float) -> Pair:
    """The pair after an edge whose direction was chosen with this much more likelihood."""
    if lead == inf:
        if choice < OPEN:
            return Pair(likely, mirrored(likely, likely.load), min(choice, HEAD_START), jumps)
        return Pair(likely, other, inf, jumps)
    if likely.motor.speed * other.motor.speed > 0.0:  # they agree by now
        if lead < -OVERTAKEN:
            likely = other
            forgotten(jumps)
        return Pair(likely, other, inf, jumps)
    if lead < -OVERTAKEN:
        likely, other, lead = other, likely, -lead
        forgotten(jumps)
    return Pair(likely, other, inf if lead > SETTLED else lead, jumps)


@compiled
def followed(
    p: Floats, noise: Noise, pair: Pair, latched: Floats, start: float, stop: float, edge: bool, steps: float
) -> Pair:
    """The pair from start to stop [s], where an edge passes or not, `steps` after the one before."""
    likely, other, lead, choice, jumps = pair.likely, pair.other, pair.lead, inf, pair.jumps
    led_on(p, jumps, acting(p, latched, stop), likely.motor.speed, stop - start)
    for which in range(2):
        if which == 1 and lead == inf:
            break
        b = carried(p, noise, likely if which == 0 else other, latched, start, stop)
        if edge:
            b, score, doubt = edge_passed(
                p, noise, b, jumps if which == 0 else jumps[:0], acting(p, latched, stop), steps
            )
            lead += score if which == 0 else -score
            choice = doubt if which == 0 else choice
            b = bounded(p, noise, b)
        if which == 0:
            likely = b
        else:
            other = b
    return _settled(likely, other, lead, jumps, choice) if edge else Pair(likely, other, lead, jumps)


@compiled
def at_sample(p: Floats, noise: Noise, pair: Pair, u: float, dt: float, seen: bool) -> Pair:
    """The pair at a sample dt [s] after the last one; seen: an edge has come since; u: effective voltage [V]."""
    likely, other = pair.likely, pair.other
    if not seen:
        likely, other = nothing_seen(noise, likely, dt), nothing_seen(noise, other, dt)
    after = turned_round(p, noise, likely, u, dt)
    if after.motor.speed * likely.motor.speed < 0.0:
        forgotten(pair.jumps)
    return Pair(bounded(p, noise, after), bounded(p, noise, other), pair.lead, pair.jumps)
