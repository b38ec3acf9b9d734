"""Each effect of the table, in motion one way, against SciPy's integrator on formulas written out once more."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray
from plant.motor import move
from scipy.integrate import solve_ivp

from motor_model.errors import ModelError

KV, KA = 12 / 174.097, 0.0055
BASE = {"kv": KV, "ka": KA}
Floats = NDArray[np.float64]
TIMES: Floats = np.arange(0.0, 1.2001, 0.005, dtype=np.float64)
LEVELS = np.select([TIMES < 0.3, TIMES < 0.7, TIMES < 1.0], [4.0, 11.0, 7.0], 9.0)  # always forward, never at rest


@dataclass(frozen=True)
class Case:
    """An effect's parameters, and the acceleration of the motor that has it, from (t, θ, ω, u)."""

    parameters: dict[str, float]
    acceleration: Callable[[float, float, float, float], float]
    way: float = 1.0
    delay: float = 0.0
    breaks: tuple[float, ...] = ()


def reference(
    rates: Callable[[float, Floats, float], tuple[float, ...]],
    volts: Floats,
    start: tuple[float, ...],
    delay: float = 0.0,
    breaks: tuple[float, ...] = (),
) -> Floats:
    """The states at TIMES, shape (K, states), by DOP853, restarted wherever its input or a load jumps."""
    jumps = TIMES[np.flatnonzero(np.diff(volts, prepend=np.nan))] + delay
    bounds = np.unique([0.0, *jumps[jumps < TIMES[-1]], *breaks, TIMES[-1]])
    states = np.zeros((len(TIMES), len(start)))
    y = np.asarray(start)
    for a, b in zip(bounds[:-1], bounds[1:], strict=True):
        late = 0.5 * (a + b) - delay
        u = volts[np.searchsorted(TIMES, late, side="right") - 1] if late > 0 else 0.0
        inside = (a <= TIMES) & (b >= TIMES)
        at = np.unique([*TIMES[inside], b])
        out = solve_ivp(rates, (a, b), y, "DOP853", at, args=(u,), rtol=1e-12, atol=1e-13, max_step=0.01)
        states[inside], y = out.y[:, : np.count_nonzero(inside)].T, out.y[:, -1]
    return states


CASES = {
    "base": Case({}, lambda t, th, w, u: (u - KV * w) / KA),
    "coulomb_friction": Case({"ks": 0.5}, lambda t, th, w, u: (u - KV * w - 0.5) / KA),
    "static_friction": Case(
        {"ks": 0.5, "breakaway_voltage": 1.1, "stribeck_speed": 60.0},
        lambda t, th, w, u: (u - KV * w - 0.5 - 0.6 * np.exp(-((w / 60.0) ** 2))) / KA,
    ),
    "quadratic_drag": Case({"drag": 1e-4}, lambda t, th, w, u: (u - KV * w - 1e-4 * w**2) / KA),
    "quadratic_drag backward": Case({"drag": 1e-4}, lambda t, th, w, u: (u - KV * w + 1e-4 * w**2) / KA, -1.0),
    "load_bias": Case({"bias_voltage": 0.7}, lambda t, th, w, u: (u - KV * w - 0.7) / KA),
    "load_bias backward": Case({"bias_voltage": 0.7}, lambda t, th, w, u: (u - KV * w - 0.7) / KA, -1.0),
    "load_step": Case(
        {"step_voltage": 0.9, "step_time": 0.4123},
        lambda t, th, w, u: (u - KV * w - 0.9 * (t >= 0.4123)) / KA,
        breaks=(0.4123,),
    ),
    "dead_zone": Case({"dead_zone_voltage": 0.6}, lambda t, th, w, u: (u - 0.6 - KV * w) / KA),
    "dead_zone backward": Case({"dead_zone_voltage": 0.6}, lambda t, th, w, u: (u + 0.6 - KV * w) / KA, -1.0),
    "voltage_limit": Case({"limit_voltage": 8.0}, lambda t, th, w, u: (min(u, 8.0) - KV * w) / KA),
    "direction_asymmetry": Case({"reverse_gain": 0.8}, lambda t, th, w, u: (u - KV * w) / KA),
    "direction_asymmetry backward": Case({"reverse_gain": 0.8}, lambda t, th, w, u: (0.8 * u - KV * w) / KA, -1.0),
    "coast_drive": Case({"coast_share": 0.6}, lambda t, th, w, u: (u - KV * w * (0.4 + 0.6 * u / 12.0)) / KA),
    "supply_sag": Case({"sag": 0.3}, lambda t, th, w, u: (u - KV * w) / (1.0 + 0.3 * (u / 12.0) ** 2) / KA),
    "transport_delay": Case({"delay": 0.0073}, lambda t, th, w, u: (u - KV * w) / KA, delay=0.0073),
    "torque_ripple": Case(
        {"ripple_voltage": 0.8, "ripple_cycles": 7.0, "ripple_phase": 0.4},
        lambda t, th, w, u: (u - KV * w - 0.8 * np.sin(7.0 * th + 0.4)) / KA,
    ),
    "warm_up": Case(
        {"resistance_rise": 0.3, "warm_up_time": 0.5, "ks": 0.5, "bias_voltage": 0.2, "drag": 5e-5},
        lambda t, th, w, u: (
            ((u - KV * w) / (1.0 + 0.3 * (1.0 - np.exp(-t / 0.5))) - 0.5 - 0.2 - 5e-5 * w**2) / KA  # copper, cold is 1
        ),
    ),
    "bridge in order": Case(
        {"limit_voltage": 8.0, "dead_zone_voltage": 0.5, "reverse_gain": 0.9, "sag": 0.2, "coast_share": 0.5},
        lambda t, th, w, u: (
            (0.9 * (max(u, -8.0) + 0.5) - KV * w * (1.0 - 0.5 * (1.0 + 0.9 * (max(u, -8.0) + 0.5) / 12.0)))
            / (1.0 + 0.2 * (0.9 * (max(u, -8.0) + 0.5) / 12.0) ** 2)
            / KA
        ),
        -1.0,
    ),
}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES.keys())
def test_effect_moves_the_motor_as_scipy_says(case: Case) -> None:
    volts = case.way * LEVELS
    motion = move(BASE | case.parameters, TIMES, volts)
    expected = reference(
        lambda t, y, u: (y[1], case.acceleration(t, y[0], y[1], u)), volts, (0.0, 0.0), case.delay, case.breaks
    )
    assert np.abs(motion.speed[motion.at] - expected[:, 1]).max() < 1e-9
    assert np.abs(motion.angle[motion.at] - expected[:, 0]).max() < 1e-9
    assert 40.0 < abs(motion.speed[-1]) < 260.0
    if "backward" not in str(case) and case.parameters and "reverse_gain" not in case.parameters:
        plain = move(BASE, TIMES, volts)
        assert np.abs(motion.speed - np.interp(motion.time, plain.time, plain.speed)).max() > 0.5


def test_first_order_motor_is_the_closed_form() -> None:
    motion = move(BASE, TIMES, np.full_like(TIMES, 10.0))
    tau, final = KA / KV, 10.0 / KV
    speed = final * -np.expm1(-TIMES / tau)
    angle = final * (TIMES + tau * np.expm1(-TIMES / tau))
    assert np.abs(motion.speed[motion.at] - speed).max() < 1e-10
    assert np.abs(motion.angle[motion.at] - angle).max() < 1e-10
    assert np.array_equal(motion.time[motion.at], TIMES)


def test_inductance_lags_the_whole_drive() -> None:
    lag = 0.004
    motion = move(BASE | {"electrical_time_constant": lag, "ks": 0.5}, TIMES, LEVELS)
    start = -lag * np.log(1.0 - 0.5 / 4.0)  # the lagged drive first has to reach ks; until then it rises alone
    moving = start < TIMES

    def rates(t: float, y: Floats, u: float) -> tuple[float, ...]:
        return (y[1], (y[2] - 0.5) / KA, (u - KV * y[1] - y[2]) / lag) if t >= start else (0.0, 0.0, (u - y[2]) / lag)

    expected = reference(rates, LEVELS, (0.0, 0.0, 0.0), breaks=(start,))
    assert np.abs(motion.speed[motion.at] - expected[:, 1])[moving].max() < 1e-9
    assert np.abs(motion.angle[motion.at] - expected[:, 0]).max() < 1e-9
    first = motion.time[np.flatnonzero(motion.speed)[0] - 1]
    assert first == pytest.approx(start, abs=1e-12)


def test_all_steady_effects_at_once() -> None:
    parameters = BASE | {
        "ks": 0.4,
        "breakaway_voltage": 0.6,
        "stribeck_speed": 20.0,
        "drag": 3e-5,
        "bias_voltage": 0.1,
        "ripple_voltage": 0.2,
        "ripple_cycles": 3.0,
        "electrical_time_constant": 0.002,
        "sag": 0.1,
        "resistance_rise": 0.2,
        "warm_up_time": 0.8,
    }

    def rates(t: float, y: Floats, u: float) -> tuple[float, ...]:
        angle, speed, pull = y
        warm = 1.2 - 0.2 * np.exp(-t / 0.8)
        resisting = 0.4 + 0.2 * np.exp(-((speed / 20.0) ** 2)) + 3e-5 * speed**2 + 0.1 + 0.2 * np.sin(3.0 * angle)
        lag_rate = ((u - KV * speed) / (1.0 + 0.1 * (u / 12.0) ** 2) - pull) / 0.002
        return speed, (pull / warm - resisting) / KA, lag_rate

    settled = -KV * 30.0  # the drive before any voltage, of a motor that already turns
    motion = move(parameters, TIMES, LEVELS, start_speed=30.0)
    expected = reference(rates, LEVELS, (0.0, 30.0, settled))
    assert np.abs(motion.speed[motion.at] - expected[:, 1]).max() < 1e-9
    assert np.abs(motion.angle[motion.at] - expected[:, 0]).max() < 1e-9


@pytest.mark.parametrize(
    ("parameters", "words"),
    [
        ({"kv": KV}, "ka"),
        (BASE | {"ka": -1.0}, "ka"),
        (BASE | {"friction": 1.0}, "friction"),
        (BASE | {"drag": float("nan")}, "drag"),
        (BASE | {"ks": 0.5, "breakaway_voltage": 0.4}, "breakaway"),
    ],
)
def test_parameters_of_no_motor_are_refused(parameters: dict[str, float], words: str) -> None:
    with pytest.raises(ModelError, match=words):
        move(parameters, TIMES, LEVELS)
