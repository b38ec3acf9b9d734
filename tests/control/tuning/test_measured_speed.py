"""The period method in the loop: its lag, and the ripple that it makes of an irregular disc, simulated edge by edge."""

import numpy as np
import pytest
from tuning_bench import BARE

from motor_control.controller import pi
from motor_control.tuning.linear_loop import sampled
from motor_control.tuning.measured_speed import Measured
from motor_control.tuning.speed_feedback import Encoder, cancelling

ENCODER = Encoder(edges_per_revolution=96, slot_irregularity=0.02, edge_resolution=0.0)


def test_the_lag_is_a_slot_period() -> None:
    assert Measured(ENCODER).lag(10.0) == pytest.approx(2.0 * np.pi / 96 / 10.0)
    assert Measured(ENCODER).plant(BARE, 10.0).late == pytest.approx(BARE.late + 0.00654, abs=1e-5)


def simulated_ripple(kp: float, speed: float) -> float:
    """Peak to peak (5 σ) over the mean, of a linear motor whose measured speed is off by random edges."""
    gains, motor, rng = cancelling(BARE, kp), sampled(BARE), np.random.default_rng(3)
    slot, period = ENCODER.slot, BARE.sample_period
    config, state = pi.Config(gains.kp, gains.ki, 1e9), pi.State(BARE.kv * speed)
    flanks = ENCODER.slot_irregularity * slot * rng.standard_normal(300_000)
    x, angle, before, speeds = np.array([speed]), 0.0, BARE.kv * speed, []
    for _ in range(20_000):
        k = int(angle / slot)
        reported = float(x[0]) + speed * (flanks[k + 1] - flanks[k]) / slot
        terms, state = pi.update(config, state, speed - reported, 0.0, period, -1e9, 1e9)
        angle += float(x[0]) * period
        x = motor.phi @ x + motor.new * before
        before = terms.voltage
        speeds.append(float(x[0]))
    return float(5.0 * np.std(speeds[500:]) / speed)


@pytest.mark.parametrize("speed", [10.0, 40.0])
def test_the_ripple_is_what_a_simulation_shows(speed: float) -> None:
    predicted = Measured(ENCODER).ripple(BARE, cancelling(BARE, 0.1), speed)
    assert predicted.speed == pytest.approx(simulated_ripple(0.1, speed), rel=0.25)
    assert predicted.reported > predicted.speed and predicted.voltage > 0.0


def test_more_gain_is_more_ripple_and_slower_is_later() -> None:
    measured = Measured(ENCODER)
    assert (
        measured.ripple(BARE, cancelling(BARE, 0.2), 40.0).speed
        > measured.ripple(BARE, cancelling(BARE, 0.1), 40.0).speed
    )
    assert measured.fastest(BARE, (3.0, 100.0)) < 0.7 * measured.fastest(BARE, (10.0, 100.0))
