"""Every effect of the table, on profiles with reversals and stops, against a plant that shares no formula with it.

Effects that leave the equation piecewise linear agree to rounding, however far apart the times asked for are; the
others converge fast.
"""

import numpy as np
import plant
import pytest
from numpy.typing import NDArray
from tiers import keep_fast

from motor_model.effects import EFFECTS, normalised, specs_of
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.simulate import Trajectory, simulate

Floats = NDArray[np.float64]
Values = dict[str, float]

BASE = {"kv": PAPER_KV, "ka": PAPER_KA}
PERIOD = 0.005
LEVELS = [8.0, -8.0, 3.0, 0.0, -3.0, 10.0, -10.0, 0.0, 1.0, 0.0, 0.6, 2.0]  # hard reversals, stops, starts
VOLTAGE: Floats = np.repeat(LEVELS, 70)
TIME: Floats = np.arange(len(VOLTAGE)) * PERIOD

# Values that an eye would see in the motion, and whether the motion between events is then linear.
LINEAR: dict[str, Values] = {
    "coulomb_friction": {"ks": 0.5},
    "load_bias": {"bias_voltage": 0.6},
    "load_step": {"step_voltage": 0.6, "step_time": 1.2345},
    "dead_zone": {"dead_zone_voltage": 0.5},
    "voltage_limit": {"limit_voltage": 7.0},
    "direction_asymmetry": {"reverse_gain": 0.9},
    "coast_drive": {"coast_share": 0.7},
    "supply_sag": {"sag": 0.2},
    "armature_inductance": {"electrical_time_constant": 0.004},
    "transport_delay": {"delay": 0.0071},
    "backlash": {"backlash_angle": 0.3, "load_fraction": 0.5},
}
CURVED: dict[str, Values] = {
    "static_friction": {"ks": 0.4, "breakaway_voltage": 0.9, "stribeck_speed": 5.0},
    "quadratic_drag": {"drag": 1e-4},
    "torque_ripple": {"ripple_voltage": 0.4, "ripple_cycles": 12.0, "ripple_phase": 0.3},
    "warm_up": {"resistance_rise": 0.3, "warm_up_time": 2.0},
}
ONLY_SEEN_BY_THE_ENCODER = {"encoder_eccentricity", "missed_edges"}


def ours(values: Values, effects: tuple[str, ...], spacing: float, voltage: Floats = VOLTAGE) -> Trajectory:
    """Our motion at TIME when it is asked for every `spacing` [s], a whole fraction of PERIOD."""
    parts = round(PERIOD / spacing)
    time: Floats = np.arange(len(TIME) * parts - parts + 1) * spacing
    time[::parts] = TIME
    dense = simulate(Parameters(BASE | values, effects), TIME, voltage, time)
    return Trajectory(TIME, dense.angle[::parts], dense.speed[::parts])


def theirs(values: Values, voltage: Floats = VOLTAGE, start_speed: float = 0.0) -> Trajectory:
    motion = plant.motor.move(BASE | values, TIME, voltage, start_speed=start_speed)
    return Trajectory(TIME, motion.angle[motion.at], motion.speed[motion.at])


def apart(a: Trajectory, b: Trajectory) -> float:
    return float(np.max(np.abs(a.angle - b.angle)))


def test_every_effect_of_the_motion_is_compared() -> None:
    assert {effect.name for effect in EFFECTS} == set(LINEAR) | set(CURVED) | ONLY_SEEN_BY_THE_ENCODER
    for name, values in (LINEAR | CURVED).items():
        assert set(values) == {spec.name for spec in specs_of((name,))[2:]}


def test_the_base_motor() -> None:
    truth, model = theirs({}), ours({}, (), PERIOD)
    assert apart(model, truth) < 1e-10
    assert np.max(np.abs(model.speed - truth.speed)) < 1e-9
    assert 100.0 < np.max(np.abs(truth.speed)) < 10.0 / PAPER_KV
    assert np.ptp(truth.angle) > 40.0


@pytest.mark.parametrize("name", LINEAR)
def test_piecewise_linear_effects_agree_to_rounding(name: str) -> None:
    truth = theirs(LINEAR[name])
    for spacing in (PERIOD, PERIOD / 50):
        model = ours(LINEAR[name], (name,), spacing)
        assert apart(model, truth) < 1e-10
        assert np.max(np.abs(model.speed - truth.speed)) < 1e-9
    assert apart(truth, theirs({})) > 0.1  # it was there to be seen


@pytest.mark.parametrize(
    "names",
    [
        ("coulomb_friction", "load_bias"),
        ("coulomb_friction", "armature_inductance"),
        ("load_bias", "armature_inductance"),
        ("armature_inductance", "backlash"),
        ("coulomb_friction", "transport_delay"),
        ("coast_drive", "coulomb_friction"),
        ("dead_zone", "direction_asymmetry"),
        ("voltage_limit", "supply_sag", "coulomb_friction"),
        ("load_step", "backlash", "coulomb_friction"),
    ],
    ids="+".join,
)
def test_pairs_of_linear_effects_agree_to_rounding(names: tuple[str, ...]) -> None:
    values = {name: value for effect in names for name, value in LINEAR[effect].items()}
    assert apart(ours(values, names, PERIOD), theirs(values)) < 1e-10


CURVED_CASES = {
    **{(name,): values for name, values in CURVED.items()},
    ("torque_ripple", "coulomb_friction"): CURVED["torque_ripple"] | {"ks": 0.3},
    ("warm_up", "coulomb_friction"): CURVED["warm_up"] | {"ks": 0.5},
    ("quadratic_drag", "coulomb_friction", "armature_inductance"): {
        "drag": 1e-4,
        "ks": 0.3,
        "electrical_time_constant": 0.004,
    },
}


@pytest.mark.parametrize("names", CURVED_CASES, ids="+".join)
def test_curved_effects_converge_with_a_high_order(names: tuple[str, ...]) -> None:
    values = CURVED_CASES[names]
    truth = theirs(values)
    at_samples, dense, denser = (apart(ours(values, names, PERIOD / n), truth) for n in (1, 10, 50))
    assert 1e-7 < at_samples < 1e-4  # as a user meets it: rad after 4 s
    assert 1e-12 < dense < 1e-6
    assert denser < 2e-8
    # Between the two, 25 for the second order, of warm copper, which takes the middle of a piece only; above 125 for
    # more than the third, unless only rounding is left.
    assert dense / denser > (24.5 if "warm_up" in names else 125.0) or denser < 1e-11
    plain = {name: value for name, value in values.items() if name == "ks"}
    assert apart(truth, theirs(plain)) > 0.1


RANGES = {
    "ks": (0.0, 1.5),
    "bias_voltage": (-1.0, 1.0),
    "step_voltage": (-1.0, 1.0),
    "step_time": (0.1, 2.0),
    "dead_zone_voltage": (0.0, 1.5),
    "limit_voltage": (4.0, 12.0),
    "reverse_gain": (0.7, 1.15),  # so that the effective voltage stays below max_voltage, where coasting ends
    "coast_share": (0.0, 1.0),
    "sag": (0.0, 0.5),
    "electrical_time_constant": (1e-4, 0.03),
    "delay": (0.0, 0.03),
    "backlash_angle": (0.0, 1.0),
    "load_fraction": (0.0, 0.9),
    "breakaway_voltage": (1.5, 2.0),
    "stribeck_speed": (2.0, 40.0),
    "drag": (0.0, 1e-4),
    "ripple_voltage": (0.0, 0.6),
    "ripple_cycles": (1.0, 20.0),
    "ripple_phase": (-3.0, 3.0),
    "resistance_rise": (0.0, 0.5),
    "warm_up_time": (0.5, 5.0),
}


def drawn(seed: int, effects: list[str], count: int) -> tuple[tuple[str, ...], Values, Floats]:
    """Effects, their values, a motor's time constant and voltages [V] that switch at random."""
    random = np.random.default_rng(seed)
    names = normalised(tuple(random.choice(effects, size=count, replace=False)))
    values = {spec.name: float(random.uniform(*RANGES[spec.name])) for spec in specs_of(names)[2:]}
    values["kv"] = float(np.exp(random.uniform(np.log(0.02), np.log(0.2))))
    values["ka"] = values["kv"] * float(np.exp(random.uniform(np.log(0.02), np.log(0.3))))
    hold = int(random.integers(1, 60))
    switched = random.uniform(-10.0, 10.0, len(TIME)) * (random.random(len(TIME)) < 0.85)
    return names, values, switched.repeat(hold)[: len(TIME)]


@pytest.mark.parametrize("seed", keep_fast(range(40), *range(8)))
def test_random_linear_motors_agree_to_rounding(seed: int) -> None:
    names, values, voltage = drawn(seed, list(LINEAR), 3)
    truth = theirs(values, voltage)
    assert apart(ours(values, names, PERIOD, voltage), truth) < 1e-9
    assert np.ptp(truth.angle) > 1.0


@pytest.mark.slow
def test_random_curved_motors_agree_closely() -> None:
    at_samples, dense = [], []
    for seed in range(20):
        names, values, voltage = drawn(seed, list(LINEAR | CURVED), 4)
        truth = theirs(values, voltage)
        at_samples.append(apart(ours(values, names, PERIOD, voltage), truth))
        dense.append(apart(ours(values, names, PERIOD / 50, voltage), truth))
    assert 1e-7 < np.median(at_samples) < 2e-5
    assert np.sort(at_samples)[-2] < 0.01  # a stop beside a hump of the ripple makes much of a small error
    assert np.max(dense) < 1e-5


@pytest.mark.parametrize("lag", [0.002, 0.004, 0.02])
def test_a_motor_that_brakes_through_zero_and_is_back_before_it_is_looked_at(lag: float) -> None:
    """Between two switches its speed has the same sign at both ends; friction in between has not."""
    values = {"electrical_time_constant": lag, "ks": 0.5}
    motor = Parameters(BASE | values, ("armature_inductance", "coulomb_friction"))
    hidden = 0
    for braking in np.arange(0.02, 0.08, 0.0005):
        time = np.array([0.0, 0.1, 0.1 + braking, 0.2 + braking])
        volts = np.array([8.0, -8.0, 8.0, 0.0])
        truth = plant.motor.move(BASE | values, time, volts, step=2e-5)
        last = truth.speed[truth.at[2] :]
        hidden += bool(last[0] > 0.0 and last[-1] > 0.0 and np.any(last < 0.0))
        model = simulate(motor, time, volts, time)
        assert np.max(np.abs(model.angle - truth.angle[truth.at])) < 1e-9
    assert hidden >= 1


def test_a_shaft_that_turns_at_the_start_has_its_current_settled() -> None:
    values = {"electrical_time_constant": 0.02, "ks": 0.5}
    voltage = np.where(TIME < 0.02, 0.0, VOLTAGE)
    parameters = Parameters(BASE | values, ("armature_inductance", "coulomb_friction"))
    model = simulate(parameters, TIME, voltage, TIME, start_speed=80.0)
    truth = theirs(values, voltage, start_speed=80.0)
    assert apart(model, truth) < 1e-9
    steady = simulate(parameters, TIME, np.full_like(TIME, 6.0), TIME, start_speed=(6.0 - 0.5) / PAPER_KV)
    assert np.ptp(steady.speed) < 1.0  # only the 0.5 V that friction takes have to build up
    assert abs(steady.speed[-1] - (6.0 - 0.5) / PAPER_KV) < 1e-9


def test_stribeck_friction_does_not_throw_the_shaft() -> None:
    """A narrow Stribeck peak on a light rotor is an instability of 10 ns; solved in too long a piece it exploded."""
    values = {"kv": 0.01358648, "ka": 2.4547e-5, "ks": 0.0, "breakaway_voltage": 2.4939, "stribeck_speed": 0.001}
    lagging = values | {"electrical_time_constant": 0.05, "coast_share": 0.1}
    motor = Parameters(lagging, ("static_friction", "armature_inductance", "coast_drive"))
    creeping = simulate(motor, TIME, np.full_like(TIME, 2.6), TIME)  # the drive passes the breakaway slowly
    assert 300.0 < np.max(np.abs(creeping.speed)) < 2000.0
    assert 10.0 < creeping.angle[-1] / TIME[-1] < 2.6 / 0.01358648  # it slips, overshoots and sticks, in turn
    hard = simulate(Parameters(values, ("static_friction",)), TIME, VOLTAGE, TIME)
    assert 600.0 < np.max(np.abs(hard.speed)) < 1.0001 * 10.0 / 0.01358648


def test_a_delay_of_many_samples_and_a_first_command_before_the_start() -> None:
    values = {"delay": 0.0613}
    assert apart(ours(values, ("transport_delay",), PERIOD), theirs(values)) < 1e-10
    late = simulate(Parameters(BASE | values, ("transport_delay",)), TIME, VOLTAGE, TIME)
    assert np.all(late.angle[TIME <= 0.0613] == 0.0) and late.angle[TIME > 0.0613][0] > 0.0
    early = simulate(Parameters(BASE), TIME - 0.1, VOLTAGE, TIME)  # from rest at 0 s, into the voltage of that time
    rolled = simulate(Parameters(BASE), TIME, np.roll(VOLTAGE, -20), TIME)
    assert np.max(np.abs(early.angle - rolled.angle)[TIME < 4.0]) < 1e-12
