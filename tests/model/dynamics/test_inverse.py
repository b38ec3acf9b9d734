"""The command that a speed and an acceleration need is the one under which the motor has them."""

import pytest
from numpy.typing import NDArray

from motor_model.dynamics.bridge import effective_voltage
from motor_model.dynamics.forces import drive_of, friction_at, loads_at
from motor_model.dynamics.inverse import needed_command
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters

BASE = {"kv": PAPER_KV, "ka": PAPER_KA}
MOTORS = {
    "plain": Parameters(BASE),
    "friction": Parameters(
        BASE | {"ks": 0.4, "breakaway_voltage": 0.9, "stribeck_speed": 4.0, "drag": 1e-4},
        ("static_friction", "quadratic_drag"),
    ),
    "bridge": Parameters(
        BASE | {"dead_zone_voltage": 0.6, "reverse_gain": 0.9, "bias_voltage": 0.2},
        ("dead_zone", "direction_asymmetry", "load_bias"),
    ),
    "sag": Parameters(BASE | {"sag": 0.2}, ("supply_sag",)),
    "coast": Parameters(BASE | {"coast_share": 0.7, "ks": 0.3}, ("coast_drive", "coulomb_friction")),
}


def acceleration(p: NDArray, command: float, speed: float, load: float, direction: float) -> float:  # type: ignore[type-arg]
    """[rad/s²] that the equation gives."""
    source, back_emf = drive_of(p, effective_voltage(p, command))
    torque = friction_at(p, speed, direction) + loads_at(p, 0.0, 0.0) + load
    return float((source - back_emf * speed - torque) / PAPER_KA)


@pytest.mark.parametrize("name", MOTORS)
@pytest.mark.parametrize(("speed", "wanted"), [(0.0, 300.0), (60.0, 0.0), (60.0, 400.0), (-40.0, -200.0), (2.0, 0.0)])
@pytest.mark.parametrize("load", [0.0, 0.3])
def test_the_motor_does_what_was_asked_for(name: str, speed: float, wanted: float, load: float) -> None:
    p = MOTORS[name].vector()
    direction = 1.0 if speed > 0.0 or (speed == 0.0 and wanted > 0.0) else -1.0
    command = needed_command(p, speed, wanted, load, direction)
    assert abs(command) < 12.0
    assert acceleration(p, command, speed, load, direction) == pytest.approx(wanted, abs=1e-6)


def test_a_motor_that_is_to_stand_without_a_load_needs_nothing() -> None:
    for motor in MOTORS.values():
        if "load_bias" not in motor.effects:
            assert needed_command(motor.vector(), 0.0, 0.0, 0.0, 0.0) == 0.0


def test_what_the_supply_cannot_give_ends_at_the_supply() -> None:
    assert needed_command(MOTORS["plain"].vector(), 200.0, 0.0, 0.0, 1.0) == pytest.approx(12.0)
    assert needed_command(MOTORS["plain"].vector(), -200.0, 0.0, 0.0, -1.0) == pytest.approx(-12.0)
