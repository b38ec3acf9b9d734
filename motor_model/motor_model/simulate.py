"""Roll-outs: where a motor is at given times under a recorded command, for one motor or a whole swarm."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from motor_model.bridge import effective_voltage
from motor_model.compiled import compiled
from motor_model.effects import INDEX
from motor_model.errors import ModelError
from motor_model.motor import advance, at_rest, turning
from motor_model.parameters import Parameters

DELAY = INDEX["delay"]

Floats = NDArray[np.float64]


@compiled
def roll_out(
    p: Floats, start_speed: float, command_time: Floats, command: Floats, out_time: Floats, angle: Floats, speed: Floats
) -> None:
    """Fill angle [rad] and speed [rad/s] of one motor at out_time [s].

    p: parameter vector. command[i] [V] holds from command_time[i] + delay on. Before the first one a standing motor had
    0 V, a turning one that command (its current has settled). out_time is ascending. The motion starts at out_time[0]
    with start_speed [rad/s] at angle 0.
    """
    delay = p[DELAY]
    before = command[0] if start_speed != 0.0 else 0.0
    switches = len(command_time)
    t = out_time[0]
    angle[0], speed[0] = 0.0, start_speed
    j = np.searchsorted(command_time, t - delay, side="right") - 1
    s = at_rest(0.0)
    if start_speed != 0.0:
        s = turning(p, start_speed, effective_voltage(p, command[j] if j >= 0 else before))
    for k in range(1, len(out_time)):
        until = out_time[k]
        while True:
            u = command[j] if j >= 0 else before
            stop = until
            if j + 1 < switches and command_time[j + 1] + delay <= until:
                stop = command_time[j + 1] + delay
            if stop > t:
                s = advance(p, u, s, t, stop - t)
                t = stop
            if j + 1 < switches and command_time[j + 1] + delay <= until:
                j += 1
            else:
                break
        angle[k], speed[k] = s.angle, s.speed


@dataclass(frozen=True)
class Trajectory:
    """A motor's motion at the times it was asked for; arrays of shape (K,)."""

    time: Floats  # [s]
    angle: Floats  # [rad] travelled since time[0]
    speed: Floats  # [rad/s]


def simulate(
    parameters: Parameters, command_time: Floats, command: Floats, out_time: Floats, start_speed: float = 0.0
) -> Trajectory:
    """The motion of one motor under a piecewise constant command.

    command[i] [V] holds from command_time[i] [s] (both of shape (M,)); out_time [s], shape (K,), ascending.

    Raises:
        ModelError: no command, not one time for each of them, or no time asked for.
    """
    if not len(command_time) == len(command) > 0 or len(out_time) == 0:
        raise ModelError("a simulation needs at least one command, a time for each, and at least one time to report.")
    angle, speed = np.empty(len(out_time)), np.empty(len(out_time))
    roll_out(parameters.vector(), start_speed, command_time, command, out_time, angle, speed)
    return Trajectory(out_time, angle, speed)


def simulate_swarm(
    vectors: Floats, start_speeds: Floats, command_time: Floats, command: Floats, out_time: Floats, threads: int = 1
) -> Floats:
    """The angles [rad] of many motors under one command: vectors (S, P), start_speeds (S,) → angles (S, K)."""
    angles = np.empty((len(vectors), len(out_time)))
    speeds = np.empty_like(angles)

    def one(i: int) -> None:
        roll_out(vectors[i], start_speeds[i], command_time, command, out_time, angles[i], speeds[i])

    if threads <= 1:
        for i in range(len(vectors)):
            one(i)
    else:
        with ThreadPoolExecutor(threads) as pool:
            list(pool.map(one, range(len(vectors))))
    return angles
