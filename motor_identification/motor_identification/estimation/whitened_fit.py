"""Fit whitened residuals, the last stage of a fit: whitened by what is known of encoder, disc and model.

What a first fit leaves says, recording by recording, what encoder and disc are like (`noise/encoder.py`); least squares
on the result is efficient where the model is right, and falls back to comparing speeds where it is not.
"""

from dataclasses import dataclass
from math import sqrt
from typing import Generic, Protocol, TypeVar

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_residuals
from motor_identification.estimation.problem import Problem
from motor_identification.estimation.speed_noise import learn_noise
from motor_identification.noise.encoder import Encoder, learn_encoder
from motor_identification.recording import Bools, Floats
from motor_model.effects import EFFECT_BY_NAME

OUTLIER_SIGMA = 8.0  # standard deviations that no noise reaches
MOST_OUTLIERS = 0.005  # share of the intervals: more of them are a wrong model


def learn_encoders(estimate: Estimate) -> tuple[Encoder, ...]:
    """Learn what the residuals of an estimate say about every recording's encoder."""
    first_harmonic = not any(EFFECT_BY_NAME[name].on_disc for name in estimate.problem.unknowns.effects)
    rows = zip(estimate.problem.intervals, estimate.increments, estimate.angles, strict=True)
    return tuple(learn_encoder(data, increments, angle, first_harmonic) for data, increments, angle in rows)


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

    def on(self, problem: Problem) -> "WhitenedResiduals":
        """The same whitening of another model's motion in the same recordings, without what was measured beside it."""
        return WhitenedResiduals(problem, self.encoders)

    @property
    def beside(self) -> tuple[Beside, ...]:
        """What was measured beside the motion; its rows come after all others, recording by recording."""
        return ()

    @property
    def gains_differ(self) -> bool:
        """Whether each recording has a gain of its own, so that they need not agree."""
        return False

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
        estimate = learn_noise(estimate)
        residuals = make_whitened(estimate).residuals
        fit = WhitenedFit(fit_residuals(estimate, residuals), residuals)
        estimate, far = fit.estimate, fit.find_outliers()
        if not last and any(marks.any() for marks in far):
            estimate = estimate.on(estimate.problem.without(far))
    return fit
