"""A reference ends when the plant is another, was away or is off, or time is over: on either side of each."""

from dataclasses import replace

import pytest
from bench_board import DEFAULTS

from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_control.controller.controller import State
from motor_control.controller.plant_watch import PlantWatch
from motor_control.controller.reference.demand import Demand, Kind, Source
from motor_control.controller.reference.ending import AWAY, OFF, drop_old_reference
from motor_control.controller.speed_law import IGNORED_TIME
from motor_model.sample import Info, Sample
from motor_model.sensing.mains_rhythm import Rhythm

CONFIG = config_of(DEFAULTS, Info())
PLANT = PlantWatch(5_000_000, 7)
BELOW, ABOVE = 0.999, 1.001
ASKED = State(arrival=0.0, demand=Demand(60.0))


def end(state: State, now: float, plant: PlantWatch = PLANT, **settings: float) -> State:
    return drop_old_reference(replace(CONFIG, **settings), state, plant, now)


def test_a_reference_lasts() -> None:
    still = replace(ASKED, arrival=1e6)
    assert end(still, 1e6) is still


def test_a_plant_that_was_restarted_is_forgotten_whether_or_not_something_is_asked_for() -> None:
    state = controller.update(CONFIG, State(), Sample(0, 3.0, 0.0), 60.0, 0.0)[1]
    assert state.motion is not None and state.faults is not None
    state = replace(state, rhythm=Rhythm(edges=20, at_rest=1.0))
    after = end(state, 0.01, replace(PLANT, restarted=True))
    assert after.motion is after.faults is after.demand is None and after.dropped == "The plant was restarted."
    assert after.rhythm == Rhythm()
    free = replace(state, demand=None)
    after = end(free, 0.01, replace(PLANT, restarted=True))
    assert after.motion is None and after.dropped == free.dropped


@pytest.mark.parametrize(("times", "ends"), [(BELOW, False), (ABOVE, True)])
def test_silence_ends_it_unless_it_is_as_fresh(times: float, ends: bool) -> None:
    after = end(ASKED, times * AWAY)
    assert (after.demand is None) is ends and ("away for more than 1 s" in after.dropped) is ends
    assert end(replace(ASKED, referred=times * AWAY), times * AWAY) == replace(after, referred=times * AWAY)  # a stream
    assert end(replace(ASKED, begun=0.1), AWAY + 0.05).demand is not None


@pytest.mark.parametrize(("times", "ends"), [(BELOW, False), (ABOVE, True)])
def test_silence_ends_it_although_our_own_clock_stood_still_meanwhile(times: float, ends: bool) -> None:
    """A laptop that was suspended for a night beside a plant that went on."""
    before = replace(ASKED, plant=PLANT, arrival=8.0, begun=7.9)
    after = replace(PLANT, sample_time=PLANT.sample_time + round(times * AWAY * 1e9))
    assert (end(before, 8.005, after).demand is None) is ends
    assert end(replace(before, begun=8.001), 8.005, after).demand is not None


@pytest.mark.parametrize(("times", "ends"), [(BELOW, False), (ABOVE, True)])
def test_being_held_at_0_v_ends_it_with_what_held_it(times: float, ends: bool) -> None:
    now = 3.0 + times * AWAY
    after = end(replace(ASKED, arrival=now, held=3.0, held_by="Too late."), now)
    assert (after.demand is None) is ends
    assert after.dropped == ("Too late. The motor was held at 0 V for more than 1 s." if ends else "")
    asked_again = replace(ASKED, arrival=now, begun=now - 0.9, held=3.0)
    assert end(asked_again, now).demand is not None
    assert (end(replace(asked_again, begun=0.0, referred=now), now).demand is None) is ends  # a stream


def test_what_comes_after_the_users_own_silence_begins() -> None:
    """A timeout that is shorter than the silence after which references begin elsewhere."""
    state = controller.update(CONFIG, State(), Sample(0, 3.0, 0.0), 60.0, 0.0)[1]
    after = end(replace(state, arrival=0.25), 0.25, reference_timeout=0.2)
    assert after.demand is None and controller.refer(after, 60.0, 0.25).demand is not None
    still = controller.drop(state, "It was released.")
    assert controller.refer(still, 60.0, 0.25).demand is None


@pytest.mark.parametrize(("source", "ended_by"), [(Source.JOINT, "joint"), (Source.REFERENCE, "reference")])
def test_each_source_has_a_timeout_of_its_own(source: Source, ended_by: str) -> None:
    state = replace(ASKED, arrival=10.0, referred=9.7, demand=Demand(60.0, Kind.SPEED, source))
    joint, reference = (end(state, 10.0, joint_timeout=a, reference_timeout=b) for a, b in ((0.2, 0.0), (0.0, 0.2)))
    assert (joint.demand is None) is (ended_by == "joint")
    assert reference.demand is None and "reference_timeout (0.2 s)" in reference.dropped
    assert end(state, 10.0, joint_timeout=0.4, reference_timeout=0.4).demand is not None
    if ended_by == "joint":
        assert "joint_command_timeout (0.2 s)" in joint.dropped


@pytest.mark.parametrize(("times", "ends"), [(BELOW, False), (ABOVE, True)])
def test_a_plant_that_ignores_voltages_ends_it(times: float, ends: bool) -> None:
    state = controller.update(CONFIG, State(), Sample(0, 3.0, 0.0), 60.0, 0.0)[1]
    assert state.run is not None
    after = end(replace(state, arrival=5.0, run=replace(state.run, ignored=times * OFF)), 5.0)
    assert (after.demand is None) is ends and ("motor/enable" in after.dropped) is ends
    asked_again = replace(state, arrival=5.0, begun=5.0, referred=5.0, run=replace(state.run, ignored=times * OFF))
    assert (end(asked_again, 5.0).demand is None) is ends


@pytest.mark.parametrize(("times", "goes_on"), [(BELOW, True), (ABOVE, False)])
def test_a_stream_slower_than_its_timeout_does_not_go_on_with_a_plant_whose_output_was_off(
    times: float, goes_on: bool
) -> None:
    """What it asks for never lasts as long as a plant may ignore voltages; its next message would start the motor."""
    state = controller.update(CONFIG, State(), Sample(0, 3.0, 0.0), 60.0, 0.0)[1]
    assert state.run is not None
    state = replace(state, arrival=0.25, run=replace(state.run, ignored=times * IGNORED_TIME))
    after = end(state, 0.25, reference_timeout=0.2)
    assert after.demand is None and ("motor/enable" in after.dropped) is not goes_on
    assert (controller.refer(after, 60.0, 0.25).demand is not None) is goes_on
