"""The sampled motor: exact between samples, late by its dead time, with the law's own frequency response."""

from dataclasses import replace
from math import exp, inf, nan

import numpy as np
import pytest
from tuning_bench import BARE, RUBBING

from motor_control.tuning.linear_loop import Gains, Plant, held, law, open_loop, plant_of, sampled
from motor_model.errors import MotorError

POLE = exp(-BARE.kv / BARE.ka * BARE.sample_period)


def test_between_samples_it_is_the_exact_first_order_motor() -> None:
    motor = sampled(replace(BARE, predicted=True))
    assert motor.phi[0, 0] == pytest.approx(POLE, rel=1e-12)
    assert motor.new[0] == pytest.approx((1.0 - POLE) / BARE.kv, rel=1e-9)
    assert motor.whole == 0 and motor.old[0] == 0.0


def test_dead_time_is_whole_samples_and_a_rest() -> None:
    motor = sampled(replace(BARE, delay=0.007))
    assert motor.whole == 2 and motor.phi[0, 0] == pytest.approx(POLE)
    assert (motor.old[0] + motor.new[0]) == pytest.approx((1.0 - POLE) / BARE.kv)
    assert 0.3 < motor.old[0] / (motor.old[0] + motor.new[0]) < 0.4  # 2 of 5 ms still have the voltage before


@pytest.mark.parametrize("lag", [0.0, 0.003])
def test_the_open_loop_has_the_continuous_loops_response_at_low_frequency(lag: float) -> None:
    plant, gains, w = replace(BARE, electrical_lag=lag, delay=0.002), Gains(0.2, 2.5), np.array([3.0, 10.0])
    s = 1j * w
    motor = 1.0 / ((plant.ka * s + 0.0) * (1.0 + lag * s) + plant.kv)
    late = np.exp(-s * (plant.dead_time + 0.5 * plant.sample_period))
    exact = (gains.kp + gains.ki / s) * motor * late
    assert open_loop(plant, gains, np.exp(s * plant.sample_period)) == pytest.approx(exact, rel=0.04)


def test_the_law_counts_the_present_error() -> None:
    z = np.array([1j, -1.0 + 0j])
    assert law(Gains(1.0, 20.0), 0.005, z) == pytest.approx(1.0 + 0.1 * z / (z - 1.0))


def test_holding_integrates() -> None:
    phi, gamma = held(np.array([[0.0, 1.0], [0.0, 0.0]]), np.array([0.0, 1.0]), 2.0)
    assert phi.tolist() == [[1.0, 2.0], [0.0, 1.0]] and gamma == pytest.approx([2.0, 2.0])


def test_a_plant_is_the_models_largest_gain() -> None:
    assert plant_of(RUBBING, 0.005) == Plant(RUBBING.value("kv"), RUBBING.value("ka"), 0.005)
    assert BARE.late == pytest.approx(0.0075) and replace(BARE, delay=0.01).dead_time == pytest.approx(0.015)


@pytest.mark.parametrize("changes", [{"ka": 0.0}, {"kv": -1.0}, {"sample_period": inf}, {"gain": nan}, {"delay": -1.0}])
def test_nonsense_is_refused(changes: dict[str, float]) -> None:
    with pytest.raises(MotorError, match=next(iter(changes))):
        replace(BARE, **changes)
