"""The loop around a motor with a single-channel encoder: it settles, does not swing and knows its direction."""

from statistics import fmean

import pytest
from bench_motor import SLOT, Plant, Trace, close_loop
from tiers import keep_fast

from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_control.controller import voltage_range as span
from motor_control.controller.controller import Config, State
from motor_control.parameters import ROWS
from motor_model.sample import Info, Sample

SEEDS = keep_fast(range(4), 0)
DEFAULTS = {row.name: row.default for row in ROWS}


def config(single_channel: bool = True, **changes: float) -> Config:
    return config_of({**DEFAULTS, **changes}, Info(single_channel=single_channel))


def drive(plant: Plant, references: tuple[float, ...], settings: Config, hold: float = 0.6) -> Trace:
    """Each reference [rad/s] in turn for `hold` [s]."""
    state = State()

    def answer(sample: Sample, time: float) -> float:
        nonlocal state
        reference = references[min(int(time / hold + 1e-9), len(references) - 1)]
        output, state = controller.update(settings, state, sample, reference, time)
        return output.terms.voltage

    return close_loop(plant, answer, hold * len(references))


def bench(seed: int, **changes: float) -> Plant:
    return Plant(seed=seed, angle=(0.1 + 0.23 * seed) * SLOT, **changes)  # type: ignore[arg-type]


def settling_time(trace: Trace, start: float, target: float, tolerance: float) -> float:
    """[s] after `start` until the true speed stays within the tolerance."""
    outside = [
        t for t, w in zip(trace.time, trace.true_speed, strict=True) if t >= start and abs(w - target) > tolerance
    ]
    return max(outside, default=start) - start


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("friction", [0.0, 0.4])
def test_a_slower_reference_is_reached_without_a_brake(seed: int, friction: float) -> None:
    trace = drive(bench(seed, ks=friction), (100.0, 40.0), config())
    assert trace.voltage_flips() == 0 and min(trace.voltages) == 0.0
    assert trace.wrong_signs() == []
    assert 0.1 < settling_time(trace, 0.6, 40.0, 1.2) < 0.3
    end = trace.since(1.0)
    assert fmean(end.true_speed) == pytest.approx(40.0, abs=0.2)
    assert max(end.true_speed) - min(end.true_speed) < 0.6


@pytest.mark.parametrize("seed", SEEDS)
def test_stop(seed: int) -> None:
    trace = drive(bench(seed), (100.0, 0.0), config())
    stopped = settling_time(trace, 0.6, 0.0, 1e-9)
    assert 0.15 < stopped < 0.4
    assert set(trace.since(0.6).voltages) == {0.0}
    assert trace.wrong_signs() == []


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("speed", [5.0, 60.0, 100.0])
def test_reversal(seed: int, speed: float) -> None:
    trace = drive(bench(seed), (speed, -speed), config())
    assert trace.voltage_flips() == 1
    # At the turning point a single channel is an edge or two late: never wrong at speed, and never for long.
    assert len(trace.wrong_signs()) * 0.005 <= 0.05
    assert trace.wrong_signs(above=30.0) == []
    assert fmean(trace.since(1.0).true_speed) == pytest.approx(-speed, rel=0.03)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(("speed", "swing"), [(3.0, 0.5), (20.0, 0.5), (100.0, 1.5)])
def test_from_rest(seed: int, speed: float, swing: float) -> None:
    trace = drive(bench(seed), (0.0, speed), config())
    assert trace.voltage_flips() == 0 and trace.wrong_signs() == []
    assert max(trace.true_speed) < speed + max(2.5, 0.03 * speed)
    end = trace.since(1.0)
    assert fmean(end.true_speed) == pytest.approx(speed, rel=0.02)
    assert max(end.true_speed) - min(end.true_speed) < swing


@pytest.mark.parametrize("seed", SEEDS)
def test_two_channels_brake_actively(seed: int) -> None:
    plant = bench(seed)
    plant.single_channel = False
    trace = drive(plant, (100.0, 20.0, -20.0), config(single_channel=False))
    assert -6.5 < min(trace.since(0.6).voltages[:5]) < -3.0  # with the back-EMF, 6.9 V, no more than 12 V
    half_way = next(
        time for time, speed in zip(trace.time, trace.true_speed, strict=True) if time > 0.6 and speed < 60.0
    )
    assert half_way - 0.6 < 0.035  # at 0 V it takes 0.04
    assert fmean(trace.since(1.7).true_speed) == pytest.approx(-20.0, rel=0.03)
    assert trace.wrong_signs(above=10.0) == []


@pytest.mark.parametrize("seed", SEEDS)
def test_a_board_that_takes_the_sign_from_the_voltage(seed: int) -> None:
    """The rule carries even that; without it the same loop swings for ever."""
    careless = {"ks": 0.4, "sign_of_voltage": True}
    gains = {"kp": 0.3, "ki": 5.0}
    ruled = drive(bench(seed, **careless), (100.0, 40.0), config(**gains))
    assert ruled.voltage_flips() == 0 and ruled.wrong_signs() == []
    assert fmean(ruled.since(1.0).true_speed) == pytest.approx(40.0, abs=0.3)
    unruled = drive(bench(seed, **careless), (100.0, 40.0), config(single_channel=False, plug_limit=2.0, **gains))
    assert unruled.voltage_flips() > 20 and len(unruled.wrong_signs()) > 20


@pytest.mark.slow
def test_a_board_that_is_slow_to_see_the_turn(monkeypatch: pytest.MonkeyPatch) -> None:
    """It needs the voltage to stay: a reversal that is broken off at `reversal_speed` leaves it wrong for 90 ms."""

    def samples_wrong(give_up: float) -> int:
        monkeypatch.setattr(span, "GIVE_UP", give_up)
        runs = [drive(bench(seed, clearly=0.4), (11.0, -20.0), config(), hold=0.4) for seed in range(8)]
        return max(len(run.wrong_signs()) for run in runs)

    assert 1 <= samples_wrong(span.GIVE_UP) <= 7
    assert samples_wrong(1.0) >= 14


@pytest.mark.parametrize("reference", [-60.0, -5.0, 5.0, 60.0])
def test_a_sign_that_is_wrong_from_the_start_mends_itself(reference: float) -> None:
    """A board that restarts while the motor turns guesses; here it guesses wrong."""
    plant = bench(1, speed=50.0)
    plant.run(0.01)
    plant.direction = -1
    trace = drive(plant, (reference,), config(), hold=1.2)
    assert trace.wrong_signs(above=10.0)[-1] < 0.3
    assert trace.voltage_flips() == 0
    assert fmean(trace.since(0.8).true_speed) == pytest.approx(reference, rel=0.05)


@pytest.mark.parametrize("load", [-0.6, 0.6])
def test_a_load_is_carried_both_ways(load: float) -> None:
    trace = drive(bench(1, load=load), (60.0, -60.0), config(), hold=1.0)
    assert fmean(trace.since(0.7).true_speed[:50]) == pytest.approx(60.0, rel=0.01)
    assert fmean(trace.since(1.7).true_speed) == pytest.approx(-60.0, rel=0.01)
    assert trace.voltage_flips() == 1


def test_rate_limit_is_followed_through_zero() -> None:
    trace = drive(bench(2), (60.0, -60.0), config(reference_rate_limit=300.0), hold=0.8)
    middle = trace.since(0.8 + 0.2)  # the reference passes zero
    assert trace.voltage_flips() == 1
    assert -25.0 < middle.true_speed[0] < 25.0
    assert fmean(trace.since(1.4).true_speed) == pytest.approx(-60.0, rel=0.03)
