"""One sample: what has come since the last one, and how things stand now and when the next voltage acts."""

from math import inf, isnan, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motor_control.filter.direction_hypotheses import Pair, at_sample, followed
from motor_control.filter.filter_state import Belief, Noise, Spread, Trail
from motor_control.filter.load_jump import SHAPE, UNEARNED
from motor_control.filter.prediction import acting, carried
from motor_model.compiled import compiled
from motor_model.dynamics.state import State
from motor_model.effects import INDEX

DELAY = INDEX["delay"]

Floats = NDArray[np.float64]


class Reading(NamedTuple):
    """What a sample leads to."""

    pair: Pair  # at the sample
    latched: Floats  # [s] before the sample, [V]; the newest first
    speed: float  # [rad/s] when a voltage sent now will act
    sigma: float  # [rad/s] of that


@compiled
def first_pair(noise: Noise, speed: float, direction: float) -> Pair:
    """A motor of which only a reported speed [rad/s] is known, as good as a period of irregular slots."""
    spread = Spread(noise.slot * noise.slot, 0.0, 0.0, 0.01 * speed * speed, 0.0, 0.01)
    motor = State(0.0, speed, 0.0, 0.0, direction, 0.0)
    belief = Belief(motor, 0.0, spread, Trail(0.0, 0.0, 0.0, False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, UNEARNED), 0.0)
    return Pair(belief, belief, inf, np.zeros(SHAPE))


@compiled
def read(
    p: Floats,
    noise: Noise,
    pair: Pair,
    latched: Floats,
    dt: float,
    voltage: float,
    earlier: tuple[float, float],
    latest: tuple[float, float],
    lead: float,
) -> Reading:
    """What is believed dt [s] after `pair`, at a sample that latches a voltage [V].

    p: the model's vector. earlier, latest: edges since then as time after `pair` [s] (NaN: none) and steps. lead: [s]
    after which a voltage that is sent now gets to the board.
    """
    p = p.copy()
    t, seen = 0.0, False
    pair = Pair(pair.likely, pair.other, pair.lead, pair.jumps.copy())  # the rest is written to it
    for at, steps, edge in ((*earlier, True), (*latest, True), (dt, 0.0, False)):
        if not isnan(at):
            stop = min(max(at, t), dt)
            pair = followed(p, noise, pair, latched, t, stop, edge, steps)
            t, seen = stop, seen or edge
    pair = at_sample(p, noise, pair, acting(p, latched, dt), dt, seen)
    after = np.empty_like(latched)
    after[0, 0], after[0, 1] = 0.0, voltage
    if latched[0, 1] == voltage:
        after[:, 0], after[:, 1] = latched[:, 0] - dt, latched[:, 1]
    else:
        after[1:, 0], after[1:, 1] = latched[:-1, 0] - dt, latched[:-1, 1]
    then = carried(p, noise, pair.likely, after, 0.0, lead + p[DELAY])
    return Reading(pair, after, then.motor.speed, sqrt(max(then.spread.ss, 0.0)))
