"""What both wheels are told: velocities within limits, and 0 whenever something is in doubt."""

from dataclasses import replace
from math import nan

import pytest

from motor_examples.diff_drive import drive
from motor_examples.diff_drive.kinematics import STILL, Geometry, Limits, Twist, Wheels, wheel_speeds
from motor_examples.diff_drive.wheel import ANSWERS, Wheel
from motor_model.sample import Info, Sample

ROBOT = Geometry(0.05, 0.2)
SPEED = Twist(0.5, 0.0)
DT = 0.02  # [s]
NONE = Limits()


class Robot:
    """The drive on a clock of its own, with wheels that turn as they are told."""

    def __init__(self, limits: Limits = NONE, timeout: float = 0.5, gain: float = 0.0) -> None:
        self.config, self.state = drive.Config(ROBOT, limits, timeout, gain), drive.State()
        self.now, self.speeds = 10.0, Wheels(0.0, 0.0)
        self.info = Info(edges_per_revolution=1_000_000, single_channel=False)
        self.said = {"left": "running", "right": "running"}
        self.unsaid: float | None = None  # [s] since when the left controller has not said how long it goes on alone
        self.rivals = ""  # who else controls the left wheel
        self.lost: Wheel | None = None  # the left wheel, since nothing is heard of it
        self.slip = Wheels(1.0, 1.0)  # share of what is asked for that each wheel turns
        self.edges = [0.0, 0.0]
        self.decisions: list[drive.Decision] = []

    def send(self, twist: Twist, age: float = 0.0, number: int | None = None) -> None:
        self.state = drive.take_command(self.config, self.state, twist, self.now, age, number)

    def wheel(self, side: int, name: str) -> Wheel:
        sample = Sample(round(self.now * 1e9), self.speeds[side], 1.0, round(self.edges[side]))
        unsaid = self.unsaid if name == "left" else None
        said = {"state": self.said[name], "reason": "Blocked.", "answered": self.now, "heard": self.now}
        said |= {"unsaid_since": unsaid, "reference_timeout": 0.5 if unsaid is None else None}  # type: ignore[dict-item]
        said |= {"rivals": self.rivals if name == "left" else ""}
        return replace(Wheel(name, info=self.info, sample=sample, edges=sample.edge_count), **said)  # type: ignore[arg-type]

    def run(self, duration: float, twist: Twist | None = None) -> drive.Decision:
        """So long [s], with the velocity sent before every step."""
        for _ in range(round(duration / DT)):
            if twist is not None:
                self.send(twist)
            wheels = (self.lost or self.wheel(0, "left"), self.wheel(1, "right"))
            decision, self.state = drive.step(self.config, self.state, wheels, self.now)
            self.speeds = decision.references or Wheels(0.0, 0.0)
            for side in range(2):
                self.edges[side] += self.slip[side] * self.speeds[side] * DT / (2.0 * 3.141592653589793) * 1e6
            self.decisions.append(decision)
            self.now += DT
        return self.decisions[-1]


def test_without_a_velocity_both_motors_are_left_alone() -> None:
    assert Robot().run(1.0) == drive.Decision(None, False, drive.IDLE, True)


def test_a_velocity_is_obeyed_within_the_limits() -> None:
    robot = Robot(Limits(linear_acceleration=1.0))
    robot.run(0.2, SPEED)
    assert robot.state.twist.linear == pytest.approx(0.2, abs=1.1 * DT)
    decision = robot.run(1.0, SPEED)
    assert decision.references == wheel_speeds(ROBOT, SPEED) and decision.reason == drive.DRIVING


def test_a_stale_velocity_slows_down_then_lets_go_once() -> None:
    robot = Robot(Limits(linear_acceleration=1.0))
    robot.run(1.0, SPEED)
    begun = len(robot.decisions)
    robot.run(3.0)
    told = robot.decisions[begun:]
    speeds = [one.references.left for one in told if one.references is not None]
    assert speeds[0] == 10.0 and speeds[-1] == 0.0 and speeds == sorted(speeds, reverse=True)
    slowing = sum(0.0 < speed < 10.0 for speed in speeds) * DT
    assert 0.45 < slowing < 0.55
    assert [one.release for one in told].count(True) == 1
    assert told[-1].references is None and told[-1].reason == drive.STALE.format(0.5)
    assert robot.run(DT, SPEED).references is not None  # and goes on with the next


def test_beside_a_wheel_that_is_lost_in_motion_the_other_one_is_let_go_as_soon_as_it_stands() -> None:
    """It was held at 0 rad/s for 2 s, and hunted there: the lost one had turned when it was last heard."""
    robot = Robot(timeout=0.0)
    robot.run(1.0, SPEED)
    robot.lost, begun = robot.wheel(0, "left"), len(robot.decisions)
    robot.run(3.0)
    told = robot.decisions[begun:]
    stopped = next(k for k, one in enumerate(told) if one.references == Wheels(0.0, 0.0))
    released = next(k for k, one in enumerate(told) if one.release)
    assert drive.STANDING <= (released - stopped) * DT <= drive.STANDING + 2 * DT
    assert [one.release for one in told].count(True) == 1


def test_without_a_timeout_a_velocity_holds() -> None:
    robot = Robot(timeout=0.0)
    robot.run(DT, SPEED)
    assert robot.run(60.0).references == wheel_speeds(ROBOT, SPEED)


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize("state", ["stopped", "no_samples", "disabled"])
def test_one_wheel_that_stops_stops_the_other(side: str, state: str) -> None:
    robot = Robot(Limits(linear_acceleration=1.0))
    robot.run(1.0, SPEED)
    robot.said[side] = state
    decision = robot.run(DT, SPEED)
    assert decision.references == Wheels(0.0, 0.0) and not decision.healthy  # at once, not within the limits
    assert f"The {side} wheel does not run: Blocked." in decision.reason and "cmd_vel of 0" in decision.reason
    assert robot.run(3.0, SPEED).references is None
    assert [one.release for one in robot.decisions].count(True) == 1


def test_nothing_begins_before_both_controllers_have_said_how_long_they_would_go_on_alone() -> None:
    robot = Robot()
    robot.unsaid = robot.now
    assert robot.run(0.4, SPEED) == drive.Decision(None, False, drive.ASKING, True)
    robot.unsaid = None
    assert robot.run(DT, SPEED).references == wheel_speeds(ROBOT, SPEED)  # nobody has to begin again for that
    robot.run(DT, SPEED)
    robot.unsaid = robot.now  # another controller
    decision = robot.run(DT, SPEED)
    assert decision.references == Wheels(0.0, 0.0) and "does not say how long it would go on" in decision.reason


def test_a_controller_that_never_says_that_is_not_driven() -> None:
    robot = Robot()
    robot.unsaid = robot.now
    decision = robot.run(ANSWERS + 2.0 * DT, SPEED)
    assert decision.references is None and not decision.healthy and "does not say how long" in decision.reason
    assert all(one.references is None for one in robot.decisions)


def test_two_controllers_of_one_wheel_stop_both_wheels() -> None:
    robot = Robot()
    robot.run(1.0, SPEED)
    robot.rivals = "/left/a, /left/b"
    decision = robot.run(DT, SPEED)
    assert decision.references == Wheels(0.0, 0.0) and not decision.healthy
    assert decision.reason.startswith("More than one node controls the left wheel (/left/a, /left/b): end the others;")


def test_after_a_trouble_velocities_begin_again() -> None:
    """Who went on sending through it has not seen it: 0 or a pause first."""
    robot = Robot()
    robot.run(1.0, SPEED)
    robot.said["left"] = "stopped"
    robot.run(1.0, SPEED)
    robot.said["left"] = "running"
    assert robot.run(3.0, SPEED).references is None and not robot.decisions[-1].healthy
    robot.run(DT, STILL)
    assert robot.run(DT, SPEED).references == wheel_speeds(ROBOT, SPEED)
    robot.said["right"] = "stopped"
    robot.run(1.0, SPEED)
    robot.said["right"] = "running"
    robot.run(0.6)
    assert robot.run(DT, SPEED).references == wheel_speeds(ROBOT, SPEED)


class Sender:
    """A node that sends a velocity again and again, and counts."""

    def __init__(self, robot: Robot, period: float, twist: Twist = SPEED) -> None:
        self.robot, self.twist, self.every, self.number, self.steps = robot, twist, round(period / DT), 0, 0

    def run(self, duration: float) -> bool:
        """So long [s]; whether a wheel was told to turn."""
        begun = len(self.robot.decisions)
        for _ in range(round(duration / DT)):
            if self.steps % self.every == 0:
                self.number += 1
                self.robot.send(self.twist, number=self.number)
            self.steps += 1
            self.robot.run(DT)
        return any(one.references not in (None, Wheels(0.0, 0.0)) for one in self.robot.decisions[begun:])


def trouble(robot: Robot, sender: Sender) -> None:
    """A wheel stops for 3 s, and somebody cures it."""
    robot.said["left"] = "stopped"
    sender.run(3.0)
    robot.said["left"] = "running"


@pytest.mark.parametrize("idle", [False, True])  # the other one sends more of them
def test_a_0_of_another_node_lets_no_stream_of_velocities_go_on(idle: bool) -> None:
    """One 0 of an idle teleop, and the robot drove at 14 rad/s 0.13 s after a wheel's output was on again."""
    robot = Robot()
    stream = Sender(robot, 0.04)
    assert stream.run(1.0)
    trouble(robot, stream)
    assert not stream.run(0.5)
    for k in range(20):
        if k == 0 or idle:
            robot.send(STILL, number=1 + k)
        assert not stream.run(0.2)
    assert robot.state.senders.ended > 0 and robot.state.refused_at > robot.now - 0.1
    assert "A cmd_vel that went on through a stop is not obeyed" in robot.decisions[-1].reason
    assert not robot.decisions[-1].healthy
    robot.send(Twist(0.1, 0.0), number=21 if idle else 2)  # who sent the 0 may drive
    assert robot.run(DT).references == wheel_speeds(ROBOT, Twist(0.1, 0.0))
    robot.send(STILL, number=stream.number + 1)  # and so may the stream after its own
    stream.number += 1
    assert stream.run(0.2) and robot.run(DT).references == wheel_speeds(ROBOT, SPEED)


@pytest.mark.parametrize("before", [0.5, 5.0])  # [s] of the stream: one velocity, or some
def test_a_stream_of_velocities_slower_than_their_timeout_has_to_begin_again(before: float) -> None:
    """At 1 Hz each velocity comes after a pause of `cmd_vel_timeout`, and the robot drove by itself at once."""
    robot = Robot()
    stream = Sender(robot, 1.0)
    assert stream.run(before)
    assert stream.run(1.2 - 0.2 * (before > 1.0))  # a timeout lets it go on
    trouble(robot, stream)
    assert not stream.run(20.0)
    stream.steps = stream.every * 100
    robot.run(10.1)
    assert stream.run(0.1)


def test_keys_that_are_pressed_at_any_times_are_obeyed_again_after_a_pause_that_is_said() -> None:
    """A pause of twice the longest one between two presses was asked for, up to 10 s, and not told."""
    robot = Robot()
    number = 0
    for pause in (0.7, 1.9, 0.4):
        number += 1
        robot.send(SPEED, number=number)
        robot.run(pause)
    robot.said["left"] = "stopped"
    robot.run(1.0)
    robot.said["left"] = "running"
    robot.send(SPEED, number=number + 1)
    robot.run(1.9)
    assert robot.decisions[-1].references is None
    assert "send a cmd_vel of 0, or pause for 2 s, before the next velocity" in robot.decisions[-1].reason
    robot.send(SPEED, number=number + 2)
    robot.run(2.1)
    assert robot.decisions[-1].references is None
    robot.send(SPEED, number=number + 3)
    assert robot.run(DT).references == wheel_speeds(ROBOT, SPEED)


def test_who_begins_to_send_velocities_is_obeyed_beside_a_stream_that_goes_on() -> None:
    robot = Robot()
    stream = Sender(robot, 0.04)
    stream.run(1.0)
    trouble(robot, stream)
    robot.send(Twist(0.1, 0.0), number=1)
    assert robot.run(DT).references == wheel_speeds(ROBOT, Twist(0.1, 0.0))
    stream.twist = Twist(0.3, 0.0)
    stream.run(0.6)
    assert robot.state.command is None  # it does not keep the other's velocity alive


@pytest.mark.parametrize("twist", [Twist(nan, 0.0), Twist(0.5, float("inf"))])
def test_what_is_not_a_number_is_a_stop(twist: Twist) -> None:
    robot = Robot()
    robot.run(1.0, SPEED)
    decision = robot.run(DT, twist)
    assert decision.references == Wheels(0.0, 0.0) and "not a number" in decision.reason
    robot.run(0.2, SPEED)
    assert robot.run(DT, SPEED).references in (None, Wheels(0.0, 0.0))


@pytest.mark.parametrize(
    ("age", "timeout", "obeyed"), [(0.4, 0.5, True), (0.6, 0.5, False), (-0.6, 0.5, False), (9.0, 0.0, True)]
)
def test_a_velocity_with_an_old_stamp_is_a_stop(age: float, timeout: float, obeyed: bool) -> None:
    """So is one from the future: of two clocks that differ nobody can tell how old it is."""
    robot = Robot(timeout=timeout)
    robot.run(1.0, SPEED)
    robot.send(SPEED, age)
    decision = robot.run(DT)
    assert (decision.references == Wheels(0.0, 0.0)) != obeyed
    assert ("The stamp of cmd_vel is older" in decision.reason) != obeyed


def test_a_velocity_that_is_refused_is_a_stop_until_they_begin_again() -> None:
    robot = Robot()
    robot.run(0.5, SPEED)
    robot.state = drive.refuse_command(robot.state, "It may be an old one.", robot.now)
    decision = robot.run(0.4, SPEED)
    assert decision.references in (None, Wheels(0.0, 0.0)) and decision.reason.startswith("It may be an old one. Both")
    robot.send(STILL)
    assert robot.run(0.4, SPEED).references == wheel_speeds(ROBOT, SPEED)


@pytest.mark.parametrize("timeout", [0.0, 10.0])
@pytest.mark.parametrize(("pause", "goes_on"), [(0.9, True), (1.1, False), (3.0, False)])
def test_a_drive_that_stood_still_does_not_go_on_by_itself(timeout: float, pause: float, goes_on: bool) -> None:
    """Ctrl-Z and fg, or a suspended computer: the motors have been let go meanwhile, and nobody expects a motion."""
    robot = Robot(Limits(linear_acceleration=1.0), timeout)
    robot.run(1.0, SPEED)
    robot.now += pause
    decision = robot.run(DT)
    assert (decision.references == wheel_speeds(ROBOT, SPEED)) is goes_on
    assert decision.reason.startswith(f"The drive stood still for {pause:.1f} s (Ctrl-Z") is not goes_on
    if goes_on:
        return
    assert decision.references == Wheels(0.0, 0.0)
    assert robot.run(3.0, SPEED).references is None
    robot.run(DT, STILL)
    assert robot.run(1.0, SPEED).references == wheel_speeds(ROBOT, SPEED)


def test_a_robot_that_was_slowing_down_when_its_drive_stood_still_stays_where_it_is() -> None:
    for sent in (None, STILL):
        robot = Robot(Limits(linear_acceleration=1.0))
        robot.run(1.0, SPEED)
        robot.run(0.6)
        assert robot.state.command is None and robot.state.twist.linear > 0.3
        robot.now += 5.0
        if sent is not None:
            robot.send(sent)
        assert robot.run(DT).references == Wheels(0.0, 0.0)


def test_a_wheel_that_stays_behind_makes_up_for_it_and_no_more_than_a_little() -> None:
    for gain, least, most in ((2.0, 0.0, 0.01), (0.0, 0.4, 0.6)):
        robot = Robot(gain=gain)
        robot.slip = Wheels(0.5, 1.0)
        robot.run(0.1, SPEED)
        robot.slip = Wheels(1.0, 1.0)
        robot.run(3.0, SPEED)
        behind = (robot.edges[1] - robot.edges[0]) / 1e6 * 2.0 * 3.141592653589793
        assert least <= behind < most
    robot = Robot(gain=2.0)
    robot.run(1.0, SPEED)
    robot.slip = Wheels(0.0, 1.0)  # blocked for 2 s: 20 rad
    assert max(one.references.left for one in robot.decisions if one.references) < 10.1
    assert robot.run(2.0, SPEED).references == pytest.approx((12.0, 10.0), abs=0.3)
    assert robot.run(DT, STILL).references == (0.0, 0.0)  # at rest nothing is added


@pytest.mark.parametrize(("limit", "most"), [(10.0, 10.0), (0.0, 30.0)])
def test_a_wheel_that_makes_up_for_its_way_keeps_to_its_limit(limit: float, most: float) -> None:
    """A radian is 20 rad/s more at the largest `travel_gain`."""
    robot = Robot(Limits(wheel=limit), gain=20.0)
    robot.slip = Wheels(0.0, 1.0)
    robot.run(2.0, SPEED)
    asked = [one.references for one in robot.decisions if one.references is not None]
    assert max(max(map(abs, one)) for one in asked) == pytest.approx(most)


@pytest.mark.parametrize("wanted", [Geometry(1e-4, ROBOT.wheel_separation), Geometry(ROBOT.wheel_radius, 0.3)])
def test_the_robot_stays_what_it_is_while_it_moves_or_is_asked_to(wanted: Geometry) -> None:
    """A radius of 0.1 mm, set while it drove, sent both motors to their top speed at once."""
    robot = Robot(Limits(linear_acceleration=1.0))

    def refused() -> bool:
        wheels = (robot.wheel(0, "left"), robot.wheel(1, "right"))
        assert drive.refuse_geometry(robot.config, robot.state, wheels, ROBOT) == ""
        return drive.refuse_geometry(robot.config, robot.state, wheels, wanted) == drive.FIXED

    assert not refused()
    robot.send(SPEED)
    assert refused()  # not yet in motion
    robot.run(1.0, SPEED)
    assert refused()
    robot.run(0.1, STILL)
    assert refused()  # slowing down
    robot.run(1.0, STILL)
    assert not refused()
    robot.speeds = Wheels(0.0, -0.1)  # pushed
    assert refused()


@pytest.mark.parametrize(("begin", "end"), [(0.0, 0.9), (0.9, 0.0), (0.5, 0.5)])
def test_a_velocity_counts_from_when_it_comes(begin: float, end: float) -> None:
    """45°/s for so long turn by so much, whenever in a step they begin and end; by whole steps 0.8° more or less."""
    robot = Robot(Limits(angular_acceleration=4.0), timeout=0.0)
    robot.run(DT, STILL)
    for share, twist in ((begin, Twist(0.0, 3.141592653589793 / 4.0)), (end, STILL)):
        robot.now -= (1.0 - share) * DT  # so long before the next step
        robot.send(twist)
        robot.now += (1.0 - share) * DT
        robot.run(2.0)
    turned = (robot.edges[1] - robot.edges[0]) * 360e-6 * ROBOT.wheel_radius / ROBOT.wheel_separation
    assert turned == pytest.approx(45.0 * (2.0 + (end - begin) * DT), abs=0.1)
