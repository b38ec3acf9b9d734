"""The speed that a loop answers a step of the reference with: linear motor, real law, real voltage limit."""

from dataclasses import dataclass
from math import ceil, inf

import numpy as np
from numpy.typing import NDArray

from motor_control.controller import pi
from motor_control.tuning.linear_loop import Gains, Plant, sampled

Floats = NDArray[np.float64]
UNLIMITED = 1e9  # [V]
RISEN = 1.0 - float(np.exp(-1.0))  # what an exponential has done after one time constant


@dataclass(frozen=True)
class StepResponse:
    """After a step from 0 to `reference`; arrays of shape (K,)."""

    reference: float  # [rad/s]
    time: Floats  # [s] since the sample that saw the step
    speed: Floats  # [rad/s] of the shaft
    voltage: Floats  # [V] asked for at these times, before its delay

    @property
    def time_constant(self) -> float:
        """[s] until 63 % of the step are done, dead time included; infinite if that never comes."""
        risen = np.flatnonzero(self.speed >= RISEN * self.reference)
        if len(risen) == 0:
            return float("inf")
        k = int(risen[0])
        share = (RISEN * self.reference - self.speed[k - 1]) / (self.speed[k] - self.speed[k - 1])
        return float(self.time[k - 1] + share * (self.time[k] - self.time[k - 1]))

    @property
    def overshoot(self) -> float:
        """Largest speed beyond the reference, as a share of it."""
        return max(float(self.speed.max()) / self.reference - 1.0, 0.0)


def respond(
    plant: Plant,
    gains: Gains,
    reference: float,
    duration: float,
    low: float,
    high: float,
    feedforward: float = 0.0,
    until: float = inf,
) -> StepResponse:
    """Close the loop at rest and step the reference [rad/s]; low..high [V] is allowed, feedforward [V] is added.

    It ends after `duration` [s], or as soon as it shows when the shaft first had the speed `until` [rad/s].
    """
    motor = sampled(plant)
    config, state = pi.Config(gains.kp, gains.ki, UNLIMITED), pi.State()
    count = int((duration + plant.sensor_lag) / plant.sample_period) + 2
    x: Floats = np.zeros(len(motor.new))
    speed, voltage = np.empty(count), np.zeros(count + motor.whole + 1)  # the voltages before the step come first
    k, end, more = 0, count, ceil(abs(plant.shift) / plant.sample_period) + 2
    while k < end:
        error = reference - float(x[0])
        terms, state = pi.update(config, state, error, feedforward, plant.sample_period, low, high)
        speed[k], voltage[k + motor.whole + 1] = x[0], terms.voltage
        if end == count and speed[k] >= until:
            end = min(count, k + more)  # the shaft is earlier or later by so much
        x = np.asarray(motor.phi @ x + motor.old * voltage[k] + motor.new * voltage[k + 1])
        k += 1
    time = np.asarray(np.arange(end) * plant.sample_period, dtype=np.float64)
    shaft = np.asarray(np.interp(time, time + plant.shift, speed[:end]), dtype=np.float64)
    return StepResponse(reference, time, shaft, voltage[motor.whole + 1 :][:end])


def small_step(plant: Plant, gains: Gains, feedforward: float, until: float = inf) -> StepResponse:
    """Simulate a step that no voltage limit is felt in, from 0 to 1 rad/s; feedforward [V] is what that adds.

    until: [rad/s] once it shows when the shaft first had that speed, no more is simulated.
    """
    duration = max(12.0 * plant.ka / (gains.kp * plant.gain + plant.kv * (feedforward > 0.0)), 20.0 * plant.late)
    return respond(plant, gains, 1.0, duration, -UNLIMITED, UNLIMITED, feedforward, until)
