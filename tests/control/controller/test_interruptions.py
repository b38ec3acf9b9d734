"""What is no number, or no voltage, again and again."""

from dataclasses import replace
from math import inf, nan

import pytest
from fault_bench import SLOT

from motor_control.controller import controller
from motor_control.controller.faults.evidence import Config as FaultConfig
from motor_control.controller.interruptions import Interruptions, count_interruption
from motor_control.controller.output import RUNNING, STOPPED
from motor_control.controller.pi import Config as Gains
from motor_control.controller.run import Config
from motor_model.sample import Sample

CONFIG = Config(Gains(0.2, 2.5, 12.0), 12.0, 0.1, 0.0, 0.0, sample_period=0.005)


def stopped(every: int, how: str, value: float = nan) -> tuple[float, str]:
    """When [s] the motor is stopped for good where every so many-th speed, or reference, is no number."""
    state = controller.State()
    for k in range(1, 2001):
        bad = k % every == 0
        sample = Sample(k * 5_000_000, value if bad and how == "sample" else 1.0, 3.0, k, k * 5_000_000, SLOT)
        reference = (value if bad else 50.0) if how == "reference" else 50.0 if k == 1 else None
        config = replace(CONFIG, voltage_limit=0.0) if bad and how == "limit" else CONFIG
        output, state = controller.update(config, state, sample, reference, 0.005 * k)
        assert output.state == (STOPPED if bad or state.latched else RUNNING)
        if state.latched:
            assert output.fault == state.latched and "motor/reset" in output.reason
            return 0.005 * k, state.latched
    return inf, ""


@pytest.mark.parametrize("value", [nan, inf, -inf])
@pytest.mark.parametrize("how", ["sample", "reference"])
def test_the_third_in_a_row_of_interruptions_stops_the_motor(how: str, value: float) -> None:
    """It was half of the voltage for ever, on a lost line, too."""
    for every in (2, 3, 10, 100):
        when, reason = stopped(every, how, value)
        assert when == pytest.approx(3 * every * 0.005)
        assert reason.startswith("A sample on motor/speed says" if how == "sample" else "The reference is")
        assert "comes and goes, 3 times within a second" in reason


def test_a_voltage_limit_of_0_that_comes_and_goes_is_one() -> None:
    """It was half of the voltage for ever, on a line that hums, too."""
    for every in (2, 100):
        when, reason = stopped(every, "limit")
        assert when == pytest.approx(3 * every * 0.005)
        assert reason.startswith("voltage_limit is 0 V") and "or sets parameters" in reason


@pytest.mark.parametrize("how", ["sample", "reference", "limit"])
def test_seldom_ones_do_not(how: str) -> None:
    assert stopped(202, how) == (inf, "")  # every 1.01 s


@pytest.mark.parametrize(("every", "stops"), [(220, True), (390, True), (410, False)])
def test_a_long_stall_time_gives_them_no_more_room(every: int, stops: bool) -> None:
    """Each began the checks anew: with 2 s of `stall_time` a blocked shaft got 12 V for ever between two of them."""
    config, state = replace(CONFIG, faults=FaultConfig(slot=SLOT, stall_time=2.0)), controller.State()
    for k in range(1, 1 + 6 * every):
        speed = nan if k % every == 0 else 0.0
        sample = Sample(k * 5_000_000, speed, state.run.asked if state.run else 0.0, 1, 5_000_000, 0.0)
        _, state = controller.update(config, state, sample, 90.0 if k == 1 else None, 0.005 * k)
        if state.latched:
            break
    assert state.latched and ("within 4 s of one another" in state.latched) == stops
    assert stops or "no edge came" in state.latched  # the checks have had their time


@pytest.mark.parametrize(
    ("stall_time", "apart", "most"), [(0.5, 0.99, 3), (0.5, 1.01, 9), (2.0, 3.99, 3), (2.0, 4.01, 9)]
)
def test_they_count_within_two_stall_times(stall_time: float, apart: float, most: int) -> None:
    state, count = Interruptions(), 0
    for k in range(8):
        reason, state = count_interruption(state, "bad", apart * k, stall_time)
        _, state = count_interruption(state, "", apart * k + 0.1, stall_time)
        count = count or (k + 1 if reason else 0)
    assert (count or 9) == most


def test_one_that_lasts_is_one() -> None:
    state = Interruptions()
    for k in range(100):
        reason, state = count_interruption(state, "bad", 0.01 * k)
        assert not reason and state.count == 1
    reason, state = count_interruption(state, "", 1.0)
    assert not reason and not state.bad and state.count == 1


@pytest.mark.parametrize(
    ("stall_time", "apart", "stops"), [(0.1, 0.9, True), (0.0, 0.9, True), (0.1, 1.1, False), (2.0, 3.9, True)]
)
def test_interruptions_within_a_second_or_twice_the_stall_time_are_of_one_cause(
    stall_time: float, apart: float, stops: bool
) -> None:
    """However quickly the other checks tell."""
    state, said = Interruptions(), ""
    for k in range(3):
        said, state = count_interruption(state, "Nothing.", k * apart, stall_time)
        _, state = count_interruption(state, "", k * apart + 0.01, stall_time)
    assert bool(said) is stops
