"""The current sensor of the plant's board: what it reads at every sample."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .forces import bridge, drive, warmth
from .motor import Motion

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Ammeter:
    """White noise [A], a zero that is off [A], and steps [A] (0: none)."""

    noise: float = 0.0
    offset: float = 0.0
    step: float = 0.0

    def read(self, p: Any, times: Floats, latched: Floats, motion: Motion, random: np.random.Generator) -> Floats:
        """[A] at each sample, before the voltage latched there acts; NaN without a resistance."""
        if p["resistance"] == 0.0:
            return np.full(len(times), np.nan)
        acts = np.searchsorted(times + p["delay"], times, side="left") - 1
        volts = np.where(acts >= 0, latched[np.maximum(acts, 0)], 0.0)
        pull = motion.lagged[motion.at]
        if p["electrical_time_constant"] == 0.0:
            speeds = motion.speed[motion.at]
            pull = np.array([drive(bridge(v, t, p), w, p) for v, t, w in zip(volts, times, speeds, strict=True)])
        warm = np.array([warmth(t, p) for t in times])
        seen = pull / (p["resistance"] * warm) + self.offset + random.normal(0.0, self.noise or 1e-300, len(times))
        return np.asarray(np.round(seen / self.step) * self.step if self.step > 0.0 else seen)
