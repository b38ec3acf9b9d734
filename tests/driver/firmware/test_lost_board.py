"""Board, link, controller or driver fails: 0 V at the pins within 150 ms, and nothing but the user switches on again.

All times are the emulator's: the pins of the emulated chip against its own clock.
"""

from dataclasses import replace
from itertools import pairwise

import pytest
from driver_rig import MakeRig, Rig, problem
from tiers import mark_slow

from motor_board.emulation.chip import Hang
from motor_board.emulation.faults import Faults
from motor_board.emulation.serial_line import SerialLine
from motor_driver.config import Config

MOST = 150.0  # [ms] to 0 V at the pins, whatever has died


def test_a_dead_controller_means_0_volt(running: Rig) -> None:
    running.until(lambda: running.gate.received == running.now, 10)
    running.voltage = None
    assert 100.0 < running.until(lambda: running.pins == 0.0, MOST) < 120.0
    assert running.stops == [] and running.gate.enabled
    running.voltage = 6.0
    running.until(lambda: running.pins == 6.0, 30)  # not latched: commands act again


def test_a_dead_driver_means_0_volt_and_its_successor_starts_afresh(running: Rig) -> None:
    running.alive = False
    assert 80.0 < running.until(lambda: running.pins == 0.0, MOST) < 130.0
    successor = Rig(emulator=running.emulator)
    successor.voltage = 6.0
    successor.plug()
    successor.until(lambda: successor.pins == 6.0, 600)
    assert successor.stops == []


def test_silence_of_the_board_is_said_and_stops_the_motor(running: Rig) -> None:
    running.faults = replace(running.faults, stuck_telemetry=True)
    assert 110.0 < running.until(lambda: running.pins == 0.0, MOST) < 140.0
    assert running.stops == ["no telemetry from the port for 120 ms"]
    assert "No telemetry comes from the port" in problem(running)
    assert "No telemetry comes" in running.enable()
    running.faults = replace(running.faults, stuck_telemetry=False)
    running.run(100)
    assert (running.pins, running.gate.enabled) == (0.0, False)
    assert problem(running) == (
        "The output is off (no telemetry from the port for 120 ms): call motor/enable with data: true."
    )
    assert running.enable() == ""
    running.until(lambda: running.pins == 6.0, 30)
    assert problem(running) == ""


def test_a_pulled_plug_stops_and_stays_off_until_enabled(running: Rig) -> None:
    before = running.readings[-1].sample
    running.unplug()
    assert running.until(lambda: running.pins == 0.0, MOST) < 130.0
    assert running.stops == ["the link to the board on the port was lost"] and running.enable() == "the port is gone"
    running.run(300)
    running.plug()
    count = len(running.readings)
    assert running.until(lambda: len(running.readings) > count, 100) < 50.0
    running.run(500)
    after = running.readings[count].sample
    assert running.pins == 0.0 and not running.readings[count].restarted
    elapsed = running.readings[count].host - running.readings[count - 1].host
    assert (after.sample_time - before.sample_time) == pytest.approx(elapsed, abs=1e6)
    assert after.edge_count > before.edge_count
    assert running.enable() == ""
    running.until(lambda: running.pins == 6.0, 30)


@pytest.mark.parametrize("hang", [None, *Hang])
def test_a_reset_board_stays_off_until_enabled(running: Rig, hang: Hang | None) -> None:
    before, cause = running.readings[-1].sample, "watchdog" if hang is not None else "external"
    if hang is None:
        running.emulator.reset()
    else:
        running.emulator.chip.hang(hang)
    assert running.until(lambda: running.pins == 0.0, MOST) < 130.0
    running.until(lambda: running.driver.resets > 0, 400)
    count = len(running.readings)
    running.until(lambda: len(running.readings) > count, 400)
    running.run(300)
    assert running.stops[-1] == f"the board was reset ({cause})"
    first = running.readings[count]
    assert first.restarted and first.sample.sample_time > before.sample_time and first.sample.edge_count < 100
    samples = [reading.sample for reading in running.readings]
    assert all(b.sample_time > a.sample_time for a, b in pairwise(samples))
    assert {b.sample_time - a.sample_time for a, b in pairwise(samples[count:])} == {5_000_000}  # configured again
    assert running.pins == 0.0 and cause in problem(running)
    assert running.enable() == ""
    running.until(lambda: running.pins == 6.0, 30)
    assert problem(running) == ""


@pytest.mark.parametrize(("rate", "most"), [(200.0, 0.25), (10.0, 0.55)])
def test_a_board_that_hears_nothing_is_not_switched_on_and_does_not_start_when_the_wire_is_back(
    make_rig: MakeRig, rate: float, most: float
) -> None:
    """Telemetry goes on: an enable was answered "The output is on", and 20 s later the motor started by itself."""
    rig = make_rig(config=Config(sample_rate=rate))
    rig.run(20)
    rig.plug()
    rig.voltage = 6.0
    rig.until(lambda: rig.pins == 6.0, 1500)
    send = rig._in.send
    rig._in.send = lambda data, faults, now: send(b"", faults, now)  # type: ignore[method-assign]
    rig.until(lambda: len(rig.stops) == 1, 400)
    assert rig.stops == ["the board heard no command for too long and switched off"]
    assert rig.enable() == ""  # nobody knows yet
    rig.run(1e3 * most)
    hears_nothing = "the board on the port says what it measures and does nothing that it is told"
    assert len(rig.stops) == 2 and rig.stops[1].startswith(hears_nothing) and not rig.gate.enabled
    rig.run(500)
    assert rig.enable().startswith(f"No voltage acts: {hears_nothing}")
    assert problem(rig).startswith(f"T{hears_nothing[1:]}")
    rig._in.send = send  # type: ignore[method-assign]
    rig.run(500)
    assert rig.pins == 0.0 and len(rig.stops) == 2
    assert rig.enable() == ""
    rig.until(lambda: rig.pins == 6.0, 300)
    rig.run(500)
    assert rig.stops[2:] == [] and rig.gate.enabled


@pytest.mark.parametrize(("delay", "stops"), [(40, False), (60, True), mark_slow(1000, True)])
def test_a_link_that_holds_bytes_back_is_no_link_to_a_motor(running: Rig, delay: int, stops: bool) -> None:
    """So many ms each way, more and more of them: nothing is lost, and no time-out sees it."""
    running._in, running._out = HeldBack(), HeldBack()
    for step in range(100):
        HeldBack.delay = delay * 10_000 * (step + 1)
        running.run(20)
    assert (running.pins == 0.0) is stops is (not running.gate.enabled)
    if stops:
        assert running.stops[0] == (
            "the board on the port answers later than 100 ms, so that the motor does what was right a while ago: the "
            "link holds bytes back (a wireless adapter, a network, a hub)"
        )
        assert running.enable().startswith("No voltage acts in time: the board on the port answers later than 100 ms")
    else:
        running.voltage = None
        assert running.until(lambda: running.pins == 0.0, 160.0) > 100.0
    HeldBack.delay = 0
    running.voltage = 6.0
    running.run(2100)
    assert running.enable() == ""
    running.until(lambda: running.pins == 6.0, 30)


class HeldBack(SerialLine):
    """A line on which all bytes come, in order, `delay` [ns] late."""

    delay = 0

    def __init__(self) -> None:
        super().__init__(1)

    def send(self, data: bytes, faults: Faults, now: int) -> None:
        if data:
            self._late.append((now + self.delay, data))


def test_a_held_up_driver_finds_its_board_switched_off(running: Rig) -> None:
    running.alive = False
    running.run(200)
    running.alive = True
    running.run(300)
    assert running.stops != [] and running.pins == 0.0
    assert running.enable() == ""
    running.until(lambda: running.pins == 6.0, 30)


def test_an_opening_that_resets_the_board_is_no_stop(make_rig: MakeRig) -> None:
    rig = make_rig()
    rig.voltage = 6.0
    rig.run(30)
    rig.plug()
    rig.run(2)
    rig.emulator.reset()
    rig.until(lambda: rig.pins == 6.0, 900)
    assert rig.stops == []


@pytest.mark.parametrize("first", [100, 150, 200])
def test_to_switch_on_off_and_on_within_a_round_trip_is_no_stop(make_rig: MakeRig, first: int) -> None:
    """The off was still under way when the board said that it was on: "the board switched off" was said of it."""
    rig = make_rig(config=Config(command_timeout=0.3))
    rig.faults, rig.voltage = Faults(delay=0.1), 6.0
    rig.plug()
    rig.until(lambda: rig.pins == 6.0, 4_000)
    for on, wait in ((False, 500), (True, first), (False, 60), (True, 1_000)):
        assert rig.enable(on) == ""
        rig.run(wait)
    assert rig.stops == [] and rig.gate.enabled and rig.pins == 6.0
    rig.enable(False)
    rig.run(200)
    assert rig.pins == 0.0
