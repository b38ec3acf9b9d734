"""Curves and what they make of a motion: hats add up to one, responses are those of the motor's equation."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter

from motor_identification.discrepancy.free_curves import FAMILIES, OF_ONE_RECORDING, hats, measure_reach, respond
from motor_identification.discrepancy.motion_history import LAGS, MotionHistory
from motor_identification.noise.error_model import Lag

RATE, KA, STEP, COUNT = 12.0, 0.0055, 1e-3, 3000


def history(speed: np.ndarray | None = None) -> MotionHistory:
    """Three seconds in segments of a millisecond, each an interval."""
    random = np.random.default_rng(1)
    time = STEP * (np.arange(COUNT) + 0.5)
    shaft = 100.0 * np.sin(5.0 * time) if speed is None else speed
    voltage = 8.0 * np.sign(np.cos(5.0 * time))
    index = np.arange(COUNT)
    return MotionHistory(
        time, np.full(COUNT, STEP), np.zeros(COUNT, dtype=bool), shaft, voltage, voltage - 0.07 * shaft,
        np.cumsum(shaft) * STEP, random.uniform(0.0, 1.0, COUNT), random.uniform(0.0, 5.0, COUNT),
        np.zeros((COUNT, LAGS)), index, index + 1,
    )  # fmt: skip


def test_hats_add_up_to_one_and_stay_within() -> None:
    values = np.linspace(-3.0, 3.0, 101)
    each = hats(values, np.array([-2.0, -0.5, 0.0, 1.0, 2.0]))
    assert np.allclose(each.sum(axis=1), 1.0)
    assert each.min() >= 0.0
    assert np.allclose(each[np.argmin(np.abs(values - 1.0))], [0.0, 0.0, 0.0, 1.0, 0.0], atol=0.05)


def test_hats_are_what_interpolation_between_knots_gives() -> None:
    random = np.random.default_rng(2)
    for knots in (np.linspace(-3.0, 3.0, 25), np.append(0.0, np.geomspace(0.01, 1.0, 12))):
        values = np.concatenate([random.uniform(knots[0] - 1.0, knots[-1] + 1.0, 500), knots, [np.inf, -np.inf]])
        expected = np.stack([np.interp(values, knots, unit) for unit in np.eye(len(knots))], axis=1)
        assert np.array_equal(hats(values, knots), expected)


def test_a_response_is_the_lag_of_the_motor() -> None:
    torque = np.where(np.arange(COUNT) < 1000, 0.5, -0.2)
    travel = respond(history(), torque[:, None], Lag(RATE, KA))[0]
    decay = np.exp(-RATE * STEP)
    speed = lfilter([1.0 - decay], [1.0, -decay], torque / (KA * RATE))
    exact = STEP * 0.5 * (speed + np.append(0.0, speed[:-1]))
    assert np.abs(travel - exact).max() < 1e-4 * np.abs(exact).max()


def test_a_standing_motor_does_not_respond() -> None:
    still = np.zeros(COUNT, dtype=bool)
    still[500:800] = True
    travel = respond(replace(history(), still=still), np.ones((COUNT, 1)), Lag(RATE, KA))[0]
    assert np.all(travel[500:800] == 0.0)
    assert 0.0 < travel[800] < 0.01 * travel[499]


@pytest.mark.parametrize("name", FAMILIES)
def test_families_have_finite_columns_of_one_volt(name: str) -> None:
    motion = history()
    reach = replace(measure_reach([motion], 0.1), lines=(1.0, 3.0, 7.0))
    columns = FAMILIES[name](motion, reach)
    assert len(columns) == COUNT and np.all(np.isfinite(columns))
    assert np.abs(columns).max() <= 1.0 + 1e-12


def test_friction_is_a_curve_over_the_speed() -> None:
    motion = history()
    columns = FAMILIES["speed"](motion, measure_reach([motion], 0.1))
    friction = np.sign(motion.speed)
    knots = np.linalg.lstsq(columns, friction, rcond=None)[0]
    assert np.abs(columns @ knots - friction).max() < 1e-9


def test_what_belongs_to_a_recording_is_learnt_there() -> None:
    assert set(OF_ONE_RECORDING) < set(FAMILIES)


def test_the_past_is_told_in_time_constants_and_angles_of_the_motor() -> None:
    """The same motion in other seconds and radians has the same columns; a slower motor's curve reaches further."""
    motion = history()
    time, angle = 25.0, 0.02
    other = replace(
        motion,
        duration=motion.duration * time,
        speed=motion.speed * angle / time,
        since=motion.since * time,
        travel=motion.travel * angle,
    )
    columns = [
        FAMILIES["past"](one, measure_reach([one], time)) for one, time in ((motion, 0.1), (other, 2.5), (motion, 2.5))
    ]
    assert np.allclose(columns[0], columns[1], atol=1e-9) and not np.allclose(columns[0], columns[2], atol=0.1)
