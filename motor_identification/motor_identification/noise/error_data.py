"""Filter the increments that a model leaves in a recording under an error model: likelihood and white residuals."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import inf

import numpy as np

from motor_identification.measurement.intervals import Intervals
from motor_identification.noise.error_filter import GAINS, fill_white, run_filter
from motor_identification.noise.error_model import ErrorModel, Lag
from motor_identification.noise.error_score import score_increments
from motor_identification.noise.run_gain import RunGain, guess_deviation, make_projection, move_to_likeliest
from motor_identification.recording import Bools, Floats

GAIN_STEPS = 2  # to a run's most likely gain: one is exact where no interval is far off
SLACK_BLUR = 0.05  # of a slot: how sharply a standing motor contradicts a simulated one that moves

_NO_GAINS = np.empty((0, GAINS))


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
    window: float  # [s] of logged speeds, each of which has that error of its own; 0 where angles have it
    increments: Floats  # [rad] simulated minus measured
    counted: Bools
    travel: Floats  # [rad] what a gain of the run adds to the increments

    def whiten(
        self, model: ErrorModel, lag: Lag, more: Floats | None = None, gains: Floats = _NO_GAINS
    ) -> tuple[float, Floats]:
        """Compute the log likelihood of what counts, and white residuals (1 + C, I) of the increments and C more rows.

        lag: the motor. more: responses [rad] that pass the same filter, shape (C, I).
        """
        if model.gain > 0.0:
            return self._whiten_with_gain(model, lag, more, gains)
        value, white, _density = self._filter(model, lag, more, gains)
        return value, white

    def densities(self, model: ErrorModel, lag: Lag) -> Floats:
        """Compute the log likelihood of every interval, shape (I,); 0 where it does not count."""
        if model.gain > 0.0:
            gain = self.find_gain(model, lag)
            price = gain.compute_price(model.gain) / len(self.fresh)
            return self.less(gain).densities(model.without_gain, lag) - price * self.counted
        return self._filter(model, lag, None, _NO_GAINS)[2]

    def score(self, model: ErrorModel, lag: Lag) -> float:
        """Compute the log likelihood of what counts."""
        if model.gain > 0.0:
            gain, share = self.find_gain(model, lag), float(np.mean(self.counted))
            return self.less(gain).score(model.without_gain, lag) - share * gain.compute_price(model.gain)
        own, process = self._describe(model, lag)
        return float(
            score_increments(
                self.fresh, self.still, self.pause, self.duration, self._blur_squared, self._still_end, own, *process,
                self.increments, self.counted,
            )
        )  # fmt: skip

    def find_gain(self, model: ErrorModel, lag: Lag) -> RunGain:
        """Find the most likely gain of the run beside what else an error model leaves."""
        gain = RunGain(guess_deviation(self.increments, self.travel), 0.0)
        for _ in range(GAIN_STEPS):
            _value, white = self.less(gain).whiten(model.without_gain, lag, self.travel[None])
            gain = move_to_likeliest(gain.deviation, white[0], white[1], model.gain)
        return gain

    def less(self, gain: RunGain) -> "ErrorData":
        """The same without what a gain adds."""
        return replace(self, increments=self.increments - gain.deviation * self.travel)

    def _whiten_with_gain(
        self, model: ErrorModel, lag: Lag, more: Floats | None, gains: Floats
    ) -> tuple[float, Floats]:
        gain = self.find_gain(model, lag)
        rows = self.travel[None] if more is None else np.concatenate([self.travel[None], more])
        value, white = self.less(gain).whiten(model.without_gain, lag, rows, gains)
        response = white[1]
        white = np.concatenate([white[:1] + gain.deviation * response, white[2:]])
        along = make_projection(response, model.gain)
        return value - gain.compute_price(model.gain), white - np.outer(white @ along, along)

    @cached_property
    def _blur_squared(self) -> Floats:
        return np.asarray(self.blur**2)

    @cached_property
    def _still_end(self) -> Floats:
        """[rad²] of the angle at the end of an interval in which the motor stood, shape (I,)."""
        return np.asarray((SLACK_BLUR * self.slack) ** 2)

    def _describe(self, model: ErrorModel, lag: Lag) -> tuple[float, tuple[float, float, float, float]]:
        """Describe an error model as the filter has it: the angle's own variance [rad²] at either end, the process."""
        own, growth = (model.share * self.unit) ** 2, model.white
        if self.window > 0.0:
            own, growth = 0.0, growth + 2.0 * own / self.window
        return own, (lag.rate, 1.0 / model.correlation_time, (model.rms_voltage / lag.ka) ** 2, growth)

    def _filter(self, model: ErrorModel, lag: Lag, more: Floats | None, gains: Floats) -> tuple[float, Floats, Floats]:
        own, process = self._describe(model, lag)
        sensor = self._blur_squared + own
        end = np.where(self.still, self._still_end, sensor)
        rows = self.increments[None] if more is None else np.concatenate([self.increments[None], more])
        white, density = np.empty_like(rows), np.empty(len(self.fresh))
        value = run_filter(
            self.fresh, self.still, self.pause, self.duration, sensor, end, *process, rows, self.counted, white, gains,
            density,
        )  # fmt: skip
        return float(value), white, density


@dataclass(frozen=True)
class TorqueWhitening:
    """The filter's gains for one recording: linear, and the same for every increment; arrays over I intervals."""

    fresh: Bools
    still: Bools
    gains: Floats  # (I, GAINS)
    along: Floats | None = None  # (I,) of a run whose gain is its own, see `make_projection`

    def white(self, increments: Floats) -> Floats:
        """Whiten angle increments [rad], shape (I,)."""
        white = np.empty(len(increments))
        fill_white(self.fresh, self.still, self.gains, np.ascontiguousarray(increments), white)
        return white if self.along is None else white - self.along * float(self.along @ white)


def make_whitening(data: ErrorData, model: ErrorModel, lag: Lag) -> TorqueWhitening:
    """Make the whitening of increments like those of `data`."""
    gains = np.empty((len(data.fresh), GAINS))
    if model.gain == 0.0:
        data.whiten(model, lag, gains=gains)
        return TorqueWhitening(data.fresh, data.still, gains)
    data.less(data.find_gain(model, lag)).whiten(model.without_gain, lag, gains=gains)
    plain = TorqueWhitening(data.fresh, data.still, gains)
    return replace(plain, along=make_projection(plain.white(data.travel), model.gain))


def unit_of(data: Intervals) -> float:
    """[rad] what a sensor's error is a share of: its unit, or the typical travel where nothing is known of that."""
    return data.unit if data.unit > 0.0 else measure_travel(data)


def measure_travel(data: Intervals) -> float:
    """Measure the typical travel [rad] in an interval; 1 where there is none."""
    return float(np.median(np.abs(data.speed * data.duration))) or 1.0


def make_error_data(
    data: Intervals, increments: Floats, counted: Bools | None = None, response: Floats | None = None
) -> ErrorData:
    """Prepare one recording's increments [rad] (I,) for the filter.

    counted: those whose likelihood is wanted. response: [rad] of the simulated angle at `data.time` to a gain of the
    run; without, nothing that goes with a gain is told.
    """
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
        window=data.window,
        increments=np.ascontiguousarray(increments),
        counted=np.ones(len(still), dtype=bool) if counted is None else counted,
        travel=np.zeros(len(still)) if response is None else measure_response(data, response),
    )


def measure_response(data: Intervals, response: Floats) -> Floats:
    """Measure what a response of the angle [rad] at `data.time` adds to the travel (I,) in each interval of motion."""
    travel = response[data.last] - response[data.first]
    return np.where(data.slack > 0.0, 0.0, travel)


def log_likelihood(rows: Sequence[ErrorData], model: ErrorModel, lag: Lag) -> float:
    """Compute the log likelihood of what counts in all recordings."""
    return sum(row.score(model, lag) for row in rows)
