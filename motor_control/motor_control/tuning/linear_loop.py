"""The speed loop as a linear sampled system: what stands between an error and the speed that answers it.

A voltage is held for a sample period T and acts late: computed at one sample, latched at the next, delayed by the
bridge; and the speed that comes back is old by `sensor_lag`. All of that is one dead time D before the motor,

    ka dω/dt = v,   τ dv/dt = g·u(t − D) − kv ω − v   (v is the right side without inductance),

and with D = d T + m, 0 <= m < T, the state x = (ω, v) between samples is exactly (Åström and Wittenmark,
"Computer-Controlled Systems", 1997, section 2.3)

    x[k+1] = Φ(T) x[k] + Φ(T − m) Γ(m) u[k−d−1] + Γ(T − m) u[k−d],   Φ(h) = e^(Ah),   Γ(h) = ∫0..h e^(As) B ds.

The law is C(z) = kp + ki T z/(z − 1): its integral has counted the present error (`pi`). Where an observer tells the
law the speed at the instant at which its voltage will act, the dead time is out of the loop, and the shaft is D later.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from motor_control.checks import at_least
from motor_model.errors import MotorError
from motor_model.parameters import Parameters

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]


@dataclass(frozen=True, slots=True)
class Gains:
    """Of the PI law."""

    kp: float  # [V/(rad/s)]
    ki: float  # [V/rad]


@dataclass(frozen=True, slots=True)
class Plant:
    """What the law controls, near one speed.

    Raises:
        MotorError: a value is negative or not finite, or there is no inertia, gain or sample period.
    """

    kv: float  # [V·s/rad]
    ka: float  # [V·s²/rad]
    sample_period: float  # [s]
    delay: float = 0.0  # [s] of the bridge; the sample of computation is counted apart
    sensor_lag: float = 0.0  # [s] how old the measured speed is
    electrical_lag: float = 0.0  # [s]
    gain: float = 1.0  # of the bridge
    predicted: bool = False  # the law knows the speed at which its voltage will act

    def __post_init__(self) -> None:
        at_least(0.0, kv=self.kv, delay=self.delay, sensor_lag=self.sensor_lag, electrical_lag=self.electrical_lag)
        for name, value in (("ka", self.ka), ("sample_period", self.sample_period), ("gain", self.gain)):
            if not 0.0 < value < float("inf"):
                raise MotorError(f"{name} = {value:g} does not work: give a finite number above 0.")

    @property
    def dead_time(self) -> float:
        """[s] from a sample to where its voltage acts, and what the sensor adds; half a sample of holding is not in."""
        return self.sample_period + self.delay + self.sensor_lag

    @property
    def shift(self) -> float:
        """[s] how much later than `sampled` says the shaft has its speed; negative: earlier."""
        return self.dead_time if self.predicted else -self.sensor_lag

    @property
    def late(self) -> float:
        """[s] everything that makes the loop late: dead time, half a sample of holding, the current's lag."""
        return self.dead_time + 0.5 * self.sample_period + self.electrical_lag


def plant_of(parameters: Parameters, sample_period: float, sensor_lag: float = 0.0) -> Plant:
    """Linearise a motor where the loop gain is largest: at cold, at full supply, in the stronger direction.

    Friction, drag and loads only add damping or an offset, which the integral and the feed-forward carry.
    """
    return Plant(
        kv=parameters.value("kv"),
        ka=parameters.value("ka"),
        sample_period=sample_period,
        delay=parameters.value("delay"),
        sensor_lag=sensor_lag,
        electrical_lag=parameters.value("electrical_time_constant"),
        gain=max(1.0, parameters.value("reverse_gain")),
    )


@dataclass(frozen=True)
class Sampled:
    """x[k+1] = phi x[k] + old u[k−whole−1] + new u[k−whole]; x is ω and what else moves with it, shape (M,).

    When u[k] begins to act, the state is `rest_phi` x[k+whole] + `rest_old` u[k−1].
    """

    phi: Floats  # (M, M)
    old: Floats  # (M,)
    new: Floats  # (M,)
    whole: int  # samples of dead time
    rest_phi: Floats  # (M, M)
    rest_old: Floats  # (M,)

    def pushed(self, z: Complexes) -> Complexes:
        """What u does to x[k+1], at points z of shape (F,): (F, M)."""
        late = z[:, None] ** -float(self.whole)
        return np.asarray(late * (self.new + self.old / z[:, None]))

    def ahead(self, z: Complexes) -> tuple[Floats, Complexes]:
        """The state when u[k] begins to act: the (M, M) that x[k] is multiplied with, and what u adds, (F, M)."""
        grown: Floats = np.eye(len(self.new))
        added: Complexes = np.zeros((len(z), len(self.new)), dtype=np.complex128)
        for j in range(self.whole):
            added = np.asarray(added @ self.phi.T + z[:, None] ** float(j) * self.pushed(z))
            grown = np.asarray(self.phi @ grown)
        return np.asarray(self.rest_phi @ grown), np.asarray(added @ self.rest_phi.T + self.rest_old / z[:, None])


def sampled(plant: Plant, watched: bool = False) -> Sampled:
    """Sample the motor, with the dead time in the loop; `watched`: angle and load stand behind ω."""
    period, dead = plant.sample_period, 0.0 if plant.predicted else plant.dead_time
    whole = int(dead / period + 1e-9)
    rest = max(dead - whole * period, 0.0)
    flow, push = continuous(plant, watched)
    late, old = held(flow, push, rest)
    after, new = held(flow, push, period - rest)
    return Sampled(held(flow, push, period)[0], np.asarray(after @ old), new, whole, late, old)


def continuous(plant: Plant, watched: bool) -> tuple[Floats, Floats]:
    """Return A and B of (ω, v) or (ω, θ, d, v), v only with inductance; d is a load in V that stays."""
    lag, inertia = plant.electrical_lag, plant.ka
    size = 1 + 2 * watched + (lag > 0.0)
    a, b = np.zeros((size, size)), np.zeros(size)
    if watched:
        a[0, 2], a[1, 0] = -1.0 / inertia, 1.0
    if lag > 0.0:
        a[0, -1], a[-1, 0], a[-1, -1], b[-1] = 1.0 / inertia, -plant.kv / lag, -1.0 / lag, plant.gain / lag
    else:
        a[0, 0], b[0] = -plant.kv / inertia, plant.gain / inertia
    return a, b


def held(a: Floats, b: Floats, time: float) -> tuple[Floats, Floats]:
    """Φ and Γ over a time [s] of constant voltage."""
    from scipy.linalg import expm

    size = len(b)
    block = np.zeros((size + 1, size + 1))
    block[:size, :size], block[:size, size] = a, b
    grown = expm(block * time)
    return np.asarray(grown[:size, :size]), np.asarray(grown[:size, size])


def open_loop(plant: Plant, gains: Gains, z: Complexes) -> Complexes:
    """L(z) from the error to the speed that the law sees, at points z of shape (F,)."""
    motor = sampled(plant)
    speed = np.linalg.solve(z[:, None, None] * np.eye(len(motor.new)) - motor.phi, motor.pushed(z)[:, :, None])[:, 0, 0]
    return np.asarray(speed * law(gains, plant.sample_period, z))


def law(gains: Gains, period: float, z: Complexes) -> Complexes:
    """C(z)."""
    return np.asarray(gains.kp + gains.ki * period * z / (z - 1.0))
