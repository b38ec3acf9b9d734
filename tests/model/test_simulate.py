"""Roll-outs of one motor: when a command acts, what the start means, and that being looked at changes nothing."""

import numpy as np
import pytest

from motor_model.dynamics.forces import sliding_speed
from motor_model.dynamics.motor import advance
from motor_model.dynamics.state import at_rest
from motor_model.effects import normalised
from motor_model.errors import ModelError
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.simulate import roll_out, simulate

BASE = {"kv": PAPER_KV, "ka": PAPER_KA}
TIME = np.arange(200) * 0.005
VOLTAGE = np.where(TIME < 0.5, 6.0, -3.0)
TAU = PAPER_KA / PAPER_KV


def test_a_step_follows_the_exponential_of_a_first_order_motor() -> None:
    motion = simulate(Parameters(BASE), np.zeros(1), np.array([6.0]), TIME)
    top = 6.0 / PAPER_KV
    assert motion.speed == pytest.approx(top * -np.expm1(-TIME / TAU), rel=1e-12)
    assert motion.angle == pytest.approx(top * (TIME + TAU * np.expm1(-TIME / TAU)), rel=1e-11, abs=1e-13)


def test_a_command_acts_a_delay_after_its_time() -> None:
    delayed = simulate(Parameters(BASE | {"delay": 0.05}, ("transport_delay",)), TIME, VOLTAGE, TIME)
    prompt = simulate(Parameters(BASE), TIME, VOLTAGE, TIME)
    assert np.all(delayed.angle[:11] == 0.0) and delayed.angle[11] > 0.0
    assert delayed.angle[10:] == pytest.approx(prompt.angle[:-10], abs=1e-12)


def test_a_shaft_that_turns_at_the_start_runs_on() -> None:
    top = 6.0 / PAPER_KV
    steady = simulate(Parameters(BASE), TIME, np.full_like(TIME, 6.0), TIME, start_speed=top)
    assert steady.speed == pytest.approx(np.full_like(TIME, top), rel=1e-12)
    coasting = simulate(Parameters(BASE), TIME, np.zeros_like(TIME), TIME, start_speed=-top)
    assert coasting.speed == pytest.approx(-top * np.exp(-TIME / TAU), rel=1e-12)


@pytest.mark.parametrize("effects", [(), ("coulomb_friction",), ("coulomb_friction", "armature_inductance")])
def test_looking_more_often_changes_nothing(effects: tuple[str, ...]) -> None:
    more = {"coulomb_friction": {"ks": 0.5}, "armature_inductance": {"electrical_time_constant": 0.004}}
    values = BASE | {name: value for effect in effects for name, value in more[effect].items()}
    motor = Parameters(values, effects)
    often = simulate(motor, TIME, VOLTAGE, np.arange(1991) * 0.0005)
    seldom = simulate(motor, TIME, VOLTAGE, TIME)
    assert often.angle[::10] == pytest.approx(seldom.angle, abs=1e-10)


HAPPENING = {"step_voltage": 0.7, "step_time": 0.3217, "backlash_angle": 0.3, "load_fraction": 0.4}


def test_what_is_straight_moves_as_the_step_of_the_motor_says() -> None:
    """A load step between two samples, and play that is taken up after a reversal: the whole hold's equation or not."""
    motor = Parameters(BASE | {"ks": 0.5} | HAPPENING, ("coulomb_friction", "load_step", "backlash"))
    whole = simulate(motor, TIME, VOLTAGE, TIME)
    s, p, stepped = at_rest(0.0), motor.vector(), [0.0]
    for k in range(len(TIME) - 1):
        s = advance(p, VOLTAGE[k], s, TIME[k], TIME[k + 1] - TIME[k])
        stepped.append(s.angle)
    assert whole.angle == pytest.approx(stepped, abs=1e-11)
    plain = simulate(Parameters(BASE | {"ks": 0.5}, ("coulomb_friction",)), TIME, VOLTAGE, TIME)
    assert np.array_equal(whole.angle[:64], plain.angle[:64])  # until the load comes, the play is not felt
    assert plain.angle[90] - whole.angle[90] > 0.5


BENT = {
    "static_friction": {"ks": 0.3, "breakaway_voltage": 0.8, "stribeck_speed": 2.0},
    "warm_up": {"resistance_rise": 0.4, "warm_up_time": 0.6},
    "armature_inductance": {"electrical_time_constant": 0.004},
}


@pytest.mark.parametrize("lagging", [False, True], ids=["at once", "with inductance"])
@pytest.mark.parametrize("effects", [("static_friction",), ("warm_up",), ("static_friction", "warm_up")])
def test_where_a_bent_motor_is_straight_it_moves_as_the_step_of_the_motor_says(
    effects: tuple[str, ...], lagging: bool
) -> None:
    """Stribeck friction that comes and goes, and warm copper: the whole hold's equation, or pieces."""
    every = (*effects, "armature_inductance") if lagging else effects
    values = BASE | {name: value for effect in every for name, value in BENT[effect].items()}
    motor = Parameters(values, normalised(every))
    whole = simulate(motor, TIME, VOLTAGE, TIME)
    s, p, stepped = at_rest(0.0), motor.vector(), [0.0]
    for k in range(len(TIME) - 1):
        s = advance(p, VOLTAGE[k], s, TIME[k], TIME[k + 1] - TIME[k])
        stepped.append(s.angle)
    assert whole.angle == pytest.approx(stepped, abs=1e-9)
    assert "static_friction" not in effects or 0.3 < np.mean(np.abs(whole.speed) > sliding_speed(p)) < 0.95


def test_a_ripple_takes_its_phase_from_the_measured_angle_where_there_is_one() -> None:
    """The anchor says that the shaft is a quarter of the ripple's period further on: so is its phase."""
    ripple = {"ripple_voltage": 0.4, "ripple_cycles": 12.0, "ripple_phase": 0.3}
    shifted = ripple | {"ripple_phase": 0.3 + np.pi / 2}
    angle, speed = np.empty_like(TIME), np.empty_like(TIME)
    free = simulate(Parameters(BASE | shifted, ("torque_ripple",)), TIME, VOLTAGE, TIME).angle
    vector = Parameters(BASE | ripple, ("torque_ripple",)).vector()
    roll_out(vector, 0.0, TIME, VOLTAGE, TIME, free + np.pi / 24, angle, speed)
    assert angle == pytest.approx(free, abs=1e-8)
    roll_out(vector, 0.0, TIME, VOLTAGE, TIME, free, angle, speed)
    assert np.max(np.abs(angle - free)) > 1e-3


@pytest.mark.parametrize(("commands", "times"), [(0, 5), (5, 0)])
def test_nothing_to_simulate_is_said(commands: int, times: int) -> None:
    with pytest.raises(ModelError, match="at least one command"):
        simulate(Parameters(BASE), TIME[:commands], VOLTAGE[:commands], TIME[:times])
    with pytest.raises(ModelError, match="a time for each"):
        simulate(Parameters(BASE), TIME[:4], VOLTAGE[:3], TIME[:4])
