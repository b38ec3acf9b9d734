"""Hold a candidate model, and judge what it leaves: noise, structure or a random torque."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import exp, sqrt

import numpy as np

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.fits.disturbed_fit import list_error_data, whiten_beside_torque
from motor_identification.discrepancy.rests import are_parts_held_out, list_held_rests, list_training_rests
from motor_identification.discrepancy.structure import Structure, find_structure
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.whitened_fit import WhitenedFit, fit_whitened
from motor_identification.measurement.intervals import Intervals, count_turns
from motor_identification.noise.error_data import ErrorData
from motor_identification.noise.error_learning import estimate_disturbance
from motor_identification.noise.error_model import Disturbance, ErrorModel, Lag
from motor_identification.noise.gain_learning import learn_errors_of_runs, learn_own_gains
from motor_identification.noise.likelihood import Noise
from motor_identification.recording import Bools, Floats, Recording
from motor_identification.uncertainty.standard_errors import Uncertainty, estimate_uncertainty
from motor_identification.validation.held_out import HeldOut, list_held_errors
from motor_identification.validation.instants import needs_instant
from motor_model.effects import EFFECT_BY_NAME


@dataclass(frozen=True)
class Score:
    """How likely recordings are under a fitted motor: logarithms of likelihoods."""

    likelihood: float  # of unseen data; beside a random torque, or where none is, of all less a price
    training: float = 0.0  # of the data that it was fitted to, where that is not part of it
    by_recording: tuple[float, ...] = ()  # the same of each; not beside a random torque
    held_out: float = 0.0  # beside a random torque, the held-out data's part of `likelihood`
    scored: int = 0  # intervals that it is of
    moments: Floats = field(default_factory=lambda: np.zeros(0))  # of all motion, what each adds to the likelihood

    @property
    def of_all(self) -> float:
        """Of held-out and of training data."""
        return self.likelihood + self.training


@dataclass(frozen=True)
class Model:
    """A fitted motor, and how it does on held-out data."""

    estimate: Estimate  # on its training data
    held: HeldOut
    noise: Noise  # what it leaves in the training data
    score: Score
    learned: ErrorModel | None = None  # of what it leaves, where it is judged beside a random torque

    @property
    def likelihood(self) -> float:
        """Logarithm of the likelihood that it is judged by."""
        return self.score.likelihood

    @property
    def beside_torque(self) -> bool:
        """Whether its likelihood is that beside a random torque."""
        return self.learned is not None

    @property
    def effects(self) -> tuple[str, ...]:
        """What it has beyond kv and ka."""
        return self.estimate.problem.unknowns.effects

    @property
    def lag(self) -> Lag:
        """The motor as a first-order lag."""
        return self.estimate.lag

    @cached_property
    def turns(self) -> float:
        """Turns of the encoder's shaft between the ends of its motion, in the recording that has most of them."""
        return count_turns(self.estimate.problem.intervals, self.estimate.angles)

    @cached_property
    def whitened(self) -> WhitenedFit:
        """The last stage of its fit, which its parameters and their standard errors are said from.

        What repeats with the angle, or begins at an instant, is fitted beside the random torque already, which hides
        its phase or instant elsewhere; and what is common to runs whose gains differ, beside these.
        """
        hidden = any(EFFECT_BY_NAME[name].periodic or needs_instant(name) for name in self.effects)
        if self.learned is not None and (hidden or self.learned.gain > 0.0):
            return whiten_beside_torque(self.estimate, self.learned)
        return fit_whitened(self.estimate)

    @cached_property
    def uncertainty(self) -> Uncertainty:
        """How sure its parameters are; every effect that it has asks."""
        fit = self.whitened
        return estimate_uncertainty(fit, fit.residuals.jacobian(fit.theta))

    @cached_property
    def told_beside_torque(self) -> tuple[WhitenedFit, Uncertainty] | None:
        """Its parameters, and how sure they are, by what knows of the random torque; None where more than that is left.

        Of a motor that a torque moves slowly, encoders alone tell a friction a tenth as well. Not what parameters are
        said from: beside a slow torque of 0.4 of a friction that holds the motor, their errors are half as large as
        they should be.
        """
        if self.learned is None or self.learned.rms_voltage == 0.0 or not self.complete:
            return None
        fit = whiten_beside_torque(self.estimate, self.learned)
        return fit, estimate_uncertainty(fit, fit.residuals.jacobian(fit.theta))

    @property
    def floor(self) -> float:
        """[rad/s] the gap that timer and slots alone leave."""
        return self.held.floor(self.noise.share)

    @cached_property
    def lasting(self) -> HeldOut:
        """What it leaves in lasting intervals."""
        return self.held.joined(find_lasting_interval(self.held))

    @cached_property
    def quiet(self) -> bool:
        """Whether it leaves nothing that lasts, so that no further effect could be relevant.

        Not where its floor is what it leaves itself: then any model is at it.
        """
        if min(data.learned for data in self.held.intervals) < thresholds.LEARNED_NOISE:
            return False
        return self.lasting.gap < thresholds.QUIET_GAP * self.lasting.floor(self.noise.share)

    @property
    def at_floor(self) -> bool:
        """Whether nothing is left to explain."""
        return self.held.gap <= thresholds.EXPLAINED_GAP * self.floor

    @property
    def above_floor(self) -> bool:
        """Whether the sensor leaves less; neither where there is nothing to judge by, and the gap no number."""
        return self.held.gap > thresholds.EXPLAINED_GAP * self.floor

    @cached_property
    def lasts(self) -> bool:
        """Whether it leaves what lasts: a torque that fast samples of a coarse sensor may hide in the gap."""
        return self.lasting.gap > thresholds.LASTING_GAP * self.lasting.floor(self.noise.share)

    @cached_property
    def errors_beside_torque(self) -> ErrorModel:
        """What sensor and random torque leave in the training data."""
        return self.learned or learn_errors(self.estimate)

    @property
    def errors(self) -> ErrorModel:
        """The same; only the sensor where it explains what is left, and nothing was learned."""
        if self.learned is None and not self.above_floor:
            return ErrorModel(self.noise.share, 0.0, 0.0, 1.0)
        return self.errors_beside_torque

    @cached_property
    def structure(self) -> tuple[Structure, ...]:
        """What free curves predict of what is left, the most telling variable first; nothing at the sensor's floor."""
        if not self.above_floor:
            return ()
        own, others = self.less_gains(list_held_errors(self.held)), []
        if not are_parts_held_out(self.estimate, self.held):
            others = list_training_rests(self.estimate, self.less_gains(list_error_data(self.estimate)))
        return find_structure(
            list_held_rests(self.estimate, self.held, own), others, self.errors.without_gain, self.lag
        )

    def less_gains(self, rows: Sequence[ErrorData]) -> list[ErrorData]:
        """Take from what is left what the gain of each run adds, which goes with everything that the runs differ in."""
        errors = self._own_gains
        return list(rows) if errors is None else [row.less(row.find_gain(errors, self.lag)) for row in rows]

    @cached_property
    def _own_gains(self) -> ErrorModel | None:
        """Errors beside which each run has a gain of its own, which no other run tells; None where there are none.

        A curve over voltage and speed tells runs of one level each by that. Measured: of ten steps of a real motor one
        ran 4 % slower than the others, which such a curve predicted (0.5 of the rest), and all that was found went.
        """
        if self.errors.gain > 0.0:
            return self.errors
        return learn_own_gains(list_error_data(self.estimate), self.lag, self.errors)

    @property
    def complete(self) -> bool:
        """Whether nothing is left that can be predicted: the sensor explains it, or it is random."""
        return not self.above_floor or (self.is_random and not any(one.certain for one in self.structure))

    @property
    def is_random(self) -> bool:
        """Whether the random torque that was learned leaves about as much as is left: else it does not describe it."""
        time = self.errors.correlation_time + 1.0 / self.lag.rate
        rows = zip(self.held.intervals, self.held.scored, strict=True)
        seen = sum(_measure_time(data, marks) for data, marks in rows)
        # Chance of the RMS of so many independent samples.
        chance = min(exp(thresholds.RANDOM_SIGMA * sqrt(0.5 * time / seen)), thresholds.MOST_CHANCE)
        low, high = (limit * self.noise_floor for limit in thresholds.RANDOM_GAP)
        # Bumps now and then are no less random than the torque of all other times.
        return low / chance < self.held.gap and self.held.find_calm_gap(thresholds.WILD_TIME) < high * chance

    @property
    def fills_floor(self) -> bool:
        """Whether it leaves about as much as sensor and torque do, or more: less may be chance, or another's torque."""
        return not self.above_floor or self.held.gap > thresholds.RANDOM_GAP[0] * self.noise_floor

    @property
    def is_tossed(self) -> bool:
        """Whether its random torque is larger than those of gears and loads: what the table lacks may be in it."""
        return tosses(self.errors, self.held.recordings)

    @property
    def unpredictable_gap(self) -> float:
        """[rad/s] of the gap, what no free curve predicts; the sensor's floor where it explains what is left."""
        if not self.above_floor or not self.is_random:
            return self.floor
        share = max((one.share for one in self.structure if one.certain), default=0.0)
        return max(self.held.gap * sqrt(max(1.0 - share, 0.0)), self.floor)

    def measure_lags(self) -> float:
        """Measure the time that it is judged by, in time constants of the motor."""
        rows = zip(self.held.intervals, self.held.scored, strict=True)
        return sum(_measure_time(data, marks) for data, marks in rows) * self.lag.rate

    @property
    def sensor_floor(self) -> float:
        """[rad/s] the gap that the sensor alone would leave, irregular slots told from a random torque."""
        return self.held.floor(self.errors.share)

    @property
    def noise_floor(self) -> float:
        """[rad/s] the gap that sensor and random torque would leave of a perfect model."""
        return float(np.sqrt(self.sensor_floor**2 + self.held.weight @ self._random_variance(self.held)))

    def estimate_disturbance(self) -> Disturbance | None:
        """Estimate the random torque beside the model, with its standard errors; None where there is none."""
        return estimate_disturbance(list_error_data(self.estimate), self.errors, self.lag)

    def scatter_of_travel(self) -> tuple[Floats, ...]:
        """Compute the scatter [rad] that sensor and random torque leave in the travel of every held-out interval."""
        scatter = []
        for data, speed in zip(self.held.intervals, self.held.supply_speeds, strict=True):
            variance = data.floor_squared(self.errors.share * data.unit)
            variance = variance + self.errors.speed_variance(data.duration, self.lag) + (self.errors.gain * speed) ** 2
            scatter.append(np.sqrt(variance) * data.duration)
        return tuple(scatter)

    def _random_variance(self, held: HeldOut) -> Floats:
        """Compute what random torque and gains leave [rad²/s²] in each interval that counts."""
        duration = np.concatenate([data.duration for data in held.intervals])[held.counted]
        speed = np.concatenate(held.supply_speeds)[held.counted]
        return self.errors.speed_variance(duration, self.lag) + (self.errors.gain * speed) ** 2


def find_lasting_interval(held: HeldOut) -> float:
    """Find how long [s] the intervals are in which what a model leaves lasts."""
    values = held.parameters.values
    whole = sum(_measure_time(data, marks) for data, marks in zip(held.intervals, held.scored, strict=True))
    longest = min(values["ka"] / values["kv"], whole / thresholds.LASTING_PARTS)
    rows = thresholds.LASTING_ROWS * float(np.median(np.concatenate([data.duration for data in held.intervals])))
    return max(min(thresholds.LASTING_INTERVAL, rows), longest)


def _measure_time(data: Intervals, marks: Bools) -> float:
    """Measure the time [s] that marked intervals stand for; speeds of instants have next to none of their own."""
    return float(data.duration[marks].sum() / data.duration.sum() * (data.time[-1] - data.time[0]))


def tosses(torque: ErrorModel | Disturbance, recordings: Sequence[Recording]) -> bool:
    """Decide whether a random torque is larger than those of gears and loads, beside the voltages of recordings.

    One that lasts for less than a row is rather the sensor's noise, or of stamps.
    """
    largest = max((float(np.max(np.abs(one.voltage))) for one in recordings), default=0.0)
    row = min((one.info.sample_period for one in recordings), default=0.0)
    strong = torque.rms_voltage > thresholds.MOST_TORQUE * largest > 0.0
    return strong and torque.correlation_time >= row


def learn_errors(estimate: Estimate) -> ErrorModel:
    """Learn what sensor and random torque leave of an estimate in its training data."""
    return learn_errors_of_runs(list_error_data(estimate), estimate.lag, None, thresholds.FINAL_EVALUATIONS)
