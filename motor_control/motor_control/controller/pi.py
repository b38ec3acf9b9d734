"""A PI law whose whole sum stays inside a span: gains and state in, every term and the next state out, no clock read.

With the error e [rad/s], the step dt [s] since the last one, the feed-forward f [V] and the span [low, high] [V]:

    p = kp e                          proportional [V]
    i = i + ki e dt                   integral     [V], as far as the sum stays inside the span (below)
    u = clip(p + i + f, low, high)    voltage      [V]

Anti-windup is conditional integration (Åström and Rundqwist, "Integrator windup and how to avoid it", American
Control Conference 1989): a step of the integral that drives the sum out of the span is cut where the sum meets the
limit. It is preferred to back-calculation because it has no tracking time to choose, and because the span may end at
0 V while a motor slows down by itself (see `span`): back-calculation would raise the integral there until the sum
leaves the limit at once, and the motor would slow down later.

The integral is kept in volts, not in rad, so new gains act from now on and do not rescale what was learnt: the voltage
moves by (kp_new - kp_old) e alone, which is nothing where the error is nothing.
"""

from dataclasses import dataclass

from motor_control.checks import at_least


@dataclass(frozen=True, slots=True)
class Config:
    """Gains and the bound of the integral; finite and not negative.

    Raises:
        MotorError: a value is negative or not finite.
    """

    kp: float  # [V/(rad/s)]
    ki: float  # [V/rad]
    limit: float  # [V] the integral stays within +-limit whatever the span allows

    def __post_init__(self) -> None:
        at_least(0.0, kp=self.kp, ki=self.ki, limit=self.limit)


@dataclass(frozen=True, slots=True)
class State:
    """What the law remembers."""

    integral: float = 0.0  # [V]


@dataclass(frozen=True, slots=True)
class Terms:
    """Everything that was computed in one step; voltage = clip(proportional + integral + feedforward)."""

    error: float  # [rad/s]
    proportional: float  # [V]
    integral: float  # [V]
    feedforward: float  # [V]
    voltage: float  # [V]
    saturated: bool  # the sum was outside the span


def update(
    config: Config, state: State, error: float, feedforward: float, dt: float, low: float, high: float
) -> tuple[Terms, State]:
    """One step of the law: error [rad/s], feedforward [V], dt [s] >= 0, low <= high [V]; all finite."""
    proportional = config.kp * error
    step = config.ki * dt * error  # in this order even a step that overflows is an infinity, not NaN
    integral = _integrate(config.limit, state.integral, step, proportional + feedforward, low, high)
    total = proportional + integral + feedforward
    voltage = min(max(total, low), high)
    return Terms(error, proportional, integral, feedforward, voltage, voltage != total), State(integral)


def apply_voltage(voltage: float, low: float, high: float) -> Terms:
    """Apply a voltage [V] as it is asked for, within the span; it stands as the feed-forward, for there is no law."""
    applied = min(max(voltage, low), high)
    return Terms(0.0, 0.0, 0.0, voltage, applied, applied != voltage)


def _integrate(limit: float, integral: float, step: float, rest: float, low: float, high: float) -> float:
    """The next integral [V]: further by `step` [V], but not past where integral + rest meets an end of the span."""
    if step > 0.0:
        step = min(step, max(high - rest - integral, 0.0))
    elif step < 0.0:
        step = max(step, min(low - rest - integral, 0.0))
    return min(max(integral + step, -limit), limit)
