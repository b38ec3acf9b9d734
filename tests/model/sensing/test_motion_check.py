"""What one channel can tell of a motor that does not turn as it should, and what two can; when that is a stop."""

from dataclasses import replace
from math import nan

import pytest
from motion_samples import checked, sample

from motor_model.sample import Sample
from motor_model.sensing.motion_check import MotionCheck

SWITCH_ON = "switch it on, and join its ground to the board's"


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


@pytest.mark.parametrize(("supply", "words"), [(0.48, "no edge ever"), (0.31, "no edge ever"), (0.29, "its supply")])
def test_and_of_a_motor_of_little_voltage_all_that_its_little_supply_gives(supply: float, words: str) -> None:
    """Less than a quarter of 1.2 V is a supply that is off."""
    blocked = [sample(0.1 * k, 0, 0.0, supply, supply) for k in range(7)]
    assert words in checked(True, *blocked, max_voltage=1.2).stop


@pytest.mark.parametrize("voltage", [0.1, -2.8])
@pytest.mark.parametrize(
    ("supply", "after", "stops"), [(2.9, 0.41, True), (2.9, 0.39, False), (3.1, 9.0, False), (nan, 9.0, False)]
)
def test_a_supply_that_is_off_for_long_stops_the_motor_under_any_voltage(
    voltage: float, supply: float, after: float, stops: bool
) -> None:
    """It was switched off and on, and the motor went on by itself."""
    coasting = [sample(0.1 * k, k, 10.0, voltage, supply) for k in range(8)]
    stopped = checked(True, *coasting, sample(0.7 + after, 7, 0.0, voltage, supply)).stop
    assert stopped == ("the motor does not turn: its supply is at 2.9 V; " + SWITCH_ON if stops else "")


def test_where_no_voltage_is_wanted_a_supply_may_be_off() -> None:
    assert checked(True, *(sample(0.1 * k, 0, 0.0, 0.0, 0.0) for k in range(20))).stop == ""
    to_and_fro = [sample(0.1 * k, 0, 0.0, 0.3 * (-1) ** k, 0.0) for k in range(7)]
    assert "its supply is at 0.0 V" in checked(True, *to_and_fro).stop


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


@pytest.mark.parametrize(
    ("voltage", "time", "stall_time", "stops"),
    [
        (5.9, 6.3, 0.4, False),
        (5.9, 6.5, 0.4, True),
        (-3.1, 6.5, 0.4, True),
        (2.9, 60.0, 0.4, False),  # a quarter: what any motor may need to turn
        (5.9, 6.5, 0.5, False),
        (5.9, 60.0, 0.0, False),  # never
    ],
)
def test_a_shaft_that_is_blocked_below_half_of_the_voltage_is_not_driven_for_ever(
    voltage: float, time: float, stall_time: float, stops: bool
) -> None:
    """It was known after 0.5 s, said, and driven on, at up to a quarter of what a stall heats."""
    check = MotionCheck(12.0, True, stall_time)
    for k in range(round(time * 20) + 1):
        check = check.see(sample(0.05 * k, 7, 0.0, voltage))
    assert bool(check.stop) is stops and bool(check.finding) is (abs(voltage) > 3.0)
    turned = check.see(sample(time + 0.05, 8, 1.0, voltage))
    assert not turned.stop


@pytest.mark.parametrize(("dip", "stops"), [(4.9, True), (4.7, False)])
def test_a_strong_voltage_that_trembles_stays_strong(dip: float, stops: bool) -> None:
    blocked = [sample(0.1 * k, 0, 0.0, 6.1 if k % 2 == 0 else dip) for k in range(7)]
    assert bool(checked(True, *blocked).stop) == stops
