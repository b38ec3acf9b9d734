"""What one channel can tell of a motor that does not turn as it should, and what two can."""

from collections.abc import Callable
from dataclasses import replace
from math import nan

import pytest
from driver.rig import Rig

from motor_board.build import FirmwareConfig
from motor_driver import status
from motor_driver.config import Config
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.sample import Sample
from motor_ros.motion_check import MotionCheck

MakeRig = Callable[..., Rig]


def said(rig: Rig) -> str:
    problem = status.problem(rig.driver, status.Tally(rig.now, rig.driver.readings), rig.now + 1)
    return " ".join(filter(None, (problem, rig.gate.problem(rig.now))))


def start(rig: Rig, voltage: float, milliseconds: float) -> Rig:
    rig.plug()
    rig.voltage = voltage
    rig.until(lambda: rig.pins == pytest.approx(voltage, abs=0.03), 500)
    rig.run(milliseconds)
    return rig


def test_a_good_motor_is_not_blamed(running: Rig) -> None:
    for voltage in (-6.0, 0.0, 12.0, 1.0):
        running.voltage = voltage
        running.run(700)
        assert running.driver.motion.finding == ""


@pytest.mark.parametrize(("voltage", "stops"), [(5.0, False), (6.0, True)])
def test_an_encoder_that_was_never_connected(make_rig: MakeRig, voltage: float, stops: bool) -> None:
    """From half of the motor's voltage on the driver stops by itself; below that it says what it sees."""
    rig = make_rig()
    rig.emulator.encoder_connected = False
    start(rig, voltage, 400)
    assert rig.driver.motion.finding == "" and rig.stops == []  # too early to say
    rig.run(200)
    assert f"o edge ever, though driven with {voltage:.1f} V: the encoder is not connected" in said(rig)
    assert (len(rig.stops), rig.pins, rig.gate.enabled) == (
        (1, 0.0, False) if stops else (0, pytest.approx(voltage, abs=0.03), True)
    )


def test_a_stop_stays_until_the_user_enables_and_comes_again(running: Rig) -> None:
    running.emulator.encoder_connected = False
    assert 480.0 < running.until(lambda: running.pins == 0.0, 600) < 520.0
    running.run(300)
    assert running.pins == 0.0 and said(running).startswith("The output is off (edges ended within one slot at full")
    assert running.enable() == ""
    running.until(lambda: running.pins == 6.0, 30)
    assert 480.0 < running.until(lambda: running.pins == 0.0, 600) < 520.0


def test_an_encoder_whose_cable_comes_off(make_rig: MakeRig) -> None:
    rig = start(make_rig(config=Config(stall_time=0.0)), 6.0, 600)  # 0: the driver only says what it sees
    rig.emulator.encoder_connected = False
    rig.run(600)
    assert "Edges ended within one slot at full motion, and 6.0 V brings none back" in said(rig)
    assert rig.pins == 6.0 and rig.stops == []
    rig.emulator.encoder_connected = True
    rig.run(20)
    assert rig.driver.motion.finding == ""


def test_a_stalled_motor(make_rig: MakeRig) -> None:
    values = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 2.0, "step_voltage": 4.5, "step_time": 1.0}
    rig = start(make_rig(parameters=Parameters(values, ("coulomb_friction", "load_step"))), 6.0, 1800)
    assert rig.pins == 0.0
    assert said(rig).startswith(
        "The output is off (no edges at 6.0 V: the motor is stalled, or the encoder's cable is off)"
    )


def test_two_channels_that_are_swapped_stop_the_motor(make_rig: MakeRig) -> None:
    backward = Parameters({"kv": PAPER_KV, "ka": PAPER_KA, "bias_voltage": 9.0}, ("load_bias",))  # drives it back
    board = FirmwareConfig(edges_per_revolution=96, channels=2)
    rig = start(make_rig(config=Config(single_channel=False), firmware=board, parameters=backward), 7.0, 0)
    assert 500.0 < rig.until(lambda: rig.pins == 0.0, 1500) < 1200.0  # it slows down at first
    assert "the motor turns against its voltage: swap" in said(rig)


def test_little_voltage_is_no_stall(make_rig: MakeRig) -> None:
    stiff = Parameters({"kv": PAPER_KV, "ka": PAPER_KA, "ks": 3.5}, ("coulomb_friction",))
    assert start(make_rig(parameters=stiff), 2.5, 900).driver.motion.finding == ""


def sample(time: float, count: int, speed: float, voltage: float = 6.0, supply: float = nan) -> Sample:
    return Sample(round(time * 1e9), speed, voltage, count, edge_period=0.01, supply_voltage=supply)


def checked(single_channel: bool, *samples: Sample, max_voltage: float = 12.0) -> MotionCheck:
    check = MotionCheck(max_voltage, single_channel)
    for one in samples:
        check = check.see(one)
    return check


def seen(single_channel: bool, *samples: Sample) -> str:
    return checked(single_channel, *samples).finding


@pytest.mark.parametrize(("supply", "words"), [(0.4, "supply is at 0.4 V; switch it on"), (11.9, "no edge ever")])
def test_a_missing_supply_is_told_from_a_missing_encoder_where_it_is_measured(supply: float, words: str) -> None:
    assert words in seen(True, *(sample(0.1 * k, 0, 0.0, supply=supply) for k in range(8)))


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_two_channels_show_a_wrong_sign_and_one_cannot(sign: float) -> None:
    turning = [sample(0.1 * k, -round(sign) * k, -sign * 20.0, sign * 6.0) for k in range(8)]
    assert seen(False, *turning).startswith("the motor turns against its voltage: swap the motor's two wires")
    assert seen(True, *(replace(one, edge_count=k) for k, one in enumerate(turning))) == ""
    assert seen(False, *(replace(one, speed=-one.speed) for one in turning)) == ""


def test_braking_is_no_wrong_sign() -> None:
    """A reversal takes a while; what counts is turning against the voltage for long."""
    reversal = [sample(0.1 * k, k, 40.0 - 10.0 * k, -6.0) for k in range(12)]
    assert seen(False, *reversal) == ""


@pytest.mark.parametrize("limit", [1.2, 12.0, 48.0])
@pytest.mark.parametrize(("share", "stops"), [(0.49, False), (0.51, True), (-0.51, True)])
def test_a_stop_is_relative_to_the_motors_voltage(limit: float, share: float, stops: bool) -> None:
    blocked = [sample(0.1 * k, 0, 0.0, share * limit) for k in range(7)]
    assert bool(checked(True, *blocked, max_voltage=limit).stop) == stops
    assert checked(True, *blocked[:5], max_voltage=limit).stop == ""  # 0.4 s


def test_a_slow_ramp_through_friction_is_no_stop() -> None:
    """The voltage becomes strong after 10 s at rest; what counts is the time at a strong voltage."""
    ramp = [sample(0.1 * k, 0, 0.0, 0.06 * k) for k in range(104)]
    assert checked(True, *ramp).stop == ""
    assert checked(True, *ramp, *(sample(10.4 + 0.1 * k, k, 1.0, 6.3) for k in range(9))).stop == ""
    assert checked(True, *ramp, *(sample(10.4 + 0.1 * k, 0, 0.0, 6.3) for k in range(9))).stop != ""


@pytest.mark.parametrize("time_constant", [0.05, 1.0, 20.0])
def test_braking_a_flywheel_with_the_motor_is_no_stop(time_constant: float) -> None:
    """From top speed with half the voltage against the motion, whatever the inertia."""
    samples, speed = [], 170.0
    for k in range(2000):
        samples.append(sample(0.005 * k, k, speed, -6.0))
        speed += 0.005 / time_constant * (-85.0 - speed)
    check = MotionCheck(12.0, False)
    for one in samples:
        check = check.see(one)
        assert check.stop == ""


def test_turning_against_a_strong_voltage_without_slowing_down_is_a_stop() -> None:
    turning = [sample(0.05 * k, -k, -min(20.0 * k, 80.0) * (1.0 + 0.03 * (-1) ** k), 8.0) for k in range(30)]
    assert [bool(checked(False, *turning[:k]).stop) for k in (10, 20)] == [False, True]
    assert checked(True, *turning).stop == ""  # one channel does not know
