"""Whiten what an estimate leaves on measured angles, and the response of a ripple, recording by recording.

What each counted run's wrong initial speed leaves (the model came to it without the ripple) is projected out of both.
Near a standstill, where the shaft swings on its ripple rather than turns over it, nothing is taken.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import tau

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.parameter_space import SLOW_SPEED
from motor_identification.estimation.whitened_fit import learn_encoders
from motor_identification.measurement.measured_angle import Track, find_row_step
from motor_identification.noise.encoder import Encoder
from motor_identification.periodic.autoregression import Autoregression, fit_autoregression
from motor_identification.periodic.linear_response import Course
from motor_identification.recording import Floats, Integers
from motor_model.compiled import compiled

BLOCK_TURNS = 8.0  # turns
SAME_INSTANT = 1e-9  # [s] intervals that are no further apart follow each other


@dataclass(frozen=True)
class WhitenedRun:
    """One recording's residual, whitened, with what is needed to whiten a response; arrays of shape (I,)."""

    encoder: Encoder
    colour: Autoregression
    course: Course
    white: Floats  # of measured minus simulated increments, without what an initial speed explains
    transient: Floats  # whitened increments that an initial speed of every counted run makes, of length 1 in each

    def whiten(self, increments: Floats) -> Floats:
        """Whiten increments (I,) [rad], those of moving intervals."""
        moving = np.where(self.course.moving, increments, 0.0)
        return self.colour.whiten(self.encoder.white(moving)[: len(increments)])

    def project_out_transient(self, white: Floats) -> Floats:
        """Project out of whitened increments (I,) what an initial speed of every counted run explains."""
        along = np.bincount(self.course.run, self.transient * white)
        return white - along[self.course.run] * self.transient

    def pull_back(self) -> Floats:
        """Pull the white residual back to increments (I,): its products with responses are those of these with them."""
        return self.encoder.pull(self.colour.whiten_adjoint(self.white))

    def sum_products(self, cycles: float, block: Integers) -> Floats:
        """Add up what least squares of a ripple of so many cycles needs to know of every block, shape (B, 5)."""
        return self.sum_products_of(self.course.response(cycles), block)

    def sum_products_of(self, increments: tuple[Floats, Floats], block: Integers) -> Floats:
        """Add up the same of any two increments (I,) [rad], of a sine and of a cosine."""
        sums = np.zeros((int(block.max()) + 1, 5))
        sine, cosine = (self.project_out_transient(self.whiten(part)) for part in increments)
        _add_products(self.white, sine, cosine, block, sums)
        return sums

    def number_blocks(self) -> Integers:
        """Number the stretches of a few turns within which the phase is surely kept, shape (I,)."""
        stretch = np.floor(self.course.start / (tau * BLOCK_TURNS)).astype(np.int64)
        pairs = np.column_stack([self.course.run, stretch])
        return np.asarray(np.unique(pairs, axis=0, return_inverse=True)[1].reshape(-1))

    def longest_turns(self) -> float:
        """Measure the longest counted run in turns."""
        begin, end = np.full((2, int(self.course.run.max(initial=0)) + 1), [[np.inf], [-np.inf]])
        for angle in (self.course.start, self.course.end):
            np.minimum.at(begin, self.course.run, angle)
            np.maximum.at(end, self.course.run, angle)
        return float((end - begin).max()) / tau


def whiten_runs(estimate: Estimate, tracks: Sequence[Track]) -> list[WhitenedRun]:
    """Whiten what an estimate leaves on measured angles in each of its recordings."""
    # Slower, a ripple holds or turns back the shaft: no linear response.
    slow = tuple(np.abs(data.speed) < SLOW_SPEED * np.abs(data.speed).max() for data in estimate.problem.intervals)
    estimate = estimate.on(estimate.problem.without(slow))
    runs = []
    rows = zip(estimate.problem.intervals, tracks, estimate.increments, learn_encoders(estimate), strict=True)
    for data, track, increments, encoder in rows:
        angle, begun = data.gear * track.at(data.time), data.time[data.first]  # of the encoder's (the motor's) shaft
        number = track.run_at(begun)
        gap = _find_gaps(begun, begun + data.duration, number, data.order, find_row_step(data))
        course = Course(
            data.order, number, angle[data.first], angle[data.last], data.duration, gap, data.slack == 0.0, estimate.lag
        )
        moved = np.where(course.moving, -increments, 0.0)
        colour = fit_autoregression(encoder.white(moved)[: len(moved)], course.order)
        run = WhitenedRun(encoder, colour, course, -increments, increments)
        white, transient = run.whiten(run.white), run.whiten(course.transient())
        length = np.sqrt(np.bincount(course.run, transient**2))[course.run]
        run = replace(run, white=white, transient=np.divide(transient, length, where=length > 0.0, out=0.0 * length))
        runs.append(replace(run, white=run.project_out_transient(white)))
    return runs


def _find_gaps(begin: Floats, end: Floats, run: Integers, order: Integers, most: float) -> Floats:
    """[s] from the end of the interval before in the same run to the beginning of each, shape (I,).

    0 where that is more than `most`: what happened there is not known.
    """
    gap = np.zeros(len(begin))
    before, after = order[:-1], order[1:]
    apart = begin[after] - end[before]
    gap[after] = np.where((run[after] == run[before]) & (apart > SAME_INSTANT) & (apart <= most), apart, 0.0)
    return gap


@compiled
def _add_products(white: Floats, sine: Floats, cosine: Floats, block: Integers, sums: Floats) -> None:
    """Add up, for every block, the products that least squares needs: (B, 5)."""
    for i in range(len(white)):
        row = sums[block[i]]
        row[0] += sine[i] * sine[i]
        row[1] += sine[i] * cosine[i]
        row[2] += cosine[i] * cosine[i]
        row[3] += sine[i] * white[i]
        row[4] += cosine[i] * white[i]
