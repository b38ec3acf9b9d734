"""Find a load that goes with the angle and is large: an arm that hangs down, or a disc out of balance.

A ripple is found in what a motor without it leaves (`ripple_spectrum.py`), as long as that motor is about right. Where
its own weight turns an arm more than the voltage does, there is no such motor: then motor and load are found at once,
by least squares of the accelerations between intervals that follow each other, α = (u − kv·ω − A·sin(θ + φ)) / ka.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from motor_identification.estimation.problem import Problem
from motor_identification.measurement.intervals import Intervals
from motor_identification.measurement.measured_angle import Track
from motor_identification.periodic.whitened_run import SAME_INSTANT
from motor_identification.recording import Floats

SPANS = (1.0, 4.0, 16.0)  # sample periods of the intervals: the noise of an acceleration falls with the square of it
LEAST_SHARE = 0.5  # of the squared accelerations that a motor alone leaves, which such a load explains
LEAST_PAIRS = 10  # of intervals that follow each other


@dataclass(frozen=True)
class AngleLoad:
    """A load A·sin(θ + φ) over the angle of the encoder's shaft, and the motor that it is on."""

    kv: float  # [V·s/rad]
    ka: float  # [V·s²/rad]
    amplitude: float  # [V]
    phases: tuple[float, ...]  # [rad] of every recording
    share: float  # of the squared accelerations that a motor alone leaves


def find_angle_load(problem: Problem, tracks: Sequence[Track], least: float) -> AngleLoad | None:
    """Find a load of more than `least` [V], once a turn, that explains most of what a motor alone leaves.

    None where there is no such load.
    """
    loads = (_fit_load(problem.coarsen(span), tracks) for span in SPANS)
    best = max((load for load in loads if load is not None), key=lambda load: load.share, default=None)
    return best if best is not None and best.share > LEAST_SHARE and best.amplitude > least else None


def _fit_load(problem: Problem, tracks: Sequence[Track]) -> AngleLoad | None:
    """Fit a motor and a load once a turn; None where that is none."""
    rows = zip(problem.intervals, tracks, problem.commands, strict=True)
    parts = [_list_accelerations(data, track, *command) for data, track, command in rows]
    motor, waves, acceleration = (np.concatenate(part) for part in zip(*parts, strict=True))
    if len(acceleration) < LEAST_PAIRS:
        return None
    of_run = np.repeat(np.arange(len(parts)), [len(part[-1]) for part in parts])
    own = (of_run[:, None] == np.arange(len(parts)))[:, :, None] * waves[:, None, :]  # each recording has its phase
    both = np.hstack([motor, own.reshape(len(motor), -1)])
    alone, (slopes, left) = _solve(motor, acceleration)[1], _solve(both, acceleration)
    if slopes[0] <= 0.0 or slopes[1] >= 0.0 or alone <= 0.0:
        return None
    weights = -(slopes[2::2] + 1j * slopes[3::2]) / slopes[0]
    return AngleLoad(
        kv=float(-slopes[1] / slopes[0]),
        ka=float(1.0 / slopes[0]),
        amplitude=float(np.mean(np.abs(weights))),
        phases=tuple(np.angle(weights).tolist()),
        share=1.0 - left / alone,
    )


def _solve(columns: Floats, wanted: Floats) -> tuple[Floats, float]:
    """Solve by least squares; with the sum of squares that is left."""
    slopes: Floats = np.asarray(np.linalg.lstsq(columns, wanted, rcond=None)[0], dtype=np.float64)
    return slopes, float(np.sum((wanted - columns @ slopes) ** 2))


def _list_accelerations(
    data: Intervals, track: Track, changed: Floats, voltage: Floats
) -> tuple[Floats, Floats, Floats]:
    """List, between the middles of intervals that follow each other, (u, ω) and (sin θ, cos θ) (N, 2), and α (N,)."""
    order = data.order
    begin, end, speed = data.time[data.first][order], data.time[data.last][order], data.speed[order]
    follow = (begin[1:] - end[:-1] <= SAME_INSTANT) & (data.slack[order][1:] == 0.0) & (data.slack[order][:-1] == 0.0)
    middle, angle = 0.5 * (begin + end), data.gear * track.at(end[:-1])[follow]
    step = np.diff(middle)[follow]
    until = np.append(changed, max(float(data.time[-1]), float(changed[-1])))  # a voltage holds until the next
    area = np.append(0.0, np.cumsum(voltage * np.diff(until)))
    mean = np.diff(np.interp(middle, until, area))[follow] / step
    motor = np.column_stack([mean, (0.5 * (speed[1:] + speed[:-1]))[follow]])
    return motor, np.column_stack([np.sin(angle), np.cos(angle)]), np.diff(speed)[follow] / step
