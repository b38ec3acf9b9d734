"""What is open of a gear's play as a recording begins: the first motion tells, whichever way it goes."""

from functools import cache

import numpy as np
import pytest
from plant import profiles, record

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.open_play import LOAD_FRACTION, OPEN, PLAY, SHARES, choose_open_play
from motor_identification.estimation.problem import Problem, make_problem
from motor_identification.recording import Floats, Recording, check
from motor_model.effects import VECTOR_NAMES
from motor_model.simulate import NOWHERE, roll_out

KV, KA, KS, GAP, FRACTION = 0.07, 0.0055, 0.5, 0.9, 0.6
MOTOR = {"kv": KV, "ka": KA, "ks": KS, "backlash_angle": GAP, "load_fraction": FRACTION}
START = 2.0  # [s] of rest, after a motion forwards


@cache
def recorded(way: float) -> Recording:
    """A motor that has turned forwards and stands when it is looked at; it begins this way, and goes to and fro."""
    time, volts = profiles.random(6.0, 9.0, 3)
    time, volts = np.concatenate([[0.0, 0.5], START + 0.2 + time]), np.concatenate([[9.0, 0.0], volts])
    volts[2:] *= way * np.sign(volts[2])
    return check(record(MOTOR, time, volts, seed=3, single_channel=False)[0].between(START, 0.0))


def problem_of(way: float) -> tuple[Problem, Floats]:
    """The problem of fitting what is in that motor, and its θ."""
    problem = make_problem([recorded(way)], ("coulomb_friction", "backlash"))
    specs = problem.unknowns.specs
    return problem, np.array([np.log(MOTOR[one.name]) if one.logarithmic else MOTOR[one.name] for one in specs])


@pytest.mark.parametrize(("way", "share"), [(1.0, 0.0), (-1.0, 1.0)])
def test_a_motor_that_begins_the_other_way_runs_alone_first(way: float, share: float) -> None:
    problem, theta = problem_of(way)
    assert problem._find_open_play(theta).tolist() == [share]
    vectors, starts = problem.unknowns.decode(theta[None])
    closed, opened = (problem._simulate(0, vectors[:, 0].copy(), starts[:, 0], one)[0] for one in SHARES[::2])
    least, most = sorted(float(np.sqrt(one**2 @ problem.weight)) for one in (closed, opened))
    assert least < 0.3 and most > 5.0 * least
    assert np.array_equal(problem.residuals(theta), opened if share else closed)
    angles, (data,) = problem.angles(theta), problem.intervals
    travel = angles[0][data.last] - angles[0][data.first]
    moving = data.slack == 0.0
    assert np.allclose((travel / data.duration - data.speed)[moving], problem.residuals(theta)[moving])


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_friction_and_play_are_found_whichever_way_a_recording_begins(way: float) -> None:
    """Of one that began against a play of 0.92 rad the first motion was off by 45 of 80 rad/s: no friction was left."""
    problem, theta = problem_of(way)
    beside = theta + np.array([0.1, -0.1, 0.2, 0.3, -0.1])
    fitted = fit_speeds(Estimate(problem, beside))
    assert np.exp(fitted.theta[:2]) == pytest.approx([KV, KA], rel=0.01)
    assert fitted.theta[2:] == pytest.approx([KS, GAP, FRACTION], rel=0.05)
    steps = problem.jacobian(fitted.theta)
    assert np.all(np.isfinite(steps)) and float(np.abs(steps).max()) < 1e4


def swarm(plays: list[float], starts: list[float]) -> tuple[Floats, Floats]:
    vectors = np.zeros((len(plays), len(VECTOR_NAMES)))
    vectors[:, PLAY], vectors[:, LOAD_FRACTION] = plays, 0.5
    return vectors, np.array(starts)


def test_the_share_that_leaves_least_is_taken_of_each_motor() -> None:
    """Half of the second one's play is open; the third turns already, and the fourth has none."""
    vectors, starts = swarm([0.3, 0.3, 0.3, 0.0], [0.0, 0.0, 5.0, 0.0])
    true, asked = np.array([0.0, 0.5, 1.0, 1.0]), []

    def simulate(some: Floats, speeds: Floats) -> Floats:
        asked.append(len(some))
        which = [0, 1, 2, 3] if len(some) == 4 else [0, 1]
        return np.outer(1.0 + np.abs(some[:, OPEN] - true[which]), np.ones(3)) + speeds[:, None]

    residuals, shares = choose_open_play(simulate, vectors, starts, np.ones(3))
    assert shares.tolist() == [0.0, 0.5, 0.0, 0.0] and asked == [4, 2, 2]
    assert residuals.tolist() == [[1.0] * 3, [1.0] * 3, [7.0] * 3, [2.0] * 3]


def test_where_no_share_leaves_less_none_is_open() -> None:
    vectors, starts = swarm([0.3], [0.0])
    _, shares = choose_open_play(lambda some, speeds: np.ones((len(some), 2)), vectors, starts, np.ones(2))
    assert shares.tolist() == [0.0]
    vectors[:, LOAD_FRACTION] = 0.0  # of which nothing hangs behind the play
    _, shares = choose_open_play(lambda some, speeds: 1.0 - some[:, [OPEN]], vectors, starts, np.ones(1))
    assert shares.tolist() == [0.0]


@pytest.mark.parametrize(("share", "begin"), [(0.0, KA), (0.5, KA * (1.0 - FRACTION)), (1.0, KA * (1.0 - FRACTION))])
def test_a_motor_accelerates_alone_while_its_play_is_open(share: float, begin: float) -> None:
    """From rest under 6 V: with its own inertia over the share of the play, and with all of it behind."""
    problem, theta = problem_of(1.0)
    vector = problem.unknowns.decode(theta[None])[0][0, 0]
    vector[OPEN] = share
    time = np.linspace(0.0, 0.1, 1001)
    angle, speed = np.empty(1001), np.empty(1001)
    roll_out(vector, 0.0, np.array([0.0]), np.array([6.0]), time, NOWHERE, angle, speed)
    acceleration, expected = np.gradient(speed, time), 6.0 - KS - KV * speed
    alone = angle < share * GAP - 0.02
    behind = angle > share * GAP + 0.02
    assert acceleration[alone][1:] == pytest.approx(expected[alone][1:] / begin, rel=0.01)
    assert acceleration[behind] == pytest.approx(expected[behind] / KA, rel=0.01) and behind.any()
