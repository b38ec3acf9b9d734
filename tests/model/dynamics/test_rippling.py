"""A fast ripple in closed form is the ripple of the pieces, and is left to them where it moves its own phase."""

from math import copysign

import numpy as np
import pytest
from numpy.typing import NDArray

from motor_model.dynamics import rippling
from motor_model.dynamics.motor import advance
from motor_model.dynamics.rippling import count_parts, respond, turn_rippled
from motor_model.dynamics.state import State
from motor_model.dynamics.straight import Hold, begin_lag, find_torques, prepare_hold
from motor_model.parameters import Parameters

FINE = 300  # pieces' share of a step, beside which it is judged
FAST = {"kv": 0.0027, "ka": 9.4e-4, "ripple_voltage": 0.02, "ripple_cycles": 7.0, "ripple_phase": 0.3}
LAG = {"electrical_time_constant": 0.003}


def motor(values: dict[str, float], *effects: str, supply: float = 5.0) -> NDArray:  # type: ignore[type-arg]
    return Parameters(values, ("torque_ripple", *effects), max_voltage=supply).vector()


def step(p: NDArray, u: float, s: State, h: float) -> tuple[float, float, float] | None:  # type: ignore[type-arg]
    """Speed, v and travel in closed form; None where that is left to the pieces."""
    hold = prepare_hold(p, u, find_torques(p, 0.0))
    found = turn_rippled(p, hold, s, h, 1.0, 0.0, begin_lag())
    return found[:3] if count_parts(p, hold, s, h, 1.0) > 0 and found[0] != 0.0 else None


def test_it_turns_as_pieces_do_that_are_far_shorter() -> None:
    """Motors of all sizes on their way: with friction, inductance, a coasting bridge; the errors are of the travel."""
    random, errors, drives = np.random.default_rng(1), [], []
    for _ in range(400):
        supply, top, lag = random.choice([3.0, 12.0, 48.0]), 10.0 ** random.uniform(0.7, 3.5), random.uniform(0.01, 0.6)
        values = {"kv": supply / top, "ka": supply / top * lag, "ripple_phase": random.uniform(-3.0, 3.0)}
        values |= {
            "ripple_voltage": random.uniform(0.002, 0.05) * supply,
            "ripple_cycles": 10.0 ** random.uniform(-0.3, 1.8),
        }
        own: dict[str, dict[str, float]] = {
            "coulomb_friction": {"ks": 0.05 * supply},
            "armature_inductance": {"electrical_time_constant": lag * 10.0 ** random.uniform(-2.0, 0.3)},
            "coast_drive": {"coast_share": 0.5},
        }
        effects = [name for name in own if random.random() < 0.4]
        for name in effects:
            values |= own[name]
        p, way = motor(values, *effects, supply=supply), random.choice([-1.0, 1.0])
        u, speed = way * random.uniform(0.2, 1.0) * supply, way * random.uniform(0.1, 1.1) * top
        s = State(random.uniform(-5.0, 5.0), speed, u - values["kv"] * speed, 0.0, way, random.uniform(-1.0, 1.0))
        h = 10.0 ** random.uniform(-3.0, -1.3)
        found = step(p, u, s, h)
        if found is None:
            continue
        then = s
        for k in range(FINE):
            then = advance(p, u, then, k * h / FINE, h / FINE)
        errors.append(max(abs(found[0] - then.speed), abs(found[2] - then.angle + s.angle) / h) / abs(speed))
        drives.append(abs(found[1] - then.drive) / supply if "armature_inductance" in effects else 0.0)
    assert len(errors) > 50
    assert np.median(errors) < 5e-8 and max(errors) < 1e-5
    assert max(drives) < 1e-5


@pytest.mark.parametrize(("effects", "more"), [((), {}), (("armature_inductance",), LAG)])
@pytest.mark.parametrize(("share", "told"), [(0.9, True), (1.1, False)])
def test_a_ripple_that_moves_its_own_phase_is_left_to_the_pieces(
    effects: tuple[str, ...], more: dict[str, float], share: float, told: bool
) -> None:
    s, h = State(0.0, 1000.0, 3.0, 0.0, 1.0, 0.0), 5e-3
    p = motor(FAST | more, *effects)
    hold = prepare_hold(p, 3.0, find_torques(p, 0.0))
    swing = 7.0 * FAST["ripple_voltage"] * abs(respond(p, hold, 1.0, 7000.0)[2].value)
    size = share * rippling.OWN_PHASE / swing * FAST["ripple_voltage"]
    assert (step(motor(FAST | more | {"ripple_voltage": size}, *effects), 3.0, s, h) is not None) is told


@pytest.mark.parametrize(("periods", "told"), [(0.2, False), (1.5, True)])
def test_a_step_of_a_part_of_a_period_is_a_piece(periods: float, told: bool) -> None:
    s = State(0.0, 1000.0, 3.0, 0.0, 1.0, 0.0)
    assert (step(motor(FAST), 3.0, s, periods * 2.0 * np.pi / 7000.0) is not None) is told


def test_a_step_in_which_the_speed_changes_has_more_parts() -> None:
    p = motor(FAST | {"ka": 9.4e-5})
    hold, h = prepare_hold(p, 3.0, find_torques(p, 0.0)), 5e-3
    settled = count_parts(p, hold, State(0.0, 3.0 / FAST["kv"], 0.0, 0.0, 1.0, 0.0), h, 1.0)
    rising = count_parts(p, hold, State(0.0, 0.8 * 3.0 / FAST["kv"], 0.0, 0.0, 1.0, 0.0), h, 1.0)
    assert settled == 1 < rising


@pytest.mark.parametrize("u", [-5.0, 0.3])
def test_a_shaft_that_slows_down_too_much_is_left_to_the_pieces(u: float) -> None:
    """It comes to rest, or to where the ripple is slow."""
    p, h = motor(FAST | {"ka": 7e-5}), 0.05
    s, hold = State(0.0, 1000.0, 0.0, 0.0, 1.0, 0.0), prepare_hold(p, u, find_torques(p, 0.0))
    assert count_parts(p, hold, s, h, 1.0) > 0 and turn_rippled(p, hold, s, h, 1.0, 0.0, begin_lag())[0] == 0.0


@pytest.mark.parametrize("tau", [0.0, 0.003])
def test_a_response_has_the_derivatives_of_its_function(tau: float) -> None:
    """Speed, v and travel at a frequency σ; beside them the differences over σ."""
    effects, more = (("armature_inductance",), {"electrical_time_constant": tau}) if tau else ((), {})
    p = motor(FAST | more, *effects)
    hold, f, apart = prepare_hold(p, 3.0, find_torques(p, 0.0)), 900.0, 0.5
    low, here, high = (respond(p, hold, 1.0, f + shift) for shift in (-apart, 0.0, apart))
    for one, two, three in zip(low, here, high, strict=True):  # σ = i·f
        assert two.first == pytest.approx((three.value - one.value) / complex(0.0, 2.0 * apart), rel=1e-4)
        assert two.second == pytest.approx(-(three.value - 2.0 * two.value + one.value) / apart**2, rel=1e-2)
    speed, drive, travel = here
    assert travel.value * complex(0.0, f) == pytest.approx(speed.value)
    inertia, sigma = FAST["ka"], complex(0.0, f)
    assert inertia * sigma * speed.value == pytest.approx(1.0 + drive.value)  # of a unit torque that drives
    assert tau * sigma * drive.value == pytest.approx(-FAST["kv"] * speed.value - drive.value)


def test_directions_are_alike() -> None:
    """Turning back is turning ahead in a mirror, with the phase turned over."""
    ahead = motor(FAST | {"ripple_phase": 0.4})
    back = motor(FAST | {"ripple_phase": -0.4})
    one = step(ahead, 3.0, State(0.2, 1000.0, 0.0, 0.0, 1.0, 0.1), 5e-3)
    other = step(back, -3.0, State(-0.2, -1000.0, 0.0, 0.0, -1.0, -0.1), 5e-3)
    assert one is not None and other is not None
    assert other == pytest.approx([-value for value in one], rel=1e-12)
    assert copysign(1.0, other[0]) == -1.0


def test_a_hold_against_one_torque_more_is_that_hold() -> None:
    p = motor(FAST)
    loaded = Parameters(FAST | {"bias_voltage": 0.25}, ("torque_ripple", "load_bias"), max_voltage=5.0).vector()
    own: Hold = rippling._retard(p, prepare_hold(p, 3.0, find_torques(p, 0.0)), 1.0, 0.25)
    wanted = prepare_hold(loaded, 3.0, find_torques(loaded, 0.0))
    assert own[1:] == pytest.approx(wanted[1:]) and own.torques == pytest.approx(wanted.torques)
