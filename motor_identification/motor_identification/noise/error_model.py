"""Describe what a model leaves: the sensor's error, and a random torque with strength and correlation time."""

from dataclasses import dataclass, replace

import numpy as np

from motor_identification.recording import Floats


@dataclass(frozen=True)
class Lag:
    """A motor as a first-order lag, which every torque passes."""

    rate: float  # [1/s] α = kv/ka, one over the time constant
    ka: float  # [V·s²/rad]


@dataclass(frozen=True)
class ErrorModel:
    """What sensor and disturbance leave in simulated minus measured angles."""

    share: float  # standard deviation of the flanks as a share of a slot (of the typical travel, where none is known)
    white: float  # [rad²/s] growth of the angle's error by what is independent in every interval
    rms_voltage: float  # [V] of the random torque; 0 where there is none
    correlation_time: float  # [s] of it
    gain: float = 0.0  # standard deviation of the runs' gains; 0 where they agree

    @property
    def without_gain(self) -> "ErrorModel":
        """The same, of runs whose gains agree."""
        return replace(self, gain=0.0)

    def speed_variance(self, duration: Floats, lag: Lag) -> Floats:
        """Compute the variance [rad²/s²] that the random torque leaves in mean speeds over durations [s], shape (I,).

        The speed's autocovariance is A e^(−βs) + B e^(−αs); over h, e^(−xs/h) averages to 2(x − 1 + e^(−x))/x².
        """
        if self.rms_voltage == 0.0:
            return np.zeros(len(duration))
        rate, beta = lag.rate, 1.0 / self.correlation_time
        if abs(rate - beta) < 1e-4 * beta:
            beta *= 1.001
        scale = (self.rms_voltage / lag.ka) ** 2 / (rate**2 - beta**2)
        return np.asarray(
            scale * (average_correlation(beta * duration) - beta / rate * average_correlation(rate * duration))
        )


@dataclass(frozen=True)
class Disturbance:
    """A random torque as an armature voltage, with standard errors."""

    rms_voltage: float  # [V]
    rms_error: float
    correlation_time: float  # [s]
    time_error: float


def average_correlation(x: Floats) -> Floats:
    """Average e^(−|s−s'|) over two instants of an interval of length x."""
    return np.where(x > 1e-4, 2.0 * (x + np.expm1(-x)) / np.maximum(x, 1e-9) ** 2, 1.0 - x / 3.0)
