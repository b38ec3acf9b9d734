"""What `tune` predicts is what a simulated motor does: steps, margins and swings, each held from both sides."""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import pytest
from tiers import mark_slow

from motor_control.controller import controller, pi
from motor_control.tuning.design import Tuning, Wish, tune
from motor_control.tuning.linear_loop import Gains, Plant, open_loop, plant_of, sampled
from motor_control.tuning.margins import Margins, margins_of
from motor_control.tuning.measured_speed import Measured
from motor_control.tuning.speed_feedback import Encoder
from motor_control.tuning.step_response import respond, small_step
from motor_model.errors import MotorError
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters, paper_motor
from motor_model.sensing.board import BoardConfig, SimulatedBoard
from motor_model.simulate import simulate

if TYPE_CHECKING:
    import control

Floats = np.ndarray[tuple[int], np.dtype[np.float64]]
BOUNDLESS = 1e7  # [V] a motor without a voltage limit is linear
PLANTS = [  # sample rate [Hz], delay [s], inductance's lag [s]
    (200.0, 0.0, 0.0),
    (200.0, 0.0073, 0.0),
    (1000.0, 0.0025, 0.0),
    (500.0, 0.0013, 0.004),
]


def motor(delay: float = 0.0, lag: float = 0.0, max_voltage: float = BOUNDLESS) -> Parameters:
    effects = {"transport_delay": {"delay": delay}, "armature_inductance": {"electrical_time_constant": lag}}
    values = {"kv": PAPER_KV, "ka": PAPER_KA, **effects["transport_delay"], **effects["armature_inductance"]}
    return Parameters(values, tuple(effects), max_voltage)


def close(parameters: Parameters, gains: Gains, rate: float, duration: float, reference: float = 50.0) -> Floats:
    """The true speed at every sample, where the law is told exactly that."""
    limit = parameters.max_voltage
    config = controller.Config(pi.Config(gains.kp, gains.ki, limit), limit, 0.1, 0.0, 10.0, single_channel=False)
    board, state, voltage = SimulatedBoard(parameters, BoardConfig(sample_rate=rate)), controller.State(), 0.0
    speeds = []
    for k in range(round(duration * rate)):
        sample = board.sample(voltage)
        speeds.append(board.speed)
        told = replace(sample, speed=board.speed)
        output, state = controller.update(config, state, told, reference, k / rate)
        voltage = output.terms.voltage
    return np.array(speeds)


def margins(plant: Plant, gains: Gains) -> Margins:
    return margins_of(lambda z: open_loop(plant, gains, z), plant.sample_period, plant.late)


def growth(speeds: Floats, reference: float = 50.0) -> float:
    """How much wider the swings of the last third are than those of the third before."""
    third = len(speeds) // 3
    before, after = speeds[third : 2 * third], speeds[2 * third :]
    return float(np.abs(after - reference).max() / np.abs(before - reference).max())


def fast_gains(plant: Plant) -> Gains:
    kp = 0.5 * plant.ka / plant.late
    return Gains(kp, kp * plant.kv / plant.ka)


@pytest.mark.parametrize(("rate", "delay", "lag"), PLANTS)
def test_the_sampled_motor_is_the_motor(rate: float, delay: float, lag: float) -> None:
    parameters, count = motor(delay, lag, 12.0), 200
    voltage = np.random.default_rng(1).uniform(1.0, 11.0, count)
    time = np.arange(count) / rate
    exact = simulate(parameters, time + 1.0 / rate, voltage, time).speed  # latched at the sample after
    linear, x = sampled(plant_of(parameters, 1.0 / rate)), np.zeros(1 + (lag > 0.0))
    before = np.concatenate([np.zeros(linear.whole + 1), voltage])
    for k in range(count):
        assert x[0] == pytest.approx(exact[k], abs=1e-7)
        x = linear.phi @ x + linear.old * before[k] + linear.new * before[k + 1]
    assert exact.max() > 20.0


@pytest.mark.parametrize(("rate", "delay", "lag"), PLANTS)
def test_the_predicted_step_is_the_step(rate: float, delay: float, lag: float) -> None:
    parameters = motor(delay, lag, 12.0)
    plant = plant_of(parameters, 1.0 / rate)
    gains = fast_gains(plant)
    predicted = respond(plant, gains, 100.0, 0.4, -12.0, 12.0)
    speeds = close(parameters, gains, rate, 0.4, 100.0)
    assert predicted.speed[: len(speeds)] == pytest.approx(speeds, abs=1e-5)
    assert speeds[-1] == pytest.approx(100.0, rel=0.02)


def state_space(plant: Plant, gains: Gains) -> "control.StateSpace":
    """The open loop as python-control holds it: the motor, the voltages on their way, the law."""
    import control  # a second of imports, which every worker of the tests would take

    motor = sampled(plant)
    size, states = len(motor.new), len(motor.new) + motor.whole + 1
    a, b = np.zeros((states, states)), np.zeros(states)
    a[:size, :size], a[:size, -1], a[:size, -2] = motor.phi, motor.old, motor.new
    a[size + 1 :, size:-1] = np.eye(motor.whole)
    b[size] = 1.0
    step = gains.ki * plant.sample_period
    speed = control.ss(a, b[:, None], np.eye(states)[:1], [[0.0]], plant.sample_period)
    return speed * control.ss([[1.0]], [[1.0]], [[step]], [[gains.kp + step]], plant.sample_period)


@pytest.mark.parametrize(("rate", "delay", "lag"), PLANTS)
def test_python_control_agrees(rate: float, delay: float, lag: float) -> None:
    plant = plant_of(motor(delay, lag), 1.0 / rate)
    gains = fast_gains(plant)
    loop, ours = state_space(plant, gains), small_step(plant, gains, 0.0)
    z = np.exp(1j * np.array([1e-3, 0.1, 1.0, 3.0]))
    assert open_loop(plant, gains, z) == pytest.approx(loop(z), rel=1e-6)
    import control

    theirs = control.step_response(control.feedback(loop, 1), ours.time)
    assert ours.speed == pytest.approx(np.squeeze(theirs.outputs), abs=1e-9)
    assert 0.02 < ours.overshoot < 0.08
    gain, phase, _, _, crossover, _ = control.stability_margins(loop, method="frd")
    assert margins(plant, gains).gain == pytest.approx(gain, rel=1e-5)
    assert margins(plant, gains).phase == pytest.approx(phase, rel=1e-5)
    assert margins(plant, gains).delay == pytest.approx(np.radians(phase) / crossover, rel=1e-5)


@pytest.mark.parametrize(("rate", "delay", "lag"), PLANTS)
@pytest.mark.parametrize("share", [0.97, 1.03])
def test_gain_margin(rate: float, delay: float, lag: float, share: float) -> None:
    parameters = motor(delay, lag)
    plant = plant_of(parameters, 1.0 / rate)
    gains = fast_gains(plant)
    factor = share * margins(plant, gains).gain
    speeds = close(parameters, Gains(factor * gains.kp, factor * gains.ki), rate, 120.0 * plant.late)
    assert (growth(speeds) > 1.1) if share > 1.0 else (growth(speeds) < 0.9)


@pytest.mark.parametrize(("rate", "delay", "lag"), PLANTS)
@pytest.mark.parametrize("share", [0.95, 1.05])
def test_delay_margin(rate: float, delay: float, lag: float, share: float) -> None:
    plant = plant_of(motor(delay, lag), 1.0 / rate)
    gains = fast_gains(plant)
    later = motor(delay + share * margins(plant, gains).delay, lag)
    speeds = close(later, gains, rate, 240.0 * plant.late)
    assert (growth(speeds) > 1.1) if share > 1.0 else (growth(speeds) < 0.9)


def measured(wish: Wish, encoder: Encoder | None = None) -> Tuning:
    return tune(paper_motor(), encoder or Encoder(), wish)


def run(tuning: Tuning, references: tuple[float, ...], seed: int, hold: float = 1.0) -> Floats:
    """The true speed while each reference [rad/s] in turn is held by the controller with the encoder's speed."""
    encoder, rate = tuning.sight.encoder, 1.0 / tuning.wish.sample_period
    config = BoardConfig(
        sample_rate=rate,
        edges_per_revolution=encoder.edges_per_revolution,
        slot_irregularity=encoder.slot_irregularity,
        seed=seed,
    )
    law = pi.Config(tuning.gains.kp, tuning.gains.ki, 12.0)
    settings = controller.Config(law, 12.0, 0.1, 0.0, 10.0)
    board, state, voltage, speeds = SimulatedBoard(paper_motor(), config), controller.State(), 0.0, []
    for k in range(round(len(references) * hold * rate)):
        sample = board.sample(voltage)
        speeds.append(board.speed)
        reference = references[int(k / rate / hold + 1e-9)]
        output, state = controller.update(settings, state, sample, reference, k / rate)
        voltage = output.terms.voltage
    return np.array(speeds)


@pytest.mark.parametrize(("rate", "speed"), [(200.0, 10.0), (200.0, 100.0), mark_slow(1000.0, 30.0)])
def test_the_disc_makes_the_shaft_swing_as_predicted(rate: float, speed: float) -> None:
    bare, sight = plant_of(paper_motor(), 1.0 / rate), Measured(Encoder())
    gains = fast_gains(sight.plant(bare, 10.0))
    swing = sight.ripple(bare, gains, speed)
    tuning = replace(measured(Wish(1.0 / rate, 10.0)), gains=gains)
    seen = [np.ptp(run(tuning, (speed,), seed, 1.0)[-round(0.5 * rate) :]) / speed for seed in range(4)]
    assert 0.65 < np.median(seen) / swing.speed < 1.35
    assert 0.006 < swing.speed < 0.03 and 0.07 < swing.reported < 0.08


def test_a_perfect_disc_leaves_the_timer() -> None:
    bare, gains = plant_of(paper_motor(), 0.005), Gains(0.2, 2.5)
    perfect, usual, rough = (
        Measured(Encoder(slot_irregularity=share)).ripple(bare, gains, 100.0).speed for share in (0.0, 0.01, 0.02)
    )
    assert 0.01 < perfect / usual < 0.2
    assert rough == pytest.approx(2.0 * usual, rel=0.02)


@pytest.mark.parametrize(("rate", "wanted"), [(200.0, 0.06), mark_slow(1000.0, 0.035)])
def test_the_wished_time_constant_is_what_the_shaft_has(rate: float, wanted: float) -> None:
    """A step from 40 to 44 rad/s, with the real encoder; the period method's lag there is below the 10 rad/s' one."""
    tuning = measured(Wish(1.0 / rate, 40.0, wanted), Encoder(slot_irregularity=0.0))
    assert tuning.time_constant == pytest.approx(wanted, rel=1e-3)
    speeds = [run(tuning, (40.0, 44.0), seed, 0.6)[round(0.6 * rate) :] for seed in range(2)]
    risen = np.mean([np.flatnonzero(s > 40.0 + 0.632 * 4.0)[0] / rate for s in speeds])
    assert 0.85 < risen / wanted < 1.2
    assert tuning.gains.ki / tuning.gains.kp == pytest.approx(PAPER_KV / PAPER_KA, rel=1e-9)


def test_the_fastest_has_the_margins_of_the_rule() -> None:
    for period in (0.005, 0.001):
        margins = measured(Wish(period, 10.0, oscillation=0.5)).margins
        assert 2.8 < margins.gain < 3.3 and 9.0 < margins.gain_db < 10.4
        assert 58.0 < margins.phase < 64.0
        late = Measured(Encoder()).plant(plant_of(paper_motor(), period), 10.0).late
        assert 1.9 < margins.delay / late < 2.3


def test_bounds() -> None:
    slow, fast = measured(Wish(0.005, 10.0)), measured(Wish(0.001, 10.0))
    sampling, lag, swing = (bound.time_constant for bound in slow.bounds)
    assert 0.013 < sampling < 0.016 < lag < 0.025 < swing < 0.04
    assert slow.time_constant == pytest.approx(swing, rel=1e-6) and fast.time_constant < 0.5 * slow.time_constant
    assert max(ripple.speed for _, ripple in slow.ripples) == pytest.approx(0.02, rel=0.01)
    coarse = measured(Wish(0.005, 10.0), Encoder(edges_per_revolution=24))
    assert 1.5 < coarse.bounds[1].time_constant / lag < 3.0
    delayed = tune(motor(0.02, max_voltage=12.0), Encoder(), Wish(0.005, 10.0))
    assert 0.02 < delayed.bounds[0].time_constant - sampling < 0.05


def test_a_stronger_direction_sets_the_gain() -> None:
    values = {"kv": PAPER_KV, "ka": PAPER_KA, "reverse_gain": 1.25}
    strong = tune(Parameters(values, ("direction_asymmetry",)), Encoder(), Wish(oscillation=0.5))
    plain = measured(Wish(oscillation=0.5))
    assert strong.gains.kp == pytest.approx(plain.gains.kp / 1.25, rel=1e-9)
    assert strong.margins.gain == pytest.approx(plain.margins.gain, rel=0.01)


@pytest.mark.parametrize(
    ("wish", "encoder", "words"),
    [
        (
            Wish(0.005, 10.0, 0.01),
            Encoder(),
            "The total delay is 14 ms .*sampling 7.5, encoder 6.54.* ask for 22.8 ms or more",
        ),
        (Wish(0.005, 10.0, 1e4), Encoder(), "1e\\+04 s is too long for this law: ask for 28.1 s or less"),
        (Wish(lowest_speed=170.0), Encoder(), "lowest speed is 170 rad/s: give one above 0 and below 157"),
        (Wish(lowest_speed=float("nan")), Encoder(), "lowest speed is nan"),
        (Wish(oscillation=1e-7), Encoder(), "No gains keep the speed ripple below 1e-05 %"),
        (Wish(sample_period=0.0), Encoder(), "sample_period = 0 does not work"),
    ],
)
def test_refusals(wish: Wish, encoder: Encoder, words: str) -> None:
    with pytest.raises(MotorError, match=words):
        tune(paper_motor(), encoder, wish)


@pytest.mark.parametrize("changes", [{"edges_per_revolution": 0}, {"slot_irregularity": -0.1}])
def test_impossible_encoders(changes: dict[str, float]) -> None:
    with pytest.raises(MotorError, match=next(iter(changes))):
        Encoder(**changes)  # type: ignore[arg-type]
