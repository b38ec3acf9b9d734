"""Telemetry as samples: counts through wraps, voltages of the supply, speeds with their sign."""

from dataclasses import asdict, replace
from math import isnan, tau

import pytest
from board_frames import HELLO, TELEMETRY
from hypothesis import given, settings
from hypothesis import strategies as st

from motor_control.controller.plant_watch import watch_plant
from motor_driver.config import Config
from motor_driver.frames.codes import NOT_MEASURED, Flag
from motor_driver.frames.from_board import Sensed, Telemetry
from motor_driver.readout import Readout
from motor_model.sample import Sample


def readout(config: Config | None = None) -> Readout:
    return Readout(config or Config(), HELLO)


def heard(into: Readout, frame: Telemetry) -> Sample:
    into.clock.hear(frame.time, frame.time * 500)
    return into.sample(frame)


def test_duty_and_voltage_are_the_same_thing_twice() -> None:
    board = readout()
    assert heard(board, replace(TELEMETRY, duty=128)).voltage == 6.0
    assert (board.duty(6.0), board.duty(-12.0), board.duty(100.0), board.duty(0.0)) == (128, -256, 256, 0)


def test_a_motor_of_12_volt_on_24_volt_gets_half_the_duty() -> None:
    board = readout(Config(max_voltage=12.0, supply_voltage=24.0))
    assert (board.duty(12.0), board.duty(24.0), board.duty(-6.0)) == (128, 128, -64)
    assert heard(board, replace(TELEMETRY, duty=128)).voltage == 12.0


def test_a_measured_supply_prevails() -> None:
    board = readout(Config(max_voltage=12.0))
    sample = heard(board, replace(TELEMETRY, duty=128, supply=10_000))
    assert (sample.supply_voltage, sample.voltage) == (10.0, pytest.approx(5.0))
    assert isnan(heard(readout(), TELEMETRY).supply_voltage)
    off = heard(readout(), replace(TELEMETRY, duty=128, supply=200))  # switched off: full duty is what was said
    assert off.voltage == 6.0 and off.supply_voltage == 0.2


@pytest.mark.parametrize(("measured", "taken"), [(480, 0.48), (310, 0.31), (290, 1.2)])
def test_a_measured_supply_of_less_than_a_quarter_of_what_is_expected_is_off(measured: int, taken: float) -> None:
    """1.2 V are expected; it was less than 3 V for any motor, and what was said prevailed."""
    sample = heard(readout(Config(max_voltage=1.2)), replace(TELEMETRY, duty=256, supply=measured))
    assert sample.voltage == pytest.approx(taken)


@pytest.mark.parametrize(("measured", "taken"), [(13.0, 13.0), (11.0, 12.0), (3.5, 12.0), (30.0, 30.0)])
def test_no_supply_at_work_is_less_than_half_of_what_was_said(measured: float, taken: float) -> None:
    """The divider of a 6 V motor on 24 V came loose and read 3.5 V: the motor got 24 V."""
    board = readout(Config(max_voltage=6.0, supply_voltage=24.0))
    for _ in range(10):
        heard(board, replace(TELEMETRY, supply=round(1e3 * measured)))
    highest = taken if measured > 12.0 else 24.0  # 24 V it may have all the same: half of them were too much
    assert board.supply == pytest.approx(taken) and board.duty(6.0) == int(6.0 / highest * 256)


@pytest.mark.parametrize(("measured", "taken"), [(23.0, 23.0), (13.0, 13.0), (11.0, 12.0), (3.5, 12.0), (30.0, 30.0)])
def test_no_supply_at_work_is_less_than_half_of_what_it_was(measured: float, taken: float) -> None:
    """A 12 V motor on 24 V that the board measures and nobody has said: a divider that read 3.5 V gave it 24 V."""
    board = readout(Config(max_voltage=12.0))
    for supply in [24.0] * 400 + [measured] * 1000:
        heard(board, replace(TELEMETRY, supply=round(1e3 * supply)))
    assert board.supply == pytest.approx(taken, rel=0.02)
    if measured < 12.0:
        assert board.duty(3.0) / 256 * 24.0 == pytest.approx(6.0, rel=0.02)
        assert 11.8 < board.duty(12.0) / 256 * 24.0 < 12.3


def test_a_spike_of_a_measured_supply_is_no_supply() -> None:
    board = readout(Config(max_voltage=12.0))
    for supply in [12.0] * 400 + [60.0] + [12.0] * 1000 + [7.0] * 1000:
        heard(board, replace(TELEMETRY, supply=round(1e3 * supply)))
    assert board.supply == pytest.approx(7.0, rel=0.01)


def test_a_current_needs_a_board_that_senses_it_and_a_gain() -> None:
    sensed = Sensed(**asdict(TELEMETRY), current=612)
    board = readout(Config(current_gain=0.185, current_offset=2.5))
    assert heard(board, sensed).current == pytest.approx((612 * 5.0 / 1024 - 2.5) / 0.185)  # 2.64 A
    assert isnan(heard(board, replace(sensed, time=20_000, current=NOT_MEASURED)).current)
    assert isnan(heard(readout(), sensed).current) and isnan(heard(readout(), TELEMETRY).current)


def test_counts_go_on_through_a_wrap_and_down() -> None:
    board = readout()
    counts = [(1 << 32) - 2, 3, (1 << 32) - 1]
    read = [heard(board, replace(TELEMETRY, time=10_000 * k, edge_count=n)) for k, n in enumerate(counts, 1)]
    assert [sample.edge_count for sample in read] == [-2, 3, -1]


def test_one_channel_shows_no_direction_and_two_do() -> None:
    frame = replace(TELEMETRY, time=30_000, edge_time=29_900, edge_period=2_000, flags=Flag.EDGE_VALID | Flag.REVERSE)
    two = heard(readout(Config(single_channel=False)), frame)
    assert two.speed == pytest.approx(-tau / 96 / 0.001)
    assert heard(readout(), replace(frame, duty=128)).speed == pytest.approx(tau / 96 / 0.001)
    assert (two.edge_period, two.edge_time) == (pytest.approx(0.001), 1_000_000_000 + 29_900 * 500)


def test_a_board_that_starts_anew_counts_from_0() -> None:
    board = readout()
    before = heard(board, replace(TELEMETRY, time=50_000, edge_count=100))
    board.restart(replace(TELEMETRY, time=2_000), HELLO, 60_000 * 500)
    after = board.sample(replace(TELEMETRY, time=2_000, edge_count=5))
    assert (before.edge_count, after.edge_count) == (100, 5)
    assert after.sample_time - before.sample_time == 10_000 * 500  # the host's clock bridges the reset


def test_a_board_that_was_reset_while_the_motor_turns_is_seen() -> None:
    """An edge had passed by its first sample: counts of 900, then 3, and nobody saw the reset."""
    board = readout(Config(single_channel=False))
    flags = Flag.EDGE_VALID
    before = replace(TELEMETRY, time=50_000, edge_count=900, edge_time=49_900, edge_period=2_000, flags=flags)
    watch = watch_plant(None, heard(board, before), 0.0, 0.005)
    after = replace(before, time=12_000, edge_count=3, edge_time=11_900)
    board.restart(after, HELLO, 60_000 * 500)
    first = board.sample(after)
    assert (first.edge_time, first.edge_period) == (0, 0.0) and first.speed == pytest.approx(tau / 96 / 0.001)
    watch = watch_plant(watch, first, 0.005, 0.005)
    assert watch.restarted
    second = heard(board, replace(after, time=22_000, edge_count=8, edge_time=21_900))
    assert second.sample_time - second.edge_time == 100 * 500 and second.edge_count == 8
    assert not watch_plant(watch, second, 0.01, 0.005).restarted


@settings(deadline=None, max_examples=300)
@given(
    wanted=st.floats(allow_nan=False),
    motor=st.floats(0.1, 100.0),
    said=st.just(0.0) | st.floats(0.1, 100.0),
    measured=st.none() | st.integers(0, 60_000),
)
def test_no_duty_gives_the_motor_more_than_its_voltage(
    wanted: float, motor: float, said: float, measured: int | None
) -> None:
    """Whatever is asked for and whatever the supply is; a supply of 25 V gave a 12 V motor 12.01 V by rounding."""
    board = readout(Config(max_voltage=motor, supply_voltage=said))
    if measured is not None:
        heard(board, replace(TELEMETRY, supply=measured))
    duty = board.duty(wanted)
    assert -256 <= duty <= 256 and (duty == 0 or (duty > 0) == (wanted > 0.0))
    assert abs(duty) / 256 * board.supply <= motor * (1.0 + 1e-12)


def test_what_is_exchanged_is_made_up_for_in_software() -> None:
    frame = replace(TELEMETRY, duty=64, edge_count=5, time=30_000, edge_time=29_900, edge_period=2_000)
    frame = replace(frame, flags=Flag.EDGE_VALID)
    motor = readout(Config(reverse_motor=True))
    assert motor.duty(6.0) == -128 and heard(motor, frame).voltage == -3.0
    encoder = readout(Config(reverse_encoder=True, single_channel=False))
    sample = heard(encoder, frame)
    assert sample.edge_count == -5 and sample.speed == pytest.approx(-tau / 96 / 0.001) and sample.voltage == 3.0
    one = readout(Config(reverse_encoder=True))  # one channel has no direction to exchange
    assert heard(one, frame).edge_count == 5


@pytest.mark.parametrize(("rise", "at_once"), [(1.03, False), (1.5, True)])
def test_a_supply_that_comes_back_is_known_before_the_next_voltage(rise: float, at_once: bool) -> None:
    """It sagged to 12 V and came back to 24: for a third of a second a 12 V motor got more than 12 V."""
    board = readout(Config(max_voltage=12.0))
    for _ in range(400):
        heard(board, replace(TELEMETRY, supply=12_000))
    heard(board, replace(TELEMETRY, supply=round(12_000 * rise)))
    given = board.duty(6.0) / 256 * 12.0 * rise
    assert (given <= 6.0 + 12.0 * rise / 512) == at_once
