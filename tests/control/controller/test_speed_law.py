"""The law at one sample: the rate limit, the plug limit, a reversal speed of the motor's own, a plant that is off."""

from dataclasses import replace
from math import tau

import pytest
from bench_board import DEFAULTS

from motor_control.configuration import config_of
from motor_control.controller.motion import Motion
from motor_control.controller.reference.demand import Demand
from motor_control.controller.run import begin
from motor_control.controller.speed_law import reversal_speed_of, step
from motor_model.parameters import PAPER_KV, paper_motor
from motor_model.sample import Info, Sample


@pytest.mark.parametrize(
    ("top", "edges", "expected"),
    [(174.0, 96, 10.4), (6.0, 96, 0.36), (600.0, 96, 36.0), (None, 96, 150 * tau / 96), (None, 24, 150 * tau / 24)],
)
def test_the_reversal_speed_is_the_motors_own(top: float | None, edges: int, expected: float) -> None:
    model = None if top is None else paper_motor()
    config = config_of(DEFAULTS, Info(edges_per_revolution=edges), model)
    if top is not None:
        config = replace(config, faults=replace(config.faults, fastest=top))
    assert reversal_speed_of(config, Motion()) == pytest.approx(expected, rel=0.01)
    assert reversal_speed_of(replace(config, reversal_speed=7.0), Motion()) == 7.0


def test_without_a_model_the_last_steady_motion_says_how_slow_is_slow() -> None:
    config, slow = config_of(DEFAULTS, Info()), Motion(steady_speed=3.0, steady_voltage=6.0)
    assert reversal_speed_of(config, slow) == pytest.approx(0.06 * 6.0)


@pytest.mark.parametrize(
    ("limit", "least"), [(1.0, -12.0 + PAPER_KV * 150.0), (1.5, -18.0 + PAPER_KV * 150.0), (2.0, -12.0)]
)
def test_voltage_and_back_emf_stay_within_the_plug_limit(limit: float, least: float) -> None:
    config = config_of(
        {**DEFAULTS, "plug_limit": limit, "reference_rate_limit": 0.0}, Info(single_channel=False), paper_motor()
    )
    run = begin(config, Sample(0, 150.0, 12.0))
    output, _ = step(config, run, Sample(5_000_000, 150.0, 12.0, 11, 4_900_000, 4e-4), Demand(-150.0))
    assert output.terms.voltage == pytest.approx(max(least, -12.0), abs=0.05)


def test_before_anything_is_known_of_the_motor_it_is_not_braked_at_speed() -> None:
    config = config_of(DEFAULTS, Info(single_channel=False))
    for speed, braked in ((100.0, False), (5.0, True)):
        run = begin(config, Sample(0, speed, 0.0))
        output, _ = step(config, run, Sample(5_000_000, speed, 0.0, 7, 4_900_000, 6e-4), Demand(-100.0))
        assert (output.terms.voltage < -1.0) == braked
