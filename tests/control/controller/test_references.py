"""A reference is obeyed until what it was for is over; then the motor waits for a fresh one."""

from dataclasses import replace
from math import tau

import pytest
from bench_board import motor, settings
from referred import CONFIG, MS, OBSTACLES, feed, running

from motor_control.controller import controller
from motor_control.controller.controller import State
from motor_control.controller.output import DISABLED, RUNNING, STOPPED, Output
from motor_control.controller.reference.demand import Kind
from motor_model.sample import Info, Sample
from motor_model.sensing.mains_rhythm import Rhythm


def waits(output: Output, words: str) -> None:
    assert output.state == DISABLED and output.terms.voltage == 0.0
    assert words in output.reason and "fresh reference" in output.reason


def test_a_reference_holds_without_being_repeated() -> None:
    output, _ = feed(running(), list(range(200, 20_000, 5)), 50.0)
    assert output.state == RUNNING


def test_a_restarted_plant_waits() -> None:
    output, state = feed(running(), [0, 5, 10], later=0.3)
    waits(output, "restarted")
    assert feed(state, [515], 60.0, later=0.3)[0].state == RUNNING


def test_a_board_that_counts_from_0_again_waits() -> None:
    """Its driver's clock goes on; an angle that was reached before is somewhere else now."""
    config = settings(motor(), Info(single_channel=False))
    state = controller.refer(State(), 500.0 * tau / 96, 0.0, Kind.POSITION)
    for k in range(4):
        sample = Sample((100 + k) * 5 * MS, 0.0, 0.0, 500, 9 * MS, 0.01)
        output, state = controller.update(config, state, sample, None, k * 0.005)
    assert output.state == RUNNING and output.terms.voltage == 0.0  # it is there
    again = Sample(104 * 5 * MS, 0.0, 0.0, 0)
    waits(controller.update(config, state, again, None, 0.02)[0], "restarted")


@pytest.mark.parametrize("restarts", [True, False])
def test_of_a_board_that_was_reset_after_a_release_nothing_is_known(restarts: bool) -> None:
    """Where it was pushed out of an angle is in counts of before the reset; without one it is remembered."""
    config = settings(motor(), Info(single_channel=False))
    state = controller.refer(State(), 500.0 * tau / 96, 0.0, Kind.POSITION)
    for k in range(4):
        sample = Sample((100 + k) * 5 * MS, 0.0, 0.0, 500, 9 * MS, 0.01)
        _, state = controller.update(config, state, sample, None, k * 0.005)
    _, state = controller.release(state, 0.0)
    again = Sample(104 * 5 * MS, 0.0, 0.0, 0 if restarts else 500, 0 if restarts else 9 * MS, 0.0 if restarts else 0.01)
    output, state = controller.update(config, state, again, None, 0.02)
    assert "released" in output.reason
    assert (state.motion is None, state.faults is None, state.place is None) == (restarts,) * 3


@pytest.mark.parametrize(("away", "resumes"), [(900, True), (1100, False)])
def test_a_plant_that_was_away_waits(away: int, resumes: bool) -> None:
    output, _ = feed(running(), [195 + away, 200 + away])
    assert (output.state == RUNNING) == resumes
    if not resumes:
        waits(output, "away")


def test_another_plant_waits() -> None:
    """Somebody's recording was played beside a running loop: its motor/info had ten times the edges."""
    state = controller.meet_other_plant(replace(running(), rhythm=Rhythm(edges=20, at_rest=1.0)))
    assert state.rhythm == Rhythm()
    output, state = feed(state, [200, 205])
    waits(output, "another one than before")
    assert state.motion is None and feed(state, [510], 60.0)[0].state == RUNNING


def test_a_reset_waits() -> None:
    state = controller.stop(running(), "It is blocked.", 0.0)
    output, state = feed(state, [200, 205], 60.0)  # a reference during the stop is none for after it
    assert output.state == STOPPED and output.drives
    said, state = controller.reset(state, 0.0)
    assert said == "Cleared: It is blocked."
    output, state = feed(state, [210, 215])
    waits(output, "cleared")
    assert feed(state, [220], 60.0)[0].state == DISABLED  # it goes on with the one that came during the stop
    assert feed(state, [705], 60.0)[0].state == RUNNING


def test_an_output_that_was_off_waits() -> None:
    state = running()
    output, state = feed(state, list(range(200, 600, 5)), on=False)
    assert output.state == RUNNING and "motor/enable" in output.reason
    output, state = feed(state, list(range(600, 1000, 5)), on=False)
    waits(output, "motor/enable")
    output, state = feed(state, [1000, 1005])  # it is on again
    waits(output, "motor/enable")
    assert feed(state, [1010], 60.0)[0].state == RUNNING


@pytest.mark.parametrize(("timeout", "drops"), [(0.0, False), (0.5, True)])
def test_a_reference_has_an_age(timeout: float, drops: bool) -> None:
    config = replace(CONFIG, reference_timeout=timeout)
    state = feed(State(), list(range(0, 450, 5)), 60.0, config)[1]
    output, state = feed(state, list(range(450, 600, 5)), config=config)
    assert (output.state == DISABLED) == drops
    if drops:
        waits(output, "older than reference_timeout (0.5 s)")
        assert feed(state, [600], 60.0, config)[0].state == RUNNING


def test_a_released_motor_gets_one_last_zero_and_is_left_to_others() -> None:
    _, state = controller.release(running(), 0.0)
    first, state = feed(state, [200])
    second, state = feed(state, [205])
    waits(first, "released")
    assert (first.drives, second.drives) == (True, False)


def test_two_plants_stop_the_motor_and_are_named() -> None:
    state = replace(running(), speakers="(/motor_driver, /motor_sim)")
    output, state = feed(state, [200, 5000, 205, 5005, 210, 5010])
    assert output.state == STOPPED and output.terms.voltage == 0.0
    assert "Two plants publish motor/speed (/motor_driver, /motor_sim)" in output.reason and state.latched


def test_a_sample_that_is_too_old_is_answered_with_zero_and_its_age() -> None:
    """A lag of 100 ms let the speed swing from 12 to 137 rad/s in the state running."""
    state = running()
    late, state = feed(state, [200], later=0.1)
    assert late.state == STOPPED and late.terms.voltage == 0.0 and late.drives
    assert late.latency == pytest.approx(0.1, abs=3e-3) and "ms old and latency_limit is 20 ms" in late.reason
    in_time, _ = feed(state, [205], later=0.01)
    assert in_time.state == RUNNING and in_time.terms.voltage > 0.0 and in_time.latency < 0.02


def begins(state: State, times: range, fresh: float | None = None, on: bool = True) -> tuple[list[int], State]:
    """When [ms] 0 V is sent before the voltage."""
    found = []
    for time in times:
        output, state = feed(state, [time], fresh if time == times[0] else None, on=on)
        found += [time] * output.begins
    return found, state


def test_voltages_begin_at_zero_and_again_where_the_plant_has_not_heard_it() -> None:
    """A plant that was started again may find the controller a moment later than the controller finds it."""
    found, state = begins(State(), range(0, 200, 5), 60.0)
    assert found == [0]
    found, state = begins(controller.release(state, 0.0)[1], range(200, 400, 5))
    assert found == []
    found, state = begins(state, range(600, 1600, 5), 60.0, on=False)
    assert found[0] == 600 and 6 <= len(found[1:]) <= 12 and found[-1] <= 1100  # as long as the reference is fresh
    _, state = feed(running(), [200])
    assert begins(state, range(800, 1000, 5), on=False)[0] == []  # a plant that was on and is not: somebody wants that


def test_voltages_begin_anew_after_silence() -> None:
    state = running()
    _, state = controller.watch(CONFIG, state, 0.4)
    output, state = feed(state, [400])
    assert output.drives and output.begins


@pytest.mark.parametrize("name", OBSTACLES)
@pytest.mark.parametrize(("seconds", "resumes"), [(0.9, True), (1.2, False)])
def test_what_holds_the_motor_for_long_ends_the_reference(name: str, seconds: float, resumes: bool) -> None:
    """Ten minutes of NaN, and the motor went to its old 50 rad/s with the first good sample."""
    config, speed, age = OBSTACLES[name]
    config = replace(config, latency_limit=0.02)
    state = controller.refer(controller.State(), 50.0, 0.0)
    free = replace(config, unusable="", voltage_limit=CONFIG.voltage_limit)
    late, end = round(1.0 / 0.005), round((1.0 + seconds) / 0.005)
    for k in range(end + 20):
        held = late <= k < end
        now = 0.005 * k + (age if held else 0.0)
        sample = Sample(k * 5_000_000, speed if held else 0.0, 1.0, k // 20)
        output, state = controller.update(config if held else free, state, sample, None, now)
        if held:
            assert output.state == "stopped" or output.state == "disabled" and output.terms.voltage == 0.0
    assert (output.state == "running") == resumes and (output.terms.voltage > 0.0) == resumes
    if not resumes:
        assert name in output.reason and "held at 0 V for more than 1 s. The motor waits for a fresh" in output.reason
        assert controller.refer(state, 20.0, 9.0).demand is not None


@pytest.mark.parametrize("period", [50, 1000])  # [ms] a joystick's, and `ros2 topic pub`'s
def test_references_that_go_on_while_the_plant_ignores_them_are_not_obeyed(period: int) -> None:
    """As where `motor/voltage` goes to another plant than that whose samples come: it turned at its top speed."""
    state, driven = State(), 0
    for time in range(0, 6000, 5):
        output, state = feed(state, [time], 60.0 if time % period == 0 else None, on=False)
        driven += output.terms.voltage != 0.0
    assert driven <= (101 if period == 50 else 202) and output.state == DISABLED and state.demand is None
    assert "The plant applied nothing of what was asked for" in state.refused
    assert f"until they begin again, with 0 or after a silence of {0.5 if period == 50 else 2:g} s" in state.refused
    assert feed(state, [6005], 0.0)[0].state == RUNNING
    late = 6000 - period + (500 if period == 50 else 2000)
    assert feed(state, [late - 5], 60.0)[0].state == DISABLED
    assert feed(state, [late + 5], 60.0)[0].state == RUNNING
