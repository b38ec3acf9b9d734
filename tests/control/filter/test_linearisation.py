"""The linearised motor against the motor's own step."""

import pytest
from filter_bench import KA, KV, vector

from motor_control.filter.linearisation import linearise_motion
from motor_control.filter.prediction import add_load
from motor_model.dynamics.motor import advance
from motor_model.dynamics.state import State


@pytest.mark.parametrize("dt", [1e-9, 1e-4, 5e-3, 0.02])
def test_small_errors_grow_as_the_motors_step_says(dt: float) -> None:
    p = vector(("quadratic_drag",), drag=1e-4)
    base = advance(p, 6.0, State(0.0, 60.0, 0.0, 0.0, 1.0, 0.0), 0.0, dt)
    t = linearise_motion(p, 6.0, 0.5 * (60.0 + base.speed), dt)
    faster = advance(p, 6.0, State(0.0, 60.01, 0.0, 0.0, 1.0, 0.0), 0.0, dt)
    assert (faster.speed - base.speed) / 0.01 == pytest.approx(t.gain, rel=1e-3)
    assert (faster.angle - base.angle) / 0.01 == pytest.approx(t.reach, rel=1e-3)
    loaded = advance(add_load(p, 0.001), 6.0, State(0.0, 60.0, 0.0, 0.0, 1.0, 0.0), 0.0, dt)
    assert (loaded.speed - base.speed) / 0.001 == pytest.approx(t.push, rel=1e-2, abs=1e-9)
    assert (loaded.angle - base.angle) / 0.001 == pytest.approx(t.pull, rel=1e-2, abs=1e-9)


def test_without_friction_it_is_the_first_order_motor() -> None:
    t = linearise_motion(vector(), 3.0, 40.0, KA / KV)
    assert t.gain == pytest.approx(0.3679, rel=1e-3)
    assert t.push == pytest.approx(-0.6321 / KV, rel=1e-3)
