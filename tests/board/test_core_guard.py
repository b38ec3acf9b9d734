"""The firmware's watch over the motor's current, on this computer, against whole numbers of any size."""

from ctypes import byref

import firmware_core as core
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motor_driver.current_limits import MOST_BUDGET, CurrentLimits

UNKNOWN = 0xFFFF
WELL, OVERCURRENT, BLIND = range(3)


def guard_with(zero: int, most: int, rated: int, budget: int) -> core.Guard:
    guard = core.Guard()
    core.load().guard_set(byref(guard), byref(core.WireProtect(zero, most, rated, budget)))
    return guard


@given(
    st.integers(0, 1023),
    st.integers(1, 1023),
    st.integers(0, 1023),
    st.integers(0, 2**32 - 1),
    st.lists(st.tuples(st.one_of(st.integers(0, 1023), st.just(UNKNOWN)), st.integers(0, 2**24)), max_size=40),
)
@settings(max_examples=300, deadline=None)
def test_it_does_what_the_wire_says(
    zero: int, most: int, rated: int, budget: int, samples: list[tuple[int, int]]
) -> None:
    guard = guard_with(zero, most, rated, budget)
    current = above = heat = unknown = 0
    budget = min(budget, MOST_BUDGET)
    for steps, period in samples:
        unknown = unknown + 1 if steps == UNKNOWN else 0
        if steps != UNKNOWN:
            current = abs(steps - zero)
            above = above + 1 if current > most else 0
        heat = max(heat + (current**2 // 64 - min(rated, 1023) ** 2 // 64) * min(period // 64, 0xFFFF), 0)
        too_much = above >= 2 or (heat >= budget and current**2 // 64 > rated**2 // 64)
        expected = OVERCURRENT if too_much else BLIND if unknown >= 10 else WELL
        assert core.load().guard_check(byref(guard), steps, period) == expected
        heat = min(heat, budget)
        assert guard.heat == heat


@pytest.mark.parametrize("rate", [200, 1000])
@pytest.mark.parametrize(("amperes", "after"), [(5.0, 0.5), (4.0, 0.5 * 21.0 / 12.0), (2.1, 25.6), (1.95, None)])
def test_a_current_lasts_as_long_as_its_square_allows(rate: int, amperes: float, after: float | None) -> None:
    """Limits of 5 A for 0.5 s from cold and 2 A for ever, a sensor of 0.185 V/A, a board with ticks of 500 ns."""
    wanted = CurrentLimits(5.0, 2.0, 0.5).protect(0.185, 2.5, 500)
    guard = guard_with(wanted.zero, wanted.most, wanted.rated, wanted.budget)
    steps = wanted.zero - round(amperes * 0.185 * 1024 / 5.0)
    for k in range(40 * rate):
        if core.load().guard_check(byref(guard), steps, 2_000_000 // rate):
            assert after is not None and k / rate == pytest.approx(after, rel=0.15 if amperes < 3.0 else 0.05)
            break
    else:
        assert after is None


def test_a_current_that_is_no_longer_converted_switches_off() -> None:
    """No data is not zero: the tenth sample in a row without a conversion, and not the ninth."""
    guard = guard_with(512, 100, 50, MOST_BUDGET)
    check = core.load().guard_check
    for _ in range(3):
        assert [check(byref(guard), UNKNOWN, 2_000) for _ in range(9)] == [WELL] * 9
        assert check(byref(guard), 512, 2_000) == WELL
    assert [check(byref(guard), UNKNOWN, 2_000) for _ in range(300)] == [WELL] * 9 + [BLIND] * 291
    assert check(byref(guard), 512, 2_000) == WELL
    without = guard_with(512, 0, 0, 0)
    assert [check(byref(without), UNKNOWN, 2_000) for _ in range(300)] == [WELL] * 300


@given(st.floats(0.05, 1.0), st.floats(32.0, 200.0), st.sampled_from([-1, 1]))
@settings(max_examples=60, deadline=None)
def test_what_lasts_is_kept_to_a_converters_step_and_a_half(gain: float, steps: float, way: int) -> None:
    """In amperes, by no rule of the firmware's: at `rated` less 1.5 steps never off, at 1.5 steps more some time."""
    step = 5.0 / 1024 / gain  # [A]
    wanted = CurrentLimits(1.5 * steps * step, steps * step, 0.1).protect(gain, 2.5, 500)
    for amperes, stops in ((steps * step - 1.5 * step, False), (steps * step + 1.5 * step, True)):
        guard = guard_with(wanted.zero, wanted.most, wanted.rated, wanted.budget)
        shown = int((2.5 + way * gain * amperes) * 1024 / 5.0)
        verdicts = {core.load().guard_check(byref(guard), shown, 10_000) for _ in range(3_000)}
        assert (OVERCURRENT in verdicts) == stops


def test_heat_outlives_a_reset_and_garbage_is_none() -> None:
    hot, kept = guard_with(512, 400, 100, 1000), core.GuardMemory()
    hot.heat = 777
    core.load().guard_keep(byref(hot), byref(kept))
    for memory, heat in ((kept, 777), (core.GuardMemory(777, 777), 0), (core.GuardMemory(2**30, 2**32 - 1 - 2**30), 0)):
        fresh = core.Guard()
        core.load().guard_recall(byref(fresh), byref(memory))
        assert fresh.heat == heat


def test_no_budget_is_so_large_that_heat_goes_round_below_it() -> None:
    """The largest current for 2 s a sample: one lasts, the second is off, and so it stays."""
    guard = guard_with(0, 1023, 0, 2**32 - 1)
    assert guard.limits.budget == MOST_BUDGET
    verdicts = [core.load().guard_check(byref(guard), 1023, 2**24) for _ in range(20)]
    assert verdicts == [WELL] + [OVERCURRENT] * 19


def test_new_limits_count_from_the_next_sample_on() -> None:
    guard, check = guard_with(512, 100, 1023, MOST_BUDGET), core.load().guard_check
    assert check(byref(guard), 700, 2_000) == WELL  # the first of two
    core.load().guard_set(byref(guard), byref(core.WireProtect(512, 100, 1023, MOST_BUDGET)))
    assert [check(byref(guard), 700, 2_000) for _ in range(2)] == [WELL, OVERCURRENT]
    assert [check(byref(guard), UNKNOWN, 2_000) for _ in range(9)][-1] == OVERCURRENT  # the latest one holds
    core.load().guard_set(byref(guard), byref(core.WireProtect(512, 100, 1023, MOST_BUDGET)))
    assert [check(byref(guard), UNKNOWN, 2_000) for _ in range(10)] == [WELL] * 9 + [BLIND]
