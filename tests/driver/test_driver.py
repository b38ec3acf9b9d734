"""The driver's logic with the real firmware: it drives, it stops, and nothing but the user switches on again.

All times are the emulator's: the pins of the emulated chip against its own clock.
"""

import re
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from math import isnan, tau
from statistics import fmean

import pytest
from driver_rig import Rig
from emulated_board import MS

from motor_board.build import FirmwareConfig
from motor_board.chip import Hang
from motor_driver import status
from motor_driver.config import Config
from motor_driver.frames import Decay, Identify, Telemetry
from motor_driver.protocol import Arrival, Decoder, LinkCounters, pack
from motor_driver.readout import Readout
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters, paper_motor
from motor_model.sample import Sample

MakeRig = Callable[..., Rig]
MOST = 150.0  # [ms] to 0 V at the pins, whatever has died


def problem(rig: Rig) -> str:
    """What /diagnostics says now, had it been fine a second ago."""
    was = status.Tally(rig.now - 1, rig.driver.readings - 1, rig.driver.counters, True, rig.driver.openings)
    return " ".join(filter(None, (status.problem(rig.driver, was, rig.now), rig.gate.problem(rig.now))))


def test_reports_the_motor_on_the_pins(running: Rig) -> None:
    running.run(600)
    info, samples = running.driver.info, [reading.sample for reading in running.readings]
    assert (info.source, info.measurement.value, info.decay) == ("hardware", "edges", "brake")
    assert (info.edge_resolution, info.sample_period, info.max_voltage) == (5e-7, 0.005, 12.0)
    assert {b.sample_time - a.sample_time for a, b in pairwise(samples)} == {5_000_000}
    assert {sample.voltage for sample in samples} == {0.0, 6.0}
    assert all(isnan(sample.supply_voltage) and isnan(sample.current) for sample in samples)
    first, last = samples[-40], samples[-1]
    turned = (last.edge_count - first.edge_count) * tau / 96
    assert turned / ((last.edge_time - first.edge_time) * 1e-9) == pytest.approx(running.emulator.shaft.speed, rel=1e-4)
    assert last.speed == pytest.approx(6.0 / PAPER_KV, rel=0.01)
    assert problem(running) == ""


def test_configures_what_it_was_told(make_rig: MakeRig) -> None:
    config = Config(sample_rate=1000.0, max_voltage=9.0, command_timeout=0.06, decay=Decay.COAST, single_channel=False)
    board = FirmwareConfig(edges_per_revolution=96, channels=2, supply_full_scale=20_000)
    rig = make_rig(config=config, firmware=board)
    rig.emulator.chip.supply(3.0)  # of 5 V, for 20 V
    rig.plug()
    rig.voltage = -4.5
    rig.until(lambda: bool(rig.readings) and rig.readings[-1].sample.speed < -40.0, 900)
    hello, sample = rig.driver.board, rig.readings[-1].sample
    assert hello is not None
    assert (hello.sample_period, hello.command_timeout, hello.decay) == (2000, 72, 1)
    assert (rig.driver.info.decay, rig.driver.info.sample_period) == ("coast", 0.001)
    assert sample.voltage == pytest.approx(-4.5, abs=0.03)
    assert sample.edge_count < -10
    assert sample.supply_voltage == pytest.approx(12.0, abs=0.1)


def test_voltages_are_limited_and_rounded_to_what_the_board_can(running: Rig) -> None:
    running.voltage = 100.0
    running.run(50)
    assert running.pins == 12.0
    running.voltage = 5.0
    running.run(50)
    assert running.pins == running.readings[-1].sample.voltage == pytest.approx(5.0, abs=0.5 * 12 / 256)


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


def test_a_held_up_driver_finds_its_board_switched_off(running: Rig) -> None:
    running.alive = False
    running.run(200)
    running.alive = True
    running.run(300)
    assert running.stops != [] and running.pins == 0.0
    assert running.enable() == ""
    running.until(lambda: running.pins == 6.0, 30)


def test_starts_off_where_the_user_wants_that(make_rig: MakeRig) -> None:
    rig = make_rig(enabled=False)
    rig.voltage = 6.0
    assert rig.enable() == "There is no link to the board yet."
    rig.plug()
    rig.run(500)
    assert rig.pins == 0.0 and len(rig.readings) > 50
    assert rig.enable() == ""
    rig.until(lambda: rig.pins == 6.0, 30)
    rig.enable(False)
    assert rig.until(lambda: rig.pins == 0.0, 30) < 20.0


def test_an_opening_that_resets_the_board_is_no_stop(make_rig: MakeRig) -> None:
    rig = make_rig()
    rig.voltage = 6.0
    rig.run(30)
    rig.plug()
    rig.run(2)
    rig.emulator.reset()
    rig.until(lambda: rig.pins == 6.0, 900)
    assert rig.stops == []


def said_by(rig: Rig) -> dict[int, Sample]:
    """What the board has said since `clean` was emptied, by sample time, read without any fault."""
    assert rig.driver.board is not None
    readout, said = Readout(rig.config, rig.driver.board), {}
    for event in Decoder().receive(rig.clean):
        if isinstance(event, Arrival) and isinstance(event.frame, Telemetry):
            assert readout.clock.hear(event.frame.time, rig.now)
            sample = readout.sample(event.frame)
            said[sample.sample_time] = sample
    return said


def test_bit_errors_never_make_a_wrong_sample(running: Rig) -> None:
    """Every published sample is one that the board has said, and the motor goes on turning."""
    running.faults = replace(running.faults, bit_error_rate=1e-3)
    running.clean, begin = b"", len(running.readings)
    running.run(4000)
    published, said = [reading.sample for reading in running.readings[begin:]], said_by(running)
    assert 500 < len(published) < 700 and len(said) > 795  # (1 − 1e-3)^288 is three quarters
    for sample in published:
        assert (sample.voltage, sample.edge_count, sample.edge_time, sample.edge_period, sample.speed) == (
            said[sample.sample_time].voltage,
            said[sample.sample_time].edge_count,
            said[sample.sample_time].edge_time,
            said[sample.sample_time].edge_period,
            pytest.approx(running.emulator.shaft.speed, rel=0.01),
        )
    assert running.stops == [] and {sample.voltage for sample in published} == {6.0}
    counters = running.driver.counters
    assert 100 < counters.lost < 600 and counters.bad > 100
    was = replace(status.tally(running.driver, running.now), link=LinkCounters(), readings=-1)
    assert re.fullmatch(r"\d+ damaged and \d+ lost frames .*", status.problem(running.driver, was, running.now + 1))


def test_another_version_is_refused_in_a_sentence(make_rig: MakeRig) -> None:
    rig = make_rig()
    rig.driver.opened("the port", rig.now)
    rig.driver.received(b"\0" + pack(Identify(), 0, version=2), rig.now)
    assert "The board on the port speaks protocol version 2, this driver version 1: update" in problem(rig)
    assert "has not answered" in rig.enable()


@pytest.mark.parametrize(
    ("board", "words"),
    [
        (
            FirmwareConfig(edges_per_revolution=20),
            "with 20 edges per revolution, and the parameter .* is 96: set the parameter",
        ),
        (FirmwareConfig(channels=2), r"reads 2 encoder channel\(s\), and single_channel is true: set the parameter"),
    ],
)
def test_a_board_that_does_not_fit_is_refused_in_a_sentence(
    make_rig: MakeRig, board: FirmwareConfig, words: str
) -> None:
    rig = make_rig(firmware=board)
    rig.plug()
    rig.voltage = 6.0
    rig.run(600)
    assert re.search(words, problem(rig)) and rig.readings == [] and rig.pins == 0.0


def test_nothing_that_answers_is_said_to_be_no_board(make_rig: MakeRig) -> None:
    rig = make_rig()
    rig.driver.opened("the port", rig.now - 3_100_000_000)
    rig.run(50)
    assert problem(rig).startswith("Nothing on the port answers as a motor board: flash it")


def test_a_board_too_slow_for_the_rate_says_what_it_achieves(running: Rig) -> None:
    was = status.tally(running.driver, running.now)
    running.run(500)
    assert status.achieved(running.driver, was, running.now) == pytest.approx(200.0, rel=0.02)
    assert float(status.values(running.driver, was, running.now)["achieved rate [Hz]"]) == pytest.approx(
        200.0, rel=0.02
    )
    running.faults = replace(running.faults, drop_rate=0.01)
    was = status.tally(running.driver, running.now)
    running.run(500)
    assert re.search(
        r"Only 1\d\d samples per second come instead of 200", status.problem(running.driver, was, running.now)
    )


def test_header_stamps_follow_a_crystal_that_is_off(make_rig: MakeRig) -> None:
    """Bytes are late by 0 to 10 ms both ways; the truth is the chip's cycle count."""
    rig = make_rig(step=MS)
    rig.plug()
    rig.faults = replace(rig.faults, delay=0.01)
    rig.voltage = 6.0
    rig.run(12_000)
    late = [(reading.host - rig.host(reading.sample.sample_time)) * 1e-6 for reading in rig.readings]
    assert fmean(x * x for x in late[400:]) ** 0.5 < 0.5
    assert min(late[400:]) < 0.4 and max(map(abs, late[400:])) < 1.0
    exchange = rig.driver.session.exchange if rig.driver.session else None
    assert exchange and exchange.fit.fit
    assert 0.05e6 < exchange.fit.fit.bound < 3e6
    assert all(abs(x) * 1e6 < exchange.fit.fit.bound for x in late[-100:])
    assert abs(exchange.fit.fit.drift) < 200e-6


def test_a_successor_does_not_drive_with_what_flowed_before(running: Rig) -> None:
    """Killed and started again under a voltage that keeps coming: 0 V until the user begins, or enables."""
    running.alive = False
    successor = Rig(emulator=running.emulator, cautious=False)
    successor.voltage, successor._said = 6.0, 500  # so many he has sent already
    successor.plug()
    successor.run(3000)
    assert successor.pins == 0.0 and successor.stops == [] and len(successor.readings) > 400
    assert "6 V was already being sent on motor/voltage when the plant came up" in problem(successor)
    assert successor.enable() == ""
    successor.until(lambda: successor.pins == 6.0, 30)
    assert problem(successor) == ""


def test_a_board_that_is_plugged_in_under_a_flowing_voltage_waits(make_rig: MakeRig) -> None:
    rig = make_rig(cautious=False)
    rig.voltage = 6.0
    rig.run(500)
    rig.plug()
    rig.run(3000)
    assert rig.pins == 0.0
    rig.voltage = 0.0
    rig.run(20)
    rig.voltage = 6.0
    rig.until(lambda: rig.pins == 6.0, 30)


def test_a_new_sender_drives_at_once(make_rig: MakeRig) -> None:
    rig = make_rig(cautious=False)
    rig.plug()
    rig.run(500)
    rig.voltage = 6.0
    rig.until(lambda: rig.pins == 6.0, 30)


@pytest.mark.parametrize(("supply", "duty"), [(24.0, 128), (48.0, 64), (0.0, 256)])
def test_a_motor_gets_its_own_voltage_from_a_higher_supply(make_rig: MakeRig, supply: float, duty: int) -> None:
    """12 V at most, as duty of what the supply gives."""
    full = supply or 12.0
    model = Parameters({"kv": PAPER_KV, "ka": PAPER_KA}, max_voltage=full)
    rig = make_rig(config=Config(supply_voltage=supply), parameters=model)
    rig.plug()
    rig.voltage = 100.0
    rig.until(lambda: rig.pins > 0.0, 500)
    rig.run(50)
    assert rig.driver.session and rig.driver.session.latest
    assert (rig.driver.session.latest.duty, rig.pins, rig.readings[-1].sample.voltage) == (duty, 12.0, 12.0)
    assert rig.driver.info.max_voltage == 12.0


def test_a_supply_below_the_motors_voltage_is_all_there_is(make_rig: MakeRig) -> None:
    rig = make_rig(config=Config(supply_voltage=9.0), parameters=replace(paper_motor(), max_voltage=9.0))
    rig.plug()
    rig.voltage = 12.0
    rig.until(lambda: rig.pins == 9.0, 500)
    rig.run(50)
    assert (rig.readings[-1].sample.voltage, rig.driver.info.max_voltage) == (9.0, 9.0)


@pytest.mark.parametrize(
    ("told", "words"), [(0.0, ""), (24.0, ""), (12.0, "a supply of 23.9 V, and supply_voltage is 12")]
)
def test_a_measured_supply_prevails(make_rig: MakeRig, told: float, words: str) -> None:
    """A 12 V motor on 24 V gets 12 V, even where the parameter is wrong."""
    board = FirmwareConfig(edges_per_revolution=96, supply_full_scale=40_000)
    motor = replace(paper_motor(), max_voltage=24.0)
    rig = make_rig(config=Config(supply_voltage=told), firmware=board, parameters=motor)
    rig.emulator.chip.supply(3.0)  # of 5 V, for 40 V
    rig.plug()
    rig.voltage = 12.0
    rig.until(lambda: rig.pins > 0.0, 500)
    rig.run(500)
    assert rig.pins == pytest.approx(12.0, abs=0.1)
    assert rig.readings[-1].sample.voltage == pytest.approx(12.0, abs=0.1)
    assert (words in problem(rig)) if words else problem(rig) == ""
    rig.emulator.chip.supply(0.1)  # switched off: nothing to divide by
    rig.run(200)
    assert rig.readings[-1].sample.voltage == pytest.approx(12.0, abs=0.1)


@pytest.mark.parametrize(
    ("wanted", "there", "words"),
    [
        (None, 7, ""),
        (7, 7, ""),
        (8, 7, "This is the board number 7, and the parameter board_id is 8: plug the right board in"),
        (8, 0, "This is the board without a number, and the parameter board_id is 8"),
    ],
)
def test_another_board_is_refused_in_a_sentence(make_rig: MakeRig, wanted: int | None, there: int, words: str) -> None:
    rig = make_rig(config=Config(board_id=wanted), firmware=FirmwareConfig(board_id=there))
    rig.plug()
    rig.voltage = 6.0
    rig.run(600)
    assert problem(rig).startswith(words) and rig.driver.unsuitable(rig.now) == bool(words)
    assert (rig.readings == []) == bool(words) and (rig.pins == 0.0) == bool(words)


def test_what_has_begun_to_run_is_said(running: Rig) -> None:
    assert status.connection(running.driver) == "Connected to the port: firmware 1.3.0, 96 edges per revolution, 12 V."
