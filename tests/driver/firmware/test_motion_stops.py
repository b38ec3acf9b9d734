"""The real firmware with a motor that does not turn as it should: what the driver says, and when it stops it."""

from collections.abc import Callable

import pytest
from driver_rig import Rig

from motor_board.build import FirmwareConfig
from motor_driver import status
from motor_driver.config import Config
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.sensing.motion_check import CUT_OFF, NEVER, STALLED

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
    start(rig, voltage, 300)
    assert rig.driver.motion.finding == "" and rig.stops == []  # too early to say
    rig.run(300)
    assert NEVER.format(voltage=voltage)[1:] in said(rig)
    assert (len(rig.stops), rig.pins, rig.gate.enabled) == (
        (1, 0.0, False) if stops else (0, pytest.approx(voltage, abs=0.03), True)
    )


def test_a_stop_stays_until_the_user_enables_and_comes_again(running: Rig) -> None:
    running.emulator.encoder_connected = False
    assert 380.0 < running.until(lambda: running.pins == 0.0, 600) < 420.0
    running.run(300)
    assert running.pins == 0.0 and said(running).startswith(f"The output is off ({CUT_OFF[:20]}")
    assert running.enable() == ""
    running.until(lambda: running.pins == 6.0, 30)
    assert 380.0 < running.until(lambda: running.pins == 0.0, 600) < 420.0
    assert "It has stopped 2 times" in running.enable() and "wait 1 s" in said(running)
    running.run(900)
    assert running.enable() and running.pins == 0.0
    running.run(110)
    assert running.enable() == ""
    running.until(lambda: running.pins == 6.0, 30)


def test_a_plug_that_is_pulled_again_and_again_does_not_count(running: Rig) -> None:
    """A second stop that counts would be refused for 1 s."""
    for _ in range(3):
        running.unplug()
        running.run(200)
        running.plug()
        running.until(lambda: running.driver.runs, 600)
        running.run(20)
        assert running.stops and running.enable() == ""


def test_an_encoder_whose_cable_comes_off(make_rig: MakeRig) -> None:
    rig = start(make_rig(config=Config(stall_time=0.0)), 6.0, 600)  # 0: the driver only says what it sees
    rig.emulator.encoder_connected = False
    rig.run(600)
    assert CUT_OFF.format(voltage=6.0)[1:] in said(rig)
    assert rig.pins == 6.0 and rig.stops == []
    rig.emulator.encoder_connected = True
    rig.run(20)
    assert rig.driver.motion.finding == ""


def test_a_stalled_motor(make_rig: MakeRig) -> None:
    values = {"kv": PAPER_KV, "ka": PAPER_KA, "ks": 2.0, "step_voltage": 4.5, "step_time": 1.0}
    rig = start(make_rig(parameters=Parameters(values, ("coulomb_friction", "load_step"))), 6.0, 1800)
    assert rig.pins == 0.0
    assert said(rig).startswith(f"The output is off ({STALLED.format(voltage=6.0)})")


def test_two_channels_that_are_swapped_stop_the_motor(make_rig: MakeRig) -> None:
    backward = Parameters({"kv": PAPER_KV, "ka": PAPER_KA, "bias_voltage": 9.0}, ("load_bias",))  # drives it back
    board = FirmwareConfig(edges_per_revolution=96, channels=2)
    rig = start(make_rig(config=Config(single_channel=False), firmware=board, parameters=backward), 7.0, 0)
    assert 500.0 < rig.until(lambda: rig.pins == 0.0, 1500) < 1200.0  # it slows down at first
    assert "the motor turns against its voltage: swap" in said(rig)


def test_little_voltage_is_no_stall(make_rig: MakeRig) -> None:
    stiff = Parameters({"kv": PAPER_KV, "ka": PAPER_KA, "ks": 3.5}, ("coulomb_friction",))
    assert start(make_rig(parameters=stiff), 2.5, 900).driver.motion.finding == ""
