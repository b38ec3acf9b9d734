"""The speed that samples report: its size, its bound, its zero, and a sign that does not go wrong when it matters."""

from fractions import Fraction
from math import tau

import numpy as np
import pytest

from motor_model.gearing.gear import edge_angle
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.sensing.board import POWER_UP, BoardConfig, SimulatedBoard
from motor_model.sensing.speed_rule import (
    PATIENCE,
    STANDSTILL,
    SpeedState,
    single_channel_speed,
    speed_magnitude,
)

SLOT = tau / 96
BASE = {"kv": PAPER_KV, "ka": PAPER_KA}
MS = 1_000_000  # [ns]
NOW = 5_000 * MS


def test_a_slot_is_a_turn_over_its_edges() -> None:
    assert edge_angle(96, Fraction(1)) == pytest.approx(0.0654498469, rel=1e-9)


@pytest.mark.parametrize(
    ("since", "period", "speed"),
    [
        (0, 0.002, SLOT / 0.002),
        (1 * MS, 0.002, SLOT / 0.002),  # a fresh edge: the period
        (2 * MS, 0.002, SLOT / 0.002),
        (4 * MS, 0.002, SLOT / 0.004),  # none came since: it cannot be faster than this
        (50 * MS, 0.002, SLOT / 0.05),
        (STANDSTILL - 1, 0.002, SLOT / 0.1),
        (STANDSTILL, 0.002, 0.0),  # 0.1 s: a standstill
        (STANDSTILL + 1, 0.002, 0.0),
        (1 * MS, 0.3, SLOT / 0.3),  # the first edge after a standstill
        (1 * MS, 0.0, 0.0),  # before the second edge
        (-1, 0.002, SLOT / 0.002),  # a stamp rounded up past the sample
    ],
)
def test_size_of_the_speed(since: int, period: float, speed: float) -> None:
    assert speed_magnitude(SLOT, NOW, NOW - since, period) == pytest.approx(speed, rel=1e-6)


def test_before_the_first_edge_there_is_no_speed() -> None:
    assert speed_magnitude(SLOT, 50 * MS, 0, 0.002) == 0.0


def signs(steps: list[tuple[float, float]], state: SpeedState | None = None, period: int = 5 * MS) -> list[float]:
    """The signs that the rule gives at samples of (magnitude [rad/s], voltage [V])."""
    state = state or SpeedState()
    found = []
    for k, (magnitude, voltage) in enumerate(steps):
        speed, state = single_channel_speed(state, magnitude, voltage, NOW + k * period)
        assert abs(speed) == magnitude
        found.append(float(np.sign(speed)))
    return found


def test_motion_from_rest_goes_where_the_latest_voltage_pushed() -> None:
    assert signs([(0, 5), (10, 5)]) == [0, 1]
    assert signs([(0, -5), (10, -5)]) == [0, -1]
    assert signs([(0, -5), (0, 0), (10, 0)]) == [0, 0, -1]
    assert signs([(0, -5), (10, 5)]) == [0, -1]  # what this sample latches has not acted yet
    assert signs([(0, -5), (0, 5), (10, 5)]) == [0, 0, 1]


def test_a_voltage_against_the_motion_does_not_turn_the_sign() -> None:
    falling = [(100.0 * 0.9**k, -12.0) for k in range(12)]
    assert signs([(0, 5), (100, 5), *falling]) == [0, 1] + [1] * 12


def test_a_speed_that_rises_again_under_the_reversed_voltage_has_passed_zero() -> None:
    dip = [(m, -12.0) for m in (100, 60, 30, 10, 4, 12, 30, 60)]
    assert signs([(0, 5), (100, 5), *dip]) == [0, 1] + [1, 1, 1, 1, 1] + [-1, -1, -1]
    mirrored = [(m, -u) for m, u in dip]
    assert signs([(0, -5), (100, -5), *mirrored]) == [0, -1] + [-1, -1, -1, -1, -1] + [1, 1, 1]


def test_irregular_slots_do_not_look_like_a_reversal() -> None:
    """±4 % in the period, while a voltage brakes a motor that hardly slows down."""
    random = np.random.default_rng(0)
    wobbling = [(float(100.0 * (1.0 + 0.04 * random.uniform(-1, 1))), -0.5) for _ in range(300)]
    assert set(signs([(0, 5), (100, 5), *wobbling])[1:]) == {1.0}


def test_a_voltage_that_turns_back_clears_the_suspicion() -> None:
    steps = [(0, 5), (100, 5), (100, -12), (60, -12), (45, 5), (45, 5), (70, 5), (100, 5)]
    assert signs(steps) == [0, 1, 1, 1, 1, 1, 1, 1]


def test_any_clear_rise_tells_once_a_bridge_cannot_be_late_any_more() -> None:
    """Early rises need a dip below half; after `PATIENCE` a rise by a fifth is enough."""
    early = [(0, 5), (20, 5), (20, -5), (20, -5), (17, -5), (21, -5)]
    assert signs(early)[-1] == 1
    late = [(0, 5), (20, 5), (20, -5), (18, -5), *[(18, -5)] * (PATIENCE // (5 * MS)), (24, -5)]
    assert signs(late)[-1] == -1


def board_run(
    volts: list[float], parameters: Parameters | None = None, **config: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Reported speeds, true speeds, and the time since the latest edge [s]."""
    board = SimulatedBoard(parameters or Parameters(BASE), BoardConfig(**config))  # type: ignore[arg-type]
    samples, truth = [], []
    for voltage in volts:
        samples.append(board.sample(voltage))
        truth.append(board.speed)
    since = np.array([(s.sample_time - (s.edge_time or POWER_UP)) * 1e-9 for s in samples])
    return np.array([sample.speed for sample in samples]), np.array(truth), since


FRICTION = Parameters(BASE | {"ks": 0.5}, ("coulomb_friction",))
LATE = Parameters(BASE | {"ks": 0.5, "delay": 0.003}, ("coulomb_friction", "transport_delay"))
DELAYED = Parameters(BASE | {"ks": 0.5, "delay": 0.012}, ("coulomb_friction", "transport_delay"))


@pytest.mark.parametrize("irregularity", [0.0, 0.01])
@pytest.mark.parametrize("parameters", [Parameters(BASE), FRICTION, LATE], ids=["base", "friction", "delay"])
@pytest.mark.parametrize("braking", [-0.5, -3.0, -12.0])
def test_braking_from_100_to_40_rad_per_s_never_turns_the_sign(
    parameters: Parameters, braking: float, irregularity: float
) -> None:
    """What a controller does on a step down: full voltage against the motion until it is slow enough, then along."""
    for seed in range(6):
        board = SimulatedBoard(parameters, BoardConfig(seed=seed, slot_irregularity=irregularity))
        reported, volts = [], 7.4
        for k in range(500):
            sample = board.sample(volts)
            reported.append(sample.speed)
            assert board.speed >= 0.0  # it never really turned
            if k >= 200:
                volts = braking if sample.speed > 40.0 else 3.3
        assert min(reported) >= 0.0
        assert 90.0 < max(reported) < 115.0
        assert 30.0 < np.mean(reported[-100:]) < 55.0


@pytest.mark.parametrize("parameters", [Parameters(BASE), FRICTION, DELAYED], ids=["base", "friction", "delay"])
@pytest.mark.parametrize("volts", [3.0, 6.0, 12.0])
def test_after_a_hard_reversal_the_sign_is_late_by_a_few_samples_and_never_early(
    parameters: Parameters, volts: float
) -> None:
    late = []
    for seed in range(10):
        speed, truth, _ = board_run([volts] * 150 + [-volts] * 150, parameters, seed=seed)
        wrong = np.flatnonzero(np.sign(speed) * np.sign(truth) < 0)
        assert np.all(truth[wrong] < 0.0)  # the old sign while it already turns the other way, never the new one early
        assert len(wrong) == 0 or np.all(np.diff(wrong) == 1)
        late.append(len(wrong))
        assert speed[-1] == pytest.approx(truth[-1], rel=0.01) and truth[-1] < -20.0
    assert max(late) <= 6 and max(late) >= 1  # samples of 5 ms
    assert np.max(np.abs(truth)) > 30.0


def test_no_report_is_above_the_bound_of_the_time_without_an_edge() -> None:
    volts = [12.0] * 100 + [0.0] * 300 + [-1.0] * 100 + [-0.2] * 200
    speed, truth, since = board_run(volts, FRICTION, seed=2)
    assert np.all(np.abs(speed) <= SLOT / np.maximum(since, 1e-9) + 1e-9)
    assert np.all(speed[since >= 0.1] == 0.0)
    still = np.flatnonzero(truth[100:] == 0.0)[0] + 100
    zero = np.flatnonzero(speed[100:] == 0.0)[0] + 100
    assert 10 <= zero - still <= 20  # 0.1 s after the last edge, which came a little before the stop


def test_from_rest_to_speed_the_report_follows_within_a_slot() -> None:
    """The mean over the latest slot is as old as half of it; so the error is bounded by acceleration × slot time."""
    speed, truth, _ = board_run([10.0] * 200, seed=1)
    moving = slice(8, None)
    assert np.all(speed[moving] <= 1.01 * truth[moving])  # two ticks of 4 µs in a period of 450 µs
    assert np.all(truth[moving] - speed[moving] < 12.0)
    assert abs(speed[-1] / truth[-1] - 1.0) < 0.01


def test_two_channels_are_not_subject_to_the_rule() -> None:
    speed, truth, _ = board_run([6.0] * 150 + [-6.0] * 150, seed=0, single_channel=False)
    wrong = np.flatnonzero(np.sign(speed) * np.sign(truth) < 0)
    assert len(wrong) <= 3  # between the turn and the first edge after it
    assert speed[-1] < -50.0
