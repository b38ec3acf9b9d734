"""The last stage of a fit: residuals whitened by what is known of encoder, disc and model, for least squares.

From a first fit's residuals it learns, recording by recording, how irregular the slots are, which slot every edge is,
and how fast the simulated angle drifts away (q of `noise.py`); least squares on the result is efficient where the model
is right, and falls back to comparing speeds where it is not.
"""

from dataclasses import dataclass
from math import nan, sqrt

import numpy as np

from motor_identification.estimation.least_squares import descend
from motor_identification.estimation.problem import Problem
from motor_identification.measurement.intervals import Intervals
from motor_identification.noise.angle_noise import AngleNoise, Whitening, adjoint, likely_growth, make_whitening, whiten
from motor_identification.noise.likelihood import likely_noise
from motor_identification.noise.slot_alignment import aligned
from motor_identification.noise.slot_table import Projection, SlotTable, likely_variance, slot_index
from motor_identification.recording import Bools, Floats
from motor_model.effects import EFFECT_BY_NAME

SLACK_BLUR = 0.05  # of a slot: how sharply a standing motor contradicts a simulated one that moves
LEAST_SHARE = 1e-4  # of a slot: irregularity to begin with at least
MOST = 0.05  # of a slot: more irregular than this is no disc
ROUNDS = 40  # of expectation maximisation
LEARNING = 4  # times at most that table, places on the disc and drift are learned from each other
OUTLIER = 8.0  # standard deviations
FEW = 0.005  # share of the intervals
LEAST_BLUR = 1e-3  # of the typical increment, where the encoder says nothing of its own accuracy


@dataclass(frozen=True)
class Encoder:
    """What one recording's encoder and disc leave: a whitening, and the table's projection where there are slots."""

    whitening: Whitening
    projection: Projection | None
    slot: float  # [rad] 0 where nothing is known of the slots
    slot_sigma: float  # [rad] standard deviation of the flanks
    growth: float  # [rad²/s] drift of the simulated angle

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
        return adjoint(self.whitening, left)


def learn(problem: Problem, place: Floats) -> tuple[Encoder, ...]:
    """What the residuals at a fitted place (D,) say about every recording's encoder."""
    first_harmonic = not any(EFFECT_BY_NAME[name].on_disc for name in problem.unknowns.effects)
    rows = zip(problem.intervals, problem.increments(place), problem.angles(place), strict=True)
    return tuple(_learn_one(data, increments, angle, first_harmonic) for data, increments, angle in rows)


def _learn_one(data: Intervals, increments: Floats, angle: Floats, first_harmonic: bool) -> Encoder:
    noise = _noise(data, increments)
    if data.slot == 0.0:
        growth = likely_growth(noise, increments)
        return Encoder(make_whitening(noise, growth), None, 0.0, 0.0, growth)
    index = slot_index(data, angle)
    # Slots and drift at once to begin with: a table learnt first would take an error of the model for its slots.
    guess = likely_noise([(data, increments)])
    variance, growth = (max(guess.share, LEAST_SHARE) * data.slot) ** 2, guess.growth
    table = SlotTable(make_whitening(noise, growth), index, first_harmonic)
    for learned in range(1, LEARNING + 1):
        white = whiten(table.whitening, increments)
        variance = likely_variance(table, white, variance, (MOST * data.slot) ** 2, ROUNDS)
        offsets = Projection(table, variance).best(white)
        index = aligned(table, white, offsets)
        moved = index is not table.index
        before, growth = growth, likely_growth(noise, increments - index.increments(offsets))
        if growth != before or moved:  # else the table's modes are those that are known
            table = SlotTable(make_whitening(noise, growth), index, first_harmonic)
        if learned >= 2 and not moved:
            break
    return Encoder(table.whitening, Projection(table, variance), data.slot, float(np.sqrt(variance)), growth)


def _noise(data: Intervals, increments: Floats) -> AngleNoise:
    still = data.slack > 0.0
    least = LEAST_BLUR * float(np.median(np.abs(increments))) + 1e-12
    variance: Floats = np.maximum(data.blur, least) ** 2
    end = np.where(still, (SLACK_BLUR * data.slack) ** 2, variance)
    return AngleNoise(data.fresh, np.where(still, 0.0, variance), end, data.duration)


@dataclass(frozen=True)
class Refined:
    """Whitened residuals of a problem, for least squares and for its statistics."""

    problem: Problem
    encoders: tuple[Encoder, ...]

    @property
    def noise_floor(self) -> float:
        """[rad/s] time-weighted RMS of what timer tick (or count quantisation) and irregular slots alone leave."""
        rows = zip(self.problem.intervals, self.encoders, strict=True)
        squares = [data.floor_squared(encoder.slot_sigma) for data, encoder in rows]
        return sqrt(float(self.problem.weight @ np.concatenate(squares)))

    def white(self, residuals: Floats) -> Floats:
        """From mean speeds' residuals [rad/s] (I,) to white ones, all recordings one after the other."""
        rows = zip(self.encoders, self.problem.travelled(residuals), strict=True)
        return np.concatenate([encoder.white(increments) for encoder, increments in rows])

    def outliers(self, place: Floats) -> tuple[Bools, ...]:
        """Intervals of every recording that no noise explains, where they are few; else none is marked.

        Such as one that hides an unnoticed reversal, or a wrong stamp. Many of them are no outliers but a wrong model.
        """
        marks = []
        for data, encoder, increments in zip(
            self.problem.intervals, self.encoders, self.problem.increments(place), strict=True
        ):
            white = encoder.white(increments)[: len(increments)]
            far = (np.abs(white) > OUTLIER) & (data.slack == 0.0)
            marks.append(far if far.sum() <= FEW * len(far) else np.zeros_like(far))
        return tuple(marks)

    def residuals(self, place: Floats) -> Floats:
        """White residuals at a place (D,)."""
        return self.white(self.problem.residuals(place))

    def jacobian(self, place: Floats) -> Floats:
        """Their derivative over the unknowns, one column each."""
        columns = self.problem.jacobian(place).T
        first = self.white(columns[0])
        white = np.empty((len(columns), len(first)))  # filled in turn, so that an hour's columns are not there twice
        white[0] = first
        for row, column in zip(white[1:], columns[1:], strict=True):
            row[:] = self.white(column)
        return white.T


def refine(problem: Problem, place: Floats) -> tuple[Refined, Floats, int]:
    """Learn the encoder from what a fit (D,) leaves, fit white residuals, and again, without outliers.

    Returns what was learnt, the place, and the number of simulations.
    """
    evaluations = 0
    for last in (False, False, True):
        refined = Refined(problem, learn(problem, place))
        place, more = descend(problem, refined, place)
        evaluations += more
        far = refined.outliers(place)
        if not last and any(marks.any() for marks in far):
            problem = problem.without(far)
    return refined, place, evaluations
