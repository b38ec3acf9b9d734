"""What one channel can tell of a motor that does not turn as it should, and what two can; when that is a stop."""

from dataclasses import replace
from math import nan

import numpy as np
import pytest

from motor_model.excitation import PROFILES
from motor_model.parameters import Parameters
from motor_model.sample import Sample
from motor_model.sensing.board import BoardConfig, SimulatedBoard
from motor_model.sensing.motion_check import MotionCheck


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


@pytest.mark.parametrize("motor", [1.2, 12.0])
@pytest.mark.parametrize(("share", "words"), [(0.04, "switch it on"), (0.24, "switch it on"), (0.26, "no edge ever")])
def test_a_missing_supply_is_one_of_less_than_a_quarter_of_the_motors_voltage(
    motor: float, share: float, words: str
) -> None:
    driven = [sample(0.1 * k, 0, 0.0, 0.26 * motor, share * motor) for k in range(8)]
    assert words in checked(True, *driven, max_voltage=motor).finding


def test_a_supply_below_the_voltage_that_is_believed_is_missing_too() -> None:
    """A motor of 1.2 V on a supply of 12 V: 0.5 V are more than a quarter of the motor's voltage, and no 12 V."""
    driven = [sample(0.1 * k, 0, 0.0, 0.6, 0.5) for k in range(8)]
    assert "supply is at 0.5 V; switch it on" in checked(True, *driven, max_voltage=1.2).finding


def test_an_encoder_that_is_unplugged_in_full_motion_is_told_from_a_motor_that_stalls() -> None:
    still = [sample(0.1 * k, 9, 0.0) for k in range(1, 8)]
    for pace in (1.0, 100.0):  # whatever the motor's speed, and its encoder's slots
        turning = replace(sample(0.0, 8, 90.0), edge_period=0.01 * pace)
        cut = seen(True, turning, replace(sample(0.05, 9, 90.0), edge_period=0.0119 * pace), *still)
        assert cut.startswith("edges ended within one slot, without slowing down before, and 6.0 V brings none back: ")
        stalled = seen(True, turning, replace(sample(0.05, 9, 90.0), edge_period=0.0121 * pace), *still)
        assert stalled == "no edges at 6.0 V: the motor is stalled, or the encoder's cable is off"
    never = seen(True, *(sample(0.1 * k, 0, 0.0) for k in range(8)))
    assert never.startswith("no edge ever, though driven with 6.0 V: the encoder is not connected")


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


@pytest.mark.parametrize(("voltage", "supply", "stops"), [(4.7, 5.0, True), (4.6, 5.0, False), (4.7, nan, False)])
def test_all_that_a_low_supply_gives_is_enough_for_a_stop(voltage: float, supply: float, stops: bool) -> None:
    """Half of the motor's 12 V never comes from a battery of 5 V."""
    blocked = [sample(0.1 * k, 0, 0.0, voltage, supply) for k in range(7)]
    assert bool(checked(True, *blocked).stop) == stops


@pytest.mark.parametrize(("supply", "stops"), [(0.48, True), (0.31, True), (0.29, False)])
def test_and_of_a_motor_of_little_voltage_all_that_its_little_supply_gives(supply: float, stops: bool) -> None:
    """Less than a quarter of 1.2 V is a supply that is off, and the voltage that is told is one that nobody has."""
    blocked = [sample(0.1 * k, 0, 0.0, supply, supply) for k in range(7)]
    assert bool(checked(True, *blocked, max_voltage=1.2).stop) == stops


@pytest.mark.parametrize("limit", [1.2, 12.0, 48.0])
@pytest.mark.parametrize(("share", "stops"), [(0.49, False), (0.51, True), (-0.51, True)])
def test_a_stop_is_relative_to_the_motors_voltage(limit: float, share: float, stops: bool) -> None:
    blocked = [sample(0.1 * k, 0, 0.0, share * limit) for k in range(7)]
    assert bool(checked(True, *blocked, max_voltage=limit).stop) == stops
    assert checked(True, *blocked[:4], max_voltage=limit).stop == ""  # 0.3 s


def test_a_slow_ramp_through_friction_is_no_stop() -> None:
    """The voltage becomes strong after 10 s at rest; what counts is the time at a strong voltage."""
    ramp = [sample(0.1 * k, 0, 0.0, 0.06 * k) for k in range(104)]
    assert checked(True, *ramp).stop == ""
    assert checked(True, *ramp, *(sample(10.4 + 0.1 * k, k, 1.0, 6.3) for k in range(9))).stop == ""
    assert checked(True, *ramp, *(sample(10.4 + 0.1 * k, 0, 0.0, 6.3) for k in range(9))).stop != ""


@pytest.mark.parametrize(("dip", "stops"), [(4.9, True), (4.7, False)])
def test_a_strong_voltage_that_trembles_stays_strong(dip: float, stops: bool) -> None:
    blocked = [sample(0.1 * k, 0, 0.0, 6.1 if k % 2 == 0 else dip) for k in range(7)]
    assert bool(checked(True, *blocked).stop) == stops


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
    assert [bool(checked(False, *turning[:k]).stop) for k in (8, 20)] == [False, True]
    assert checked(True, *turning).stop == ""  # one channel does not know


@pytest.mark.parametrize(
    ("times", "stops"),
    [
        ((0.2, 0.4, 0.6), True),  # five edges a second, which a plant reports as a standstill
        ((0.2, 0.4, 0.59), True),
        ((0.2, 0.4, 0.66), False),  # each a quarter later than the one before: it comes to rest
        ((0.09, 0.18, 0.27), False),  # fast enough for a speed that tells
    ],
)
@pytest.mark.parametrize("sign", [1, -1])
def test_slow_edges_against_a_strong_voltage_are_a_stop(times: tuple[float, ...], stops: bool, sign: int) -> None:
    """A motor of 6 rad/s with 8 edges a turn and exchanged channels ran for ever."""
    edges = (0.0, *times)
    check = MotionCheck(12.0, single_channel=False)
    for k in range(160):
        passed = [at for at in edges if at <= 0.005 * k]
        period = passed[-1] - passed[-2] if len(passed) > 1 else 0.2
        check = check.see(Sample(k * 5_000_000, 0.0, 7.2 * sign, -sign * len(passed), edge_period=period))
        if check.stop:
            break
    assert check.stop.startswith("the motor turns against") == stops
    along = MotionCheck(12.0, single_channel=False)
    for k in range(160):
        along = along.see(Sample(k * 5_000_000, 0.0, 7.2, sum(at <= 0.005 * k for at in edges), edge_period=0.2))
    assert "against" not in along.stop


@pytest.mark.parametrize(("share", "stops"), [(0.25, False), (0.5, True)])
def test_pulses_against_the_motion_are_a_wrong_direction_if_they_are_strong_in_the_mean(
    share: float, stops: bool
) -> None:
    """A loop with its channels exchanged lets a fast motor coast and pushes on: 12 and 0 V in turn, for ever."""
    rng, on = np.random.default_rng(4), 0.0
    check, stopped = MotionCheck(12.0, False), 0.0
    for k in range(400):
        on += share
        pulse, on = (12.0, on - 1.0) if on >= 1.0 else (0.0, on)
        speed = -20.0 - 2.0 * float(rng.uniform())
        check = check.see(sample(0.005 * k, -k, speed, pulse))
        stopped = stopped or 0.005 * k * bool(check.stop)
    assert (0.39 < stopped < 0.6) if stops else not stopped
    assert not check.stop or check.stop.startswith("the motor turns against its voltage")


@pytest.mark.parametrize(("share", "stops"), [(0.296, True), (0.26, False)])
def test_what_presses_against_the_motion_for_good_is_a_wrong_sign(share: float, stops: bool) -> None:
    """A limit on plugging held exchanged channels at 0.296 of the voltage, at 26 % of the top speed, for ever."""
    turning = [sample(0.005 * k, -5 * k, -45.0, share * 12.0) for k in range(200)]
    at = next((0.005 * k for k in range(200) if checked(False, *turning[: k + 1]).stop), None)
    assert (at is not None) == stops and (at is None or 0.39 < at < 0.5)
    assert checked(True, *turning).stop == ""


def test_a_load_that_drives_the_motor_is_braked_by_what_presses_against_it() -> None:
    """It has been held back for long, and grown; then another reference brakes it hard, within 75 ms."""
    held = [sample(0.005 * k, -k, -(10.0 + 0.1 * min(k, 100)), 0.2 * 12.0) for k in range(300)]
    braked = [sample(1.5 + 0.005 * k, -300 - k, -20.0 + 0.6 * k, 12.0) for k in range(15)]
    assert not any(checked(False, *held, *braked[: k + 1]).stop for k in range(15))


@pytest.mark.parametrize("name", ["chirp", "reversals"])
@pytest.mark.parametrize(("top", "lag", "edges"), [(6.0, 0.15, 8), (6.0, 0.3, 8), (6.0, 0.3, 20), (30.0, 0.5, 8)])
def test_a_healthy_motor_may_turn_to_and_fro_within_a_slot(name: str, top: float, lag: float, edges: int) -> None:
    """The project's own profiles stopped a slow motor with a coarse disc; a shaft that is blocked then is a fault."""
    kv = 12.0 / top
    plant = Parameters({"kv": kv, "ka": kv * lag, "ks": 0.4}, ("coulomb_friction",))
    board = SimulatedBoard(plant, BoardConfig(edges_per_revolution=edges, single_channel=True))
    check, shape = MotionCheck(12.0, True), PROFILES[name]
    for volts in shape.voltage(np.arange(0.0, shape.duration, 0.005), 12.0):
        check = check.see(last := board.sample(float(volts)))
        assert check.stop == ""
    for k in range(1, 1000):
        blocked = replace(last, sample_time=last.sample_time + 5_000_000 * k, speed=0.0, voltage=12.0 * (-1.0) ** k)
        check = check.see(blocked)
        if check.stop:
            break
    assert 0.0 < 0.005 * k < 2.0


@pytest.mark.parametrize(
    ("volts", "low", "high"),
    [
        ([12.0, -12.0], 0.4, 0.55),
        ([12.0, 0.0], 1.0, 1.2),
        ([7.2] * 20 + [-7.2] * 20, 1.8, 2.0),
        ([12.0] * 60 + [0.0] * 20, 0.4, 0.7),
        ([8.4, 0.0], np.inf, np.inf),  # 0.495 of 12 V in the mean square
        ([5.9, -5.9], np.inf, np.inf),
    ],
)
def test_a_voltage_that_comes_and_goes_heats_a_motor_as_one_that_stays(
    volts: list[float], low: float, high: float
) -> None:
    """It was never strong for the stall time, and never stopped."""
    check, stopped = MotionCheck(12.0, False), np.inf
    for k in range(4000):
        check = check.see(sample(0.005 * k, 7, 0.0, volts[k % len(volts)]))
        if check.stop:
            stopped = 0.005 * k
            break
    assert low <= stopped <= high
    if stopped < np.inf:
        assert check.stop.startswith("no edges, and 6.") and " V in the mean square for 1.6 s: " in check.stop
    moving = MotionCheck(12.0, True)
    for k in range(4000):
        moving = moving.see(sample(0.005 * k, k // 50, 0.0, volts[k % len(volts)]))  # four edges a second
        assert moving.heat < 0.4
    never = MotionCheck(12.0, True, stall_time=0.0)
    for k in range(1000):
        never = never.see(sample(0.005 * k, 7, 0.0, 12.0 if k % 2 else -12.0))
        assert never.stop == ""
