"""Step responses of loops whose answer is known."""

from dataclasses import replace
from math import exp, inf

import numpy as np
import pytest
from tuning_bench import BARE

from motor_control.tuning.linear_loop import Gains
from motor_control.tuning.speed_feedback import cancelling
from motor_control.tuning.step_response import RISEN, StepResponse, respond, small_step


def test_a_slow_cancelling_loop_is_an_exponential() -> None:
    """τ = ka/kp, and the dead time."""
    tau = 0.3
    step = small_step(BARE, cancelling(BARE, BARE.ka / tau), 0.0)
    assert step.time_constant == pytest.approx(tau + BARE.dead_time, rel=0.04)
    assert step.overshoot < 0.01 and step.speed[-1] == pytest.approx(1.0, abs=0.01)


def test_the_voltage_limit_is_full_voltage_until_there() -> None:
    step = respond(BARE, cancelling(BARE, 0.3), 100.0, 0.3, 0.0, 12.0)
    full = step.voltage >= 12.0
    assert 0.03 < full.sum() * BARE.sample_period < 0.08 and step.voltage.min() >= 0.0
    k = int(np.flatnonzero(~full)[0])
    exact = 12.0 / BARE.kv * (1.0 - exp(-(step.time[k] - BARE.dead_time) * BARE.kv / BARE.ka))
    assert step.speed[k] == pytest.approx(exact, rel=0.01)


def test_feed_forward_leaves_nothing_to_the_integral() -> None:
    step = respond(BARE, Gains(0.1, 0.0), 10.0, 1.0, -12.0, 12.0, 10.0 * BARE.kv)
    assert step.speed[-1] == pytest.approx(10.0, rel=1e-3) and step.overshoot < 0.01


def test_a_lag_of_the_sensor_shifts_what_is_measured_not_the_shaft() -> None:
    lagging = respond(replace(BARE, sensor_lag=0.02), cancelling(BARE, 0.02), 1.0, 1.0, -1e9, 1e9)
    bare = respond(BARE, cancelling(BARE, 0.02), 1.0, 1.0, -1e9, 1e9)
    assert lagging.time_constant == pytest.approx(bare.time_constant, rel=0.08)


def test_one_that_never_rises_has_no_time_constant() -> None:
    flat = StepResponse(1.0, np.arange(3.0), np.array([0.0, 0.1, 0.2]), np.zeros(3))
    assert flat.time_constant == inf and flat.overshoot == 0.0


@pytest.mark.parametrize("shift", [{}, {"sensor_lag": 0.033}, {"predicted": True, "delay": 0.021}])
def test_a_step_that_ends_early_has_the_same_time_constant_to_the_bit(shift: dict[str, float]) -> None:
    plant, gains = replace(BARE, **shift), cancelling(BARE, 0.02)  # type: ignore[arg-type]
    whole, early = small_step(plant, gains, 0.0), small_step(plant, gains, 0.0, RISEN)
    assert early.time_constant == whole.time_constant < inf
    assert len(early.time) == len(early.speed) == len(early.voltage) < 0.2 * len(whole.time)
