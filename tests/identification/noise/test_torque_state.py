"""Estimates of a disturbed motor and their covariance, against matrices."""

import numpy as np
import pytest

from motor_identification.noise.torque_response import (
    ANGLE_D,
    ANGLE_T,
    BB,
    BD,
    BT,
    BY_T,
    DD,
    DT,
    LEFT_D,
    LEFT_T,
    RESPONSES,
    TERMS,
    TT,
    fill_response,
    fill_series,
)
from motor_identification.noise.torque_state import (
    Covariance,
    Means,
    correct,
    move,
    pass_pause,
    propagate,
    stationary_covariance,
    update,
)

ALPHA, BETA, STRENGTH = 12.0, 20.0, 700.0
NOISE = 2.0 * BETA * STRENGTH
BEFORE = Covariance(2.0, 0.3, -0.4, 5.0, 1.1, 3.0)


def respond(duration: float) -> np.ndarray:
    series, response = np.zeros((TERMS, RESPONSES)), np.zeros(RESPONSES)
    fill_series(ALPHA, BETA, series)
    fill_response(series, BETA, duration, response)
    return response


def matrix(p: Covariance) -> np.ndarray:
    return np.array([[p.bb, p.bd, p.bt], [p.bd, p.dd, p.dt], [p.bt, p.dt, p.tt]])


def transition(r: np.ndarray) -> np.ndarray:
    return np.array([[1.0, r[ANGLE_D], r[ANGLE_T]], [0.0, r[LEFT_D], r[BY_T]], [0.0, 0.0, r[LEFT_T]]])


def growth(r: np.ndarray) -> np.ndarray:
    return NOISE * np.array([[r[BB], r[BD], r[BT]], [r[BD], r[DD], r[DT]], [r[BT], r[DT], r[TT]]])


@pytest.mark.parametrize("duration", [0.002, 0.07])
def test_the_covariance_is_propagated_as_matrices_are(duration: float) -> None:
    r = respond(duration)
    expected = transition(r) @ matrix(BEFORE) @ transition(r).T + growth(r)
    assert np.allclose(matrix(propagate(BEFORE, r, NOISE)), expected, rtol=1e-12, atol=0.0)


def test_a_pause_does_to_speed_and_torque_what_an_interval_does() -> None:
    r = respond(0.05)
    after, same = pass_pause(BEFORE, r, NOISE), propagate(BEFORE, r, NOISE)
    assert after[3:] == pytest.approx(same[3:], rel=1e-12) and after[:3] == BEFORE[:3]


def test_the_stationary_state_stays() -> None:
    p = stationary_covariance(ALPHA, BETA, STRENGTH)
    assert p[:3] == (0.0, 0.0, 0.0) and p.tt == STRENGTH
    assert propagate(p, respond(0.03), NOISE)[3:] == pytest.approx(p[3:], rel=1e-12)


def test_estimates_move_as_the_transition_says() -> None:
    x = Means(np.zeros(2), np.array([0.1, -0.2]), np.array([3.0, 4.0]), np.array([50.0, -60.0]))
    before, r = np.array(x[1:]), respond(0.01)
    move(x, r)
    assert np.allclose(np.array(x[1:]), transition(r) @ before, rtol=1e-12)
    assert not x.level.any()


@pytest.mark.parametrize(("trust", "off"), [(1.0, 0.5), (0.8, 3.0)])
def test_a_mixture_of_a_regular_interval_and_one_that_says_nothing(trust: float, off: float) -> None:
    variance = BEFORE.bb + 0.7
    gain = matrix(BEFORE)[:, 0] / variance
    spread = trust * variance - trust * (1.0 - trust) * off**2  # Kalman's, where trust is 1
    after, *gains = update(BEFORE, off, variance, trust, 0.7, 9.0)
    assert np.allclose(gains, trust * gain, rtol=1e-12)
    assert np.allclose(matrix(after), matrix(BEFORE) - spread * np.outer(gain, gain), rtol=1e-12)


@pytest.mark.parametrize(("trust", "lost"), [(0.499, True), (0.501, False)])
def test_an_angle_that_jumped_is_known_from_there_on_only(trust: float, lost: bool) -> None:
    after, *gains = update(BEFORE, 4.0, BEFORE.bb + 0.7, trust, 0.7, 9.0)
    assert (gains == [1.0, 0.0, 0.0]) == lost
    assert (after == Covariance(0.7, 0.0, 0.0, 14.0, 1.1, 3.0)) == lost


def test_rows_are_corrected_by_what_each_is_off() -> None:
    x = Means(np.array([1.0, 2.0]), np.array([0.5, 0.25]), np.zeros(2), np.zeros(2))
    increments, white = np.array([[9.0, 0.5], [9.0, 0.25]]), np.full((2, 2), np.nan)
    correct(x, 1, increments, 10.0, 0.5, 2.0, -4.0, white)
    assert white[:, 1].tolist() == [10.0, 20.0] and np.isnan(white[:, 0]).all()
    assert [row.tolist() for row in x] == [[1.5, 2.25], [1.0, 1.25], [2.0, 4.0], [-4.0, -8.0]]
