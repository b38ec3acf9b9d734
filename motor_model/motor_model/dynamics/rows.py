"""The motion of a plain motor over many rows and commands in one loop: what most rows of most motors are.

Plain is what is straight (`straight.py`) and has no inductance, ripple or warm-up. While it turns one way, or rests,
nothing but its angle and speed changes, and the loop has no branch to anything rarer: a row takes a quarter of the time
that it takes where any motor is moved on. The same numbers come out, to the last bit.
"""

from math import copysign, inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motor_model.compiled import compiled
from motor_model.dynamics.forces import steady_load_at
from motor_model.dynamics.motor import holding_level
from motor_model.dynamics.state import State
from motor_model.dynamics.straight import Hold, Straight, prepare_hold, turn
from motor_model.effects import INDEX

Floats = NDArray[np.float64]

LAG, RIPPLE, RISE = INDEX["electrical_time_constant"], INDEX["ripple_voltage"], INDEX["resistance_rise"]


class Commands(NamedTuple):
    """What a motor is told: values[i] [V] holds from time[i] + delay [s] on; arrays of shape (M,)."""

    time: Floats
    values: Floats
    delay: float


class Reached(NamedTuple):
    """How far a roll-out has come: the motor, the command that holds, the number of the row to fill next."""

    time: float  # [s]
    state: State
    command: float  # [V]
    row: int
    number: int  # of the command
    switch: float  # [s] of the next command
    hold: Hold


@compiled
def is_plain(p: Floats, straight: Straight) -> bool:
    """Tell whether a motor is plain wherever it turns faster than the straight one's least speed."""
    return bool(p[LAG] == 0.0 and p[RIPPLE] == 0.0 and p[RISE] == 0.0 and straight.least < inf)


@compiled
def find_switch(commands: Commands, number: int) -> float:
    """Find when the command after one of this number acts [s]; never after the last."""
    return commands.time[number + 1] + commands.delay if number + 1 < len(commands.time) else inf


@compiled
def pass_rows(
    p: Floats, least: float, commands: Commands, reached: Reached, before: float, rows: Floats, angle: Floats,
    speed: Floats,
) -> Reached:  # fmt: skip
    """Fill angle [rad] and speed [rad/s] at rows [s] for as long as a plain motor, its play taken up, stays so.

    Up to where it comes to rest, leaves its rest, or is not faster than `least` [rad/s]; and before a load step.
    """
    t, s, command, row, number, switch, hold = reached
    here, now = s.angle, s.speed
    level = holding_level(p, 1.0)
    while row < len(rows):
        until = rows[row]
        stop = min(until, switch)
        if stop >= before:
            break
        if stop > t and now == 0.0:
            if abs(hold.source - steady_load_at(p, t)) > level:
                break
            t = stop
        elif stop > t:
            if not abs(now) > least:
                break
            then, travel = turn(p, hold, now, stop - t, 1.0)
            if not (then * now > 0.0 and abs(then) > least):
                break
            here, now, t = here + travel, then, stop
        if switch <= until:
            number += 1
            command, switch = commands.values[number], find_switch(commands, number)
            hold = prepare_hold(p, command, hold.torques)
        else:
            angle[row], speed[row] = here, now
            row += 1
    s = State(here, now, s.drive, s.play, copysign(1.0, now) if now != 0.0 else s.direction, s.turned)
    return Reached(t, s, command, row, number, switch, hold)
