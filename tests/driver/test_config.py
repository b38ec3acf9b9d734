"""What the driver asks of a board, and which board it refuses."""

from dataclasses import replace

import pytest
from board_frames import HELLO

from motor_driver.config import SILENCE, Config
from motor_driver.exchange import MEMORY, PING_EVERY
from motor_driver.frames.codes import Decay
from motor_driver.frames.from_host import Configure


@pytest.mark.parametrize(
    ("rate", "period"), [(200.0, 10_000), (1000.0, 2_000), (10.0, 200_000), (5000.0, 2_000)]
)  # the last: no quicker than the board can
def test_the_sample_period_is_in_ticks_of_the_board(rate: float, period: int) -> None:
    assert Config(sample_rate=rate).configure(HELLO).sample_period == period
    assert Config(sample_rate=200.0).configure(replace(HELLO, tick_ns=1000)).sample_period == 5_000


@pytest.mark.parametrize(("rate", "older"), [(61.0, 0x8000), (20.33, 3 * 0x8000), (50.0, 40_000), (200.0, 10_000)])
def test_an_older_board_is_given_no_period_that_ends_with_a_short_step(rate: float, older: int) -> None:
    """It would notice a missing command ever later: 61 Hz are a longest step of its counter and 10 us."""
    board = replace(HELLO, firmware_major=1, firmware_minor=4, firmware_patch=4)
    assert Config(sample_rate=rate).configure(board).sample_period == older
    newer = Config(sample_rate=rate).configure(replace(board, firmware_patch=5)).sample_period
    assert newer == round(2e6 / rate)


@pytest.mark.parametrize(("timeout", "milliseconds"), [(0.1, 120), (0.06, 72), (0.01, 50), (5.0, 120)])
def test_the_board_waits_a_little_longer_than_the_driver_and_never_long(timeout: float, milliseconds: int) -> None:
    asked = Config(command_timeout=timeout, decay=Decay.COAST).configure(HELLO)
    assert asked == Configure(10_000, milliseconds, Decay.COAST)


@pytest.mark.parametrize(("timeout", "longest"), [(0.02, 0.1), (0.1, 0.1), (0.5, 0.5), (1.0, 1.0), (10.0, 1.0)])
def test_a_link_may_be_as_late_as_commands_are_old_but_no_later_than_pings_are_known(
    timeout: float, longest: float
) -> None:
    """A stop of the user's acts as late: 10 s were allowed, and 1.3 s called "later than 10000 ms"."""
    assert Config(command_timeout=timeout).round_trip == longest < MEMORY * PING_EVERY * 1e-9


def test_silence_is_a_stop_before_150_ms_but_for_slow_samples() -> None:
    assert Config().silence == SILENCE < 0.15
    assert Config(sample_rate=10.0).silence == pytest.approx(0.15)


def test_a_board_for_another_encoder_is_refused() -> None:
    assert Config().refusal(HELLO) == "" and Config().refusal(replace(HELLO, edges_per_revolution=0)) == ""
    said = Config().refusal(replace(HELLO, edges_per_revolution=12))
    assert "an encoder with 12 edges per revolution, and the parameter edges_per_revolution is 96" in said
    said = Config(single_channel=False).refusal(HELLO)
    assert "reads 1 encoder channel(s), and single_channel is false" in said
    assert Config(single_channel=False).refusal(replace(HELLO, channels=2)) == ""


@pytest.mark.parametrize(("major", "minor", "refused"), [(1, 0, True), (0, 9, True), (1, 1, False), (2, 0, False)])
def test_firmware_that_is_too_old_is_refused(major: int, minor: int, refused: bool) -> None:
    """Without pull-ups and with a wrong count it was driven without a word."""
    said = Config().refusal(replace(HELLO, firmware_major=major, firmware_minor=minor))
    assert (said == "") != refused
    assert not refused or (f"firmware {major}.{minor}, and this driver needs 1.1" in said and "flash" in said)


def test_another_board_than_the_one_named_is_refused() -> None:
    assert Config(board_id=3).refusal(replace(HELLO, board_id=3)) == ""
    assert "board number 4, and the parameter board_id is 3" in Config(board_id=3).refusal(replace(HELLO, board_id=4))
    assert "board without a number, and the parameter board_id is 3" in Config(board_id=3).refusal(HELLO)
    assert Config().refusal(replace(HELLO, board_id=4)) == ""


def test_info_is_what_the_board_does_and_before_it_speaks_what_was_asked() -> None:
    info = Config(max_voltage=9.0).info(replace(HELLO, sample_period=2_000, decay=Decay.COAST))
    assert (info.sample_period, info.edge_resolution, info.decay) == (pytest.approx(0.001), 5e-7, "coast")
    assert (info.source, info.max_voltage, info.edges_per_revolution) == ("hardware", 9.0, 96)
    early = Config(sample_rate=500.0).info(None)
    assert (early.sample_period, early.edge_resolution, early.decay) == (0.002, 5e-7, "brake")


@pytest.mark.parametrize(("motor", "supply", "most"), [(12.0, 0.0, 12.0), (12.0, 24.0, 12.0), (12.0, 9.0, 9.0)])
def test_no_more_than_the_motors_voltage_nor_than_the_supply(motor: float, supply: float, most: float) -> None:
    info = Config(max_voltage=motor, supply_voltage=supply).info(HELLO)
    assert (info.max_voltage, info.full_voltage) == (most, supply or motor)


@pytest.mark.parametrize(("name", "bad", "good"), [("tick_ns", 0, 1), ("pwm_top", 0, 1), ("pwm_top", 32_768, 32_767)])
def test_a_board_that_says_what_cannot_be_is_refused(name: str, bad: int, good: int) -> None:
    assert f"says {name} = {bad}, which cannot be" in Config().refusal(replace(HELLO, **{name: bad}))
    assert Config().refusal(replace(HELLO, **{name: good})) == ""
