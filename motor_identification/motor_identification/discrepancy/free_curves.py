"""Free curves: torques that depend on one variable of the measured motion in any way, learnt as knots.

Whatever a model lacks is, as long as it can be predicted at all, a torque over something: speed, drive, commanded
voltage, angle, time, what was just before. A family has a column for every knot (or wave) of one such variable: the
torque [V] of 1 V at that knot, in each short segment of a recording, and what it makes of the angle in every interval.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import exp, expm1
from typing import Any

import numpy as np
from numpy.typing import NDArray

from motor_identification.discrepancy.motion_history import MotionHistory
from motor_identification.noise.error_model import Lag
from motor_identification.recording import Bools, Floats
from motor_model.compiled import compiled

KNOTS = 12  # of a curve over each direction of the motion
GRID = 7  # knots along each side of a curve over two variables
HARMONICS = 16  # of a turn
TIME_KNOTS = 15  # over a recording
SINCE = (0.03, 30.0)  # time constants since a reversal: from what a delay is to what any motion has forgotten
TRAVEL = (6e-4, 0.6)  # of the angle at top speed in a time constant: from a gear's play to many turns


@dataclass(frozen=True)
class Reach:
    """How far recordings reach, so that they share their knots."""

    speed: float
    voltage: float
    drive: float
    duration: float
    time_constant: float  # [s] of the fitted motor
    lines: tuple[float, ...] = ()  # [Hz] where the spectrum of what is left is highest


def hats(values: Floats, knots: NDArray[np.floating[Any]]) -> Floats:
    """Evaluate linear hat functions over knots (M,) at values (S,), shape (S, M); constant beyond the ends."""
    each = np.zeros((len(values), len(knots)))
    _fill_hats(values, np.asarray(knots, dtype=np.float64), each)
    return each


@compiled
def _fill_hats(values: Floats, knots: Floats, each: Floats) -> None:
    """Fill the two hats that a value is under: all others are 0 there."""
    last = len(knots) - 1
    for s in range(len(values)):
        if values[s] <= knots[0]:
            each[s, 0] = 1.0
        elif values[s] >= knots[last]:
            each[s, last] = 1.0
        else:
            k = min(np.searchsorted(knots, values[s], side="right"), last) - 1
            part = (values[s] - knots[k]) * (1.0 / (knots[k + 1] - knots[k]))
            each[s, k], each[s, k + 1] = 1.0 - part, part


def log_hats(values: Floats, reach: tuple[float, float], unit: float) -> Floats:
    """Evaluate hats over knots that are even in the logarithm, from the first to the last of `reach` times a unit."""
    knots = np.geomspace(*reach, KNOTS)
    return hats(np.log(np.maximum(values / unit, reach[0])), np.log(knots))


def _both_ways(values: Floats, way: Floats, most: float) -> Floats:
    """Hats over a variable, apart for motion forward and backward."""
    knots = np.linspace(-most, most, 2 * KNOTS + 1)
    each = hats(values, knots)
    return np.concatenate([each * (way > 0.0)[:, None], each * (way < 0.0)[:, None]], axis=1)


def _speed(h: MotionHistory, most: Reach) -> Floats:
    knots = most.speed * np.concatenate([[0.0], np.geomspace(0.01, 1.0, KNOTS)])
    size = hats(np.abs(h.speed), knots)
    return np.concatenate([size * (h.speed > 0.0)[:, None], size * (h.speed < 0.0)[:, None]], axis=1)


def _voltage(h: MotionHistory, most: Reach) -> Floats:
    return _both_ways(h.voltage, h.speed, most.voltage)


def _drive(h: MotionHistory, most: Reach) -> Floats:
    return _both_ways(h.drive, h.speed, most.drive)


def _speed_by_voltage(h: MotionHistory, most: Reach) -> Floats:
    speed = hats(h.speed, np.linspace(-most.speed, most.speed, GRID))
    voltage = hats(h.voltage, np.linspace(-most.voltage, most.voltage, GRID))
    return np.asarray((speed[:, :, None] * voltage[:, None, :]).reshape(len(h.speed), -1))


def _angle(h: MotionHistory, most: Reach) -> Floats:
    phases = np.arange(1, HARMONICS + 1) * h.angle[:, None]
    waves, way = np.concatenate([np.sin(phases), np.cos(phases)], axis=1), np.sign(h.speed)[:, None]
    few = [0, 1, HARMONICS, HARMONICS + 1]
    return np.concatenate([waves, waves[:, few] * way, waves[:, few] * (h.drive / most.drive)[:, None]], axis=1)


def _time(h: MotionHistory, most: Reach) -> Floats:
    curve = hats(h.time, np.linspace(0.0, most.duration, TIME_KNOTS))
    return np.concatenate([curve, curve * np.sign(h.speed)[:, None], curve * (h.drive / most.drive)[:, None]], axis=1)


def _spectrum(h: MotionHistory, most: Reach) -> Floats:
    phases = 2.0 * np.pi * np.asarray(most.lines) * h.time[:, None]
    waves = np.concatenate([np.sin(phases), np.cos(phases)], axis=1)
    return np.concatenate(
        [waves, waves * np.sign(h.speed)[:, None], waves * (h.voltage / most.voltage)[:, None]], axis=1
    )


def _past(h: MotionHistory, most: Reach) -> Floats:
    way = np.sign(h.speed)[:, None]
    since = log_hats(h.since, SINCE, most.time_constant) * way
    travel = log_hats(h.travel, TRAVEL, most.speed * most.time_constant) * way
    share = h.past / most.voltage
    return np.concatenate([since, travel, h.past, share * np.abs(h.past)], axis=1)


PAST = "past"
BY_SPEED, BY_TIME = "speed", "time"
FAMILIES: dict[str, Callable[[MotionHistory, Reach], Floats]] = {
    BY_SPEED: _speed,
    "voltage": _voltage,
    "drive": _drive,
    "speed_voltage": _speed_by_voltage,
    "angle": _angle,
    BY_TIME: _time,
    "spectrum": _spectrum,
    PAST: _past,
}

REPEATING = ("angle", BY_TIME, "spectrum")  # what comes and goes whatever the motor is asked to do
OF_SPEED = ("speed", "drive", "speed_voltage", "angle", BY_TIME)  # the measured speed is part of the curves
OF_ONE_RECORDING = (BY_TIME, "spectrum")  # what is different in every recording is learnt and judged in the same one


def respond(history: MotionHistory, torques: Floats, lag: Lag) -> Floats:
    """Compute what torques [V] (S, C) make of simulated minus measured travel [rad] in every interval, shape (C, I)."""
    travel = np.zeros((len(torques) + 1, torques.shape[1]))
    fill_travel(history.duration, history.still, np.ascontiguousarray(torques), lag.rate, 1.0 / lag.ka, travel)
    return np.ascontiguousarray((travel[history.at_end] - travel[history.at_start]).T)


@compiled
def fill_travel(duration: Floats, still: Bools, torque: Floats, rate: float, gain: float, travel: Floats) -> None:
    """Integrate dd/dt = −rate·d + gain·T and its angle over segments of constant torque; a standing motor has d = 0."""
    columns = torque.shape[1]
    speed = np.zeros(columns)
    for s in range(len(duration)):
        h = duration[s]
        decay, reach = exp(-rate * h), -expm1(-rate * h) / rate
        for c in range(columns):
            if still[s]:
                speed[c] = 0.0
                travel[s + 1, c] = travel[s, c]
            else:
                push = gain * torque[s, c]
                travel[s + 1, c] = travel[s, c] + speed[c] * reach + push * (h - reach) / rate
                speed[c] = speed[c] * decay + push * reach


def measure_reach(histories: Sequence[MotionHistory], time_constant: float) -> Reach:
    """Measure how far the motion of some recordings reaches; time_constant [s]: the motor's."""

    def largest(name: str) -> float:
        return max(float(np.abs(getattr(history, name)).max(initial=0.0)) for history in histories) or 1.0

    return Reach(largest("speed"), largest("voltage"), largest("drive"), largest("time"), time_constant)
