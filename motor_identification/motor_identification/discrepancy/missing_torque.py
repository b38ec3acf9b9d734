"""Estimate the torque that a model lacks, in volts, over speed, angle and time.

Where the model obeys ka dω/dt = drive − kv ω and the motor has a torque T [V] more against it, the residual r =
simulated − measured speed obeys ka dr/dt + kv r = T. So T is read off the residual; a person who sees its shape can add
a row to the table of effects.
"""

from dataclasses import dataclass
from math import tau

import numpy as np

from motor_identification.discrepancy.operating_conditions import OperatingConditions, find_conditions
from motor_identification.recording import Bools, Floats, Integers
from motor_identification.validation.held_out import HeldOut

TORQUE_BINS = 24
ERROR_BLOCK = 0.1  # [s] inside of which torques may repeat each other, for the standard error
LEAST_ERROR_BLOCKS = 4  # blocks behind a standard error
CLEAR_ERRORS = 5.0  # standard errors
LEAST_CLEAR_BINS = 4  # bins that make a shape
AXIS_NAMES = {"speed": "speed [rad/s]", "angle": "shaft angle [rad]", "time": "time [s]"}


@dataclass(frozen=True)
class MissingTorque:
    """The missing torque in B bins, [V]; positive drives backward. NaN where a bin has too little time."""

    axis: str  # speed | angle | time
    recording: int  # −1: all together
    edges: Floats  # (B + 1,)
    torque: Floats  # (B,) [V]
    error: Floats  # (B,) [V] standard error, from blocks of time
    seconds: Floats  # (B,)


def estimate_missing_torque(held: HeldOut) -> tuple[MissingTorque, ...]:
    """Estimate the missing torque over speed, and over angle and time of every recording."""
    seen = find_conditions(held)
    torque, good = _torque(held, seen)
    top = float(np.abs(seen.speed).max(initial=0.0)) or 1.0
    longest = float(seen.time.max(initial=0.0)) or 1.0
    block = np.floor(seen.time / ERROR_BLOCK).astype(np.int64) + 1_000_000 * seen.recording
    shapes = [_shape("speed", -1, _even(-top, top, TORQUE_BINS + 1), seen.speed, torque, seen.duration, block, good)]
    for number in range(len(held.recordings)):
        here = good & (seen.recording == number)
        for axis, edges, values in (
            ("angle", _even(0.0, tau, TORQUE_BINS), np.mod(seen.angle, tau)),
            ("time", _even(0.0, longest, TORQUE_BINS), seen.time),
        ):
            shapes.append(_shape(axis, number, edges, values, torque, seen.duration, block, here))
    return tuple(shapes)


def _even(low: float, high: float, bins: int) -> Floats:
    return np.asarray(np.linspace(low, high, bins + 1), dtype=np.float64)


def _torque(held: HeldOut, seen: OperatingConditions) -> tuple[Floats, Bools]:
    """[V] in every interval that counts, and where it means anything: motor and simulation turn, and so do neighbours.

    The derivative is taken between the two neighbours, of all intervals, counted or not.
    """
    slopes, known = [], []
    for data, part in zip(held.intervals, held.residuals_of, strict=True):
        middle = 0.5 * (data.time[data.first] + data.time[data.last])
        fresh = data.fresh
        inner = np.zeros(len(part), dtype=bool)
        inner[1:-1] = ~fresh[1:-1] & ~fresh[2:]
        slope = np.zeros(len(part))
        slope[1:-1] = (part[2:] - part[:-2]) / np.where(inner[1:-1], middle[2:] - middle[:-2], 1.0)
        slopes.append(slope)
        known.append(inner)
    values = held.parameters.values
    turning = ~seen.still & (seen.speed * (seen.speed + held.residuals) > 0.0)
    torque = values["ka"] * np.concatenate(slopes)[held.counted] + values["kv"] * held.residuals
    return np.asarray(torque), turning & np.concatenate(known)[held.counted]


def _shape(
    axis: str,
    number: int,
    edges: Floats,
    values: Floats,
    torque: Floats,
    duration: Floats,
    block: Integers,
    here: Bools,
) -> MissingTorque:
    bins = len(edges) - 1
    index = np.clip(np.searchsorted(edges, values[here], side="right") - 1, 0, bins - 1)
    _, which = np.unique(block[here], return_inverse=True)
    blocks = int(which.max(initial=0)) + 1
    seconds = np.bincount(index * blocks + which, duration[here], bins * blocks).reshape(bins, blocks)
    sums = np.bincount(index * blocks + which, (duration * torque)[here], bins * blocks).reshape(bins, blocks)
    total, count = seconds.sum(axis=1), np.count_nonzero(seconds, axis=1)
    enough = count >= LEAST_ERROR_BLOCKS
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = sums.sum(axis=1) / total
        # Of a ratio estimator: blocks are independent, what is inside one is not.
        scatter = (
            np.sqrt(np.sum((sums - mean[:, None] * seconds) ** 2, axis=1) * count / np.maximum(count - 1, 1)) / total
        )
    return MissingTorque(axis, number, edges, np.where(enough, mean, np.nan), np.where(enough, scatter, np.nan), total)


def describe_torque(shapes: tuple[MissingTorque, ...]) -> str:
    """Describe the residual torque over the axis that shows most of it; empty if none is significant."""
    rows = [(_power(shape), shape) for shape in shapes if np.count_nonzero(_clear(shape)) >= LEAST_CLEAR_BINS]
    if not rows:
        return ""
    _, shape = max(rows, key=lambda row: row[0])
    clear = _clear(shape)
    k = int(np.argmax(np.where(clear, np.abs(shape.torque), 0.0)))
    torque, middle = shape.torque[clear], 0.5 * (shape.edges[k] + shape.edges[k + 1])
    name, unit = AXIS_NAMES[shape.axis].rstrip("]").split(" [")
    span = f"{torque.min():.2g} to {torque.max():.2g} V"
    return f"Residual torque over the {name}: {span}, largest near {middle:.2g} {unit}."


def _clear(shape: MissingTorque) -> Bools:
    return np.nan_to_num(np.abs(shape.torque)) > CLEAR_ERRORS * np.nan_to_num(shape.error, nan=np.inf)


def _power(shape: MissingTorque) -> float:
    """[V²] mean square of the torque, less what its errors alone would show."""
    known = np.isfinite(shape.torque) & np.isfinite(shape.error)
    return float(np.average((shape.torque**2 - shape.error**2)[known], weights=shape.seconds[known]))
