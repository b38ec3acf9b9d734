"""The controller sample by sample: states, reasons, time, restarts."""

from dataclasses import replace
from itertools import pairwise
from math import inf, isfinite, isnan, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from motor_control.controller import controller, pi
from motor_control.controller.controller import Config, State
from motor_control.controller.output import Output
from motor_model.errors import MotorError
from motor_model.sample import Sample

CONFIG = Config(
    pi.Config(kp=0.2, ki=2.5, limit=12.0),
    voltage_limit=12.0,
    sample_timeout=0.1,
    reference_rate_limit=0.0,
    reversal_speed=10.0,
)
TWO_CHANNELS = replace(CONFIG, single_channel=False)
MS = 1_000_000  # [ns]


def feed(
    times_ms: list[float], speed: float, reference: float, config: Config = CONFIG, state: State | None = None
) -> tuple[Output, State]:
    """Samples of one speed at these times from a plant that applies what it was asked for; the last output."""
    assert times_ms
    state = state or State()
    for time in times_ms:
        sample = Sample(round(time * MS), speed, state.run.asked if state.run else 0.0)
        output, state = controller.update(config, state, sample, reference, time * 1e-3)
    return output, state


def assert_stopped(output: Output, *words: str) -> None:
    assert output.terms.voltage == output.terms.integral == 0.0
    assert output.state != controller.RUNNING
    assert all(word in output.reason for word in words), output.reason


def test_without_a_reference_it_is_disabled_and_says_how_to_give_one() -> None:
    output, _ = controller.update(CONFIG, State(), Sample(0, 3.0, 0.0), None, 0.0)
    assert_stopped(output, "motor/reference", "rad/s")
    assert output.state == controller.DISABLED
    assert isnan(output.reference) and output.speed == 3.0


def test_running_shows_every_term() -> None:
    output, _ = feed([0, 5, 10], speed=90.0, reference=100.0)
    assert (output.state, output.reason) == (controller.RUNNING, "")
    assert (output.reference, output.speed, output.terms.error) == (100.0, 90.0, 10.0)
    assert output.terms.proportional == pytest.approx(2.0)
    assert output.terms.integral == pytest.approx(2.5 * 10.0 * 0.010)
    assert output.terms.voltage == pytest.approx(2.25)
    assert isnan(output.speed_sigma)


def test_time_is_the_plants_and_lost_samples_count() -> None:
    all_of_them, _ = feed([0, 5, 10, 15, 20], speed=99.0, reference=100.0)
    some_lost, _ = feed([0, 20], speed=99.0, reference=100.0)
    assert some_lost.terms.integral == pytest.approx(all_of_them.terms.integral) == pytest.approx(0.05)


def test_late_messages_change_nothing() -> None:
    _, state = controller.update(CONFIG, State(), Sample(0, 99.0, 0.0), 100.0, now=0.0)
    output, _ = controller.update(CONFIG, state, Sample(5 * MS, 99.0, 0.0), 100.0, now=0.09)
    assert output.terms.integral == pytest.approx(2.5 * 0.005)


def test_a_repeated_sample_integrates_nothing() -> None:
    once, state = feed([0, 5], speed=99.0, reference=100.0)
    again, _ = feed([5], speed=99.0, reference=100.0, state=state)
    assert again.terms.integral == once.terms.integral > 0.0


@pytest.mark.parametrize("time_ms", [2.0, 111.0])
def test_restart_and_gap_begin_a_new_run(time_ms: float) -> None:
    """The plant's clock is behind, or further ahead than `sample_timeout`."""
    _, state = feed([0, 5, 10], speed=99.0, reference=100.0)
    output, state = feed([time_ms], speed=99.0, reference=100.0, state=state)
    if time_ms < 10.0:  # it was restarted
        assert_stopped(output, "The plant was restarted.", "begin again, with 0")
        state, time_ms = controller.refer(state, 0.0, 0.002), time_ms + 5
        output, state = feed([time_ms], speed=99.0, reference=100.0, state=state)
    assert output.state == controller.RUNNING and output.terms.integral == 0.0
    output, _ = feed([time_ms + 5], speed=99.0, reference=100.0, state=state)
    assert output.terms.integral == pytest.approx(2.5 * 0.005)


def test_a_gap_just_within_the_timeout_goes_on() -> None:
    _, state = feed([0, 5, 10], speed=99.0, reference=100.0)
    output, _ = feed([109], speed=99.0, reference=100.0, state=state)
    assert output.terms.integral == pytest.approx(2.5 * 0.109)


def test_rate_limit_begins_at_the_motion_and_ends_at_the_reference() -> None:
    config = replace(CONFIG, reference_rate_limit=200.0)
    output, state = feed([0], speed=20.0, reference=100.0, config=config)
    assert output.reference == 20.0
    output, state = feed([5, 10], speed=20.0, reference=100.0, config=config, state=state)
    assert output.reference == pytest.approx(22.0)
    output, _ = feed([10 + 5 * k for k in range(1, 100)], speed=20.0, reference=100.0, config=config, state=state)
    assert output.reference == 100.0


@pytest.mark.parametrize("reference", [nan, inf, -inf])
def test_a_reference_that_is_not_finite_stops_until_the_next_finite_one(reference: float) -> None:
    _, state = feed([0, 5], speed=50.0, reference=100.0)
    output, state = feed([10], speed=50.0, reference=reference, state=state)
    assert_stopped(output, str(reference), "motor/reference")
    assert output.state == controller.STOPPED
    output, _ = feed([15], speed=50.0, reference=100.0, state=state)
    assert output.state == controller.RUNNING
    assert output.terms.integral == 0.0 and output.terms.voltage == pytest.approx(10.0)


@pytest.mark.parametrize("field", ["speed", "voltage", "edge_period"])
@pytest.mark.parametrize("value", [nan, inf, -inf])
def test_a_sample_that_is_not_finite_stops(field: str, value: float) -> None:
    sample = replace(Sample(0, 50.0, 0.0), **{field: value})
    output, state = controller.update(CONFIG, State(), sample, 100.0, 0.0)
    assert_stopped(output, "motor/speed", field)
    assert feed([5], speed=50.0, reference=100.0, state=state)[0].state == controller.RUNNING


def test_unmeasured_current_and_supply_do_not_matter() -> None:
    sample = Sample(0, 50.0, 0.0, supply_voltage=nan, current=nan)
    assert controller.update(CONFIG, State(), sample, 100.0, 0.0)[0].state == controller.RUNNING


def test_stops_one_after_the_other_are_cleared_later_and_later() -> None:
    state, cleared = State(), []
    for now in (0.0, 0.1, 1.0, 1.2, 3.15, 5.0, 5.2):
        state = state if state.latched else controller.stop(state, "The motor is blocked.", now)
        output, state = feed([1e3 * now], speed=0.0, reference=9.0, state=state)
        assert_stopped(output, "The motor is blocked. Call motor/reset")
        said, state = controller.reset(state, now)
        cleared.append(not state.latched)
        assert said.startswith("Cleared: " if cleared[-1] else "Not cleared: The motor is blocked. It has stopped ")
    assert cleared == [True, False, False, True, False, False, True]


def test_latched_stop_holds_until_reset() -> None:
    _, state = feed([0, 5], speed=50.0, reference=100.0)
    state = controller.stop(state, "The motor is blocked.", 0.0)
    for time in (10.0, 15.0):
        output, state = feed([time], speed=50.0, reference=100.0, state=state)
        assert_stopped(output, "The motor is blocked.", "motor/reset")
        assert output.state == controller.STOPPED
    assert controller.watch(CONFIG, state, 1.0)[1].latched  # survives silence
    output, state = feed([20], speed=50.0, reference=100.0, state=controller.reset(state, 0.0)[1])
    assert_stopped(output, "The stop was cleared.", "begin again, with 0")
    assert feed([521], speed=50.0, reference=100.0, state=state)[0].state == controller.RUNNING


def test_silence_is_reported_at_once_and_then_five_times_a_second() -> None:
    _, state = feed([0, 5], speed=50.0, reference=100.0)
    reports = []
    for k in range(101, 1105):  # every ms; the last sample came at 5 ms
        output, state = controller.watch(CONFIG, state, k * 1e-3)
        if output is not None:
            reports.append(k)
            assert_stopped(output, "motor/speed", "motor_sim")
            assert output.state == controller.NO_SAMPLES
    assert 105 <= reports[0] <= 106
    assert len(reports) == 5 and all(200 <= b - a <= 201 for a, b in pairwise(reports))


def test_silence_ends_the_run() -> None:
    _, state = feed([0, 5, 10], speed=50.0, reference=60.0)
    _, state = controller.watch(CONFIG, state, 0.2)
    output, _ = feed([15], speed=50.0, reference=60.0, state=state)  # the plant's clock stood still meanwhile
    assert output.terms.integral == 0.0


def test_a_plant_that_never_came_is_named_so() -> None:
    assert controller.watch(CONFIG, State(since=7.0), 7.09)[0] is None
    output, _ = controller.watch(CONFIG, State(since=7.0), 7.11)
    assert output is not None
    assert_stopped(output, "No sample has come", "motor_driver")


def test_single_channel_waits_before_it_turns_round() -> None:
    output, state = feed([0, 5], speed=60.0, reference=-60.0)
    assert output.terms.voltage == 0.0 and output.terms.saturated
    assert output.state == controller.RUNNING and "10 rad/s" in output.reason
    output, _ = feed([10], speed=9.0, reference=-60.0, state=state)
    assert -12.0 <= output.terms.voltage < -11.9 and output.reason == ""


def test_two_channels_brake_at_once() -> None:
    output, _ = feed([0, 5], speed=60.0, reference=40.0, config=TWO_CHANNELS)
    assert output.terms.voltage == pytest.approx(-4.25)


def test_at_a_standstill_the_integral_of_the_other_direction_is_dropped() -> None:
    _, state = feed([0, 50, 100], speed=5.0, reference=20.0)
    assert state.run is not None and state.run.law.integral > 2.0
    output, _ = feed([105], speed=0.0, reference=-3.0, state=state)
    assert output.terms.integral <= 0.0 and output.terms.voltage == pytest.approx(-0.6 - 2.5 * 3.0 * 0.005)
    output, state = feed([105], speed=0.0, reference=0.0, state=state)
    assert output.terms.integral == output.terms.voltage == 0.0


@pytest.mark.parametrize("field", ["voltage_limit", "sample_timeout", "reference_rate_limit", "reversal_speed"])
@pytest.mark.parametrize("value", [-1.0, nan, inf])
def test_settings_that_do_not_work_are_refused(field: str, value: float) -> None:
    with pytest.raises(MotorError, match=field):
        replace(CONFIG, **{field: value})


ANYTHING = st.floats(allow_nan=True, allow_infinity=True) | st.floats(-200.0, 200.0)


@given(
    steps=st.lists(
        st.tuples(st.integers(-20, 200), ANYTHING, ANYTHING, st.none() | ANYTHING, st.booleans()),
        min_size=1,
        max_size=30,
    ),
    single_channel=st.booleans(),
    rate=st.sampled_from([0.0, 100.0]),
)
def test_whatever_comes_the_voltage_is_finite_and_within_the_limit(
    steps: list[tuple[int, float, float, float | None, bool]], single_channel: bool, rate: float
) -> None:
    config = replace(CONFIG, single_channel=single_channel, reference_rate_limit=rate)
    state, time, latest = State(), 0, None
    for advance, speed, voltage, reference, pause in steps:
        time += advance * MS
        latest = latest if reference is None else reference
        output, state = controller.update(config, state, Sample(time, speed, voltage), reference, 0.0)
        assert isfinite(output.terms.voltage) and abs(output.terms.voltage) <= 12.0
        assert isfinite(output.terms.integral) and abs(output.terms.integral) <= 12.0
        if not all(isfinite(value) for value in (speed, voltage, nan if latest is None else latest)):
            assert_stopped(output)
            assert output.reason.endswith(".")
        if pause:
            _, state = controller.watch(config, state, 1.0)
