"""A robot of two simulated motors as a user drives it: there, its pose, one wheel that is switched off, and the end."""

import time
from collections.abc import Callable
from itertools import count
from math import sin
from subprocess import Popen

import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from patience import PATIENCE
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter as RosParameter
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64
from std_srvs.srv import SetBool, Trigger
from workbench import DOMAIN, Bench, end

from motor_examples.diff_drive import drive, wheel
from motor_examples.diff_drive.kinematics import STILL
from motor_examples.diff_drive.kinematics import Twist as Velocity
from motor_examples.diff_drive.motor import ASK_AGAIN
from motor_examples.diff_drive.node import DiffDrive
from motor_model.sample import Info, Sample
from motor_msgs.msg import ControlState
from motor_ros import qos
from motor_ros.clocks.hold_ups import boot_time
from motor_ros.loopback import stay_on_this_machine

Start = Callable[..., "Popen[str]"]
SIDES = ("left", "right")
RADIUS, SEPARATION = 0.05, 0.2  # [m]


class Driver:
    """Sends a velocity every 50 ms, and begins again with 0 where the drive says so: the machine may be held up."""

    def __init__(self, bench: Bench) -> None:
        self.bench, self.twist, self.begins_again = bench, (0.0, 0.0), True
        self.reason, self._level, self._zeros = "", DiagnosticStatus.OK, 0
        self._publisher = bench.publisher(Twist, "cmd_vel", qos.REFERENCE)
        bench.node.create_subscription(DiagnosticArray, "/diagnostics", self._on_diagnostics, qos.DIAGNOSTICS)
        bench.node.create_timer(0.05, self._send)
        bench.heard(self._publisher)

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        for status in message.status:
            if status.name == "/diff_drive":
                self.reason, self._level = status.message, status.level
                self._zeros = 4 if status.level == DiagnosticStatus.ERROR and self.begins_again else 0

    def _send(self) -> None:
        self._zeros = max(self._zeros - 1, 0)
        twist = Twist()
        if not self._zeros:
            twist.linear.x, twist.angular.z = self.twist
        self._publisher.publish(twist)


def held(timeout: float) -> SetParameters.Request:
    value = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=timeout)
    return SetParameters.Request(parameters=[Parameter(name="reference_timeout", value=value)])


def start_wheels(start: Start, *timeouts: float) -> None:
    """Two simulated motors, and a controller for each that drops a reference after so long [s]."""
    for side, timeout in zip(SIDES, timeouts, strict=True):
        options = ("--ros-args", "-r", f"__ns:=/{side}", "-p")
        start("motor_sim", "motor_sim", *options, f"name:={side}", "-p", "single_channel:=false")
        start("motor_control", "motor_control", *options, f"reference_timeout:={timeout}", "-p", "latency_limit:=0.5")


@pytest.mark.parametrize(
    ("given", "timeout", "words"),
    [
        ("max_lineer", 2.0, "There is no parameter max_lineer, and max_linear may be meant: correct that, and start"),
        ("max_linear", 0.0, "The controller of the right wheel would go on if this drive died"),
        ("max_linear", 60.0, "The controller of the right wheel would go on for 60 s if this drive died"),
    ],
)
def test_a_drive_in_doubt_asks_two_motors_for_no_motion(
    bench: Bench, start: Start, given: str, timeout: float, words: str
) -> None:
    """Not for a moment, whoever begins again and again; the same robot drives in the test below."""
    start_wheels(start, 2.0, timeout)
    start("motor_examples", "diff_drive", "--ros-args", "-p", f"{given}:=0.1")
    references = [bench.hear(Float64, f"{side}/motor/reference", qos.REFERENCE) for side in SIDES]
    states = [bench.hear(ControlState, f"{side}/motor/control_state", qos.CONTROL_STATE) for side in SIDES]
    poses = bench.hear(Odometry, "odom", qos.ODOMETRY)
    driver = Driver(bench)
    driver.twist = (0.4, 1.0)
    bench.wait(lambda: all(states) and driver.reason.startswith(words), "the words")
    seen = len(poses)
    bench.wait(lambda: len(poses) > seen + 100, "two seconds of them")
    assert not any(one.data for side in references for one in side) and poses[-1].pose.pose.position.x == 0.0


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("-r", "~/get_parameters:=/away/get_parameters"), "The controller of the left wheel does not say how long"),
        ((), "More than one node controls the left wheel (/left/motor_control, /left/second): end the others"),
    ],
)
def test_a_drive_that_does_not_know_who_controls_a_wheel_asks_for_no_motion(
    bench: Bench, start: Start, options: tuple[str, ...], words: str
) -> None:
    """It drove both after 3 s; beside a controller that answered nothing and held its references for ever, too."""
    left = ("--ros-args", "-r", "__ns:=/left", "-p", "latency_limit:=0.5")
    for side in SIDES:
        namespace = ("--ros-args", "-r", f"__ns:=/{side}")
        start("motor_sim", "motor_sim", *namespace, "-p", f"name:={side}", "-p", "single_channel:=false")
    start("motor_control", "motor_control", *left, *options, "-p", "reference_timeout:=0.0" if options else "kp:=0.2")
    start("motor_control", "motor_control", "--ros-args", "-r", "__ns:=/right", "-p", "reference_timeout:=0.5")
    if not options:
        start("motor_control", "motor_control", *left, "-r", "__node:=second")
    references = [bench.hear(Float64, f"{side}/motor/reference", qos.REFERENCE) for side in SIDES]
    states = [bench.hear(ControlState, f"{side}/motor/control_state", qos.CONTROL_STATE) for side in SIDES]
    bench.wait(lambda: all(any(one.state == "disabled" for one in side) for side in states), "both controllers")
    start("motor_examples", "diff_drive")
    poses = bench.hear(Odometry, "odom", qos.ODOMETRY)
    driver = Driver(bench)
    driver.twist = (0.4, 1.0)
    bench.wait(lambda: driver.reason.startswith(words), "the words")
    seen = len(poses)
    bench.wait(lambda: len(poses) > seen + 200, "four seconds of them")
    assert not any(one.data for side in references for one in side) and poses[-1].pose.pose.position.x == 0.0


def test_questions_that_nobody_answers_are_not_kept(bench: Bench) -> None:
    """One was added every second, for as long as a controller hung."""
    rclpy.init(args=[], domain_id=int(DOMAIN))
    node, hung = DiffDrive(), rclpy.create_node("motor_control", context=bench._context, namespace="left")
    try:
        hung.create_publisher(ControlState, "motor/control_state", qos.CONTROL_STATE)
        hung.create_service(Trigger, "motor/release", lambda _, response: response)  # never spun
        motor, asked = node._left, set()

        def ask(times: int) -> bool:
            motor._asked_at = 0.0
            motor.meet_controller()
            motor.release()
            asked.add(motor._question)
            return len(asked - {None}) >= times and motor._let_go is not None

        bench.wait(lambda: ask(5), "questions")
        assert motor._asked is not None and len(motor._asked._pending_requests) == 1
        assert len(motor._release._pending_requests) == 1
        assert motor.wheel.reference_timeout is None and motor.wheel.unsaid_since is not None
    finally:
        hung.destroy_node()
        node.destroy_node()
        rclpy.shutdown()


def test_a_controller_without_that_parameter_is_asked_again_no_sooner_than_one_that_hangs(bench: Bench) -> None:
    """It was asked at every look, ten times a second, for as long as it was there."""
    rclpy.init(args=[], domain_id=int(DOMAIN))
    node, other = DiffDrive(), rclpy.create_node("motor_control", context=bench._context, namespace="left")
    bench.executor.add_node(other)
    try:
        other.create_publisher(ControlState, "motor/control_state", qos.CONTROL_STATE)
        motor, asked = node._left, []

        def looked(times: int) -> bool:
            motor.meet_controller()
            asked.extend([motor._question] if motor._question not in (None, *asked) else [])
            rclpy.spin_once(node, timeout_sec=0.02)
            return len(asked) > 0 and asked[0].done() and next(looks) >= times

        looks = count(1)
        bench.wait(lambda: looked(5), "looks")
        assert len(asked) == 1 and motor.wheel.unsaid_since is not None
        motor._asked_at -= 1.01 * ASK_AGAIN
        motor.meet_controller()
        assert motor._question is not asked[0]
    finally:
        other.destroy_node()
        node.destroy_node()
        rclpy.shutdown()


@pytest.mark.parametrize(
    "given", [("-p", "right:=left"), ("-p", "right:=/left"), ("-r", "right/motor/reference:=left/motor/reference")]
)
def test_a_drive_of_one_motor_is_none(start: Start, given: tuple[str, str]) -> None:
    """It told that motor both wheels' speeds in turn, and said that it drove."""
    process = start("motor_examples", "diff_drive", "--ros-args", *given)
    _, said = process.communicate(timeout=PATIENCE)
    assert process.returncode == 1 and "Both wheels would be the motor that is told on /left/motor/reference" in said


def hear_both_wheels(node: DiffDrive) -> None:
    """Both controllers run, and have just been heard."""
    for motor in (node._left, node._right):
        info, sample = Info(single_channel=False), Sample(1, 0.0, 1.0)
        told = wheel.Wheel(motor.wheel.name, info=info, sample=sample, reference_timeout=2.0)
        motor.wheel = wheel.follow_controller(told, "running", "", 1.0, boot_time())
        motor.wheel = wheel.follow_sample(motor.wheel, Sample(2, 0.0, 1.0), boot_time())


def test_a_drive_whose_computer_was_suspended_does_not_go_on_by_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    """The clock that is never set stands still meanwhile, so that the velocity was as fresh as before."""
    asleep, read = [0.0], time.clock_gettime
    monkeypatch.setattr(time, "clock_gettime", lambda it: read(it) + asleep[0] * (it == time.CLOCK_BOOTTIME))
    stay_on_this_machine()
    rclpy.init(args=[], domain_id=int(DOMAIN))
    node = DiffDrive()
    try:
        hear_both_wheels(node)
        node._state = drive.take_command(node._config, node._state, Velocity(0.3, 0.0), boot_time())
        node._on_timer()
        assert node._decision.reason == drive.DRIVING
        asleep[0] = 600.0
        hear_both_wheels(node)
        node._on_timer()
        assert node._decision.reason.startswith("The drive stood still for 600.") and node._state.twist == STILL
    finally:
        node.destroy_node()
        rclpy.shutdown()


def test_a_drive_refuses_another_radius_while_it_drives_and_keeps_its_own() -> None:
    stay_on_this_machine()
    rclpy.init(args=[], domain_id=int(DOMAIN))
    node = DiffDrive()
    try:
        other, limit = RosParameter("wheel_radius", value=0.01), RosParameter("max_linear", value=0.2)
        assert node.set_parameters_atomically([RosParameter("wheel_radius", value=0.05)]).successful
        hear_both_wheels(node)
        node._state = drive.take_command(node._config, node._state, Velocity(0.3, 0.0), boot_time())
        answer = node.set_parameters_atomically([other])
        assert not answer.successful and answer.reason == drive.FIXED
        assert node.set_parameters_atomically([limit]).successful
        assert (node._config.geometry.wheel_radius, node._config.limits.linear) == (0.05, 0.2)
    finally:
        node.destroy_node()
        rclpy.shutdown()


@pytest.mark.long
def test_a_robot_is_driven_and_stops_where_one_wheel_does(bench: Bench, start: Start) -> None:
    start_wheels(start, 2.0, 2.0)
    robot = ("-p", f"wheel_radius:={RADIUS}", "-p", f"wheel_separation:={SEPARATION}", "-p", "right_reversed:=true")
    drive = start("motor_examples", "diff_drive", "--ros-args", *robot)
    poses = bench.hear(Odometry, "odom", qos.ODOMETRY)
    states = {side: bench.hear(ControlState, f"{side}/motor/control_state", qos.CONTROL_STATE) for side in SIDES}
    joints = {side: bench.hear(JointState, f"{side}/joint_states", qos.JOINT_STATES) for side in SIDES}
    driver = Driver(bench)
    bench.wait(lambda: bool(poses) and all(states.values()), "both motors")

    driver.twist = (0.4, 1.0)
    bench.wait(lambda: poses[-1].pose.pose.position.y > 0.1, "a way to the left")
    assert poses[-1].twist.twist.linear.x == pytest.approx(0.4, abs=0.2)
    assert (poses[-1].header.frame_id, poses[-1].child_frame_id) == ("odom", "base_link")

    player = rclpy.create_node("rosbag2_player", context=bench._context)
    player.create_publisher(Twist, "cmd_vel", qos.REFERENCE)
    bench.wait(lambda: "A recording of cmd_vel is played (/rosbag2_player)" in driver.reason, "the words")
    bench.wait(lambda: abs(poses[-1].twist.twist.linear.x) < 0.01, "the robot to stand")
    player.destroy_node()
    bench.wait(lambda: poses[-1].twist.twist.linear.x > 0.3, "the robot to go on")

    driver.begins_again = False
    assert bench.call(SetBool, "left/motor/enable", SetBool.Request(data=False)).success
    bench.wait(lambda: "left wheel" in driver.reason, "the reason")
    bench.wait(lambda: all(joints[side][-1].velocity[0] == 0.0 for side in SIDES), "a standstill")
    turned = [RADIUS * joints[side][-1].position[0] * sign for side, sign in zip(SIDES, (1.0, -1.0), strict=True)]
    seen, slot = poses[-1].pose.pose.orientation, RADIUS * 0.0654
    bench.wait(lambda: states["right"][-1].state == "disabled", "a motor that was let go")
    heading = (turned[1] - turned[0]) / SEPARATION
    assert 2.0 * seen.z * seen.w == pytest.approx(sin(heading), abs=2.0 * slot / SEPARATION)

    assert bench.call(SetBool, "left/motor/enable", SetBool.Request(data=True)).success
    driver.begins_again, before = True, joints["right"][-1].position[0]
    bench.wait(lambda: joints["right"][-1].position[0] < before - 1.0, "motion again")
    assert bench.call(SetParameters, "right/motor_control/set_parameters", held(0.0)).results[0].successful
    bench.wait(lambda: "right wheel would go on" in driver.reason, "a controller that holds for ever")
    bench.wait(lambda: all(joints[side][-1].velocity[0] == 0.0 for side in SIDES), "a standstill")
    assert bench.call(SetParameters, "right/motor_control/set_parameters", held(2.0)).results[0].successful
    bench.wait(lambda: "would go on" not in driver.reason, "a controller that does not")
    end(drive)
    assert drive.returncode == 0
    bench.wait(lambda: all(states[side][-1].state == "disabled" for side in SIDES), "both motors let go")
