"""The loop with the speed of the period method: how late that is, and how it swings with an irregular disc.

The period method says slot/period of the latest two edges. At constant speed ω edge j comes where its flank is off by
an angle o_j (slots irregular by a share, the timer's tick), so that the reported speed is off by

    n = ω (o_j − o_(j−1)) / slot,   held until the next edge, slot/ω later.

Its autocovariance is linear between 2, −1 and 0 times (σ_o ω/slot)² at lags of 0, 1 and 2 slot periods; seen by
samples T apart and sent through the loop, voltage and speed swing by

    σ² = 1/2π ∫ |H|² Σk r(kT) cos kΩ dΩ,   H = C/(1 + L) for the voltage, L/(1 + L) for the speed.

The lag is one slot period in the mean: half of it is the averaging over the period, half the wait for the next edge.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from motor_control.tuning.linear_loop import Complexes, Gains, Plant, law, open_loop
from motor_control.tuning.margins import Loop
from motor_control.tuning.speed_feedback import MEASURED, PEAK_TO_PEAK, Encoder, Ripple

Floats = NDArray[np.float64]
FREQUENCIES = 256
LATENESSES = 2.0  # of τ in Λ at least, see `tuning`


@dataclass(frozen=True)
class Measured:
    """The law sees what the plant reports."""

    encoder: Encoder
    name: str = MEASURED
    bound: str = "encoder delay at {:.3g} rad/s"

    def lag(self, speed: float) -> float:
        """[s] how old the reported speed is at a speed [rad/s], in the mean."""
        return self.encoder.slot / speed

    def plant(self, bare: Plant, speed: float) -> Plant:
        """With the encoder's lag."""
        return replace(bare, sensor_lag=self.lag(speed))

    def law(self, gains: Gains) -> Gains:
        """As they are."""
        return gains

    def forward(self, plant: Plant, reference: float) -> float:
        """None: without a model the integral does it all."""
        return 0.0

    def fastest(self, bare: Plant, speeds: tuple[float, ...]) -> float:
        """What everything that makes the loop late allows at the lowest speed."""
        plant = self.plant(bare, min(speeds))
        return plant.ka / (plant.gain * LATENESSES * plant.late)

    def loop(self, bare: Plant, gains: Gains, speed: float) -> Loop:
        """L(z)."""
        plant = self.plant(bare, speed)
        return lambda z: open_loop(plant, gains, z)

    def ripple(self, bare: Plant, gains: Gains, speed: float) -> Ripple:
        """The integral above, over a grid of frequencies."""
        period = bare.sample_period
        angle = (np.arange(FREQUENCIES) + 0.5) * np.pi / FREQUENCIES  # [rad] per sample, up to Nyquist
        z = np.exp(1j * angle)
        loop = self.loop(bare, gains, speed)(z)
        spectrum = _held_differences(angle, self.lag(speed) / period)
        sigma = self.encoder.edge_noise(speed) * speed / self.encoder.slot

        def swing(h: Complexes) -> float:
            return PEAK_TO_PEAK * sigma * float(np.sqrt(np.mean(np.abs(h) ** 2 * spectrum)))

        calm = 1.0 / (1.0 + loop)
        shaft, seen, voltage = swing(loop * calm), swing(calm), swing(law(gains, period, z) * calm)
        return Ripple(shaft / speed, seen / speed, voltage)


def _held_differences(angle: Floats, hold: float) -> Floats:
    """Σ r(k) cos kΩ for unit σ_o ω/slot, held for `hold` samples, at these angles Ω."""
    lags = np.arange(1, int(2.0 * hold) + 1)
    covariance = np.interp(lags / hold, [0.0, 1.0, 2.0], [2.0, -1.0, 0.0])
    total = 2.0 + 2.0 * np.cos(np.outer(angle, lags)) @ covariance
    return np.asarray(np.maximum(total, 0.0))
