"""The plant's physics outside the table, against SciPy and closed forms."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from plant.motor import move
from scipy.integrate import solve_ivp

KV, KA = 12 / 174.097, 0.0055
BASE = {"kv": KV, "ka": KA}
Floats = NDArray[np.float64]
TIMES: Floats = np.arange(0.0, 0.8001, 0.005, dtype=np.float64)
U = 7.0

Rates = Callable[[float, Floats], tuple[float, ...]]

# name -> (parameters, start speed, rates of (angle, speed, ...), start of what comes after the speed)
CASES: dict[str, tuple[dict[str, float], float, Rates, tuple[float, ...]]] = {
    "angle friction": (
        {"ks": 0.2, "angle_friction": 1.0},
        0.0,
        lambda t, y: (y[1], (U - KV * y[1] - 0.2 - 0.5 * (1.0 + np.sin(y[0]))) / KA),
        (),
    ),
    "load friction driving": (
        {"ks": 0.2, "load_friction": 0.15},
        0.0,
        lambda t, y: (y[1], ((U - KV * y[1]) * 0.85 - 0.2) / KA),
        (),
    ),
    "load friction braking": (
        {"ks": 0.2, "load_friction": 0.15},
        170.0,
        lambda t, y: (y[1], (U - KV * y[1] - 0.15 * abs(U - KV * y[1]) - 0.2) / KA),
        (),
    ),
    "presliding, reversing": (
        {"ks": 0.8, "presliding_angle": 0.05},
        -60.0,
        lambda t, y: (y[1], (U - KV * y[1] - 0.8 * y[2]) / KA, (y[1] - abs(y[1]) * y[2]) / 0.05),
        (-1.0,),
    ),
    "compliance": (
        {"ks": 0.2, "compliance_fraction": 0.4, "compliance_stiffness": 2.0, "compliance_damping": 1e-3},
        0.0,
        lambda t, y: (
            y[1],
            (U - KV * y[1] - 0.2 - 2.0 * (y[0] - y[2]) - 1e-3 * (y[1] - y[3])) / (0.6 * KA),
            y[3],
            (2.0 * (y[0] - y[2]) + 1e-3 * (y[1] - y[3])) / (0.4 * KA),
        ),
        (0.0, 0.0),
    ),
    "supply ripple": (
        {"supply_ripple": 0.1, "supply_ripple_frequency": 2.5},
        0.0,
        lambda t, y: (y[1], (U * (1.0 + 0.1 * np.sin(5.0 * np.pi * t)) - KV * y[1]) / KA),
        (),
    ),
    "slew rate": ({"slew_rate": 20.0}, 0.0, lambda t, y: (y[1], (min(20.0 * t, U) - KV * y[1]) / KA), ()),
}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES.keys())
def test_effect_moves_the_motor_as_scipy_says(
    case: tuple[dict[str, float], float, Rates, tuple[float, ...]],
) -> None:
    parameters, speed, rates, more = case
    motion = move(BASE | parameters, TIMES, np.full_like(TIMES, U), start_speed=speed)
    start = (0.0, speed, *more)
    out = solve_ivp(rates, (0.0, TIMES[-1]), start, "DOP853", TIMES, rtol=1e-11, atol=1e-12, max_step=5e-4)
    assert np.abs(motion.angle[motion.at] - out.y[0]).max() < 1e-7
    assert np.abs(motion.speed[motion.at] - out.y[1]).max() < 1e-6
    plain = move(BASE | {"ks": parameters.get("ks", 0.0)}, TIMES, np.full_like(TIMES, U), start_speed=speed)
    assert np.abs(motion.speed[motion.at] - plain.speed[plain.at]).max() > 1.0


def test_a_compliant_motor_rings_at_its_resonance() -> None:
    share, stiffness = 0.4, 2.0
    parameters = {"kv": 0.0, "ka": KA, "compliance_fraction": share, "compliance_stiffness": stiffness}
    motion = move(parameters, TIMES, np.full_like(TIMES, 1.0))
    angular = np.sqrt(stiffness / (KA * share * (1.0 - share)))
    at = motion.time
    swing = share / (1.0 - share) / KA / angular**2  # the shaft's own part of the mode
    angle = 0.5 / KA * at**2 + swing * (1.0 - np.cos(angular * at))
    assert np.abs(motion.angle - angle).max() < 1e-8
    assert 30.0 < angular < 50.0 and swing > 0.05


def test_presliding_gives_way_without_breaking_loose() -> None:
    parameters = BASE | {"ks": 0.8, "presliding_angle": 0.05}
    motion = move(parameters, np.arange(0.0, 4.0, 0.005, dtype=np.float64), np.full(800, 0.4))
    # 0.4 V of 0.8 V bends the bristles halfway: ks*(1 - exp(-angle/0.05)) = 0.4, plus what the swing adds
    assert 0.05 * np.log(2.0) < motion.angle[-1] < 0.3
    assert abs(motion.speed[-1]) < 1e-3
    assert np.ptp(motion.angle[motion.time > 3.0]) < 1e-3


@pytest.mark.parametrize(
    ("volts", "moves"), [(0.9, False), (0.999, False), (1.001, True), (-0.999, False), (-1.001, True)]
)
def test_load_friction_lifts_what_holds_the_motor(volts: float, moves: bool) -> None:
    parameters = BASE | {"ks": 0.9, "load_friction": 0.1}  # |u| <= 0.9 + 0.1 |u| holds: up to 1 V
    motion = move(parameters, TIMES, np.full_like(TIMES, volts))
    assert bool(np.any(motion.speed)) is moves
    assert not moves or np.sign(motion.angle[-1]) == np.sign(volts)
