"""What is asked for, by whom: one source at a time drives, and a stream has to begin."""

from dataclasses import replace
from math import nan

import pytest
from bench_board import DEFAULTS

from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_control.controller.output import DISABLED, RUNNING, STOPPED, Output
from motor_control.controller.reference.demand import Demand, Kind, Source
from motor_control.controller.state import EARLIER, introduce, meet_players
from motor_model.sample import Info, Sample

INFO = Info(single_channel=False)
CONFIG = config_of(DEFAULTS, INFO)
JOINT = Demand(20.0, source=Source.JOINT)
STOP = Demand(0.0, source=Source.JOINT)
DT = 0.005  # [s]


class Loop:
    """The controller on a clock of its own, beside a motor that does not turn and applies what it is told."""

    def __init__(self, **changes: float | bool) -> None:
        self.config = replace(CONFIG, **changes)  # type: ignore[arg-type]
        self.now, self.voltage, self.state = 100.0, 0.0, controller.State(since=100.0)
        self.off = False  # the plant applies nothing

    def run(self, duration: float, demand: Demand | str | None = None) -> Output:
        """So long [s], with the joint's command before every sample."""
        for _ in range(round(duration / DT)):
            self.now += DT
            if demand is not None:
                self.state = controller.command_joint(self.config, self.state, demand, self.now)
            sample = Sample(round(self.now * 1e9), 0.0, self.voltage)
            output, self.state = controller.update(self.config, self.state, sample, None, self.now)
            self.voltage = 0.0 if self.off else output.terms.voltage
        return output


def test_a_stream_begins_with_zero_or_after_a_silence() -> None:
    """One that was there before the controller is not obeyed: nobody knows what it would do."""
    loop = Loop()
    output = loop.run(1.0, JOINT)
    assert (output.state, output.terms.voltage) == (DISABLED, 0.0) and "with 0, or after a silence" in output.reason
    loop.run(DT, STOP)
    assert loop.run(0.02, JOINT).terms.voltage > 0.0
    silent = Loop()
    silent.run(0.6)
    assert silent.run(DT, JOINT).state == RUNNING
    early = Loop()
    early.run(0.4)
    assert early.run(DT, JOINT).state == DISABLED


def test_a_stream_that_ends_stops_the_motor() -> None:
    loop = Loop()
    loop.run(DT, STOP)
    loop.run(0.1, JOINT)
    assert loop.run(0.49).state == RUNNING
    output = loop.run(0.03)
    assert (output.state, output.terms.voltage, output.warning) == (DISABLED, 0.0, True)
    assert "joint_command_timeout (0.5 s)" in output.reason
    held = Loop(joint_timeout=0.0)
    held.run(DT, STOP)
    held.run(0.1, JOINT)
    assert held.run(0.3).state == RUNNING


def test_a_stream_that_goes_on_while_the_plant_is_away_is_not_obeyed_until_it_begins_again() -> None:
    """It went on with the motor when the link was there again, however long that had been away."""
    for away, obeyed in ((0.9, True), (1.2, False)):
        loop = Loop()
        loop.run(DT, STOP)
        assert loop.run(0.2, JOINT).state == RUNNING
        for _ in range(round(away / DT)):
            loop.now += DT
            loop.state = controller.command_joint(loop.config, loop.state, JOINT, loop.now)
            loop.state = controller.watch(loop.config, loop.state, loop.now)[1]
        assert (loop.run(0.1, JOINT).state == RUNNING) is obeyed
        loop.run(DT, STOP)
        assert loop.run(DT, JOINT).state == RUNNING


def test_after_a_stop_a_stream_that_goes_on_is_not_obeyed_until_it_begins_again() -> None:
    loop = Loop()
    loop.run(DT, STOP)
    loop.run(0.1, JOINT)
    loop.state = controller.stop(loop.state, "It is blocked.", 0.0)
    assert loop.run(1.0, STOP).state == STOPPED  # latched, whatever comes
    _, loop.state = controller.reset(loop.state, 0.0)
    assert loop.run(1.0, JOINT).state == DISABLED
    loop.run(DT, STOP)
    assert loop.run(DT, JOINT).state == RUNNING
    _, loop.state = controller.release(loop.state, loop.now)
    assert loop.run(1.0, JOINT).state == DISABLED


@pytest.mark.parametrize("late", [0.2, 0.8])  # [s] after the latest command: before its time-out, and after it
@pytest.mark.parametrize("how", ["released", "stopped", "plant", "off"])
def test_a_stream_slower_than_its_time_out_is_not_obeyed_after_what_else_ends_it(how: str, late: float) -> None:
    """At 1 Hz it started the motor 0.2 s after `motor/release`, and 0.9 s after its plant had been started again."""
    loop = Loop()
    loop.run(0.6)
    for _ in range(3):
        assert loop.run(DT, JOINT).state == RUNNING
        assert loop.run(0.995).state == DISABLED  # by its time-out
    loop.run(DT, JOINT)
    loop.run(late)
    if how == "released":
        _, loop.state = controller.release(loop.state, loop.now)
    elif how == "stopped":
        loop.state = controller.stop(loop.state, "It is blocked.", loop.now)
        _, loop.state = controller.reset(loop.state, loop.now)
    elif how == "plant":
        loop.state = controller.meet_other_plant(loop.state)
    else:
        loop.off = True
        loop.run(1.0 - late)
        loop.run(DT, JOINT)
        loop.run(late)
        loop.off = False
    loop.run(0.995 - late)
    for _ in range(4):
        assert loop.run(DT, JOINT).state == DISABLED and "a silence of 2 s" in loop.state.refused
        assert loop.run(0.995).state == DISABLED
    loop.run(1.1)
    assert loop.run(DT, JOINT).state == RUNNING


@pytest.mark.parametrize("why", ["motor/joint_command asks for nan rad/s: send a finite number."])
def test_what_cannot_be_obeyed_is_a_stop(why: str) -> None:
    loop = Loop()
    loop.run(DT, STOP)
    loop.run(0.1, JOINT)
    output = loop.run(DT, why)
    assert (output.state, output.terms.voltage) == (DISABLED, 0.0) and why in output.reason
    assert loop.run(0.1, JOINT).state == DISABLED


def test_one_source_drives_and_the_other_is_told() -> None:
    loop = Loop()
    loop.state = controller.refer(loop.state, 10.0, loop.now)
    output = loop.run(0.1, STOP)
    assert output.state == RUNNING and output.reference == 10.0
    assert output.reason.startswith("motor/joint_command is not obeyed while motor/reference drives the motor")
    _, loop.state = controller.release(loop.state, loop.now)
    loop.run(DT, STOP)
    loop.run(0.1, JOINT)
    loop.state = controller.refer(loop.state, 10.0, loop.now)
    output = loop.run(DT, JOINT)
    assert output.reference == 20.0
    output = loop.run(0.6)  # the stream has ended
    loop.state = controller.refer(loop.state, 10.0, loop.now)
    assert loop.run(DT).reference == 10.0


@pytest.mark.parametrize(
    ("number", "after", "obeyed"), [(1, 0.6, True), (1, 0.4, False), (900, 1.9, False), (900, 2.1, True)]
)
def test_a_stream_of_joint_commands_that_was_there_before_the_controller(
    number: int, after: float, obeyed: bool
) -> None:
    """Found 3 s after a controller that was started again, it was taken for one that had been silent so long."""
    state = introduce(controller.State(since=10.0), 13.0)
    state = controller.command_joint(CONFIG, state, JOINT, 13.0 + after, number)
    assert (state.demand is not None) is obeyed


def test_several_senders_of_joint_commands_are_none() -> None:
    loop = Loop()
    loop.run(DT, STOP)
    loop.run(0.1, JOINT)
    loop.state = replace(loop.state, joint_senders="(/a, /b)")
    output = loop.run(DT, JOINT)
    assert output.state == DISABLED and "Several nodes publish motor/joint_command (/a, /b)" in output.reason


@pytest.mark.parametrize(("asked", "applied"), [(3.0, 3.0), (-3.0, -3.0), (30.0, 12.0), (0.0, 0.0)])
def test_a_voltage_is_applied_as_it_is_within_the_limits(asked: float, applied: float) -> None:
    loop = Loop()
    loop.run(DT, Demand(0.0, Kind.VOLTAGE, Source.JOINT))
    output = loop.run(0.05, Demand(asked, Kind.VOLTAGE, Source.JOINT))
    assert output.terms.voltage == output.terms.feedforward + (applied - asked) == applied
    assert output.terms.saturated == (asked != applied) and output.reference != output.reference
    assert (output.terms.proportional, output.terms.integral, output.terms.error) == (0.0, 0.0, 0.0)


def test_a_blocked_motor_under_a_voltage_is_stopped_as_under_a_speed() -> None:
    loop = Loop()
    loop.run(DT, Demand(0.0, Kind.VOLTAGE, Source.JOINT))
    output = loop.run(0.7, Demand(12.0, Kind.VOLTAGE, Source.JOINT))
    assert output.state == STOPPED and "no edge came" in output.reason


def test_a_voltage_that_is_no_number_is_0_volt() -> None:
    loop = Loop()
    loop.state = controller.refer(loop.state, nan, loop.now, Kind.VOLTAGE)
    assert loop.run(DT).terms.voltage == 0.0 and loop.run(DT).state == STOPPED


def test_a_reference_that_is_refused_is_said_and_changes_nothing() -> None:
    loop = Loop()
    loop.run(0.1)
    before = loop.state
    loop.state = controller.doubt(loop.state, "It may be an old one.", loop.now)
    same = replace(loop.state, refused="", refused_at=before.refused_at, references=before.references)
    assert same == before
    output = loop.run(0.1)
    assert (output.state, output.reason, output.warning) == (DISABLED, "It may be an old one.", True)
    assert loop.run(0.5).reason != "It may be an old one."


@pytest.mark.parametrize("joint", [False, True])
def test_while_a_recording_is_played_nothing_is_obeyed(joint: bool) -> None:
    loop = Loop()

    def ask(value: float, duration: float) -> Output:
        if joint:
            return loop.run(duration, Demand(value, source=Source.JOINT))
        loop.state = controller.refer(loop.state, value, loop.now)
        return loop.run(duration)

    ask(0.0, DT)
    assert ask(20.0, 0.1).terms.voltage > 0.0
    loop.state = meet_players(loop.state, "/rosbag2_player")
    output = loop.run(0.02)
    assert output.terms.voltage == 0.0 and "A recording is played" in output.reason
    for value in (20.0, 0.0, 20.0):
        output = ask(value, 0.1)
        assert output.terms.voltage == 0.0 and "(/rosbag2_player)" in output.reason
    loop.state = meet_players(loop.state, "")
    assert loop.run(0.1).terms.voltage == 0.0  # nobody asks
    ask(0.0, DT)
    assert ask(20.0, 0.1).terms.voltage > 0.0


@pytest.mark.parametrize("kind", [Kind.SPEED, Kind.VOLTAGE])
def test_a_stream_whose_voltages_have_no_effect_ends(kind: Kind) -> None:
    """As where they go to another plant, whose motor would turn for as long as the stream lasts."""
    loop, driven, stream = Loop(effort_as_voltage=kind is Kind.VOLTAGE), 0.0, Demand(6.0, kind, Source.JOINT)
    loop.run(1.0, STOP)
    for _ in range(600):
        output = loop.run(DT, stream)
        driven, loop.voltage = driven + DT * (output.terms.voltage != 0.0), 0.0
    assert output.state == DISABLED and driven < 0.52 and "until it begins again" in loop.state.refused


@pytest.mark.parametrize("halt", ["release", "stop and reset"])
@pytest.mark.parametrize(("sent", "obeyed"), [(9.9, False), (10.1, True)])
def test_what_was_asked_for_before_a_stop_is_not_obeyed_after_it(halt: str, sent: float, obeyed: bool) -> None:
    """A reference waits up to 2 s for its sender to be known, and set a motor going that was let go of meanwhile."""
    if halt == "release":
        _, state = controller.release(controller.State(), 10.0)
    else:
        _, state = controller.reset(controller.stop(controller.State(), "It is blocked.", 10.0), 12.0)
    for asked in (
        controller.refer(state, 50.0, sent, number=1),
        controller.refer(state, 1.0, sent, Kind.POSITION, number=1),
        controller.command_joint(CONFIG, state, JOINT, sent, number=1),
    ):
        assert (asked.demand is not None) is obeyed
        assert obeyed or asked.refused == EARLIER
