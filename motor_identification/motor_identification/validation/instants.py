"""Place the instants of effects, such as that of a load step, and list them: each recording has its own."""

from collections.abc import Callable, Sequence
from math import inf

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.problem import Problem
from motor_identification.recording import Floats
from motor_model.effects import EFFECT_BY_NAME

FIRST_SHARE = 0.05  # of the largest voltage or speed of a recording, from which on its motor is driven, or moves


def needs_instant(effect: str) -> bool:
    """Tell whether an effect begins at an instant, which a search finds a place for where any size would help."""
    return any(spec.is_instant for spec in EFFECT_BY_NAME[effect].parameters)


def comes_slowly(effect: str) -> bool:
    """Tell whether an effect comes over all of a recording, and so at no instant, but not in a few pieces either."""
    return EFFECT_BY_NAME[effect].anywhere and not needs_instant(effect)


def list_instants(estimate: Estimate) -> tuple[list[float], ...]:
    """List the instants [s] of every recording at which something begins in a motor, such as a load step."""
    unknowns = estimate.problem.unknowns
    own = [i for i, spec in enumerate(unknowns.specs) if spec.is_instant]
    return tuple([float(estimate.theta[columns[i]]) for i in own] for columns in unknowns.columns)


def list_instant_columns(problem: Problem, effects: Sequence[str]) -> list[tuple[int, float]]:
    """List where in θ each recording has each instant of some effects, and how long [s] the recording is."""
    unknowns = problem.unknowns
    own = [spec.name for effect in effects for spec in EFFECT_BY_NAME[effect].parameters if spec.is_instant]
    return [
        (int(column), recording.duration)
        for name in own
        for recording, column in zip(problem.recordings, unknowns.columns[:, unknowns.names.index(name)], strict=True)
    ]


def list_first_motions(problem: Problem) -> tuple[float, ...]:
    """List when each recording first tells of its motor: when that is driven, or moves [s]; else nothing acts on it."""
    return tuple(
        min(_find_first(recording.time, recording.voltage), _find_first(data.time[data.first], data.speed))
        for recording, data in zip(problem.recordings, problem.intervals, strict=True)
    )


def _find_first(time: Floats, values: Floats) -> float:
    """Find when values (N,) first are a good part of their largest; infinity where there are none."""
    size = np.abs(values)
    large = size > FIRST_SHARE * size.max(initial=0.0)
    return float(time[np.argmax(large)]) if large.any() else inf


def try_instants(
    cost: Callable[[Floats], float], theta: Floats, column: int, duration: float, tried: int
) -> tuple[Floats, float]:
    """Put one instant at the best of many times of a recording, the rest of θ (D,) as it is; with the cost there."""
    trials = np.tile(theta, (tried, 1))
    trials[:, column] = np.linspace(0.0, duration, tried)
    costs = [cost(trial) for trial in trials]
    best = int(np.argmin(costs))
    return trials[best], costs[best]
