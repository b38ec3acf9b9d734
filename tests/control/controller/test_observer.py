"""The observer against the true motion: error, honesty of sigma, standstill, direction, load, and nonsense."""

from dataclasses import dataclass, replace
from math import isfinite, tau

import numpy as np
import pytest
from bench_board import motor
from bench_motor import Plant
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from motor_control.controller.observer import Observer, State
from motor_control.filter.packed_state import unpack_hypotheses
from motor_model.errors import MotorError
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.sample import Info, Measurement, Sample
from motor_model.sensing.board import BoardConfig, SimulatedBoard

SLOT = tau / 96
PROFILE = ((0.2, 0.0), (0.5, 8.0), (0.5, 1.2), (0.5, -3.0), (0.4, 8.0), (0.4, -8.0), (0.4, 0.0))  # [s], [V]


@dataclass(frozen=True)
class Watch:
    """At each sample: time [s], true and observed speed, its sigma, the load, what was reported; arrays (K,)."""

    time: NDArray[np.float64]
    true: NDArray[np.float64]
    seen: NDArray[np.float64]
    sigma: NDArray[np.float64]
    load: NDArray[np.float64]
    reported: NDArray[np.float64]

    def error(self, start: float = 0.0, stop: float = 1e9) -> float:
        """RMS [rad/s]."""
        keep = (self.time >= start) & (self.time < stop)
        return float(np.sqrt(np.mean((self.seen - self.true)[keep] ** 2)))


def watch(
    plant: Parameters,
    profile: tuple[tuple[float, float], ...] = PROFILE,
    model: Parameters | None = None,
    rate: float = 200.0,
    single_channel: bool = True,
    seed: int = 3,
    told: float = 0.01,
) -> Watch:
    config = BoardConfig(sample_rate=rate, slot_irregularity=0.01, seed=seed, single_channel=single_channel)
    board = SimulatedBoard(plant, config)
    observer, state, rows = Observer(model or plant, config.info(plant), told), None, []
    for duration, voltage in profile:
        for _ in range(round(duration * rate)):
            sample = board.sample(voltage)
            state = state or observer.begin(sample, sample.speed)
            estimate, state = observer.update(state, sample)
            speed, sigma = observer.predict(state, 0.0)
            rows.append((len(rows) / rate, board.speed, speed, sigma, estimate.load, sample.speed))
    return Watch(*np.array(rows).T)


@pytest.mark.parametrize("rate", [200.0, 1000.0])
@pytest.mark.parametrize("single_channel", [True, False])
def test_the_speed_through_two_reversals_and_a_stop(rate: float, single_channel: bool) -> None:
    run = watch(motor(), rate=rate, single_channel=single_channel)
    assert 0.005 < run.error() < 0.1
    reported = float(np.sqrt(np.mean((run.reported - run.true) ** 2)))
    assert reported > 15.0 * run.error()
    assert np.sum((run.seen * run.true < 0.0) & (np.abs(run.true) > 1.0)) == 0


def test_sigma_is_honest() -> None:
    runs = [watch(motor(), rate=200.0, seed=seed) for seed in range(6)]
    scores = np.concatenate([(run.seen - run.true)[run.sigma > 1e-3] / run.sigma[run.sigma > 1e-3] for run in runs])
    assert 0.4 < np.sqrt(np.mean(scores**2)) < 1.4
    assert 0.9 < np.mean(np.abs(scores) < 2.0) <= 1.0


def test_standstill_is_zero() -> None:
    run = watch(motor())
    begin, end = run.time < 0.2, run.time > 2.8
    assert set(run.seen[begin]) == {0.0} and set(run.true[end]) == {0.0}
    assert set(run.seen[end]) == {0.0} and run.sigma[end].max() < 1e-5


@pytest.mark.parametrize("load", [0.5, -0.3])
def test_an_unknown_load_is_found_and_leaves_no_error(load: float) -> None:
    run = watch(motor(("load_bias",), bias_voltage=load), ((1.0, 5.0),), model=motor())
    late = run.time > 0.5
    assert run.load[late].mean() == pytest.approx(load, abs=0.01)
    assert abs((run.seen - run.true)[late].mean()) < 0.01


@pytest.mark.slow
def test_a_disc_worse_than_told_shows_hardly_a_jump() -> None:
    """Taken as told, its slots would be jumps of the load a tenth to a third of the time, and the error 8 times."""
    runs = [[watch(motor(), ((3.0, 1.1),), rate=1000.0, seed=s, told=told) for s in range(4)] for told in (0.01, 0.005)]
    honest, bold = ([run.error(0.6) for run in some] for some in runs)
    assert max(honest) < 0.1 and 1.0 < np.mean(bold) / np.mean(honest) < 4.0
    assert max(float(np.mean(run.sigma[run.time > 0.6] > 0.05)) for run in runs[1]) < 0.09


def test_without_friction_in_the_model_a_blocked_motor_is_seen_to_stand() -> None:
    """The model would have it turn at 7 rad/s, and no edge comes; then it is let go."""
    run = watch(motor(), ((0.5, 0.5), (0.5, 4.0)), model=Parameters({"kv": PAPER_KV, "ka": PAPER_KA}))
    waiting = run.time < 0.5
    travelled = np.cumsum(run.seen[waiting]) * 0.005
    assert np.max(run.seen[waiting]) > 1.0 and np.max(travelled) < 4.0 * SLOT
    assert set(run.seen[(run.time > 0.2) & waiting]) == {0.0}
    assert run.error(0.7) < 0.1


def test_the_delay_holds_commands_back() -> None:
    """17 ms: three samples and a bit."""
    delayed = motor(("transport_delay",), delay=0.017)
    known, unknown = watch(delayed), watch(delayed, model=motor())
    assert known.error() < 0.1 < 0.5 < unknown.error()


def test_prediction_is_for_the_instant_at_which_a_voltage_acts() -> None:
    """One sample and the delay after the sample: the estimate before equals the truth then."""
    plant = motor(("transport_delay",), delay=0.005)
    config = BoardConfig(slot_irregularity=0.01, seed=1)
    board, observer = SimulatedBoard(plant, config), Observer(plant, config.info(plant))
    state, ahead, true = None, [], []
    for _ in range(60):
        sample = board.sample(10.0)
        state = state or observer.begin(sample, sample.speed)
        estimate, state = observer.update(state, sample)
        ahead.append(estimate.speed)
        true.append(board.speed)
    errors = np.array(ahead[5:-2]) - np.array(true[7:])
    assert np.sqrt(np.mean(errors**2)) < 0.3 < np.sqrt(np.mean((np.array(ahead[5:30]) - np.array(true[5:30])) ** 2))


def test_missed_edges_are_recognised_where_the_model_has_them() -> None:
    plant = motor(("missed_edges",), miss_rate=0.02)
    run = watch(plant, ((0.4, 8.0), (0.6, 7.0)))
    assert 0.01 < run.error(0.4) < 0.3
    assert watch(plant, ((0.4, 8.0), (0.6, 7.0)), model=motor()).error(0.4) > 2.0 * run.error(0.4)


@pytest.mark.parametrize("sample_period", [0.005, 0.001])
def test_a_plant_of_other_make(sample_period: float) -> None:
    """Small fixed steps and its own encoder, written apart from the model; it turns round four times."""
    model = Parameters({"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.4}, ("coulomb_friction",))
    plant = Plant(sample_period=sample_period)
    observer = Observer(model, Info(sample_period=sample_period))
    state: State | None = None
    errors, wrong = [], 0
    for k in range(round(1.5 / sample_period)):
        plant.voltage = (8.0, -6.0, 2.0, -1.0, 0.0)[int(k * sample_period / 0.3 + 1e-9)]
        sample = plant.report()
        state = state or observer.begin(sample, sample.speed)
        _, state = observer.update(state, sample)
        speed = observer.predict(state, 0.0)[0]
        errors.append(speed - plant.speed)
        wrong += speed * plant.speed < 0.0 and abs(plant.speed) > 3.0
        plant.run(sample_period)
    assert 0.005 < np.sqrt(np.mean(np.square(errors))) < 0.15
    assert wrong == 0 and speed == plant.speed == 0.0


def test_a_wrong_direction_at_the_start_mends_itself() -> None:
    """The mirrored motion fits the next edges better; a load that explains them all takes 70 ms to be found."""
    config = BoardConfig(slot_irregularity=0.01, sample_rate=1000.0)
    board, observer = SimulatedBoard(motor(), config), Observer(motor(), config.info(motor()))
    for _ in range(300):
        sample = board.sample(5.0)
    state, speeds = observer.begin(sample, -sample.speed), []
    for _ in range(200):
        _, state = observer.update(state, board.sample(5.0))
        speeds.append(observer.predict(state, 0.0)[0])
    assert speeds[0] < -30.0 and min(speeds[40:]) > 50.0
    assert np.max(np.abs(np.array(speeds[100:]) - board.speed)) < 0.8


def test_plants_without_stamped_edges_are_refused() -> None:
    for measurement in (Measurement.COUNTS, Measurement.SPEED):
        with pytest.raises(MotorError, match="time stamps"):
            Observer(motor(), Info(measurement=measurement))
    with pytest.raises(MotorError, match="slot_irregularity"):
        Observer(motor(), Info(), -0.1)


ANY_INT = st.integers(-(2**62), 2**62)


@settings(max_examples=60, deadline=None)
@given(
    steps=st.lists(
        st.tuples(
            st.integers(0, 100_000_000),
            st.floats(-1e6, 1e6),
            st.integers(-100, 100) | ANY_INT,
            st.integers(-(10**8), 10**8) | ANY_INT,
            st.floats(-1e300, 1e300),
        ),
        min_size=1,
        max_size=25,
    ),
    speed=st.floats(-1e300, 1e300),
    single=st.booleans(),
)
def test_whatever_comes_the_estimate_is_finite(
    steps: list[tuple[int, float, int, int, float]], speed: float, single: bool
) -> None:
    plant = motor(("transport_delay", "armature_inductance"), delay=0.012, electrical_time_constant=0.002)
    observer = Observer(plant, Info(single_channel=single))
    sample = Sample(0, 0.0, 0.0)
    state = observer.begin(sample, speed)
    time = 0
    for advance, voltage, count, edge, period in steps:
        time += advance
        estimate, state = observer.update(state, Sample(time, 0.0, voltage, count, time + edge, period))
        assert isfinite(estimate.speed) and isfinite(estimate.sigma) and isfinite(estimate.load)
        assert abs(estimate.load) <= 36.0 and estimate.sigma >= 0.0
        assert abs(unpack_hypotheses(state.memory).likely.estimate.motor.speed) < 1e5


def test_update_changes_nothing_that_it_was_given() -> None:
    observer = Observer(motor(), Info())
    state = observer.begin(Sample(0, 0.0, 3.0), 0.0)
    before = [part.copy() for part in (*state.memory, *state.commands, observer.vector)]
    sample = Sample(5_000_000, 0.0, 4.0, 1, 3_000_000, 0.0)
    first, second = observer.update(state, sample), observer.update(state, sample)
    assert first[0] == second[0]
    for one, other in zip(
        (*first[1].memory, *first[1].commands), (*second[1].memory, *second[1].commands), strict=True
    ):
        assert np.array_equal(one, other)
    for now, then in zip((*state.memory, *state.commands, observer.vector), before, strict=True):
        assert np.array_equal(now, then)
    assert replace(state, sample_time=1) != state
