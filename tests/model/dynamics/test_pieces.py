"""How long a piece may be, and the lines that stand in it for curves."""

from math import inf, sqrt

import pytest
from numpy.typing import NDArray

from motor_model.dynamics.events import solve
from motor_model.dynamics.forces import friction_at, friction_slope_at
from motor_model.dynamics.linear import Coefficients
from motor_model.dynamics.pieces import EARLY, LATE, lines, longest_piece
from motor_model.dynamics.state import State
from motor_model.effects import INDEX
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters

STATIC = {"ks": 0.4, "breakaway_voltage": 0.9, "stribeck_speed": 5.0}
RIPPLE = {"ripple_voltage": 0.4, "ripple_cycles": 12.0, "ripple_phase": 0.3}


def vector(*effects: str, **values: float) -> NDArray:  # type: ignore[type-arg]
    return Parameters({"kv": PAPER_KV, "ka": PAPER_KA} | values, effects).vector()


def moving(speed: float) -> State:
    return State(0.0, speed, 0.0, 0.0, 1.0, 0.0)


BENT = [
    vector("static_friction", **STATIC),
    vector("quadratic_drag", drag=1e-4),
    vector("torque_ripple", **RIPPLE),
    vector("warm_up", resistance_rise=0.3, warm_up_time=2.0),
]


def test_a_linear_motor_needs_one_piece_and_an_oscillating_one_a_quarter_period() -> None:
    assert longest_piece(vector("coulomb_friction", ks=0.5), moving(50.0), 1000.0, PAPER_KA, inf) == inf
    lag = 0.1  # [s] more than a quarter of the time constant: it oscillates
    swinging = vector("armature_inductance", electrical_time_constant=lag)
    piece = longest_piece(swinging, moving(50.0), 1000.0, PAPER_KA, inf)
    assert piece == pytest.approx(1.5 * sqrt(PAPER_KA * lag / PAPER_KV))
    damped = vector("armature_inductance", electrical_time_constant=0.004)
    assert longest_piece(damped, moving(50.0), 1000.0, PAPER_KA, inf) == inf


@pytest.mark.parametrize("p", BENT, ids=["static friction", "drag", "ripple", "warm-up"])
def test_a_coarser_search_takes_pieces_so_much_longer(p: NDArray) -> None:  # type: ignore[type-arg]
    fine = longest_piece(p, moving(3.0), 500.0, PAPER_KA, inf)
    coarse = p.copy()
    coarse[INDEX["coarseness"]] = 4.0
    assert longest_piece(coarse, moving(3.0), 500.0, PAPER_KA, inf) == pytest.approx(4.0 * fine)
    assert 1e-6 < fine < 0.1


def test_pieces_are_short_where_the_curve_bends() -> None:
    static = vector("static_friction", **STATIC)
    near, far = (longest_piece(static, moving(speed), 500.0, PAPER_KA, inf) for speed in (3.0, 100.0))
    assert near < 0.01 * STATIC["stribeck_speed"] and far > 30.0 * near
    drag = vector("quadratic_drag", drag=1e-4)
    slow, swift = (longest_piece(drag, moving(50.0), a, PAPER_KA, inf) for a in (100.0, 800.0))
    assert slow / swift == pytest.approx(4.0)  # the third root of the acceleration's square
    for wanted, found in ((0.99 * swift, inf), (1.01 * swift, swift)):  # not computed where it is long enough
        assert longest_piece(drag, moving(50.0), 800.0, PAPER_KA, wanted) == pytest.approx(found)


def test_a_straight_line_stands_for_itself() -> None:
    p = vector("coulomb_friction", ks=0.5)
    c = Coefficients(PAPER_KA, 0.5, 0.0, 6.0, PAPER_KV, 0.0)
    line, h = lines(p, c, moving(20.0), 0.0, 0.01)
    assert h == 0.01 and line == pytest.approx(c)


def test_the_line_of_friction_goes_through_its_values_at_the_gauss_nodes() -> None:
    p, s, h = vector("quadratic_drag", drag=1e-3), moving(20.0), 0.02
    c = Coefficients(PAPER_KA, friction_at(p, 20.0, 1.0), friction_slope_at(p, 20.0), 6.0, PAPER_KV, 0.0)
    line, taken = lines(p, c, s, 0.0, h)
    assert taken == h
    for node in (EARLY, LATE):
        speed = solve(p, c, s, node * h)[0]
        assert line.torque + line.slope * (speed - 20.0) == pytest.approx(friction_at(p, speed, 1.0), rel=1e-12)
    assert line.slope > 1.1 * c.slope  # the motor gathers speed


def test_a_piece_with_lines_ends_where_the_shaft_comes_to_rest() -> None:
    p, s = vector("static_friction", **STATIC), moving(2.0)
    c = Coefficients(PAPER_KA, friction_at(p, 2.0, 1.0), friction_slope_at(p, 2.0), -6.0, PAPER_KV, 0.0)
    _, taken = lines(p, c, s, 0.0, 0.01)
    assert taken < 0.01 and abs(solve(p, c, s, taken)[0]) < 1e-6
