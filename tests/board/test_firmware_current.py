"""The real firmware on the emulated chip senses the motor's current: in every frame, in the middle of a pulse."""

from collections.abc import Callable

import numpy as np
import pytest
from electrical import ELECTRIC, LUMPED
from emulated_board import MS, TICK, Bench, on_each_chip

from motor_board.build import FirmwareConfig
from motor_board.emulation.emulator import SENSE_HELD, SENSE_NOISE
from motor_board.emulation.wiring import Wiring
from motor_driver.current_limits import CurrentLimits
from motor_driver.frames.codes import NOT_MEASURED, Flag
from motor_driver.frames.from_board import Protection, Sensed, Telemetry
from motor_driver.frames.from_host import Command
from motor_model.parameters import Parameters
from motor_model.sample import CURRENT_LAG

MakeBench = Callable[..., Bench]
SENSING = FirmwareConfig(current_sense=True, supply_full_scale=20_000)
MOTOR = Parameters(LUMPED, ("coulomb_friction",), **ELECTRIC)
PULSE = 128 * MS // 1000  # [cycle] of a PWM period
GAIN, ZERO, STEP = 0.185, 2.5, 5.0 / 1024
SUPPLY = 11_992  # [mV] of 3 V on A0, in whole steps


def watch(bench: Bench) -> list[tuple[int, float]]:
    """Cycle and true current of every conversion from now on."""
    seen: list[tuple[int, float]] = []
    inner = bench.emulator._sense

    def sense(cycle: int) -> None:
        seen.append((cycle, bench.emulator.shaft.current_at(cycle + SENSE_HELD)))
        inner(cycle)

    bench.emulator._sense = sense  # type: ignore[method-assign]
    return seen


@on_each_chip
@pytest.mark.parametrize(("decay", "period"), [(0, 10_000), (1, 2_000)])
def test_every_frame_has_the_current_before_its_tick(make_bench: MakeBench, decay: int, period: int) -> None:
    bench = make_bench(parameters=MOTOR, config=SENSING)
    bench.emulator.supply(3.0)
    bench.start(period, decay=decay)
    seen = watch(bench)
    bench.drive(128, 60)
    turned = len(seen)
    bench.drive(-192, 60)
    frames = bench.all(Telemetry)
    assert all(isinstance(frame, Sensed) and frame.current != NOT_MEASURED for frame in frames)
    assert {frame.supply for frame in frames[5:]} == {SUPPLY}  # the converter serves both
    times = np.array([frame.time for frame in frames]) * TICK + bench.chip.clock_zero
    starts = np.array([cycle for cycle, _ in seen])
    before = times[:, None] - starts[None, :]
    latest = np.argmin(np.where(before > 0, before, 1 << 40), axis=1)
    lead = before[np.arange(len(times)), latest][3:-3]
    assert np.all((lead > 1_600) & (lead < 6_000))  # [cycle] the conversion takes 104 µs, and 375 µs is the most
    assert abs((np.mean(lead) - SENSE_HELD) / 16e6 - CURRENT_LAG["hardware"]) < 8e-6
    true = np.array([current for _, current in seen])[latest]
    read = np.array([frame.current for frame in frames if isinstance(frame, Sensed)]) * STEP - ZERO
    error = (read / GAIN - true)[3:-3]
    assert np.max(np.abs(error)) < 5.0 * np.hypot(SENSE_NOISE, STEP) / GAIN
    assert np.ptp(true) > 4.0 and turned > 10


def test_it_is_the_middle_of_the_pulse(make_bench: MakeBench) -> None:
    """Pulses of 64 and 192 counts have middles 64 counts apart, 512 cycles."""
    bench = make_bench(parameters=MOTOR, config=SENSING)
    bench.start(2_000)
    phases = []
    for duty in (64, 192):
        bench.drive(duty, 20)
        seen = watch(bench)
        bench.drive(duty, 100)
        phases.append(np.array([cycle % PULSE for cycle, _ in seen]))
    spread = [float(np.ptp((phase - phase[0] + PULSE // 2) % PULSE)) for phase in phases]
    assert max(spread) < 0.2 * PULSE  # [cycle] a window of 16 µs, and the interrupts of edges
    apart = (np.median(phases[1]) - np.median(phases[0])) % PULSE
    assert 400 < apart < 620


def protected(make_bench: MakeBench, most: float, rated: float, seconds: float, period: int) -> Bench:
    """A motor with a blocked shaft, 2.3 ohm, on 12 V, and limits [A], [A], [s]."""
    bench = make_bench(parameters=MOTOR, config=SENSING)
    bench.emulator.supply(3.0)
    bench.emulator.wiring = Wiring(shaft_stuck=True)
    bench.start(period)
    bench.send(CurrentLimits(most, rated, seconds).protect(GAIN, ZERO, 500))
    bench.run(20)
    assert bench.all(Protection) and not bench.last(Telemetry).enabled
    bench.enable()
    bench.run(10)
    return bench


@on_each_chip
@pytest.mark.parametrize("period", [10_000, 2_000])
@pytest.mark.parametrize(("most", "stops"), [(5.0, True), (5.4, False)])
def test_a_peak_switches_off_within_three_samples(make_bench: MakeBench, period: int, most: float, stops: bool) -> None:
    """5.2 A at full duty."""
    bench = protected(make_bench, most, 0.0, 1.0, period)
    bench.send(Command(-256))
    on = bench.run_until(lambda: bench.emulator.shaft.voltage < -11.9, 50)
    for _ in range(60):
        bench.send(Command(-256))
        bench.run(1)
    frame = bench.last(Telemetry)
    assert (frame.flags & Flag.OVERCURRENT > 0, frame.enabled) == (stops, not stops)
    if stops:
        first = next(one for one in bench.all(Telemetry) if not one.enabled)
        since = (first.time * TICK + bench.chip.clock_zero - on) / (period * TICK)
        assert since < 3.1 and bench.emulator.shaft.voltage == 0.0 and first.flags & Flag.OVERCURRENT
        bench.enable()
        bench.run(10)  # nothing but that switches it on again
        assert not bench.last(Telemetry).flags & Flag.OVERCURRENT


@pytest.mark.parametrize("period", [10_000, 2_000])
@pytest.mark.parametrize(("rated", "after"), [(2.0, 0.31), (3.5, 0.50), (4.0, None)])
def test_what_lasts_switches_off_after_a_time_that_goes_with_its_square(
    make_bench: MakeBench, period: int, rated: float, after: float | None
) -> None:
    """3.9 A at three quarters of the duty, 0.2 s allowed at 5 A: (25 - rated^2)/(3.9^2 - rated^2) of that."""
    bench = protected(make_bench, 5.0, rated, 0.2, period)
    bench.send(Command(192))
    on = bench.run_until(lambda: bench.emulator.shaft.voltage > 8.0, 50)
    for _ in range(250):
        bench.send(Command(192))
        bench.run(4)
        if not bench.last(Telemetry).enabled:
            break
    took = (bench.chip.cycle - on) / 16e6
    assert bench.last(Telemetry).enabled == (after is None)
    assert after is None or took == pytest.approx((25 - rated**2) / (3.9**2 - rated**2) * 0.2, rel=0.12)


@on_each_chip
def test_a_hot_motor_is_hot_after_a_reset(make_bench: MakeBench) -> None:
    """0.39 s at this current from cold; 0.2 s, a reset, as whoever opens the port of an Uno makes one, and the rest."""
    bench = protected(make_bench, 5.0, 2.0, 0.2, 10_000)
    bench.drive(192, 200)
    assert bench.last(Telemetry).enabled
    bench.emulator.reset()
    bench.run(20)
    bench.send(CurrentLimits(5.0, 2.0, 0.2).protect(GAIN, ZERO, 500))
    bench.run(20)
    bench.enable()
    begun, on = bench.chip.cycle, True
    while on and bench.chip.cycle - begun < 400 * MS:
        bench.send(Command(192))
        bench.run(6)
        on = bench.last(Telemetry).enabled
    took = (bench.chip.cycle - begun) / 16e6
    assert not on and bench.last(Telemetry).flags & Flag.OVERCURRENT
    assert 0.17 < took < 0.24


def test_limits_are_known_to_hold_and_need_a_sensor(make_bench: MakeBench) -> None:
    limits = CurrentLimits(5.0, 2.0, 0.5).protect(GAIN, ZERO, 500)
    for config, most in ((SENSING, limits.most), (FirmwareConfig(), 0)):
        bench = make_bench(parameters=MOTOR, config=config)
        bench.run(8)
        bench.chip.feed(b"\0")
        bench.send(limits)
        bench.run(20)
        assert bench.last(Protection) == Protection(limits.zero, most, limits.rated, limits.budget)


def test_a_board_without_a_sensor_sends_what_it_always_did(make_bench: MakeBench) -> None:
    bench = make_bench()
    bench.start()
    bench.send(Command(50))
    bench.run(20)
    assert {type(frame) for frame in bench.all(Telemetry)} == {Telemetry}
