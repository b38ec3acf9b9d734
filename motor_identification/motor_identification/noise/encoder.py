"""Learn what one recording's encoder and disc leave, and whiten angle increments by it.

From a fit's residuals: how irregular the slots are, which slot every edge is, and how fast the simulated angle drifts
away (q of `angle_noise.py`).
"""

from dataclasses import dataclass, replace
from math import nan

import numpy as np

from motor_identification.measurement.intervals import Intervals
from motor_identification.noise.angle_noise import (
    AngleNoise,
    Whitening,
    make_angle_noise,
    make_whitening,
    whiten,
    whiten_adjoint,
)
from motor_identification.noise.likelihood import estimate_noise
from motor_identification.noise.noise_grid import estimate_drift
from motor_identification.noise.slots.alignment import align_slots
from motor_identification.noise.slots.slot_table import Projection, SlotTable, estimate_slot_variance, index_slots
from motor_identification.recording import Floats

LEAST_IRREGULARITY = 1e-4  # of a slot: to begin with at least
UNEVEN_IRREGULARITY = 0.1  # the same of both channels' flanks, whose pattern the first guess takes for drift
MOST_IRREGULARITY = 0.05  # of a slot: more irregular than this is no disc (real ones: around 1 %)
EM_ROUNDS = 40  # of expectation maximisation
MOST_TURNS = 4  # that table, slots and drift are learned from each other
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
        """Whiten angle increments [rad]."""
        white = whiten(self.whitening, increments)
        return white if self.projection is None else self.projection(white)

    def within(self, tolerance: float) -> "Encoder":
        """Whiten with a table that is solved within a tolerance only, a share: of many slots, several times faster."""
        if self.projection is None:
            return self
        return replace(self, projection=replace(self.projection, tolerance=tolerance))

    def pull(self, white: Floats) -> Floats:
        """Apply the transpose of `white` but for the table's prior, (I,) → (I,): for products with what is white."""
        left = white if self.projection is None else self.projection(white)[: len(white)]
        return whiten_adjoint(self.whitening, left)


def learn_encoder(data: Intervals, increments: Floats, angle: Floats, first_harmonic: bool) -> Encoder:
    """Learn what simulated minus measured increments [rad] (I,) say about one recording's encoder.

    angle: [rad] simulated at `data.time`. first_harmonic: whether the disc's own first harmonic is part of its table.
    """
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
