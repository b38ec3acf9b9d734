"""Learn what a model leaves: the sensor's error, and a random torque with strength and correlation time.

All parts are learned together, by maximum likelihood of the increments that a fitted model leaves in training data
(`error_filter.py`): a torque that no model can predict is no reason to distrust a name, but it has to be known before
anything can be called significant.
"""

from collections.abc import Callable, Sequence
from math import sqrt

import numpy as np
from scipy.optimize import OptimizeResult, minimize

from motor_identification.noise.error_data import ErrorData, log_likelihood
from motor_identification.noise.error_model import Disturbance, ErrorModel
from motor_identification.recording import Floats

SHARES = (1e-4, 0.2)  # of a slot: how irregular a disc may be, or the four flanks of two channels
SPEED_SHARES = (0.03, 10.0)  # of what is known of a logged speed's noise: how much more of it there may be
TIMES = (0.3, 30.0)  # of the median interval, and of the motor's time constant: correlation times that are looked for
LIKELIHOOD_TOLERANCE = 0.3  # [nat] that a search ends at
PRICE = 6.0  # [nat] that a disturbance has to be worth, so that a perfect encoder's residual is called just that


def learn_error_model(
    rows: Sequence[ErrorData], rate: float, ka: float, guess: ErrorModel | None = None, evaluations: int = 120
) -> ErrorModel:
    """Find the error model under which increments are most likely.

    rate: kv/ka [1/s] of the motor, ka [V·s²/rad]. guess: where to begin, of a similar model; else a grid tells.
    """
    shares = _bound_share(rows)
    quiet, least = _learn_share(rows, shares, rate, ka)
    duration = np.concatenate([row.duration[~row.still] for row in rows])
    speeds = np.concatenate([(row.increments / row.duration)[~row.still] for row in rows])
    step = float(np.median(duration))
    gap = sqrt(float(duration @ speeds**2 / duration.sum())) + 1e-300
    shortest, longest = TIMES[0] * step, max(TIMES[1] / rate, 10.0 * step)
    low = np.log([shares[0], 1e-6 * gap * rate * ka, shortest])
    high = np.log([shares[1], 1e3 * gap * (rate + 1.0 / step) * ka, longest])

    def of(x: Floats) -> ErrorModel:
        share, rms, time = np.exp(np.clip(x, low, high))
        return ErrorModel(float(share), 0.0, float(rms), float(time))

    def cost(x: Floats) -> float:
        outside = float(np.sum(np.maximum(low - x, 0.0) + np.maximum(x - high, 0.0)))
        return 10.0 * outside - log_likelihood(rows, of(x), rate, ka)

    starts = [
        np.log([share, gap * ka * sqrt(rate * (rate + 1.0 / time)) * part, time])
        for time in np.geomspace(shortest, longest, 5)[1:-1]
        for part in (1.0, 0.1)
        for share in sorted(
            {max(part, 10.0 * shares[0]) for part in (min(quiet.share, 50.0 * shares[0]), 0.7 * quiet.share)}
        )
    ]
    if guess is not None and guess.rms_voltage > 0.0:
        scale = gap * ka * sqrt(rate * (rate + 1.0 / guess.correlation_time))
        starts = [
            np.log([max(guess.share, shares[0]), rms, guess.correlation_time]) for rms in (guess.rms_voltage, scale)
        ]
        starts += [np.log([max(guess.share, shares[0]), 0.2 * scale, 0.3 * guess.correlation_time])]
    found = _minimise(cost, _choose_start(cost, starts, low, high), evaluations)
    if (
        guess is None
    ):  # a share that was far off hides which of the grid's times is right: once more with the share found
        others = [np.array([found.x[0], *start[1:]]) for start in starts]
        begin = _choose_start(cost, others, low, high)
        if cost(begin) < found.fun - LIKELIHOOD_TOLERANCE:
            found = min(found, _minimise(cost, begin, evaluations), key=lambda one: one.fun)
    return quiet if -least < found.fun + PRICE else of(found.x)


def _choose_start(cost: Callable[[Floats], float], starts: Sequence[Floats], low: Floats, high: Floats) -> Floats:
    """Choose the start (3,) of the least cost, within bounds."""
    inside = [np.clip(start, low, high) for start in starts]
    return inside[int(np.argmin([cost(start) for start in inside]))]


def _minimise(cost: Callable[[Floats], float], begin: Floats, evaluations: int) -> OptimizeResult:
    simplex = begin + np.vstack([np.zeros(3), np.diag([0.3, 0.3, 0.5])])
    options = {"xatol": 0.03, "fatol": LIKELIHOOD_TOLERANCE, "maxfev": evaluations, "initial_simplex": simplex}
    return minimize(cost, begin, method="Nelder-Mead", options=options)


def _bound_share(rows: Sequence[ErrorData]) -> tuple[float, float]:
    """Between which shares a sensor's error is looked for."""
    return SPEED_SHARES if all(row.window > 0.0 for row in rows) else SHARES


def _learn_share(
    rows: Sequence[ErrorData], shares: tuple[float, float], rate: float, ka: float
) -> tuple[ErrorModel, float]:
    """Find the sensor's share alone, without any disturbance, and its log likelihood."""

    def value(share: float) -> float:
        return log_likelihood(rows, ErrorModel(share, 0.0, 0.0, 1.0), rate, ka)

    grid = [0.0, *np.geomspace(*shares, 12)]
    best = max(grid, key=value)
    if best > 0.0:
        for step in (1.35, 1.1, 1.03):
            best = max((best / step, best, best * step), key=value)
    return ErrorModel(best, 0.0, 0.0, 1.0), value(best)


def estimate_disturbance(rows: Sequence[ErrorData], model: ErrorModel, rate: float, ka: float) -> Disturbance | None:
    """Estimate the standard errors of a learned random torque from the curvature of the log likelihood; None without.

    Central differences over the logarithms of share, strength and correlation time; NaN where there is no maximum.
    """
    if model.rms_voltage == 0.0:
        return None
    best = np.log([max(model.share, _bound_share(rows)[0]), model.rms_voltage, model.correlation_time])
    step = 0.05 * np.eye(3)

    def value(x: Floats) -> float:
        share, rms, time = np.exp(x)
        return log_likelihood(rows, ErrorModel(share, model.white, rms, time), rate, ka)

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
