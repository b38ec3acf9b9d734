"""Update the filter at a sample: through the edges since the last one, then on to when the next voltage acts."""

from math import inf, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motor_control.filter.direction_hypotheses import (
    Hypotheses,
    finish_sample,
    predict_hypotheses,
    update_hypotheses,
)
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
from motor_control.filter.load_jump import UNEARNED, Jumps
from motor_control.filter.packed_state import Memory, pack_hypotheses, unpack_hypotheses
from motor_control.filter.prediction import Commands, find_acting_voltage, predict_state
from motor_model.compiled import compiled
from motor_model.dynamics.state import State
from motor_model.effects import INDEX

DELAY, U_MAX = INDEX["delay"], INDEX["max_voltage"]
UNKNOWN_LOAD = 0.1 / 12.0  # of the supply: standard deviation of the load at the start

Floats = NDArray[np.float64]


class Edge(NamedTuple):
    """An edge between two samples."""

    time: float  # [s] after the earlier sample; NaN: there was none
    steps: float  # since the edge before it; signed where the encoder has two channels
    bare: bool  # it has no period: the first one, and where two channels take an edge back


class Speed(NamedTuple):
    """A speed and how certain it is."""

    mean: float  # [rad/s]
    sigma: float  # [rad/s]


class SampleUpdate(NamedTuple):
    """What a sample leads to."""

    memory: Memory  # the hypotheses at the sample
    commands: Commands  # counted from the sample
    ahead: Speed  # when a voltage sent now will act
    innovation: float  # [rad] angle at the latest edge less its prediction
    load: float  # [V] beyond the model's
    stands: bool  # no edge comes although the model would have it move


@compiled
def start_filter(p: Floats, noise: Noise, speed: float, direction: float, jumps: Jumps) -> Memory:
    """Start from a reported speed [rad/s] alone, as good as a period of irregular slots; jumps: a table without any."""
    covariance = Covariance(noise.slot * noise.slot, 0.0, 0.0, (0.1 * speed) ** 2, 0.0, (UNKNOWN_LOAD * p[U_MAX]) ** 2)
    estimate = Estimate(State(0.0, speed, 0.0, 0.0, direction, 0.0), 0.0, covariance)
    history = History(LatestEdge(0.0, 0.0, 0.0, 0.0), Silence(0.0, False), Consistency(0.0, 0.0, UNEARNED), 0.0, 0.0)
    state = FilterState(estimate, history, 0.0)
    return pack_hypotheses(Hypotheses(state, state, inf, jumps))


@compiled
def shift_commands(commands: Commands, voltage: float, dt: float) -> Commands:
    """Count the commands from a sample dt [s] later that latches a voltage [V]; the oldest goes if that is new."""
    times, voltages = np.empty_like(commands.times), np.empty_like(commands.voltages)
    times[0], voltages[0] = 0.0, voltage
    if commands.voltages[0] == voltage:
        times[:], voltages[:] = commands.times - dt, commands.voltages
    else:
        times[1:], voltages[1:] = commands.times[:-1] - dt, commands.voltages[:-1]
    return Commands(times, voltages)


@compiled
def predict_speed(p: Floats, noise: Noise, memory: Memory, commands: Commands, lead: float) -> Speed:
    """Predict the speed `lead` [s] after the sample if its voltage stays."""
    then = predict_state(p, noise, unpack_hypotheses(memory).likely, commands, 0.0, lead).estimate
    return Speed(then.motor.speed, sqrt(max(then.covariance.ss, 0.0)))


@compiled
def update_at_sample(
    p: Floats,
    noise: Noise,
    memory: Memory,
    commands: Commands,
    dt: float,
    voltage: float,
    edges: tuple[Edge, Edge],
    lead: float,
) -> SampleUpdate:
    """Update the hypotheses at a sample dt [s] after their own, which latches a voltage [V].

    p: the model's vector. edges: the latest two since then. lead: [s] after which a voltage that is sent now gets to
    the board.
    """
    pair, t, seen = unpack_hypotheses(memory), 0.0, False
    for edge in edges:
        if edge.time == edge.time:  # not NaN
            stop = min(max(edge.time, t), dt)
            pair = predict_hypotheses(p, noise, pair, commands, t, stop)
            pair = update_hypotheses(p, noise, pair, find_acting_voltage(p, commands, stop), edge.steps, edge.bare)
            t, seen = stop, True
    pair = predict_hypotheses(p, noise, pair, commands, t, dt)
    pair = finish_sample(p, noise, pair, find_acting_voltage(p, commands, dt), dt, seen)
    after = shift_commands(commands, voltage, dt)
    history, load = pair.likely.history, pair.likely.estimate.load
    memory = pack_hypotheses(pair)
    ahead = predict_speed(p, noise, memory, after, lead + p[DELAY])
    return SampleUpdate(memory, after, ahead, history.edge.innovation, load, history.silence.stands)
