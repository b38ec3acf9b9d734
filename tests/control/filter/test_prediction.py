"""Prediction: the mean is the motor model's, the covariance that of many noisy motors, and commands act late."""

import numpy as np
import pytest
from filter_bench import CERTAIN, KA, KV, NOISE, held, state, vector

from motor_control.filter.filter_state import Covariance, History
from motor_control.filter.prediction import (
    Commands,
    add_load,
    find_acting_voltage,
    predict_covariance,
    predict_state,
)
from motor_model.dynamics.motor import advance


def test_the_mean_is_the_models_own_step_under_the_load() -> None:
    p, x = vector(("coulomb_friction",), ks=0.4), state(20.0, load=0.5)
    after = predict_state(p, NOISE, x, held(5.0), 0.0, 0.02)
    alone = advance(add_load(p, 0.5), 5.0, x.estimate.motor, 0.0, 0.02)
    assert after.estimate.motor == alone
    assert alone.speed < advance(p, 5.0, x.estimate.motor, 0.0, 0.02).speed - 1.0
    assert after.elapsed == after.history.edge.since == 0.02
    assert p[0] == vector(("coulomb_friction",), ks=0.4)[0]


def test_the_covariance_is_that_of_many_noisy_motors() -> None:
    """20,000 motors in small steps, each with a wandering load and white torque."""
    rng, dt, steps, count = np.random.default_rng(1), 5e-5, 100, 20_000
    speed, angle, load = (np.zeros(count) for _ in range(3))
    for _ in range(steps):
        load += np.sqrt(NOISE.walk * dt) * rng.standard_normal(count)
        torque = load + np.sqrt(NOISE.shake / dt) * rng.standard_normal(count)
        angle += 0.5 * speed * dt
        speed += -dt * (KV * speed + torque) / KA
        angle += 0.5 * speed * dt
    c = predict_covariance(vector(), NOISE, Covariance(0.0, 0.0, 0.0, 0.0, 0.0, 0.0), 5.0, 60.0, dt * steps)
    assert np.var(speed) == pytest.approx(c.ss, rel=0.1)  # damping within the step is left out of the noise
    assert np.var(angle) == pytest.approx(c.aa, rel=0.1)
    assert np.var(load) == pytest.approx(c.ll, rel=0.05)
    assert np.mean(speed * load) == pytest.approx(c.sl, rel=0.1)
    assert np.mean(speed * angle) == pytest.approx(c.as_, rel=0.1)


def test_prediction_in_two_pieces_is_the_same() -> None:
    p, x = vector(), state(30.0)
    whole = predict_state(p, NOISE, x, held(2.0), 0.0, 0.005).estimate
    half = predict_state(p, NOISE, x, held(2.0), 0.0, 0.002)
    parts = predict_state(p, NOISE, half, held(2.0), 0.002, 0.005).estimate
    assert parts.motor.speed == pytest.approx(whole.motor.speed, rel=1e-12)
    assert tuple(parts.covariance) == pytest.approx(tuple(whole.covariance), rel=0.02)


def test_a_command_acts_after_the_delay() -> None:
    p = vector(("transport_delay",), delay=0.017)
    commands = Commands(np.array([0.0, -0.01, -0.03]), np.array([3.0, 2.0, 1.0]))
    assert [find_acting_voltage(p, commands, t) for t in (0.0, 0.008, 0.018)] == [1.0, 2.0, 3.0]
    after = predict_state(p, NOISE, state(0.0), commands, 0.0, 0.025).estimate.motor
    s = state(0.0).estimate.motor
    for voltage, span in ((1.0, 0.007), (2.0, 0.01), (3.0, 0.008)):
        s = advance(p, voltage, s, 0.0, span)
    assert after.speed == pytest.approx(s.speed, rel=1e-12)


def test_a_motor_that_stands_against_its_model_stays_and_its_load_grows_uncertain() -> None:
    x = state(0.0)
    h = x.history
    stands = x._replace(history=History(h.edge, h.silence._replace(stands=True), h.consistency, 0.0, 0.0))
    after = predict_state(vector(), NOISE, stands, held(5.0), 0.0, 1.0).estimate
    assert after.motor.speed == 0.0 and after.covariance.ss == 0.0
    assert after.covariance.ll == pytest.approx(CERTAIN.ll + NOISE.walk)
