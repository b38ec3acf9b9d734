"""The shell that simulated and real motor share, so that they swap: topics, QoS, services, parameters."""

import time
from collections.abc import Callable

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_srvs.srv import SetBool

from motor_model.gearing.gear import angle_of_count
from motor_model.printable import escape
from motor_model.sample import Info, Sample
from motor_msgs.msg import MotorInfo, MotorSpeed, MotorVoltage
from motor_ros import qos
from motor_ros.clocks.hold_ups import STOOD_STILL, HoldUps
from motor_ros.gate import AWAY, CONFLICT, OFF, STOPPED, Gate
from motor_ros.graph.callers import Callers
from motor_ros.graph.commanders import Commanders
from motor_ros.graph.other_plant import OtherPlant
from motor_ros.graph.process_number import tell_crowd
from motor_ros.graph.publishers import count_publishers
from motor_ros.graph.unheard import Unheard
from motor_ros.messages import diagnostic_message, info_message, speed_message, stamp_age
from motor_ros.numbered_input import Arrival, NumberedInput

PLAYED = (
    "A recording of {} is played ({}): the motor gets 0 V until that has ended, and then until 0 V is sent, or "
    "motor/enable is called with data: true. To drive a motor by a recording, use ros2 run motor_identification play "
    "BAG --topics motor/voltage."
)
OLD = (
    "{:.3g} V on motor/voltage is stamped {:.3g} s {}, as what is played from a recording: it is not obeyed. If it is "
    "yours, set both computers' clocks, or leave the stamp empty."
)
OUTLASTS = (
    "command_timeout is {:g} s: once who sends motor/voltage has died, or its network, the motor gets its latest"
    " voltage for as long. 0.1 s is usual."
)
STAYS = "The output stays off.", "The output is on, and the motor stays at 0 V."  # when a call is refused: off, on
JUST_NOW = "Just now, {}: look, then call again."
LOOK_FOR_CROWD_EVERY = 5_000_000_000  # [ns] it takes half a millisecond
NAME = 80  # characters of a sender's frame_id that are looked at and said
UNHEARD = "References are published on {} and nobody hears them: start motor_control in this namespace."


class Plant:
    """Topics, services and the gate of one motor, on a node that says when to sample."""

    def __init__(
        self,
        node: Node,
        info: Info,
        gate: Gate,
        refusal: Callable[[], str] = str,
        changed: Callable[[], None] | None = None,
    ) -> None:
        """`refusal` says why the output cannot be switched on now; `changed` is called after a command, at a switch.

        Commands are taken when `voltage` is asked for: where that is not soon, `changed` has to ask.
        """
        self._node, self.info, self.gate = node, info, gate.come_up(time.monotonic_ns())
        self._refusal, self._changed = refusal, changed or (lambda: None)
        self._turned, self._count = 0, 0  # counts: signed, and the board's own
        self._speed = node.create_publisher(MotorSpeed, "motor/speed", qos.SPEED)
        self._other = OtherPlant(node, self._speed)
        self._info = node.create_publisher(MotorInfo, "motor/info", qos.INFO)
        self._joint = node.create_publisher(JointState, "joint_states", qos.JOINT_STATES)
        self._diagnostics = node.create_publisher(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
        self._commanders, self._played = Commanders(node, "motor/voltage"), ""
        self._best_effort = Unheard(node, "motor/voltage")
        self._unheard = 0  # diagnostics in a row in which nobody heard references
        self._old, self._old_at = "", 0  # the latest voltage with an old stamp, as a sentence, and when [ns] that was
        self._crowd, self._crowd_at = "", 0  # that there are too many processes, and when [ns] they were counted
        self._hold_ups = HoldUps(node)
        self._input = NumberedInput(
            node,
            MotorVoltage,
            "motor/voltage",
            qos.COMMANDS,
            self._on_voltage,
            rings=changed,
            hold_ups=self._hold_ups,
            commanders=self._commanders,
            counts=lambda message, arrival: self.gate.goes_on(_name_of(message), arrival.number, arrival.at),
        )
        service = node.create_service(SetBool, "motor/enable", self._on_enable)
        self._enabling = Callers(node).guard(service, self._would_switch_on, self._refuse)
        if gate.outlasts:
            node.get_logger().warning(OUTLASTS.format(gate.timeout))
        self.publish_info()

    def now(self) -> int:
        """[ns] ROS time."""
        return int(self._node.get_clock().now().nanoseconds)

    def voltage(self, due: int | None = None) -> float:
        """[V] to apply now; the age of commands is judged by a clock that is never set.

        due [ns]: when it was to be applied by a plant that was held up, and catches up: a command that was too old for
        that instant does not act in it.
        """
        self._input.poll()
        limit, now = self.info.max_voltage, time.monotonic_ns()
        if self._commanders.players != self._played:
            self._played = self._commanders.players
            self._node.get_logger().error(self._find_others(now) or "The recording has ended.")
        if self._played or self._other.speaks(now):
            self.gate = self.gate.come_up(now)
        return min(max(self.gate.voltage(now if due is None else due), -limit), limit)

    def stop(self, why: str, motor: bool = False) -> None:
        """Switch the output off until motor/enable; `why` is said. motor: for what the motor did."""
        if self.gate.stopped != why:
            self._node.get_logger().error(STOPPED.format(why))
        if self.gate.enabled or self.gate.stopped != why:
            self._enabling.refuse_waiting(JUST_NOW.format(why))
        self.gate = self.gate.stop_motor(why, time.monotonic_ns()) if motor else self.gate.stop(why)

    def recount(self) -> None:
        """The board has started anew and counts edges from 0 again."""
        self._count = 0

    def publish_info(self) -> None:
        """Say how the samples are to be read; call again when that changes."""
        self._info.publish(info_message(self.info, self._node.get_clock().now().to_msg()))

    def publish(self, sample: Sample, stamp: Time) -> None:
        """Send one sample, and the joint state that viewers draw."""
        message = speed_message(sample, stamp, self.info.name)
        self._other.sent(message)
        self._speed.publish(message)
        turned = sample.edge_count - self._count
        if self.info.single_channel and sample.speed < 0.0:
            turned = -turned
        self._turned += turned
        self._count = sample.edge_count
        if not self._joint.get_subscription_count():  # a viewer is seldom there, and it is 20 us of every sample
            return
        angle = angle_of_count(self._turned, self.info.edges_per_revolution, self.info.gear)
        joint = JointState(name=[self.info.name], position=[angle], velocity=[sample.speed])
        joint.header.stamp = stamp
        self._joint.publish(joint)

    def diagnose(self, problem: str, values: dict[str, str]) -> None:
        """Send one diagnostic status, every second: OK if nothing is wrong, with the gate's state and these values."""
        if count_publishers(self._node, "motor/info") > 1:
            self.publish_info()  # what a recording, or whoever it is, says of another motor does not hold for this one
        now = time.monotonic_ns()
        gate = self.gate.problem(now, self._input.senders(self._node))
        old = self._old if now - self._old_at <= CONFLICT else ""
        around = self._find_others(now), self._look_for_controller(), self._best_effort.look()
        message = " ".join(filter(None, (problem, *around, old, gate, self._look_for_crowd(now))))
        level = DiagnosticStatus.WARN if message else DiagnosticStatus.OK
        sender = self.gate.sender.name if self.gate.sender and self.gate.fresh(now) else ""
        told = diagnostic_message(
            f"{self._node.get_fully_qualified_name()}: {self.info.name}",
            DiagnosticStatus.ERROR if self.gate.stopped else level,
            message or self.gate.state(now),
            {**values, "voltage sender": sender},
            self._node.get_clock().now().to_msg(),
            self.info.name,
        )
        self._diagnostics.publish(told)

    def _find_others(self, now: int) -> str:
        """Say who else is there whom the motor is not to be driven by; empty if nobody is."""
        if players := self._commanders.players:
            return PLAYED.format(self._node.resolve_topic_name("motor/voltage"), players)
        return self._other.problem(now)

    def _look_for_crowd(self, now: int) -> str:
        """Say that there are processes on this machine that do not find each other; this one is found."""
        if now - self._crowd_at >= LOOK_FOR_CROWD_EVERY:
            before, self._crowd, self._crowd_at = self._crowd, tell_crowd(self._node), now
            if self._crowd and not before:
                self._node.get_logger().warning(self._crowd)
        return self._crowd

    def _look_for_controller(self) -> str:
        """Say that references are published and no controller is there, as where it is in another namespace."""
        topic = self._node.resolve_topic_name("motor/reference")
        unheard = self._node.count_publishers(topic) > 0 and not self._node.count_subscribers(topic)
        self._unheard = self._unheard + 1 if unheard else 0
        said = UNHEARD.format(topic) if self._unheard > 1 else ""  # for a second: not only just discovered
        if self._unheard == 2:
            self._node.get_logger().warning(said)
        return said

    def _on_voltage(self, message: MotorVoltage, arrival: Arrival) -> None:
        now, before, voltage = time.monotonic_ns(), self.gate, message.voltage
        if self._is_old(message, now):
            self._node.get_logger().error(self._old, throttle_duration_sec=1.0)
            return
        name, number = _name_of(message), arrival.number
        self.gate = before.take(voltage, arrival.at, name, number, arrival.waited, arrival.sent)
        if self.gate.refused > before.refused:
            said = self.gate.tell_no_number(now, self._input.senders(self._node))
            self._node.get_logger().error(said, throttle_duration_sec=1.0)
        elif not before.problem(now) and (problem := self.gate.problem(now, self._input.senders(self._node))):
            self._node.get_logger().warning(problem, throttle_duration_sec=1.0)

    def _is_old(self, message: MotorVoltage, now: int) -> bool:
        """Whether a voltage is of another time by its stamp; a controller's is that of the sample."""
        age = stamp_age(message.header.stamp, self.now())
        if message.voltage == 0.0 or abs(age) * 1e9 <= max(AWAY, self.gate.timeout * 1e9):
            return False
        self._old, self._old_at = OLD.format(message.voltage, abs(age), "ago" if age > 0.0 else "ahead"), now
        return True

    def _would_switch_on(self, request: SetBool.Request) -> bool:
        return bool(request.data) and not (self.gate.enabled and self.gate.begun)  # not for who calls again and again

    def _on_enable(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        was_on = self.gate.enabled
        self._changed()  # a stop that is due comes before what is asked for now
        now = time.monotonic_ns()
        refusal = self._find_refusal(now) if request.data else ""
        self.gate = self.gate.call(now) if request.data else self.gate
        if request.data and was_on and not self.gate.enabled:
            refusal = JUST_NOW.format(self.gate.stopped)
        if refusal:
            return self._refuse(request, response, refusal)
        if not request.data:
            self._enabling.refuse_waiting(JUST_NOW.format("it was switched off by motor/enable"))
        self._input.forget()  # nor does a command from before the switch act that waits for its sender to be known
        self.gate = self.gate.enable(request.data, now)
        self._changed()
        response.success = True
        response.message = "The output is on." if request.data else OFF
        return response

    def _find_refusal(self, now: int) -> str:
        """Find why the output may not be switched on at `now` [ns], as a sentence; empty if it may.

        What was called while this process stood still is carried out when it goes on, and whoever called then may have
        given up long ago.
        """
        stood = STOOD_STILL if self._hold_ups.bars(0) else ""
        mixed = self.gate.tell_mixed(now, self._input.senders(self._node))
        return self.gate.refusal(now) or stood or self._find_others(now) or mixed or self._refusal()

    def _refuse(self, _: SetBool.Request, response: SetBool.Response, why: str) -> SetBool.Response:
        response.success, response.message = False, f"{STAYS[self.gate.enabled]} {why}"
        return response


def _name_of(message: MotorVoltage) -> str:
    """What a sender calls itself, as it may stand in a log: strangers write it."""
    return escape(message.header.frame_id[: NAME + 1], NAME)
