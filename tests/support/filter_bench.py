"""A filter to test: the paper's motor, an even disc, and states made by hand."""

from math import inf, tau

import numpy as np

from motor_control.filter.filter_state import (
    Consistency,
    Covariance,
    Estimate,
    FilterState,
    History,
    LatestEdge,
    Noise,
    Silence,
)
from motor_control.filter.prediction import Commands
from motor_model.dynamics.state import State
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters

SLOT = tau / 96
NOISE = Noise(
    slot=SLOT, flank=0.01 * SLOT, turn=0.2 * SLOT, tick=4e-6, walk=0.002, shake=1e-6, missing=False, single=True
)
TWO_CHANNELS = NOISE._replace(single=False)
CERTAIN = Covariance(1e-8, 0.0, 0.0, 1e-4, 0.0, 1e-4)
KV, KA = PAPER_KV, PAPER_KA


def vector(effects: tuple[str, ...] = (), **values: float) -> np.ndarray:
    """The paper's motor as the filter takes it."""
    return Parameters({"kv": KV, "ka": KA, **values}, effects).vector()


def state(
    speed: float, angle: float = 0.0, load: float = 0.0, covariance: Covariance = CERTAIN, since: float = 0.0
) -> FilterState:
    """A motor whose latest edge was passed forwards (or backwards, by the speed's sign) `since` [s] ago."""
    side = 1.0 if speed >= 0.0 else -1.0
    estimate = Estimate(State(angle, speed, 0.0, 0.0, side, 0.0), load, covariance)
    history = History(LatestEdge(side, since, 0.0, load), Silence(0.0, False), Consistency(0.0, 0.0, 1.0), 0.0, 0.0)
    return FilterState(estimate, history, 0.0)


def held(voltage: float) -> Commands:
    """One command [V], for ever."""
    return Commands(np.array([0.0, -inf]), np.array([voltage, voltage]))
