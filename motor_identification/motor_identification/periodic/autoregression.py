"""Whiten what a random torque colours: an autoregression predicts every residual from the ones just before.

The angle's own whitening takes what a model leaves from interval to interval for independent. A random torque, filtered
by the motor, is slow beside a ripple; what cannot be predicted from the residuals before has a flat spectrum, in which
a fast line stands out (prediction-error filter; G. Box & G. Jenkins, Time Series Analysis, 1970).
"""

from dataclasses import dataclass

import numpy as np

from motor_identification.recording import Floats, Integers

ORDER = 4  # a torque with a correlation time, a motor's lag, and the two flanks of an interval
ROBUST = 4.0  # standard deviations: what is beyond does not tell how residuals hang together


@dataclass(frozen=True)
class Autoregression:
    """What predicts a residual from those before it in time, and the scale that keeps the residuals' power."""

    order: Integers  # of the intervals in time
    weights: Floats  # of the residual before, the one before that, …
    scale: float

    def whiten(self, residuals: Floats) -> Floats:
        """Leave what cannot be predicted of residuals (I,)."""
        left = residuals[self.order]
        done = left.copy()
        for lag, weight in enumerate(self.weights, 1):
            done[lag:] -= weight * left[:-lag]
        return self._put_back(done)

    def whiten_adjoint(self, white: Floats) -> Floats:
        """Apply the transpose of `whiten`, (I,) → (I,): for products with what is white."""
        left = white[self.order]
        done = left.copy()
        for lag, weight in enumerate(self.weights, 1):
            done[:-lag] -= weight * left[lag:]
        return self._put_back(done)

    def _put_back(self, ordered: Floats) -> Floats:
        back = np.empty_like(ordered)
        back[self.order] = self.scale * ordered
        return back


def fit_autoregression(residuals: Floats, order: Integers) -> Autoregression:
    """Fit the weights to residuals (I,) by least squares; `order` is that of their times. Too few have none."""
    ordered = residuals[order]
    size = float(np.sqrt(np.mean(ordered**2))) if len(ordered) else 0.0
    if len(ordered) < 10 * ORDER or size == 0.0:
        return Autoregression(order, np.zeros(0), 1.0)
    clipped = np.clip(ordered, -ROBUST * size, ROBUST * size)
    before = np.column_stack([clipped[ORDER - lag : len(clipped) - lag] for lag in range(1, ORDER + 1)])
    weights = np.asarray(np.linalg.lstsq(before, clipped[ORDER:], rcond=None)[0], dtype=np.float64)
    whitened = Autoregression(order, weights, 1.0).whiten(residuals)
    return Autoregression(order, weights, size / float(np.sqrt(np.mean(whitened**2))))
