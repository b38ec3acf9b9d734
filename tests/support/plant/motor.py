"""The plant's motion: classic Runge-Kutta steps of 10 µs that end exactly at every stop, start, take-up and switch.

At rest the motor holds while |drive − loads| <= max(ks, breakaway). A speed that reaches zero stops there; whether it
stays or goes on, and which way, is then that same rule's decision. Commands switch between steps, never inside one.

Backlash as read here: the motor pushes its load's share of inertia in one direction through one flank of the play.
When it starts in the other direction, the load's share is missing until the motor has moved backlash_angle (or has
come back); then both go on at the motor's speed. The definition speaks of inertia alone, so that ω has no jump there (a
load that really stood still would take momentum). All friction stays with the motor. A stop without a reversal frees
nothing, and whichever way the motor first moves, the play is taken up.
"""

from dataclasses import dataclass
from math import ceil, copysign
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray
from scipy.signal import lfilter

from .forces import State, bridge, drive, inlined, outer_load, push_at_rest
from .parameters import Values, record_of
from .runge_kutta import Mode, find_change, take_step

Floats = NDArray[np.float64]
_STEPS_PER_NODE = 5
_RANDOM_STEP = 1e-4  # [s] for which a random torque stays as it is
_EVENTS_PER_STEP = 50  # more than that within 10 µs is chatter: held for the rest of the step


@dataclass(frozen=True)
class Motion:
    """Where the motor is, as nodes between which it moves smoothly and one way only; every array has shape (M,)."""

    time: Floats  # [s] since the start, not decreasing: a take-up is two nodes at one time
    angle: Floats  # [rad] since the start
    speed: Floats  # [rad/s]
    lagged: Floats  # [V] resistance times current, where the armature has inductance
    at: NDArray[np.int64]  # (K,) the node that belongs to each of the times asked for


def move(
    parameters: Values, times: Floats, voltages: Floats, *, start_speed: float = 0.0, step: float = 1e-5
) -> Motion:
    """Drive the motor: voltages[k] [V] is commanded from times[k] [s] until times[k + 1]; 0 V before times[0].

    Motion starts at times[0], at angle 0, with a lagged drive that has settled at 0 V. It ends at times[-1].
    """
    return move_plant(record_of(parameters), times, voltages, start_speed, step)


def move_plant(p: Any, times: Floats, voltages: Floats, start_speed: float, step: float) -> Motion:
    """Drive a motor whose parameters are checked already, for who drives it from sample to sample."""
    start, stop = times[0], times[-1]
    switches = times + p["delay"]
    extra = np.append(switches, start + p["step_time"])
    bounds = np.unique(np.concatenate([times, extra[(extra > start) & (extra < stop)]])) - start
    middles = start + 0.5 * (bounds[1:] + bounds[:-1])
    which = np.searchsorted(switches, middles, side="right") - 1
    commands = np.where(which >= 0, voltages[np.maximum(which, 0)], 0.0)
    stepped = middles - start > p["step_time"]
    nodes, at_bounds = _run(p, bounds, commands, stepped, random_torque(p, bounds[-1]), step, start_speed)
    at = at_bounds[np.searchsorted(bounds, times - start)]
    return Motion(nodes[:, 0], nodes[:, 1], nodes[:, 2], nodes[:, 3], at)


def random_torque(p: Any, duration: float) -> Floats:
    """An Ornstein-Uhlenbeck load [V] over so many seconds, a value for each 0.1 ms; always the same for one seed."""
    count = int(duration / _RANDOM_STEP) + 2
    if p["random_torque"] == 0.0:
        return np.zeros(count)
    remembered = np.exp(-_RANDOM_STEP / p["random_torque_time"])
    shocks = np.random.default_rng(int(p["random_torque_seed"])).normal(size=count)
    shocks[1:] *= np.sqrt(1.0 - remembered**2)
    return np.asarray(p["random_torque"] * lfilter([1.0], [1.0, -remembered], shocks))


@njit(cache=True)
def _started(y: State, mode: Mode, push: float, p: Any) -> Mode:
    """The mode of a motor that leaves its rest in the direction of the push."""
    way = copysign(1.0, push)
    contact, low, high = mode[1], mode[2], mode[3]
    if p.backlash_angle <= 0.0 or contact == 2.0:
        contact = way
    elif contact == -way:
        contact = 0.0
        low, high = (y[0], y[0] + p.backlash_angle) if way > 0.0 else (y[0] - p.backlash_angle, y[0])
    return way, contact, low, high


@njit(cache=True)
def _rest(
    y: State, mode: Mode, t: float, h: float, v: float, slope: float, outer: float, p: Any
) -> tuple[State, Mode, float, bool]:
    """(state, mode, time used, whether something happened) of a motor at rest for at most h seconds."""
    push, hold = push_at_rest(y, t, v, outer, p)
    if abs(push) > hold:
        return y, _started(y, mode, push, p), 0.0, True
    new = take_step(y, mode, t, h, v, slope, outer, p)
    push, hold = push_at_rest(new, t + h, v + slope * h, outer, p)
    if abs(push) <= hold:
        return new, mode, h, False
    used = find_change(y, mode, t, h, v, slope, outer, p, -1, 0.0)
    return take_step(y, mode, t, used, v, slope, outer, p), mode, used, True


@inlined
def _advance(
    y: State, mode: Mode, t: float, h: float, v: float, slope: float, outer: float, p: Any
) -> tuple[State, Mode, float, bool]:
    """(state, mode, time used, whether something happened) after at most h seconds, up to the first event."""
    way, contact, low, high = mode
    if way == 0.0:
        return _rest(y, mode, t, h, v, slope, outer, p)
    flank = high if way > 0.0 else low
    if contact == 0.0 and way * (y[0] - flank) >= 0.0:
        return y, (way, way, low, high), 0.0, True
    new = take_step(y, mode, t, h, v, slope, outer, p)
    used = h
    stops = way * new[1] <= 0.0
    if stops:
        used = find_change(y, mode, t, h, v, slope, outer, p, 1, 0.0)
        new = take_step(y, mode, t, used, v, slope, outer, p)
    if contact == 0.0 and way * (new[0] - flank) >= 0.0:
        used = find_change(y, mode, t, used, v, slope, outer, p, 0, flank)
        new = take_step(y, mode, t, used, v, slope, outer, p)
        return (flank, new[1], new[2], new[3], new[4], new[5]), mode, used, True
    if stops:
        return (new[0], 0.0, new[2], new[3], new[4], new[5]), (0.0, contact, low, high), used, True
    return new, mode, h, False


@njit(cache=True)
def _put(nodes: Floats, count: int, t: float, y: State) -> tuple[Floats, int]:
    if count == len(nodes):
        nodes = np.concatenate((nodes, np.empty_like(nodes)))
    nodes[count, 0], nodes[count, 1], nodes[count, 2], nodes[count, 3] = t, y[0], y[1], y[2]
    return nodes, count + 1


@njit(cache=True, error_model="numpy")
def _run(
    p: Any,
    bounds: Floats,
    commands: Floats,
    stepped: NDArray[np.bool_],
    random: Floats,
    step: float,
    start_speed: float,
) -> tuple[Floats, NDArray[np.int64]]:
    """Nodes (time, angle, speed, lagged drive), shape (M, 4), and the number of the node at each bound."""
    y = (0.0, start_speed, drive(bridge(0.0, 0.0, p), start_speed, p), np.sign(start_speed), 0.0, start_speed)
    mode = (np.sign(start_speed), 2.0 if start_speed == 0.0 else np.sign(start_speed), 0.0, 0.0)
    nodes, count = _put(np.empty((1 << 14, 4)), 0, bounds[0], y)
    at = np.zeros(len(bounds), dtype=np.int64)
    v = 0.0
    for k in range(len(bounds) - 1):
        steps = max(1, int(ceil((bounds[k + 1] - bounds[k]) / step - 1e-6)))
        h = (bounds[k + 1] - bounds[k]) / steps
        for i in range(steps):
            begin = bounds[k] + i * h
            outer = outer_load(begin, stepped[k], random[int((begin - bounds[0]) / _RANDOM_STEP)], p)
            change = commands[k] - v
            slope = 0.0
            if p.slew_rate > 0.0:
                slope = min(max(change / h, -p.slew_rate), p.slew_rate)
            else:
                v = commands[k]
            done, events = 0.0, 0
            while done < h:
                left = h - done
                if events == _EVENTS_PER_STEP:
                    y, mode = (y[0], 0.0, y[2], y[3], y[4], y[5]), (0.0, mode[1], mode[2], mode[3])
                    y = take_step(y, mode, begin + done, left, v + slope * done, slope, outer, p)
                    break
                y, mode, used, happened = _advance(y, mode, begin + done, left, v + slope * done, slope, outer, p)
                done = h if used == left else done + used
                if happened:
                    events += 1
                    nodes, count = _put(nodes, count, begin + done, y)
            v += slope * h
            if (i + 1) % _STEPS_PER_NODE == 0 or i + 1 == steps:
                nodes, count = _put(nodes, count, bounds[k + 1] if i + 1 == steps else begin + h, y)
        at[k + 1] = count - 1
    return nodes[:count], at
