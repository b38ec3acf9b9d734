"""What an integral has left over is taken back where the motor shall stand."""

from dataclasses import replace
from math import inf

import pytest
from bench_board import DEFAULTS, motor

from motor_control.configuration import config_of
from motor_control.controller import controller, pi
from motor_control.controller.leftover import forget, gains_to_rest, runs_on
from motor_control.controller.motion import Motion
from motor_control.controller.reference.demand import Demand
from motor_control.controller.run import begin
from motor_control.controller.speed_law import step
from motor_model.parameters import PAPER_KA, PAPER_KV
from motor_model.sample import Info, Sample
from motor_model.sensing.board import BoardConfig, SimulatedBoard


@pytest.mark.parametrize(
    ("edges", "reference", "kept"), [(1, 0.0, 0.7), (3, 0.0, 0.34), (-1, 0.0, 1.0), (0, 0.0, 1.0), (1, 1.0, 1.0)]
)
def test_an_integral_that_turns_a_motor_which_shall_stand_is_reduced(edges: int, reference: float, kept: float) -> None:
    """Slower than 10 edges a second it is reported to stand."""
    config = config_of(DEFAULTS, Info(single_channel=False, edges_per_revolution=24))
    run = replace(begin(config, Sample(0, 0.0, 0.9, 7)), law=pi.State(0.9), begins=False)
    output, _ = step(config, run, Sample(5_000_000, 0.0, 0.9, 7 + edges, 4_900_000, 1.2), Demand(reference))
    assert output.terms.integral == pytest.approx(0.9 * kept, abs=0.02)


def rest_with_few_edges(rate: float, load: float, first: float, then: float) -> list[float]:
    """Angles [rad] of a motor of 6 rad/s that runs, then shall stand; load: share of 12 V, from 0.8 s on."""
    plant = motor(
        ("load_step",),
        kv=2.0,
        ka=2.0 * PAPER_KA / PAPER_KV,
        ks=0.396,
        breakaway_voltage=0.9,
        stribeck_speed=0.18,
        step_voltage=12.0 * load,
        step_time=0.8,
    )
    board = BoardConfig(sample_rate=rate, edges_per_revolution=24, single_channel=False, slot_irregularity=0.01, seed=1)
    simulated, info = SimulatedBoard(plant, board), board.info(plant)
    config = config_of({**DEFAULTS, "kp": 0.2 / PAPER_KV * 2.0, "ki": 2.5 / PAPER_KV * 2.0}, info)
    state, voltage, angles = controller.State(), 0.0, []
    for k in range(round(9.0 * rate)):
        wanted = 0.0 if k < 0.2 * rate else (first if k < then * rate else 0.0)
        output, state = controller.update(config, state, simulated.sample(voltage), wanted, k / rate)
        voltage = output.terms.voltage
        angles.append(simulated.angle)
    assert not state.latched
    return angles


@pytest.mark.parametrize("load", [0.1, 0.15])
def test_a_load_is_held_at_0_with_few_edges(load: float) -> None:
    """Caught one edge too high it was let fall, again and again: 0.4 rad a second, and more with a faster motor."""
    angles = rest_with_few_edges(200.0, load, 0.6, 0.6)
    assert abs(angles[-1] - angles[-1000]) < 0.3


@pytest.mark.parametrize("first", [0.48, 0.9])
def test_a_motor_with_few_edges_comes_to_rest(first: float) -> None:
    """An integral between sliding and static friction turned it to and fro by a slot and more for ever."""
    angles = rest_with_few_edges(200.0, 0.0, first, 1.7)
    assert angles[340] > 0.5 and abs(angles[-1] - angles[-1000]) < 0.005


def test_without_a_gain_an_integral_is_forgotten() -> None:
    held = pi.State(2.0)
    assert forget(pi.Config(0.2, 0.0, 12.0), held, 0.2).integral == pytest.approx(0.74, abs=0.01)
    assert forget(pi.Config(0.2, 1e-9, 12.0), held, 0.2) == held


@pytest.mark.parametrize(
    ("ki", "reference", "error", "quick"),
    [(0.01, 0.0, -5.0, 0.8), (0.01, 0.0, 5.0, 0.01), (0.01, 3.0, -5.0, 0.01), (2.5, 0.0, -5.0, 2.5)],
)
def test_a_small_gain_takes_back_what_turns_a_motor_that_shall_stand(
    ki: float, reference: float, error: float, quick: float
) -> None:
    assert gains_to_rest(pi.Config(0.2, ki, 12.0), pi.State(1.0), reference, error).ki == pytest.approx(quick)


@pytest.mark.parametrize(
    ("kp", "ki", "top", "reference", "error", "expected"),
    [
        (0.0, 1e-4, 174.0, 0.0, -80.0, True),  # it ran on at half of its top speed for ever
        (1e-3, 1e-4, 174.0, 0.0, -80.0, True),
        (0.06, 0.06, 174.0, 0.0, -80.0, True),  # 10 of 12 V at the top speed, and a second
        (0.08, 0.06, 174.0, 0.0, -80.0, False),
        (0.06, 0.08, 174.0, 0.0, -80.0, False),
        (1e-3, 1e-4, 174.0, 0.0, 80.0, False),  # it holds a load
        (1e-3, 1e-4, 174.0, 5.0, -80.0, False),
        (1e-3, 1e-4, inf, 0.0, -80.0, False),  # of whose top speed nothing is known
    ],
)
def test_what_next_to_no_gain_would_not_stop(
    kp: float, ki: float, top: float, reference: float, error: float, expected: bool
) -> None:
    config = config_of({**DEFAULTS, "kp": kp, "ki": ki}, Info(single_channel=False))
    known = Motion(steady_speed=top / 2, steady_voltage=6.0) if top < inf else Motion()
    assert runs_on(config, known, pi.State(6.0), reference, error) == expected


@pytest.mark.parametrize(("kp", "ki"), [(0.0, 1e-4), (1e-3, 1e-4)])
def test_a_motor_whose_gains_became_next_to_nothing_is_stopped_by_a_reference_of_0(kp: float, ki: float) -> None:
    """5 s later it turned at 50 and 39 % of its top speed."""
    plant, board = motor(), BoardConfig(single_channel=False)
    simulated, info, state, voltage = SimulatedBoard(plant, board), board.info(plant), controller.State(), 0.0
    for k in range(800):
        gains = {"kp": kp, "ki": ki} if k >= 240 else {}
        config = config_of({**DEFAULTS, **gains}, info)
        sample = simulated.sample(voltage)
        output, state = controller.update(config, state, sample, 80.0 if k < 300 else 0.0, k / 200.0)
        voltage = output.terms.voltage
        assert k != 299 or simulated.speed > 60.0
    assert simulated.speed == 0.0 and not state.latched
