"""Fit whitened residuals, the last stage of a fit: whitened by what is known of encoder, disc and model.

From a first fit's residuals it learns, recording by recording, how irregular the slots are, which slot every edge is,
and how fast the simulated angle drifts away (q of `angle_noise.py`); least squares on the result is efficient where the
model is right, and falls back to comparing speeds where it is not.
"""

from dataclasses import dataclass
from math import nan, sqrt
from typing import Generic, Protocol, TypeVar

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_residuals
from motor_identification.estimation.problem import Problem
from motor_identification.measurement.intervals import Intervals
from motor_identification.noise.angle_noise import (
    AngleNoise,
    Whitening,
    estimate_drift,
    make_angle_noise,
    make_whitening,
    whiten,
    whiten_adjoint,
)
from motor_identification.noise.likelihood import estimate_noise
from motor_identification.noise.slot_alignment import align_slots
from motor_identification.noise.slot_table import Projection, SlotTable, estimate_slot_variance, index_slots
from motor_identification.recording import Bools, Floats
from motor_model.effects import EFFECT_BY_NAME

LEAST_IRREGULARITY = 1e-4  # of a slot: to begin with at least
UNEVEN_IRREGULARITY = 0.1  # the same of both channels' flanks, whose pattern the first guess takes for drift
MOST_IRREGULARITY = 0.05  # of a slot: more irregular than this is no disc (real ones: around 1 %)
EM_ROUNDS = 40  # of expectation maximisation
MOST_TURNS = 4  # that table, slots and drift are learned from each other
OUTLIER_SIGMA = 8.0  # standard deviations that no noise reaches
MOST_OUTLIERS = 0.005  # share of the intervals: more of them are a wrong model
LEAST_BLUR_SHARE = 1e-3  # of the typical increment, where the encoder says nothing of its own accuracy
DRIFT_GRID = tuple(10.0 ** (-0.5 * i) for i in range(20))  # of the mean square increment per second


@dataclass(frozen=True)
class Encoder:
    """What one recording's encoder and disc leave: a whitening, and the table's projection where there are slots."""

    whitening: Whitening
    projection: Projection | None
    slot: float  # [rad] 0 where nothing is known of the slots
    slot_sigma: float  # [rad] standard deviation of the flanks
    drift: float  # [rad²/s] drift of the simulated angle

    @property
    def irregularity(self) -> float:
        """The flanks' standard deviation as a share of a slot; NaN where nothing is known of the slots."""
        return self.slot_sigma / self.slot if self.slot > 0.0 else nan

    def white(self, increments: Floats) -> Floats:
        """White residuals from angle increments [rad]."""
        white = whiten(self.whitening, increments)
        return white if self.projection is None else self.projection(white)

    def pull(self, white: Floats) -> Floats:
        """The transpose of `white` but for the table's prior, (I,) → (I,): for products with what is white."""
        left = white if self.projection is None else self.projection(white)[: len(white)]
        return whiten_adjoint(self.whitening, left)


def learn_encoders(estimate: Estimate) -> tuple[Encoder, ...]:
    """Learn what the residuals of an estimate say about every recording's encoder."""
    first_harmonic = not any(EFFECT_BY_NAME[name].on_disc for name in estimate.problem.unknowns.effects)
    rows = zip(estimate.problem.intervals, estimate.increments, estimate.angles, strict=True)
    return tuple(_learn_one(data, increments, angle, first_harmonic) for data, increments, angle in rows)


def _learn_one(data: Intervals, increments: Floats, angle: Floats, first_harmonic: bool) -> Encoder:
    noise = make_angle_noise(data, 0.0, LEAST_BLUR_SHARE * float(np.median(np.abs(increments))) + 1e-12)
    if data.slot == 0.0:
        drift = _estimate_drift(noise, increments)
        return Encoder(make_whitening(noise, drift), None, 0.0, 0.0, drift)
    index = index_slots(data, angle)
    # Slots and drift at once to begin with: a table learnt first would take an error of the model for its slots.
    guess = estimate_noise([(data, increments)])
    least = UNEVEN_IRREGULARITY if data.unevenness > 1.0 else LEAST_IRREGULARITY
    variance, drift = (max(guess.share, least) * data.slot) ** 2, guess.drift
    table = SlotTable(make_whitening(noise, drift), index, first_harmonic)
    for turn in range(1, MOST_TURNS + 1):
        white = whiten(table.whitening, increments)
        variance = estimate_slot_variance(
            table, white, variance, (data.unevenness * MOST_IRREGULARITY * data.slot) ** 2, EM_ROUNDS
        )
        offsets = Projection(table, variance).best(white)
        index = align_slots(table, white, offsets)
        moved = index is not table.index
        before, drift = drift, _estimate_drift(noise, increments - index.increments(offsets))
        if drift != before or moved:  # else the table's modes are those that are known
            table = SlotTable(make_whitening(noise, drift), index, first_harmonic)
        if turn >= 2 and not moved:
            break
    return Encoder(table.whitening, Projection(table, variance), data.slot, float(np.sqrt(variance)), drift)


def _estimate_drift(noise: AngleNoise, increments: Floats) -> float:
    scale = float(np.mean(increments**2) / np.mean(noise.duration))
    return estimate_drift([noise], [increments], [scale * share for share in DRIFT_GRID])


class Filter(Protocol):
    """Something that whitens one recording's increments."""

    def white(self, increments: Floats) -> Floats:
        """White residuals from angle increments [rad] (I,)."""


F = TypeVar("F", bound=Filter)


@dataclass(frozen=True)
class FilteredResiduals(Generic[F]):
    """Residuals of a problem for least squares, whitened by a filter for each recording."""

    problem: Problem
    filters: tuple[F, ...]

    def white(self, residuals: Floats) -> Floats:
        """From mean speeds' residuals [rad/s] (I,) to white ones, all recordings one after the other."""
        rows = zip(self.filters, self.problem.to_travel(residuals), strict=True)
        return np.concatenate([one.white(increments) for one, increments in rows])

    def residuals(self, theta: Floats) -> Floats:
        """White residuals at θ (D,)."""
        return self.white(self.problem.residuals(theta))

    def jacobian(self, theta: Floats) -> Floats:
        """Their derivative over the unknowns, one column each."""
        columns = self.problem.jacobian(theta).T
        first = self.white(columns[0])
        white = np.empty((len(columns), len(first)))  # filled in turn, so that an hour's columns are not there twice
        white[0] = first
        for row, column in zip(white[1:], columns[1:], strict=True):
            row[:] = self.white(column)
        return white.T


@dataclass(frozen=True)
class Beside:
    """White residuals of one recording that are no intervals of motion: a row for each time [s], shape (K,)."""

    time: Floats


@dataclass(frozen=True)
class WhitenedResiduals(FilteredResiduals[Encoder]):
    """Residuals whitened by what is known of every recording's encoder, and their statistics."""

    @property
    def encoders(self) -> tuple[Encoder, ...]:
        """Every recording's encoder."""
        return self.filters

    @property
    def beside(self) -> tuple[Beside, ...]:
        """What was measured beside the motion; its rows come after all others, recording by recording."""
        return ()

    @property
    def noise_floor(self) -> float:
        """[rad/s] time-weighted RMS of what timer tick (or count quantisation) and irregular slots alone leave."""
        rows = zip(self.problem.intervals, self.encoders, strict=True)
        squares = [data.floor_squared(encoder.slot_sigma) for data, encoder in rows]
        return sqrt(float(self.problem.weight @ np.concatenate(squares)))


@dataclass(frozen=True)
class WhitenedFit:
    """An estimate by least squares of white residuals, and the residuals themselves."""

    estimate: Estimate
    residuals: WhitenedResiduals

    @property
    def problem(self) -> Problem:
        """What was fitted."""
        return self.estimate.problem

    @property
    def theta(self) -> Floats:
        """The fitted unknowns (D,)."""
        return self.estimate.theta

    def find_outliers(self) -> tuple[Bools, ...]:
        """Mark the intervals of every recording that no noise explains, where they are few; else none.

        Such as one that hides an unnoticed reversal, or a wrong stamp. Many of them are no outliers but a wrong model.
        """
        marks = []
        rows = zip(self.problem.intervals, self.residuals.encoders, self.estimate.increments, strict=True)
        for data, encoder, increments in rows:
            white = encoder.white(increments)[: len(increments)]
            far = (np.abs(white) > OUTLIER_SIGMA) & (data.slack == 0.0)
            marks.append(far if far.sum() <= MOST_OUTLIERS * len(far) else np.zeros_like(far))
        return tuple(marks)


def make_whitened(estimate: Estimate) -> WhitenedFit:
    """Whiten the residuals of an estimate by what they say about the encoder, θ as it is."""
    return WhitenedFit(estimate, WhitenedResiduals(estimate.problem, learn_encoders(estimate)))


def fit_whitened(estimate: Estimate) -> WhitenedFit:
    """Learn the encoder from what an estimate leaves, fit white residuals, and again, without outliers."""
    for last in (False, False, True):
        residuals = make_whitened(estimate).residuals
        fit = WhitenedFit(fit_residuals(estimate, residuals), residuals)
        estimate, far = fit.estimate, fit.find_outliers()
        if not last and any(marks.any() for marks in far):
            estimate = estimate.on(estimate.problem.without(far))
    return fit
