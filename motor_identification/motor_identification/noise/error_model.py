"""Estimate what a model leaves: the sensor's error, and a random torque with strength and correlation time.

All parts are learned together, by maximum likelihood of the increments that a fitted model leaves in training data
(`error_filter.py`): a torque that no model can predict is no reason to distrust a name, but it has to be known before
anything can be called significant.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, sqrt

import numpy as np
from scipy.optimize import minimize

from motor_identification.measurement.intervals import Intervals
from motor_identification.noise.error_filter import GAINS, fill_white, run_filter
from motor_identification.recording import Bools, Floats

SLACK_BLUR = 0.05  # of a slot: how sharply a standing motor contradicts a simulated one that moves
SHARES = (1e-4, 0.2)  # of a slot: how irregular a disc may be, or the four flanks of two channels
TIMES = (0.3, 30.0)  # of the median interval, and of the motor's time constant: correlation times that are looked for
PRICE = 6.0  # [nat] that a disturbance has to be worth, so that a perfect encoder's residual is called just that


_NO_GAINS = np.empty((0, GAINS))


@dataclass(frozen=True)
class ErrorModel:
    """What sensor and disturbance leave in simulated minus measured angles."""

    share: float  # standard deviation of the flanks as a share of a slot (of the typical travel, where none is known)
    white: float  # [rad²/s] growth of the angle's error by what is independent in every interval
    rms_voltage: float  # [V] of the random torque; 0 where there is none
    correlation_time: float  # [s] of it

    def speed_variance(self, duration: Floats, rate: float, ka: float) -> Floats:
        """[rad²/s²] variance that the random torque leaves in mean speeds over durations [s], shape (I,).

        The speed's autocovariance is A e^(−βs) + B e^(−αs); over h, e^(−xs/h) averages to 2(x − 1 + e^(−x))/x².
        rate: α = kv/ka [1/s], ka [V·s²/rad].
        """
        if self.rms_voltage == 0.0:
            return np.zeros(len(duration))
        beta = 1.0 / self.correlation_time
        if abs(rate - beta) < 1e-4 * beta:
            beta *= 1.001
        scale = (self.rms_voltage / ka) ** 2 / (rate**2 - beta**2)
        return np.asarray(scale * (_mean(beta * duration) - beta / rate * _mean(rate * duration)))


@dataclass(frozen=True)
class ErrorData:
    """One recording's increments [rad] with all that the filter has to know of its intervals; arrays of shape (I,)."""

    fresh: Bools
    still: Bools
    pause: Floats  # [s] from the end of the run before
    duration: Floats  # [s]
    blur: Floats  # [rad] standard deviation of the angle that timer or counting leave
    slack: Floats  # [rad]
    unit: float  # [rad] what a share is a share of
    increments: Floats  # [rad] simulated minus measured
    counted: Bools

    def whiten(
        self, model: ErrorModel, rate: float, ka: float, more: Floats | None = None, gains: Floats = _NO_GAINS
    ) -> tuple[float, Floats]:
        """Compute the log likelihood of what counts, and white residuals (1 + C, I) of the increments and C more rows.

        rate: kv/ka [1/s] of the motor, ka [V·s²/rad]. more: responses [rad] that pass the same filter, shape (C, I).
        """
        value, white, _density = self._filter(model, rate, ka, more, gains)
        return value, white

    def densities(self, model: ErrorModel, rate: float, ka: float) -> Floats:
        """Compute the log likelihood of every interval, shape (I,); 0 where it does not count."""
        return self._filter(model, rate, ka, None, _NO_GAINS)[2]

    def _filter(
        self, model: ErrorModel, rate: float, ka: float, more: Floats | None, gains: Floats
    ) -> tuple[float, Floats, Floats]:
        sensor = self.blur**2 + (model.share * self.unit) ** 2
        end = np.where(self.still, (SLACK_BLUR * self.slack) ** 2, sensor)
        rows = self.increments[None] if more is None else np.concatenate([self.increments[None], more])
        white, density = np.empty_like(rows), np.empty(len(self.fresh))
        value = run_filter(
            self.fresh, self.still, self.pause, self.duration, sensor, end,
            rate, 1.0 / model.correlation_time, (model.rms_voltage / ka) ** 2, model.white,
            rows, self.counted, white, gains, density,
        )  # fmt: skip
        return float(value), white, density


@dataclass(frozen=True)
class TorqueWhitening:
    """The filter's gains for one recording: linear, and the same for every increment; arrays over I intervals."""

    fresh: Bools
    still: Bools
    gains: Floats  # (I, GAINS)

    def white(self, increments: Floats) -> Floats:
        """Whiten angle increments [rad], shape (I,)."""
        white = np.empty(len(increments))
        fill_white(self.fresh, self.still, self.gains, np.ascontiguousarray(increments), white)
        return white


def make_whitening(data: ErrorData, model: ErrorModel, rate: float, ka: float) -> TorqueWhitening:
    """Make the whitening of increments like those of `data`; rate is kv/ka [1/s], ka [V·s²/rad]."""
    gains = np.empty((len(data.fresh), GAINS))
    data.whiten(model, rate, ka, gains=gains)
    return TorqueWhitening(data.fresh, data.still, gains)


def _mean(x: Floats) -> Floats:
    """Average e^(−|s−s'|) over two instants of an interval of length x."""
    return np.where(x > 1e-4, 2.0 * (x + np.expm1(-x)) / np.maximum(x, 1e-9) ** 2, 1.0 - x / 3.0)


def unit_of(data: Intervals) -> float:
    """[rad] what a sensor's error is a share of: a slot, or the typical travel where nothing is known of slots."""
    return data.slot if data.slot > 0.0 else float(np.median(np.abs(data.speed * data.duration))) or 1.0


def make_error_data(data: Intervals, increments: Floats, counted: Bools | None = None) -> ErrorData:
    """Prepare one recording's increments [rad] (I,) for the filter; `counted`: those whose likelihood is wanted."""
    still = data.slack > 0.0
    start, end = data.time[data.first], data.time[data.last]
    pause = np.full(len(start), inf)
    moving = np.flatnonzero(~still)
    pause[moving[1:]] = np.maximum(start[moving[1:]] - end[moving[:-1]], 0.0)
    unit = unit_of(data)
    return ErrorData(
        fresh=data.fresh,
        still=still,
        pause=pause,
        duration=data.duration,
        blur=np.maximum(data.blur, 1e-4 * unit + 1e-12),
        slack=data.slack,
        unit=unit,
        increments=np.ascontiguousarray(increments),
        counted=np.ones(len(still), dtype=bool) if counted is None else counted,
    )


def log_likelihood(rows: Sequence[ErrorData], model: ErrorModel, rate: float, ka: float) -> float:
    """Compute the log likelihood of what counts in all recordings."""
    return sum(row.whiten(model, rate, ka)[0] for row in rows)


def learn_error_model(
    rows: Sequence[ErrorData], rate: float, ka: float, guess: ErrorModel | None = None, evaluations: int = 120
) -> ErrorModel:
    """Find the error model under which increments are most likely.

    rate: kv/ka [1/s] of the motor, ka [V·s²/rad]. guess: where to begin, of a similar model; else a grid tells.
    """
    quiet, least = _learn_share(rows, rate, ka)
    duration = np.concatenate([row.duration[~row.still] for row in rows])
    speeds = np.concatenate([(row.increments / row.duration)[~row.still] for row in rows])
    step = float(np.median(duration))
    gap = sqrt(float(duration @ speeds**2 / duration.sum())) + 1e-300
    shortest, longest = TIMES[0] * step, max(TIMES[1] / rate, 10.0 * step)
    low = np.log([SHARES[0], 1e-6 * gap * rate * ka, shortest])
    high = np.log([SHARES[1], 1e3 * gap * (rate + 1.0 / step) * ka, longest])

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
        for share in (max(min(quiet.share, 0.005), 1e-3),)
    ]
    if guess is not None and guess.rms_voltage > 0.0:
        scale = gap * ka * sqrt(rate * (rate + 1.0 / guess.correlation_time))
        starts = [
            np.log([max(guess.share, SHARES[0]), rms, guess.correlation_time]) for rms in (guess.rms_voltage, scale)
        ]
        starts += [np.log([max(guess.share, SHARES[0]), 0.2 * scale, 0.3 * guess.correlation_time])]
    values = [cost(np.clip(x, low, high)) for x in starts]
    begin = np.clip(starts[int(np.argmin(values))], low, high)
    simplex = begin + np.vstack([np.zeros(3), np.diag([0.3, 0.3, 0.5])])
    options = {"xatol": 0.03, "fatol": 0.3, "maxfev": evaluations, "initial_simplex": simplex}
    found = minimize(cost, begin, method="Nelder-Mead", options=options)
    return quiet if -least < found.fun + PRICE else of(found.x)


def _learn_share(rows: Sequence[ErrorData], rate: float, ka: float) -> tuple[ErrorModel, float]:
    """Find the sensor's share alone, without any disturbance, and its log likelihood."""

    def value(share: float) -> float:
        return log_likelihood(rows, ErrorModel(share, 0.0, 0.0, 1.0), rate, ka)

    grid = [0.0, *np.geomspace(*SHARES, 12)]
    best = max(grid, key=value)
    if best > 0.0:
        for step in (1.35, 1.1, 1.03):
            best = max((best / step, best, best * step), key=value)
    return ErrorModel(best, 0.0, 0.0, 1.0), value(best)


@dataclass(frozen=True)
class Disturbance:
    """A random torque as an armature voltage, with standard errors."""

    rms_voltage: float  # [V]
    rms_error: float
    correlation_time: float  # [s]
    time_error: float


def estimate_disturbance(rows: Sequence[ErrorData], model: ErrorModel, rate: float, ka: float) -> Disturbance | None:
    """Estimate the standard errors of a learned random torque from the curvature of the log likelihood; None without.

    Central differences over the logarithms of share, strength and correlation time; NaN where there is no maximum.
    """
    if model.rms_voltage == 0.0:
        return None
    best = np.log([max(model.share, SHARES[0]), model.rms_voltage, model.correlation_time])
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
