"""Map a residual over speed, direction, acceleration, voltage, time and angle, to see where a model is wrong.

In: a model on held-out data. Out: its gap, noise floor and bias in the bins of every axis. The worst conditions are in
`worst_regions`, their description in `region_text`, the residual torque in `missing_torque`.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf, tau

import numpy as np

from motor_identification.discrepancy.operating_conditions import OperatingConditions, find_conditions
from motor_identification.recording import Bools, Floats
from motor_identification.validation.held_out import HeldOut

SINCE_EDGES = (0.0, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, inf)  # [s]
ACCELERATION_EDGES = (0.02, 0.05, 0.1, 0.2, 0.5, 1.0)  # of the largest


@dataclass(frozen=True)
class Axis:
    """What a residual is mapped over; `along`: its bias counts along the motion, so that positive is "too fast"."""

    name: str
    label: str
    unit: str
    values: Callable[[OperatingConditions], Floats]  # (I,); NaN: not on this map
    edges: Callable[[Floats], Floats]  # of the bins, from the finite values
    along: bool = False
    of_recording: bool = False  # a map for each recording, since it begins anew in each


@dataclass(frozen=True)
class Map:
    """The residual in B bins; NaN where a bin holds no time. `gap` above `floor` is the model's error."""

    axis: Axis
    recording: int  # whose it is; −1: of all together
    edges: Floats  # (B + 1,)
    gap: Floats  # (B,) [rad/s] time-weighted RMS of simulated − measured mean speed
    floor: Floats  # (B,) [rad/s] the gap of a perfect model in the same intervals
    mean: Floats  # (B,) [rad/s] time-weighted mean: the bias
    seconds: Floats  # (B,) how much time the bin holds


def _even(bins: int) -> Callable[[Floats], Floats]:
    """So many equal bins; where values have both signs, symmetric to zero: an odd number has one around it."""

    def edges(values: Floats) -> Floats:
        top = float(np.abs(values).max(initial=0.0)) or 1.0
        low, high = float(values.min(initial=top)), float(values.max(initial=-top))
        if low < 0.0 < high or low >= high:
            low, high = -top, top
        return np.asarray(np.linspace(low, high, bins + 1), dtype=np.float64)

    return edges


def _fine_at_zero(values: Floats) -> Floats:
    top = float(np.abs(values).max(initial=0.0)) or 1.0
    return np.array(
        [*(-top * share for share in reversed(ACCELERATION_EDGES)), *(top * share for share in ACCELERATION_EDGES)]
    )


def _times(values: Floats) -> Floats:
    return np.asarray(np.linspace(0.0, float(values.max(initial=0.0)) or 1.0, 31))


def _turn(bins: int) -> Floats:
    return np.asarray(np.linspace(0.0, tau, bins + 1), dtype=np.float64)


AXES = (
    Axis("speed", "speed", "rad/s", lambda s: s.speed, _even(25)),
    Axis("direction", "direction", "", lambda s: np.sign(s.speed), lambda values: np.array([-1.5, -0.5, 0.5, 1.5])),
    Axis("acceleration", "acceleration", "rad/s²", lambda s: np.where(s.still, np.nan, s.acceleration), _fine_at_zero,
         along=True),
    Axis("since", "time since standstill or reversal", "s", lambda s: np.where(s.still, np.nan, s.since),
         lambda values: np.array(SINCE_EDGES), along=True),
    Axis("time", "time within the recording", "s", lambda s: s.time, _times, of_recording=True),
    Axis("voltage", "voltage", "V", lambda s: s.voltage, _even(15)),
    Axis("angle", "shaft angle", "rad", lambda s: np.mod(s.angle, tau), lambda values: _turn(24),
         of_recording=True),
)  # fmt: skip


def map_residuals(held: HeldOut, share: float) -> tuple[Map, ...]:
    """Map the residual over every axis; `share` is the irregularity of the slots behind the floor, of a slot."""
    seen = find_conditions(held)
    floors = held.floors(share)
    made = []
    for axis in AXES:
        values = axis.values(seen)
        numbers = range(len(held.recordings)) if axis.of_recording else (-1,)
        edges = axis.edges(values[np.isfinite(values)])
        for number in numbers:
            here = (seen.recording == number) if number >= 0 else np.ones(len(values), dtype=bool)
            made.append(_map(axis, number, edges, values, here & ~np.isnan(values), seen, held.residuals, floors))
    return tuple(made)


def _map(
    axis: Axis,
    number: int,
    edges: Floats,
    values: Floats,
    here: Bools,
    seen: OperatingConditions,
    left: Floats,
    floors: Floats,
) -> Map:
    bins = len(edges) - 1
    index = np.clip(np.searchsorted(edges, values[here], side="right") - 1, 0, bins - 1)
    bias = project_on_motion(seen, left) if axis.along else left
    seconds: Floats = np.bincount(index, seen.duration[here], bins).astype(np.float64)

    def mean(what: Floats) -> Floats:
        total = np.bincount(index, (seen.duration * what)[here], bins)
        return np.asarray(np.divide(total, seconds, out=np.full(bins, np.nan), where=seconds > 0.0))

    return Map(axis, number, edges, np.sqrt(mean(left**2)), np.sqrt(mean(floors**2)), mean(bias), seconds)


def project_on_motion(seen: OperatingConditions, left: Floats) -> Floats:
    """Project residuals [rad/s] on the motion: positive where the simulation is too fast."""
    return np.where(seen.still, np.abs(left), left * np.sign(seen.speed))
