"""Follow two hypotheses where a single channel leaves the direction open: the likely one, and the other way round.

Near a reversal the model decides, and may be wrong by an edge. So wherever an edge has left doubt, the mirrored motion
is followed too. The voltage drives one of them on and brakes the other, hence the next edge or two tell which is true
(a bank of two filters, compared by the likelihood of the edges: Bar-Shalom, Li & Kirubarajan, "Estimation with
Applications to Tracking and Navigation", 2001, section 11.6).
"""

from math import inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motor_control.filter.edge_update import update_at_edge
from motor_control.filter.filter_state import FilterState, Noise, mirror_motion
from motor_control.filter.load_jump import Jumps, forget_jumps, predict_jumps
from motor_control.filter.no_edge_update import clamp_state, turn_by_load, update_without_edge
from motor_control.filter.prediction import Commands, find_acting_voltage, predict_state
from motor_model.compiled import compiled

OPEN = 12.0  # log-likelihood by which the chosen direction has to lead, else the other one is followed as well
HEAD_START = 3.0  # of it, at most, that the chosen one is given: a wrong model is too sure of itself
OVERTAKEN = 25.0  # by which the other has to lead to be taken for the true one: a model's own errors make less
SETTLED = 25.0  # after which the other one is dropped

Floats = NDArray[np.float64]


class Hypotheses(NamedTuple):
    """Both directions, and by how much log-likelihood the first leads; infinite: there is no other."""

    likely: FilterState
    other: FilterState
    lead: float
    jumps: Jumps  # of the likely one's load; see `load_jump`


@compiled
def decide_direction(pair: Hypotheses, margin: float) -> Hypotheses:
    """Decide between the directions after an edge whose own direction was chosen by this log-likelihood margin."""
    likely, other, lead, jumps = pair.likely, pair.other, pair.lead, pair.jumps
    if lead == inf:
        if margin < OPEN:
            return Hypotheses(likely, mirror_motion(likely, likely.estimate.load), min(margin, HEAD_START), jumps)
        return pair
    if likely.estimate.motor.speed * other.estimate.motor.speed > 0.0:  # they agree by now
        if lead < -OVERTAKEN:
            return Hypotheses(other, other, inf, forget_jumps(jumps))
        return Hypotheses(likely, other, inf, jumps)
    if lead < -OVERTAKEN:
        likely, other, lead, jumps = other, likely, -lead, forget_jumps(jumps)
    return Hypotheses(likely, other, inf if lead > SETTLED else lead, jumps)


@compiled
def predict_hypotheses(
    p: Floats, noise: Noise, pair: Hypotheses, commands: Commands, start: float, stop: float
) -> Hypotheses:
    """Predict both hypotheses from `start` to `stop` [s]."""
    u = find_acting_voltage(p, commands, stop)
    jumps = predict_jumps(p, pair.jumps, u, pair.likely.estimate.motor.speed, stop - start)
    likely = predict_state(p, noise, pair.likely, commands, start, stop)
    other = pair.other if pair.lead == inf else predict_state(p, noise, pair.other, commands, start, stop)
    return Hypotheses(likely, other, pair.lead, jumps)


@compiled
def update_hypotheses(p: Floats, noise: Noise, pair: Hypotheses, u: float, steps: float, bare: bool) -> Hypotheses:
    """Update both hypotheses at an edge, `steps` after the last one, under an effective voltage u [V]."""
    first = update_at_edge(p, noise, pair.likely, pair.jumps, u, steps, bare)
    likely, other, lead = clamp_state(p, noise, first.state), pair.other, pair.lead
    if lead != inf:
        second = update_at_edge(p, noise, other, pair.jumps[:0], u, steps, bare)
        other, lead = clamp_state(p, noise, second.state), lead + first.log_likelihood - second.log_likelihood
    return decide_direction(Hypotheses(likely, other, lead, first.jumps), first.margin)


@compiled
def finish_sample(p: Floats, noise: Noise, pair: Hypotheses, u: float, dt: float, seen: bool) -> Hypotheses:
    """Finish a sample dt [s] after the last one, at an effective voltage u [V]; seen: an edge has come since."""
    likely, other, jumps = pair.likely, pair.other, pair.jumps
    if not seen:
        likely, other = update_without_edge(noise, likely, dt), update_without_edge(noise, other, dt)
    after = turn_by_load(p, noise, likely, u, dt)
    if after.estimate.motor.speed * likely.estimate.motor.speed < 0.0:
        jumps = forget_jumps(jumps)
    return Hypotheses(clamp_state(p, noise, after), clamp_state(p, noise, other), pair.lead, jumps)
