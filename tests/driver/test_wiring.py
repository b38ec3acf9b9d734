"""What one channel can tell of a motor that does not turn as it should, and what two can."""

from collections.abc import Callable
from dataclasses import replace
from math import nan

import pytest
from driver_rig import Rig

from motor_driver import status
from motor_driver.wiring import Wiring
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.sample import Sample

MakeRig = Callable[..., Rig]


def said(rig: Rig) -> str:
    return status.problem(rig.driver, status.Tally(rig.now, rig.driver.readings), rig.now + 1)


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
        assert running.driver.wiring.finding == ""


def test_an_encoder_that_was_never_connected(make_rig: MakeRig) -> None:
    rig = make_rig()
    rig.emulator.encoder_connected = False
    start(rig, 6.0, 400)
    assert rig.driver.wiring.finding == ""  # too early to say
    rig.run(200)
    assert "no edge ever, though driven with 6.0 V: the encoder is not connected" in said(rig)


def test_an_encoder_whose_cable_comes_off(running: Rig) -> None:
    running.emulator.encoder_connected = False
    running.run(600)
    assert "edges ended within one slot at full motion, and 6.0 V brings none back" in said(running)
    running.emulator.encoder_connected = True
    running.run(20)
    assert running.driver.wiring.finding == ""


def test_a_stalled_motor(make_rig: MakeRig) -> None:
    values = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 2.0, "step_voltage": 4.5, "step_time": 1.0}
    rig = start(make_rig(parameters=Parameters(values, ("coulomb_friction", "load_step"))), 6.0, 1800)
    assert rig.emulator.shaft.speed == 0.0
    assert said(rig).startswith("no edges at 6.0 V: the motor is stalled, or the encoder's cable is off")


def test_little_voltage_is_no_stall(make_rig: MakeRig) -> None:
    stiff = Parameters({"kv": PAPER_KV, "ka": PAPER_KA, "ks": 3.5}, ("coulomb_friction",))
    assert start(make_rig(parameters=stiff), 2.5, 900).driver.wiring.finding == ""


def sample(time: float, count: int, speed: float, voltage: float = 6.0, supply: float = nan) -> Sample:
    return Sample(round(time * 1e9), speed, voltage, count, edge_period=0.01, supply_voltage=supply)


def seen(single_channel: bool, *samples: Sample) -> str:
    wiring = Wiring(12.0, single_channel)
    for one in samples:
        wiring = wiring.see(one)
    return wiring.finding


@pytest.mark.parametrize(("supply", "words"), [(0.4, "the supply is at 0.4 V; switch it on"), (11.9, "no edge ever")])
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
