"""Roll-outs: where a motor is at given times under a recorded command, for one motor."""

from dataclasses import dataclass, field
from math import inf

import numpy as np
from numpy.typing import NDArray

from motor_model.compiled import compiled
from motor_model.dynamics.bridge import effective_voltage
from motor_model.dynamics.current import current_at
from motor_model.dynamics.forces import warmth
from motor_model.dynamics.motor import advance
from motor_model.dynamics.rippling import turn_on
from motor_model.dynamics.rows import Commands, Reached, find_switch, is_plain, pass_rows
from motor_model.dynamics.state import State, standing, turning
from motor_model.dynamics.straight import begin_lag, find_straight, find_torques, prepare_hold
from motor_model.effects import INDEX
from motor_model.errors import ModelError
from motor_model.parameters import Parameters
from motor_model.sensing.encoder import shaft_angle_at

DELAY = INDEX["delay"]
STEP, STEP_TIME = INDEX["step_voltage"], INDEX["step_time"]

Floats = NDArray[np.float64]

NOWHERE: Floats = np.empty(0)  # no measured angles


@compiled
def _put_current(p: Floats, acted: float, s: State, t: float, current: Floats, k: int) -> None:
    """Put the current [A] at time t [s] in its place, if it is wanted; acted: the command [V] that brought s there."""
    if len(current) > 0:
        current[k] = current_at(p, effective_voltage(p, acted), s, t)


@compiled
def roll_out(
    p: Floats,
    start_speed: float,
    command_time: Floats,
    command: Floats,
    out_time: Floats,
    anchor: Floats,
    angle: Floats,
    speed: Floats,
) -> None:
    """Fill angle [rad] and speed [rad/s] of one motor at out_time [s]; see `roll_out_with_current`."""
    roll_out_with_current(p, start_speed, command_time, command, out_time, anchor, angle, speed, np.empty(0))


@compiled
def roll_out_with_current(  # noqa: C901
    p: Floats,
    start_speed: float,
    command_time: Floats,
    command: Floats,
    out_time: Floats,
    anchor: Floats,
    angle: Floats,
    speed: Floats,
    current: Floats,
) -> None:
    """Fill angle [rad], speed [rad/s] and current [A] (where that is not empty) of one motor at out_time [s].

    p: parameter vector. command[i] [V] holds from command_time[i] + delay on. Before the first one a standing motor had
    0 V, a turning one that command (its current has settled). out_time is ascending. The motion starts at out_time[0]
    with start_speed [rad/s] at angle 0. What repeats with the angle takes it from `anchor` [rad], the angle that the
    encoder showed at out_time, where that is not empty: a simulated angle drifts, and its phase would be lost.
    Where the command changes at the very out_time, the current is that just before. Angles are the output's.
    """
    told = Commands(command_time, command, p[DELAY])
    t = out_time[0]
    angle[0], speed[0] = 0.0, start_speed
    j = np.searchsorted(command_time, t - told.delay, side="right") - 1
    u = command[max(j, 0)] if j >= 0 or start_speed != 0.0 else 0.0
    acted = u if start_speed != 0.0 else 0.0
    s = turning(p, start_speed, effective_voltage(p, u)) if start_speed != 0.0 else standing(p)
    _put_current(p, acted, s, t, current, 0)
    switch = find_switch(told, j)
    straight, lagging = find_straight(p), begin_lag()
    hold = prepare_hold(p, u, find_torques(p, t))
    loaded = p[STEP_TIME] if p[STEP] != 0.0 and p[STEP_TIME] > t else inf
    if len(anchor) > 0:
        s = State(s.angle, s.speed, s.drive, s.play, s.direction, shaft_angle_at(p, anchor[0]))
    plain, k = is_plain(p, straight) and len(current) == 0, 0
    while k + 1 < len(out_time):
        k += 1
        if plain and s.play == 0.0 and (abs(s.speed) > straight.least or s.speed == 0.0):
            t, s, u, k, j, switch, hold = pass_rows(
                p, straight.least, told, Reached(t, s, u, k, j, switch, hold), loaded, out_time, angle, speed
            )
            if k == len(out_time):
                break
        until = out_time[k]
        while True:
            stop = min(until, switch, loaded)
            if stop > t:
                then, travel, drive, h = 0.0, 0.0, s.drive, stop - t
                if abs(s.speed) > straight.least and h <= straight.longest and s.play == 0.0:
                    w = warmth(p, t + 0.5 * h)
                    then, drive, travel, lagging = turn_on(p, hold, s, h, w, straight.least, lagging)
                if then * s.speed > 0.0 and abs(then) > straight.least:
                    s = State(s.angle + travel, then, drive, s.play, 1.0 if s.speed > 0.0 else -1.0, s.turned)
                else:
                    s = advance(p, u, s, t, h)
                t, acted = stop, u
            if stop == loaded:
                loaded, hold = inf, prepare_hold(p, u, find_torques(p, t))
                continue
            if switch > until:
                break
            j += 1
            u = command[j]
            switch = find_switch(told, j)
            if straight.least < inf:
                hold = prepare_hold(p, u, hold.torques)
        angle[k], speed[k] = s.angle, s.speed
        _put_current(p, acted, s, t, current, k)
        if len(anchor) > 0:
            s = State(s.angle, s.speed, s.drive, s.play, s.direction, shaft_angle_at(p, anchor[k]) - s.angle)


@dataclass(frozen=True)
class Trajectory:
    """A motor's motion at the times it was asked for; arrays of shape (K,), `current` also empty."""

    time: Floats  # [s]
    angle: Floats  # [rad] travelled since time[0]
    speed: Floats  # [rad/s]
    current: Floats = field(default_factory=lambda: np.empty(0))  # [A] of a motor whose resistance is known


def simulate(
    parameters: Parameters, command_time: Floats, command: Floats, out_time: Floats, start_speed: float = 0.0
) -> Trajectory:
    """Simulate the motion of one motor under a piecewise constant command.

    command[i] [V] holds from command_time[i] [s] (both of shape (M,)); out_time [s], shape (K,), ascending.

    Raises:
        ModelError: no command, not one time for each of them, or no time asked for.
    """
    if not len(command_time) == len(command) > 0 or len(out_time) == 0:
        raise ModelError("a simulation needs at least one command, a time for each, and at least one time to report.")
    angle, speed = np.empty(len(out_time)), np.empty(len(out_time))
    current = np.empty(len(out_time) if parameters.resistance > 0.0 else 0)
    where = (start_speed, command_time, command, out_time, NOWHERE)
    roll_out_with_current(parameters.vector(), *where, angle, speed, current)
    return Trajectory(out_time, angle, speed, current)
