"""The age of a sample from two clocks: it shows a lag, forgives a drift, and begins anew with the plant."""

import numpy as np
import pytest
from bench_board import DEFAULTS, motor
from tiers import keep_fast

from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_control.controller.timing.latency import DRIFT, MOST, Echo, LatencyState, follow_echo, track_latency
from motor_model.sample import Sample
from motor_model.sensing.board import BoardConfig, SimulatedBoard


def ages(arrivals: list[float], rate: float = 200.0, offset: float = 7.0, pace: float = 1.0) -> list[float]:
    """Samples each 1/rate on a clock that runs `pace` as fast as ours, answered so late [s]."""
    state: LatencyState | None = None
    found = []
    for k, late in enumerate(arrivals):
        age, state = track_latency(state, round(k / rate * pace * 1e9), offset + k / rate + late)
        found.append(age)
    return found


def test_a_lag_shows_in_full() -> None:
    found = ages([0.001] * 200 + [0.1] * 20)
    assert max(found[:200]) < 1e-6 and found[200] == pytest.approx(0.099, abs=2e-3)
    assert found[-1] == pytest.approx(0.098 - DRIFT * 19 / 200, abs=1e-4)


def test_ordinary_jitter_is_its_own_size() -> None:
    late = np.random.default_rng(1).exponential(0.001, 2000)
    found = np.array(ages(list(late)))
    assert found == pytest.approx(late, abs=1.5e-3) and found.min() >= 0.0


@pytest.mark.parametrize("pace", [0.995, 1.0, 1.005])
def test_a_clock_with_a_ceramic_resonator_is_not_late(pace: float) -> None:
    assert max(ages([0.001] * 20_000, pace=pace)) < 1e-6


def test_a_restarted_plant_has_a_new_clock() -> None:
    _, state = track_latency(None, 10**9, 5.0)
    age, state = track_latency(state, 0, 6.0)
    assert age == 0.0 and track_latency(state, 5_000_000, 6.015)[0] == pytest.approx(0.01, abs=1e-3)


@pytest.mark.parametrize(("pause", "late"), [(0.3, True), (0.5, False), (3600.0, False)])
def test_a_plant_whose_clock_stood_still_is_not_late_for_ever(pause: float, late: bool) -> None:
    """A simulation that was held up, a computer that slept: samples pause, and their clock with them."""
    _, state = track_latency(None, 0, 5.0)
    age, state = track_latency(state, 5_000_000, 5.005 + pause)
    assert (age > 0.5 * pause) == late
    assert (track_latency(state, 10_000_000, 5.01 + pause)[0] > 0.05) == late


@pytest.mark.parametrize("rate", [200.0, 1000.0])
def test_a_loop_that_was_held_up_does_not_swing(rate: float) -> None:
    """Held up for 30 ms, a late sample answered, held up for 60 ms: it got 0 V, and was 23 % too fast after that."""
    board = BoardConfig(sample_rate=rate)
    simulated, config = SimulatedBoard(motor(), board), config_of(DEFAULTS, board.info(motor()))
    state, voltage, waiting, stay = controller.State(), 0.0, round(0.03 * rate), round(0.09 * rate)
    speeds, reasons, late = [], [], Sample(0, 0.0, 0.0)
    for k in range(round(2.0 * rate)):
        time, since, sample = k / rate, k - round(rate), simulated.sample(voltage)
        late = sample if since == 0 else late
        if since == waiting or not 0 <= since < stay:
            answered = late if since == waiting else sample
            output, state = controller.update(config, state, answered, 50.0 if k == 0 else None, time)
            voltage = output.terms.voltage
            reasons.append(output.reason)
        speeds.append(simulated.speed if since >= 0 else 50.0)
    assert set(reasons) == {""} and 47.5 < min(speeds) < max(speeds) < 52.5


def echoed(applied: list[float], asked: list[float], window: float = 0.03) -> tuple[str, float]:
    """What is said of voltages [V] applied at 200 Hz, of those asked for a sample before each; and the excess [s]."""
    echo, reason = Echo(), ""
    for k, (voltage, answer) in enumerate(zip(applied[1:], asked, strict=False)):
        sample = Sample((k + 1) * 5_000_000, 0.0, voltage)
        reason, echo = follow_echo(echo, sample, (k * 5_000_000, answer), window, 12.0)
        if reason:
            break
    return reason, echo.excess


SWING = [6.0 + 6.0 * np.sin(0.1 * k) for k in range(400)]  # a period of 0.31 s


@pytest.mark.parametrize(("late", "stops"), [(1, False), (6, False), (7, False), (16, True), (30, True)])
def test_a_voltage_that_was_asked_for_long_ago_shows_a_loop_that_is_late(late: int, stops: bool) -> None:
    applied = [0.0] * late + SWING
    reason, excess = echoed(applied, SWING)
    assert bool(reason) == stops
    assert "late (a slow link to it), or somebody else" in reason if stops else excess < 0.1 * MOST


def test_less_than_asked_for_is_no_sign_and_who_drives_the_other_way_is_one() -> None:
    """A supply that sags, a limit of the plant, an output that is off; and somebody else."""
    assert echoed([0.5 * voltage for voltage in SWING], SWING) == ("", 0.0)
    assert echoed([0.0] * 400, SWING) == ("", 0.0)
    assert "The plant applies -6 V, and no more than -0 V was asked for" in echoed([-6.0] * 400, SWING)[0]
    assert echoed([1.09 * voltage + 0.2 for voltage in [0.0, *SWING]], SWING) == ("", 0.0)


def test_who_allows_old_samples_is_not_asked_about_old_voltages() -> None:
    assert echoed([0.0] * 30 + SWING, SWING, window=0.3) == ("", 0.0)


def swing(late: float, rate: float, observed: bool) -> tuple[float, str]:
    """The speeds' range in the last second as a share of the reference, of a loop whose samples come late [s]."""
    plant = motor()
    board = BoardConfig(sample_rate=rate, slot_irregularity=0.01)
    values = DEFAULTS | ({"speed_source": "observer", "feedforward": True} if observed else {})
    config = config_of(values, board.info(plant), plant if observed else None)  # type: ignore[arg-type]
    simulated, state, command = SimulatedBoard(plant, board), controller.State(), 0.0
    waiting, speeds = [], []
    for k in range(round(4.0 * rate)):
        waiting.append(simulated.sample(command))
        speeds.append(simulated.speed)
        if len(waiting) <= late * rate:
            continue
        fresh = 87.0 if k == round(0.5 * rate) else None
        output, state = controller.update(config, state, waiting.pop(0), fresh, k / rate)
        command = output.terms.voltage
    last = speeds[-round(rate) :]
    return (max(last) - min(last)) / 87.0, state.latched


@pytest.mark.parametrize("observed", [False, True])
@pytest.mark.parametrize("rate", keep_fast([200.0, 1000.0], 200.0))
def test_a_loop_that_has_always_been_late_does_not_swing_for_ever(rate: float, observed: bool) -> None:
    """It did, from a quarter to three quarters of the top speed, and said that it was running."""
    for late in (0.0, 0.02):
        wide, stopped = swing(late, rate, observed)
        assert wide < 0.06 and stopped == ""
    for late in (0.06, 0.15):
        wide, stopped = swing(late, rate, observed)
        assert wide < 0.01 and stopped.startswith("The plant applies ")
