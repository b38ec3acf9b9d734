"""Learn what a model leaves: the sensor's error, and a random torque with strength and correlation time.

All parts are learned together, by maximum likelihood of the increments that a fitted model leaves in training data
(`error_filter.py`): a torque that no model can predict is no reason to distrust a name, but it has to be known before
anything can be called significant.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache
from math import inf, sqrt

import numpy as np
from scipy.optimize import OptimizeResult, minimize

from motor_identification.noise.error_data import ErrorData, log_likelihood
from motor_identification.noise.error_model import Disturbance, ErrorModel, Lag
from motor_identification.recording import Floats

SHARES = (1e-4, 0.2)  # of a slot: how irregular a disc may be, or the four flanks of two channels
SPEED_SHARES = (0.03, 10.0)  # of what is known of a logged speed's noise: how much more of it there may be
TIMES = (0.3, 30.0)  # of the median interval, and of the motor's time constant: correlation times that are looked for
LONGEST_SHARE = 0.25  # of a usual run of several: what differs from run to run only was not seen to change
LIKELIHOOD_TOLERANCE = 0.3  # [nat] that a search ends at
PRICE = 6.0  # [nat] that a disturbance has to be worth, so that a perfect encoder's residual is called just that


@dataclass(frozen=True)
class _Box:
    """Bounds of the logarithms of share, strength [V] and correlation time [s], each of shape (3,)."""

    low: Floats
    high: Floats

    def clip(self, x: Floats) -> Floats:
        """Move what is outside onto the bound."""
        return np.asarray(np.minimum(np.maximum(x, self.low), self.high))  # np.clip takes twice as long


@dataclass(frozen=True)
class _Scale:
    """What sizes of a random torque are measured by: what a model leaves, and the motor."""

    step: float  # [s] the median interval
    gap: float  # [rad/s] RMS of what is left
    run: float  # [s] the usual length of several runs; infinite of a single one
    lag: Lag  # the motor

    @property
    def times(self) -> tuple[float, float]:
        """Span the correlation times [s] that a search begins at."""
        return TIMES[0] * self.step, max(TIMES[1] / self.lag.rate, 10.0 * self.step)

    def strength(self, time: float) -> float:
        """Compute the RMS [V] of a torque with a correlation time [s] that would leave all of it."""
        rate = self.lag.rate
        return self.gap * self.lag.ka * sqrt(rate * (rate + 1.0 / time))

    def bound(self, shares: tuple[float, float]) -> _Box:
        """Bound what is looked for."""
        (shortest, longest), rate, ka = self.times, self.lag.rate, self.lag.ka
        longest = min(longest, max(LONGEST_SHARE * self.run, 10.0 * self.step))
        return _Box(
            np.log([shares[0], 1e-6 * self.gap * rate * ka, shortest]),
            np.log([shares[1], 1e3 * self.gap * (rate + 1.0 / self.step) * ka, longest]),
        )


def learn_error_model(
    rows: Sequence[ErrorData], lag: Lag, guess: ErrorModel | None = None, evaluations: int = 120
) -> ErrorModel:
    """Find the error model under which increments are most likely.

    lag: the motor. guess: where to begin, of a similar model; else a grid tells.
    """
    shares = _bound_share(rows)
    quiet, least = _learn_share(rows, shares, lag)
    scale = _measure_scale(rows, lag)
    box = scale.bound(shares)

    def of(x: Floats) -> ErrorModel:
        share, rms, time = np.exp(x)
        return ErrorModel(float(share), 0.0, float(rms), float(time))

    @cache  # searches begin where a grid has been
    def likelihood(model: ErrorModel) -> float:
        return log_likelihood(rows, model, lag)

    def cost(x: Floats) -> float:
        inside = box.clip(x)
        return 10.0 * float(np.abs(x - inside).sum()) - likelihood(of(inside))

    starts = _list_starts(quiet.share, shares[0], scale)
    if guess is not None and guess.rms_voltage > 0.0:
        starts = _list_starts_near(guess, shares[0], scale)
    found = _minimise(cost, _choose_start(cost, starts, box), evaluations)
    # A share that was far off hides which of the grid's times is right: once more with the share found.
    if guess is None:
        others = [np.array([found.x[0], *start[1:]]) for start in starts]
        begin = _choose_start(cost, others, box)
        if cost(begin) < found.fun - LIKELIHOOD_TOLERANCE:
            found = min(found, _minimise(cost, begin, evaluations), key=lambda one: one.fun)
    return quiet if -least < found.fun + PRICE else of(box.clip(found.x))


def _measure_scale(rows: Sequence[ErrorData], lag: Lag) -> _Scale:
    """Measure the scale of what is left where motors moved."""
    duration = np.concatenate([row.duration[~row.still] for row in rows])
    speeds = np.concatenate([(row.increments / row.duration)[~row.still] for row in rows])
    gap = sqrt(float(duration @ speeds**2 / duration.sum())) + 1e-300
    run = float(np.median([row.duration.sum() for row in rows])) if len(rows) > 1 else inf
    return _Scale(float(np.median(duration)), gap, run, lag)


def _list_starts(quiet: float, least: float, scale: _Scale) -> list[Floats]:
    """List a grid of starts, logarithms of shape (3,); quiet: the share without any torque, least: the lowest."""
    shares = sorted({max(share, 10.0 * least) for share in (min(quiet, 50.0 * least), 0.7 * quiet)})
    return [
        np.log([share, scale.strength(time) * part, time])
        for time in np.geomspace(*scale.times, 5)[1:-1]
        for part in (1.0, 0.1)
        for share in shares
    ]


def _list_starts_near(guess: ErrorModel, least: float, scale: _Scale) -> list[Floats]:
    """List starts near a guess, logarithms of shape (3,); least: the lowest share."""
    share, time, whole = max(guess.share, least), guess.correlation_time, scale.strength(guess.correlation_time)
    return [
        np.log([share, guess.rms_voltage, time]),
        np.log([share, whole, time]),
        np.log([share, 0.2 * whole, 0.3 * time]),
    ]


def _choose_start(cost: Callable[[Floats], float], starts: Sequence[Floats], box: _Box) -> Floats:
    """Choose the start (3,) of the least cost, within bounds."""
    inside = [box.clip(start) for start in starts]
    return inside[int(np.argmin([cost(start) for start in inside]))]


def _minimise(cost: Callable[[Floats], float], begin: Floats, evaluations: int) -> OptimizeResult:
    simplex = begin + np.vstack([np.zeros(3), np.diag([0.3, 0.3, 0.5])])
    options = {"xatol": 0.03, "fatol": LIKELIHOOD_TOLERANCE, "maxfev": evaluations, "initial_simplex": simplex}
    return minimize(cost, begin, method="Nelder-Mead", options=options)


def _bound_share(rows: Sequence[ErrorData]) -> tuple[float, float]:
    """Bound the share that a sensor's error is looked for in."""
    return SPEED_SHARES if all(row.window > 0.0 for row in rows) else SHARES


def _learn_share(rows: Sequence[ErrorData], shares: tuple[float, float], lag: Lag) -> tuple[ErrorModel, float]:
    """Find the sensor's share alone, without any disturbance, and its log likelihood."""

    @cache
    def value(share: float) -> float:
        return log_likelihood(rows, ErrorModel(share, 0.0, 0.0, 1.0), lag)

    grid = [0.0, *np.geomspace(*shares, 12)]
    best = max(grid, key=value)
    if best > 0.0:
        for step in (1.35, 1.1, 1.03):
            best = max((best / step, best, best * step), key=value)
    return ErrorModel(best, 0.0, 0.0, 1.0), value(best)


def estimate_disturbance(rows: Sequence[ErrorData], model: ErrorModel, lag: Lag) -> Disturbance | None:
    """Estimate the standard errors of a learned random torque from the curvature of the log likelihood; None without.

    Central differences over the logarithms of share, strength and correlation time; NaN where there is no maximum.
    """
    if model.rms_voltage == 0.0:
        return None
    best = np.log([max(model.share, _bound_share(rows)[0]), model.rms_voltage, model.correlation_time])
    step = 0.05 * np.eye(3)

    def value(x: Floats) -> float:
        share, rms, time = np.exp(x)
        return log_likelihood(rows, replace(model, share=share, rms_voltage=rms, correlation_time=time), lag)

    hessian = np.empty((3, 3))
    for i in range(3):
        for j in range(i, 3):
            a, b = step[i], step[j]
            corners = value(best + a + b) - value(best + a - b) - value(best - a + b) + value(best - a - b)
            hessian[i, j] = hessian[j, i] = corners / (4.0 * 0.05**2)
    try:
        covariance = np.linalg.inv(-hessian)
    except np.linalg.LinAlgError:
        covariance = np.full((3, 3), np.nan)
    with np.errstate(invalid="ignore"):
        relative = np.sqrt(np.diag(covariance))
    return Disturbance(
        model.rms_voltage,
        float(model.rms_voltage * relative[1]),
        model.correlation_time,
        float(model.correlation_time * relative[2]),
    )
