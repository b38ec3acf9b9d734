"""The loop with an observer in it: its margins where motor and model part, and how it swings with an irregular disc.

The observer (`observer`) is a Kalman filter over speed ω, angle θ and load d, told the voltage; the law is

    u = kp (r − ω⁺) + f(r) + d,   ω⁺: the speed at the instant at which u will act,

so that the dead time is out of the nominal loop and d does the integral's work. A steady speed lets edges come in even
steps; here every sample measures the angle instead, with the same information per second:

    R = σ_o² (slot/ω) / T,   σ_o of an edge's place.

With the steady gain K of that filter, the motor's Φ, the angle's row H and v white with variance R, the observer's
error e = x − x̂⁻ and, since the dead time is out of the loop, the motor at the instants at which voltages begin to act
follow

    e' = Φ ((I − KH) e − K v),   x' = Φ x + Γ u,   u = f·(x − A((I − KH) e − K v)),   f = (−kp, .., 1 for d),

A from the sample to that instant. The loop is cut at the voltage that reaches the motor, where a gain or a delay that
the model does not know comes in.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from motor_control.tuning.linear_loop import Complexes, Gains, Plant, continuous, held, sampled
from motor_control.tuning.margins import Loop, least, margins_of
from motor_control.tuning.speed_feedback import OBSERVER, PEAK_TO_PEAK, Encoder, Ripple, cancelling
from motor_model.errors import MotorError

Floats = NDArray[np.float64]
ANGLE, LOAD = 1, 2  # in the state, behind the speed
LATENESSES = 2.0  # of ka/kp in Λ at least, as without an observer
PHASE, GAIN = 45.0, 2.0  # [deg] and factor that the loop keeps
FINE = 6  # halvings more than stability asks for
SLOWEST = 1000.0  # times slower than the first guess
NO_MARGINS = (
    "With so few edges at {:g} rad/s, or with that delay, the observer leaves no phase margin of 45 deg at any gain: "
    "give a higher lowest speed, or take the measured speed."
)


@dataclass(frozen=True)
class Observed:
    """The law sees what the observer says; walk and shake are the filter's [V²/s] and [V²·s]."""

    encoder: Encoder
    walk: float
    shake: float
    name: str = OBSERVER
    bound: str = "stability margins with the observer"

    def plant(self, bare: Plant, speed: float) -> Plant:
        """Nothing is late that the model knows."""
        return replace(bare, predicted=True)

    def law(self, gains: Gains) -> Gains:
        """The load's estimate does what the integral did."""
        return Gains(gains.kp, 0.0)

    def forward(self, plant: Plant, reference: float) -> float:
        """What the model needs for it."""
        return plant.kv * reference / plant.gain

    def fastest(self, bare: Plant, speeds: tuple[float, ...]) -> float:
        """The largest kp up to ka/(2 Λ) that leaves a phase margin of 45° and a gain margin of 2 at all speeds."""
        from scipy.optimize import brentq

        few = (speeds[0], speeds[len(speeds) // 2], speeds[-1])

        def spare(log_kp: float) -> float:
            gains = cancelling(bare, float(np.exp(log_kp)))
            worst = least([margins_of(self.loop(bare, gains, speed), bare.sample_period, bare.late) for speed in few])
            return min(worst.phase / PHASE, worst.gain / GAIN) - 1.0

        high = float(np.log(bare.ka / (bare.gain * LATENESSES * bare.late)))
        if spare(high) >= 0.0:
            return float(np.exp(high))
        low = high - float(np.log(SLOWEST))
        if spare(low) < 0.0:
            raise MotorError(NO_MARGINS.format(speeds[0]))
        return float(np.exp(brentq(spare, low, high, xtol=1e-3)))

    def loop(self, bare: Plant, gains: Gains, speed: float) -> Loop:
        """L(z) from the voltage that reaches the motor to the one that the law answers, with the sign of C(z) P(z)."""
        motor, f, k = sampled(bare, watched=True), self._row(bare, gains), self._gain(bare, speed)
        size = len(k)
        kept = np.eye(size) - np.outer(k, np.eye(size)[ANGLE])

        def answer(z: Complexes) -> Complexes:
            known = (f[0] * motor.ahead(z)[1][:, 0])[:, None, None]  # what u says of ω when the next one acts
            row = f @ motor.ahead(z[:1])[0]
            pushed = motor.pushed(z)[:, :, None]
            # Unknown are x̂⁻ and u:  z x̂⁻ = Φ x̂ + pushed u,  u = row·x̂ + known u,  x̂ = kept x̂⁻ + K y.
            above = np.concatenate([z[:, None, None] * np.eye(size) - motor.phi @ kept, -pushed], axis=2)
            below = np.concatenate([np.broadcast_to(-row @ kept, (len(z), 1, size)), 1.0 - known], axis=2)
            right = np.concatenate([motor.phi @ k, [row @ k]])[None, :, None]
            both = np.concatenate([above, below], axis=1)
            told = np.linalg.solve(both, np.broadcast_to(right, (len(z), size + 1, 1)))[:, -1, 0]
            shaft = np.linalg.solve(z[:, None, None] * np.eye(size) - motor.phi, pushed)[:, ANGLE, 0]
            return np.asarray(-told * shaft)

        return answer

    def ripple(self, bare: Plant, gains: Gains, speed: float) -> Ripple:
        """The steady covariance of motor and observer under the noise of the edges."""
        from scipy.linalg import solve_discrete_lyapunov

        motor, f, k = (
            sampled(replace(bare, predicted=True), watched=True),
            self._row(bare, gains),
            self._gain(bare, speed),
        )
        size = len(k)
        kept = np.eye(size) - np.outer(k, np.eye(size)[ANGLE])
        there = sampled(bare, watched=True).ahead(np.ones(1, dtype=np.complex128))[0]
        moving = np.setdiff1d(np.arange(size), [ANGLE, LOAD])  # the load stays, and no matter where the angle is
        a = np.zeros((len(moving) + size, len(moving) + size))
        a[: len(moving), : len(moving)] = (motor.phi + np.outer(motor.new, f))[np.ix_(moving, moving)]
        a[: len(moving), len(moving) :] = -np.outer(motor.new[moving], f @ there @ kept)
        a[len(moving) :, len(moving) :] = motor.phi @ kept
        noise = np.concatenate([motor.new[moving] * (f @ there @ k), -motor.phi @ k])
        variance = self._variance(bare, speed)
        spread = solve_discrete_lyapunov(a, variance * np.outer(noise, noise))

        def swing(row: Floats) -> float:
            whole = np.concatenate([row[moving], -row @ there @ kept])
            return PEAK_TO_PEAK * float(np.sqrt(whole @ spread @ whole + variance * (row @ there @ k) ** 2))

        shaft = PEAK_TO_PEAK * float(np.sqrt(spread[0, 0]))
        return Ripple(shaft / speed, swing(np.eye(size)[0]) / speed, swing(f))

    def _row(self, bare: Plant, gains: Gains) -> Floats:
        """f: what the law makes of the state at the instant at which its voltage will act."""
        row = np.zeros(len(continuous(bare, True)[1]))
        row[0], row[LOAD] = -gains.kp, 1.0 / bare.gain
        return row

    def _variance(self, bare: Plant, speed: float) -> float:
        """R [rad²]."""
        return float(self.encoder.edge_noise(speed) ** 2 * self.encoder.slot / speed / bare.sample_period)

    def _gain(self, bare: Plant, speed: float) -> Floats:
        """The filter's steady gain on (ω, θ, d) and v, by Riccati's equation."""
        from scipy.linalg import solve_discrete_are

        phi = sampled(bare, watched=True).phi
        h, r = np.eye(len(phi))[ANGLE], self._variance(bare, speed)
        p = solve_discrete_are(phi.T, h[:, None], self._noise(bare), [[r]])
        return np.asarray(p @ h / (h @ p @ h + r))

    def _noise(self, bare: Plant) -> Floats:
        """What walk and shake add to the state's covariance in a sample: over an instant, then doubled and doubled."""
        flow, push = continuous(bare, True)
        halvings = max(0, int(np.ceil(np.log2(np.abs(flow).sum() * bare.sample_period)))) + FINE
        time = bare.sample_period / 2**halvings
        q = np.zeros_like(flow)
        q[0, 0], q[LOAD, LOAD] = self.shake / bare.ka**2 * time, self.walk * time
        phi = held(flow, push, 0.5 * time)[0]
        q = phi @ q @ phi.T
        phi = phi @ phi
        for _ in range(halvings):
            q, phi = q + phi @ q @ phi.T, phi @ phi
        return np.asarray(q)
