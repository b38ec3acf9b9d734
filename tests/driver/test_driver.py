"""The driver's logic with the real firmware while all is well, or nearly: voltages, samples, times, damaged frames.

All times are the emulator's: the pins of the emulated chip against its own clock.
"""

import re
from dataclasses import replace
from itertools import pairwise
from math import isnan, tau
from statistics import fmean

import pytest
from driver_rig import MakeRig, Rig, problem
from emulated_board import MS

from motor_board.build import FirmwareConfig
from motor_driver import status
from motor_driver.config import Config
from motor_driver.frames.codes import Decay
from motor_driver.frames.from_board import Telemetry
from motor_driver.protocol import Arrival, Decoder, LinkCounters
from motor_driver.readout import Readout
from motor_model.parameters import PAPER_KV
from motor_model.sample import Sample


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
    rig.run(7_000)
    late = [(reading.host - rig.host(reading.sample.sample_time)) * 1e-6 for reading in rig.readings]
    assert fmean(x * x for x in late[400:]) ** 0.5 < 0.5
    assert min(late[400:]) < 0.4 and max(map(abs, late[400:])) < 1.0
    exchange = rig.driver.session.exchange if rig.driver.session else None
    assert exchange and exchange.fit.fit
    assert 0.05e6 < exchange.fit.fit.bound < 3e6
    assert all(abs(x) * 1e6 < exchange.fit.fit.bound for x in late[-100:])
    assert abs(exchange.fit.fit.drift) < 200e-6


def test_what_has_begun_to_run_is_said(running: Rig) -> None:
    assert status.connection(running.driver) == "Connected to the port: firmware 1.4.6, 96 edges per revolution, 12 V."
