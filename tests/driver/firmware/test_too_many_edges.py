"""The real firmware with more edges than it has time for: the motor is faster than its speed says, and is stopped."""

from collections.abc import Callable

import pytest
from driver_rig import Rig, problem

from motor_board.build import FirmwareConfig
from motor_board.emulation.shaft import EncoderConfig
from motor_driver.config import Config

MakeRig = Callable[..., Rig]
EDGES = 2000  # 55,400 a second at 12 V


def drive(make_rig: MakeRig, voltage: float, rate: float) -> Rig:
    """A motor at a voltage, begun from rest."""
    rig = make_rig(
        config=Config(sample_rate=rate, edges_per_revolution=EDGES),
        firmware=FirmwareConfig(edges_per_revolution=EDGES),
        encoder=EncoderConfig(edges_per_revolution=EDGES, seed=3),
    )
    rig.plug()
    rig.voltage = 1.0
    rig.until(lambda: rig.pins > 0.9, 1000)
    rig.voltage = voltage
    rig.run(700)
    return rig


@pytest.mark.parametrize("rate", [50.0, 200.0, 1000.0])
def test_a_motor_too_fast_to_be_counted_is_stopped_until_the_user_enables(make_rig: MakeRig, rate: float) -> None:
    rig = drive(make_rig, 12.0, rate)
    assert (rig.pins, rig.gate.enabled, len(set(rig.stops))) == (0.0, False, 1)
    assert "The output is off (edges came faster than the board can count them, again" in problem(rig)
    rig.run(2000)
    assert rig.pins == 0.0 and not rig.driver.shed.stop
    assert rig.enable() == ""
    rig.until(lambda: rig.pins > 11.9, 100)
    rig.until(lambda: rig.pins == 0.0, 700)
    assert "It has stopped 2 times" in rig.enable()


@pytest.mark.parametrize("rate", [50.0, 200.0, 1000.0])
def test_what_the_board_can_count_is_never_stopped(make_rig: MakeRig, rate: float) -> None:
    rig = drive(make_rig, 6.6, rate)
    assert rig.emulator.shaft.speed * EDGES / 6.2832 == pytest.approx(30_000, rel=0.05)
    rig.run(1000)
    assert rig.stops == [] and rig.pins == pytest.approx(6.6, abs=0.03)
    assert rig.readings[-1].sample.speed == pytest.approx(rig.emulator.shaft.speed, rel=0.02)


def test_noise_for_a_moment_stops_no_motor(running: Rig) -> None:
    running.emulator.stray_edges = 100_000.0
    running.run(60)
    running.emulator.stray_edges = 0.0
    running.run(500)
    assert running.driver.encoder_errors >= 5 and running.stops == [] and running.pins == 6.0
    running.emulator.stray_edges = 100_000.0
    running.until(lambda: running.pins == 0.0, 300)
    assert "edges came faster" in running.stops[0]
