"""A current sensor: a shunt or Hall sensor with its amplifier, read by a ten-bit converter."""

from dataclasses import dataclass

import numpy as np

from motor_model.parameters import Parameters

STEPS = 1024  # of the ATmega328P's converter
HEADROOM = 2.2  # of the stall current: what the sensor reaches to either side; a reversal at full speed takes twice it
NOISE = 1.0  # [steps] RMS; a Hall sensor such as the ACS712 has one to two of them


@dataclass
class CurrentSense:
    """Reads a current with white noise, in whole steps, as far as it reaches."""

    reach: float  # [A] to either side
    random: np.random.Generator

    @property
    def step(self) -> float:
        """[A] of the converter."""
        return 2.0 * self.reach / STEPS

    def read(self, current: float) -> float:
        """Return what is reported of a current [A]."""
        steps = round(current / self.step + float(self.random.normal(0.0, NOISE)))
        return self.step * min(max(steps, -STEPS // 2), STEPS // 2 - 1)


def make_current_sense(parameters: Parameters, seed: int) -> CurrentSense | None:
    """Return a sensor made for this motor; None where its resistance, and so its current, is unknown."""
    if parameters.resistance == 0.0:
        return None
    reach = HEADROOM * parameters.max_voltage / parameters.resistance
    return CurrentSense(reach, np.random.default_rng([seed, 2]))
