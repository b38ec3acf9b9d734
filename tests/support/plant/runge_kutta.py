"""One classic Runge-Kutta step of the plant, and the instant within it at which something changes."""

from typing import Any

from numba import njit

from .forces import State, bridge, inlined, push_at_rest, rates

# way: -1, 0 (held), +1; contact: the flank the load hangs on: -1, +1, 0 in the play, 2 before the first motion; the
# angles between which the motor is free
Mode = tuple[float, float, float, float]
_INSTANT = 1e-14  # [s] to which changes are located


@inlined
def _shift(y: State, k: State, h: float) -> State:
    return y[0] + h * k[0], y[1] + h * k[1], y[2] + h * k[2], y[3] + h * k[3], y[4] + h * k[4], y[5] + h * k[5]


@njit(cache=True, error_model="numpy")
def take_step(y: State, mode: Mode, t: float, h: float, v: float, slope: float, outer: float, p: Any) -> State:
    """One classic Runge-Kutta step; the voltage is v + slope·(time into the step)."""
    way = mode[0]
    share = (1.0 - p.compliance_fraction) * (1.0 - p.load_fraction if mode[1] == 0.0 else 1.0)
    half = 0.5 * h
    first = middle = last = bridge(v, t, p)
    if slope != 0.0 or p.supply_ripple != 0.0:
        middle, last = bridge(v + slope * half, t + half, p), bridge(v + slope * h, t + h, p)
    a = rates(y, t, first, outer, way, share, p)
    b = rates(_shift(y, a, half), t + half, middle, outer, way, share, p)
    c = rates(_shift(y, b, half), t + half, middle, outer, way, share, p)
    d = rates(_shift(y, c, h), t + h, last, outer, way, share, p)
    return _shift(_shift(_shift(_shift(y, a, h / 6.0), b, h / 3.0), c, h / 3.0), d, h / 6.0)


@njit(cache=True)
def _measure_above(y: State, t: float, v: float, outer: float, p: Any, which: int, level: float) -> float:
    """State number `which` less a level; for -1, by how much [V] the push at rest exceeds what holds."""
    if which >= 0:
        return y[which] - level
    push, hold = push_at_rest(y, t, v, outer, p)
    return abs(push) - hold


@njit(cache=True)
def find_change(
    y: State, mode: Mode, t: float, h: float, v: float, slope: float, outer: float, p: Any, which: int, level: float
) -> float:
    """The part of a step [s] after which `_measure_above` has just changed sign: false position, Illinois variant."""
    low, high = 0.0, h
    f_low = _measure_above(y, t, v, outer, p, which, level)
    f_high = _measure_above(take_step(y, mode, t, h, v, slope, outer, p), t + h, v + slope * h, outer, p, which, level)
    while high - low > 2.0 * _INSTANT:
        x = (low * f_high - high * f_low) / (f_high - f_low) if f_high != f_low else 0.5 * (low + high)
        x = min(max(x, low + _INSTANT), high - _INSTANT)
        f = _measure_above(take_step(y, mode, t, x, v, slope, outer, p), t + x, v + slope * x, outer, p, which, level)
        if (f > 0.0) == (f_high > 0.0):
            high, f_high, f_low = x, f, 0.5 * f_low
        else:
            low, f_low, f_high = x, f, 0.5 * f_high
    return high
